// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Drilling cycles of the CL file: depth, pecks, dwell.
#include "alignment.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cusp::post::verify {

namespace {

using reader::ExecutedMotion;

bool isRapid(const ExecutedMotion& motion) { return motion.code == reader::MotionCode::Rapid; }

}  // namespace

const ExpectedCycle* Alignment::nextHole() const {
    const std::uint32_t cycle = done() ? none : expected_->points[next_].cycle;
    return cycle == none ? nullptr : &expected_->cycles[cycle];
}

/// On the way to the bottom the tool may go up and down: at rapid where it has cut, at the feed below, and in pecks as the
/// CL file has them, the last one as deep as is left.
void Alignment::inHole(const ExecutedMotion& motion, const ExpectedCycle& cycle, double fraction) {
    const std::size_t line = expected_->points[next_].line;
    const double below_mm = fraction * (cycle.approach_mm + cycle.depth_mm) - cycle.approach_mm;
    if (below_mm <= -cycle.approach_mm + tolerance_.tip_mm) hole_.out = true;
    const double deeper_mm = below_mm - hole_.drilled_mm;
    if (deeper_mm <= tolerance_.tip_mm) return;
    const auto differs = [&](const std::string& what) {
        findings_.error("verify.cycle", motion.place, fmt::format("{} in the hole of CL line {}", what, line));
    };
    if (isRapid(motion) && fraction < 1.0)
        findings_.error(
            "verify.kind", motion.place,
            fmt::format("a rapid (G0) goes {:.4g} mm into uncut material in the hole of CL line {}", deeper_mm, line));
    if (cycle.largest_peck_mm && deeper_mm > *cycle.largest_peck_mm + tolerance_.tip_mm)
        differs(fmt::format("drills {:.4g} mm at once, more than {:.4g} mm,", deeper_mm, *cycle.largest_peck_mm));
    if (cycle.smallest_peck_mm && hole_.peck_mm && *hole_.peck_mm < *cycle.smallest_peck_mm - tolerance_.tip_mm)
        differs(fmt::format("drilled {:.4g} mm before this, less than {:.4g} mm,", *hole_.peck_mm,
                            *cycle.smallest_peck_mm));
    if (cycle.smallest_peck_mm && hole_.peck_mm && hole_.out != cycle.comes_out)
        differs(cycle.comes_out ? "does not come out after a peck"
                                : "comes out after a peck, which only breaks the chip,");
    hole_ = {below_mm, deeper_mm, false};
}

/// On the way out of a hole.
void Alignment::checkDwell(const ExecutedMotion& motion, const ExpectedPoint& point) {
    std::size_t bottom = next_;
    while (bottom > 0 && expected_->points[bottom].cycle == none) --bottom;
    const ExpectedCycle& cycle = expected_->cycles[expected_->points[bottom].cycle];
    if (!cycle.dwell_s || std::abs(dwelt_s_.value_or(0.0) - *cycle.dwell_s) <= 1e-3) return;
    findings_.error("verify.cycle", motion.place,
                    fmt::format("dwells {:.4g} s at the bottom of the hole of CL line {}, which has {:.4g} s",
                                dwelt_s_.value_or(0.0), point.line, *cycle.dwell_s));
}

}  // namespace cusp::post::verify
