// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The motions of drilling cycles, written down a second time from the programming guide.
#pragma once

#include "nc_blocks.hpp"

#include <vector>

namespace cusp::post::verify::test {

/// A way to a height, or a stop.
struct HoleStep {
    double height = 0.0;
    bool rapid = false;
    double feed_mm_per_min = 0.0;
    double rpm = 0.0;      ///< 0: as before
    int spindle = 0;       ///< M function from here on, 0: as before
    double dwell_s = 0.0;  ///< > 0: no way but a stop
};

/// Siemens, Programming Guide Cycles (PGZ): CYCLE81 to CYCLE85 with depths as absolute values.
[[nodiscard]] std::vector<HoleStep> holeSteps(const NcBlock& call, double feed_mm_per_min);
/// SDAC of CYCLE84; 0 when it names no M function.
[[nodiscard]] int spindleAfterTap(const NcBlock& call);

}  // namespace cusp::post::verify::test
