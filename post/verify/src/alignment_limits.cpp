// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Rotary limits, of programmed positions and of those the control chooses; travel of the linear axes.
#include "alignment.hpp"

#include <cusp/post/reader/move_sampler.hpp>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace cusp::post::verify {

namespace {

using reader::ExecutedMotion;

constexpr double same_axis_rad = 1e-12;
/// Between tests of what the rotary axes can reach.
constexpr double reach_step_rad = base::radFromDeg(1.0);
/// Rounding of limits between degrees and radians.
constexpr double limit_slack_rad = 1e-9;
/// Rounding of printed positions.
constexpr double travel_slack_mm = 1e-4;
/// Between looks at the linear axes while rotary ones turn: of a lever of 0.5 m, 0.02 mm may go unseen.
constexpr double travel_step_rad = base::radFromDeg(1.0);
constexpr int most_looks = 720;

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
    const int count = stepsFor(way / reach_step_rad, most_looks);
    for (int sample = 1; sample <= count; ++sample) {
        const double fraction = static_cast<double>(sample) / count;
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

/// Under TRAORI the linear axes follow the rotary ones on curved ways. Where the control chooses the rotary positions, the
/// linear ones are its choice as well.
void Alignment::checkTravel(const ExecutedMotion& motion) {
    if (motion.machine_coordinates) return checkSuppressed(motion);
    if (!motion.end_pose) return;
    reader::RotaryValues from{};
    reader::RotaryValues to{};
    bool known = !motion.vector_programmed;
    for (std::size_t i = 0; i < chain_.rotaryCount(); ++i) {
        known = known && motion.end.rotary_rad[i];
        to[i] = motion.end.rotary_rad[i].value_or(0.0);
        from[i] = motion.start.rotary_rad[i].value_or(to[i]);
    }
    const bool follows = motion.orientation_path == reader::OrientationPath::RotaryLinear ||
                         reader::rotaryTravel(motion) < same_axis_rad;
    if (!known || !follows || !chain_.linearPositions(motion.end_pose->tip_mm, to, motion.placement)) {
        ++report_.travel_unchecked;
        return;
    }
    ++report_.travel_checked;
    const double turns = motion.start_pose ? reader::rotaryTravel(motion) : 0.0;
    const bool arc = motion.arc && motion.start_pose;
    const double way = std::max(turns, arc ? std::abs(motion.arc->sweep_rad) : 0.0);
    const int looks = stepsFor(way / travel_step_rad, most_looks);
    for (int look = 1; look <= looks; ++look) {
        const double fraction = static_cast<double>(look) / looks;
        reader::RotaryValues rotary{};
        for (std::size_t i = 0; i < chain_.rotaryCount(); ++i) rotary[i] = from[i] + fraction * (to[i] - from[i]);
        const reader::Vector3 tip =
            look < looks ? reader::poseAt(motion, chain_, fraction).tip_mm : motion.end_pose->tip_mm;
        const auto at = chain_.linearPositions(tip, rotary, motion.placement);
        if (at && !checkPositions(motion, {(*at)[0], (*at)[1], (*at)[2]})) return;
    }
}

/// SUPA names machine positions; along the spindle only without a tool length, which is not suppressed.
void Alignment::checkSuppressed(const ExecutedMotion& motion) {
    std::array<std::optional<double>, 3> at;
    static constexpr std::array<std::string_view, 3> names = {"X", "Y", "Z"};
    for (std::size_t i = 0; i < std::min<std::size_t>(3, chain_.linearCount()); ++i)
        for (std::size_t j = 0; j < 3; ++j)
            if (chain_.linearName(i) == names[j] && (j != 2 || motion.state->cutting_edge == 0))
                at[i] = motion.end.linear_mm[j];
    static_cast<void>(checkPositions(motion, at));
}

bool Alignment::checkPositions(const ExecutedMotion& motion, const std::array<std::optional<double>, 3>& at_mm) {
    for (std::size_t i = 0; i < std::min<std::size_t>(3, chain_.linearCount()); ++i) {
        if (!at_mm[i]) continue;
        const machine::LinearAxis& axis = chain_.linearAxis(i);
        const bool below = *at_mm[i] < axis.min_mm - travel_slack_mm;
        if (!below && *at_mm[i] <= axis.max_mm + travel_slack_mm) continue;
        ++report_.limit_violations;
        ++report_.travel_violations;
        findings_.error("verify.limit", motion.place,
                        fmt::format("axis {} is at {:.4f} mm, beyond its limit {:.6g} mm", chain_.linearName(i),
                                    *at_mm[i], below ? axis.min_mm : axis.max_mm));
        return false;
    }
    return true;
}

}  // namespace cusp::post::verify
