// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Between block ends: off the move of the CL file, and the long way round.
#include "alignment.hpp"

#include <cusp/post/reader/move_sampler.hpp>
#include <fmt/format.h>
#include <numbers>

namespace cusp::post::verify {

namespace {

using reader::ExecutedMotion;

/// Rounding of limits between degrees and radians.
constexpr double limit_slack_rad = 1e-9;
/// Two turns: no way between two CL points takes more, and nothing is sampled for it.
constexpr double most_travel_rad = 4.0 * std::numbers::pi;
/// Printed rotary values differ from the exact ones; far below any wrong branch away from the pole.
constexpr double branch_slack_rad = base::radFromDeg(0.1);

bool isRapid(const ExecutedMotion& motion) { return motion.code == reader::MotionCode::Rapid; }

}  // namespace

void Alignment::checkBetween(const ExecutedMotion& motion, double to) {
    // A block behind one that leads nowhere comes from off the path; that one is named.
    if (next_ == 0 || !at_ || !motion.start_pose || !difference(*motion.start_pose, *at_).within(tolerance_)) return;
    if (reader::rotaryTravel(motion) > most_travel_rad) return;
    const ExpectedPoint& point = expected_->points[next_];
    const PoseError stray = strayBetween(motion, chain_, nextMove(), fraction_, to);
    const bool rapid = isRapid(motion);
    raise(rapid ? report_.max_tip_between_rapid_mm : report_.max_tip_between_mm, stray.tip_mm, motion.place,
          point.line);
    raise(rapid ? report_.max_axis_between_rapid_rad : report_.max_axis_between_rad, stray.axis_rad, motion.place,
          point.line);
    if (stray.tip_mm > options_.between_tip_tolerance_mm)
        findings_.error(
            "verify.between-tip", motion.place,
            fmt::format("between its ends the tip is up to {:.3g} mm off the move to CL line {}, tolerance {:.3g} mm",
                        stray.tip_mm, point.line, options_.between_tip_tolerance_mm));
    if (!rapid && options_.between_axis_tolerance_rad && stray.axis_rad > *options_.between_axis_tolerance_rad)
        findings_.error(
            "verify.between-axis", motion.place,
            fmt::format("between its ends the tool axis is up to {:.3g}° off the move to CL line {}, tolerance {:.3g}°",
                        base::degFromRad(stray.axis_rad), point.line,
                        base::degFromRad(*options_.between_axis_tolerance_rad)));
}

/// A wrong branch or winding is right at every block end: only the way between shows it. Rotary axes that run linearly
/// between two ends on the same branch leave the great circle by at most half the angle between the ends, the pole
/// included (C sweeping by 2φ at tilt a: a·(1 − cos φ) against an angle of 2·a·sin φ); on the wrong one by far more.
void Alignment::checkTurns(const ExecutedMotion& motion, std::size_t cl_line) {
    if (!motion.start_pose || !at_) return;
    const double travel = reader::rotaryTravel(motion);
    if (travel > most_travel_rad)
        return findings_.error(
            "verify.winding", motion.place,
            fmt::format("a rotary axis turns {:.4g}° on the way to CL line {}", base::degFromRad(travel), cl_line));
    const double turn = reader::angleBetween(motion.start_pose->axis, motion.end_pose->axis);
    if (travel <= 2.0 * turn + branch_slack_rad) return;
    ExecutedMotion linear = motion;
    linear.orientation_path = reader::OrientationPath::RotaryLinear;
    const PoseError stray = strayBetween(linear, chain_, {*motion.start_pose, *motion.end_pose}, 0.0, 1.0);
    const bool keeps_axis = stray.axis_rad <= turn + branch_slack_rad;
    if (keeps_axis && travel <= std::numbers::pi + limit_slack_rad) return;
    // Beside the pole, where a turn hardly moves the tool axis, half a turn and what the way past the pole adds to it.
    const double most_rad = (keeps_axis ? 1.5 : 1.0) * std::numbers::pi + limit_slack_rad;
    const std::string text = fmt::format(
        "the rotary axes go the long way round in this {} to CL line {}: one turns {:.4g}°, the tool axis swings {:.3g}° "
        "off a way of {:.3g}°",
        isRapid(motion) ? "rapid" : "feed move", cl_line, base::degFromRad(travel), base::degFromRad(stray.axis_rad),
        base::degFromRad(turn));
    // In a rapid, a change of branch on the way to the next cut may be meant.
    if (!isRapid(motion) && (stray.axis_rad > options_.pole_cone_rad || travel > most_rad))
        findings_.error("verify.winding", motion.place, text);
    else
        findings_.warning("verify.winding", motion.place, text);
}

}  // namespace cusp::post::verify
