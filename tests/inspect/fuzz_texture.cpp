// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Fuzz entry of the stylus reader: any bytes end in a profile with finite heights, or in a problem.
#include <cusp/inspect/texture_profile.hpp>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <sstream>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::istringstream in(std::string(data, data + size));
    cusp::base::Diagnostics warnings;
    const auto profile = cusp::inspect::readStylusProfile(in, "fuzz", warnings);
    if (!profile) {
        if (!profile.error().hasErrors()) std::abort();
        return 0;
    }
    if (!(profile->spacing_mm > 0.0) || profile->height_mm.size() < 100) std::abort();
    for (const double height : profile->height_mm)
        if (!std::isfinite(height)) std::abort();
    return 0;
}
