// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Rotary limits, of programmed positions and of those the control chooses.
#include "alignment.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cusp::post::verify {

namespace {

using reader::ExecutedMotion;

constexpr double same_axis_rad = 1e-12;
/// Between tests of what the rotary axes can reach.
constexpr double reach_step_rad = base::radFromDeg(1.0);
/// Rounding of limits between degrees and radians.
constexpr double limit_slack_rad = 1e-9;

}  // namespace

void Alignment::checkLimits(const ExecutedMotion& motion) {
    for (std::size_t i = 0; i < chain_.rotaryCount(); ++i) {
        const auto& value = motion.end.rotary_rad[i];
        const machine::RotaryAxis& axis = chain_.rotaryAxis(i);
        if (!value) continue;
        const bool below = axis.min_rad && *value < *axis.min_rad - limit_slack_rad;
        const bool above = axis.max_rad && *value > *axis.max_rad + limit_slack_rad;
        if (!below && !above) continue;
        ++report_.limit_violations;
        findings_.error("verify.limit", motion.place,
                        fmt::format("axis {} is at {:.6g}°, beyond its limit {:.6g}°", chain_.rotaryName(i),
                                    base::degFromRad(*value), base::degFromRad(below ? *axis.min_rad : *axis.max_rad)));
    }
}

/// Where the control chooses the rotary positions (vectors, and every great circle between two ends), some position within
/// the limits must give the tool axis, at the end and on the way.
void Alignment::checkReach(const ExecutedMotion& motion) {
    if (!motion.end_pose || !motion.transformation) return;
    const bool on_circle = motion.orientation_path == reader::OrientationPath::GreatCircle && motion.start_pose;
    if (!motion.vector_programmed && !on_circle) return;
    const double way = on_circle ? reader::angleBetween(motion.start_pose->axis, motion.end_pose->axis) : 0.0;
    if (!motion.vector_programmed && way < same_axis_rad) return;
    const double count = std::max(1.0, std::ceil(way / reach_step_rad));
    for (double sample = 1.0; sample <= count; sample += 1.0) {
        const double fraction = sample / count;
        const reader::Vector3 axis =
            on_circle ? reader::onGreatCircle(motion.start_pose->axis, motion.end_pose->axis, fraction)
                      : motion.end_pose->axis;
        const auto reached = chain_.reaches(axis);
        if (!reached) report_.rotary_limits_checked = false;
        if (!reached || *reached) continue;
        ++report_.limit_violations;
        return findings_.error(
            "verify.limit", motion.place,
            fmt::format(
                "no position of the rotary axes within their limits gives the tool axis ({:.6f}, {:.6f}, {:.6f}){}",
                axis.x, axis.y, axis.z, fraction < 1.0 ? ", which lies on the way" : ""));
    }
}

}  // namespace cusp::post::verify
