// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Fuzz entry of the QIF reader: any bytes end in results whose capability can be computed, or in a problem.
#include <cusp/inspect/capability.hpp>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <sstream>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cusp;
    std::istringstream in(std::string(data, data + size));
    base::Diagnostics warnings;
    const auto results = inspect::readQif(in, "fuzz", warnings);
    if (!results) {
        if (!results.error().hasErrors()) std::abort();
        return 0;
    }
    for (const auto& measured : results->measurements)
        if (measured.part >= results->parts.size() || measured.characteristic >= results->characteristics.size())
            std::abort();
    if (!results->points.directions.empty() && results->points.directions.size() != results->points.size())
        std::abort();
    static_cast<void>(inspect::capabilityOf({&*results, 1}));
    return 0;
}
