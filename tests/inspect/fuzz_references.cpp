// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Fuzz entry of reference files: any bytes end in a finite pose, or in a problem.
#include <cusp/inspect/reference_alignment.hpp>

#include <cstdint>
#include <cstdlib>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cusp;
    const std::string text(data, data + size);
    const auto references = inspect::readReferences(text, "fuzz");
    if (!references) {
        if (!references.error().hasErrors()) std::abort();
        return 0;
    }
    const auto found = inspect::alignToReferences(*references);
    if (!found) {
        if (!found.error().hasErrors()) std::abort();
        return 0;
    }
    if (!found->nominal_from_measured.matrix().allFinite()) std::abort();
    if (found->residuals_mm.size() != references->size()) std::abort();
    return 0;
}
