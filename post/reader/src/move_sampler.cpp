// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Lines, arcs, machine axes, linear rotary motion and great circles.
#include <cusp/post/reader/move_sampler.hpp>

#include <algorithm>

namespace cusp::post::reader {

namespace {

Vector3 onArc(const Arc& arc, double fraction) {
    const double angle = arc.start_angle_rad + fraction * arc.sweep_rad;
    const double radius = arc.start_radius_mm + fraction * (arc.end_radius_mm - arc.start_radius_mm);
    return arc.center_mm + (radius * std::cos(angle)) * arc.first + (radius * std::sin(angle)) * arc.second +
           (fraction * arc.height_mm) * arc.normal;
}

bool rotaryKnown(const ExecutedMotion& motion, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
        if (!motion.start.rotary_rad[i] || !motion.end.rotary_rad[i]) return false;
    return true;
}

RotaryValues valuesOf(const AxisPositions& at) {
    RotaryValues values{};
    for (std::size_t i = 0; i < max_rotary_axes; ++i) values[i] = at.rotary_rad[i].value_or(0.0);
    return values;
}

}  // namespace

ToolPose poseAt(const ExecutedMotion& motion, const ForwardChain& chain, double fraction) {
    const ToolPose& start = *motion.start_pose;
    const ToolPose& end = *motion.end_pose;
    ToolPose pose;
    const Vector3 on_path = motion.arc ? onArc(*motion.arc, fraction)
                                       : (1.0 - fraction) * motion.path_start_mm + fraction * motion.path_end_mm;
    pose.tip_mm = on_path;
    const std::size_t count = chain.rotaryCount();
    if (motion.orientation_path == OrientationPath::GreatCircle || !rotaryKnown(motion, count)) {
        pose.axis = onGreatCircle(start.axis, end.axis, fraction);
        return pose;
    }
    RotaryValues values{};
    for (std::size_t i = 0; i < count; ++i)
        values[i] = (1.0 - fraction) * *motion.start.rotary_rad[i] + fraction * *motion.end.rotary_rad[i];
    pose.axis = chain.toolAxis(values);
    if (motion.joint_linear) pose.tip_mm = chain.tip(on_path, values, motion.placement);
    return pose;
}

/// On an arc (r·e)'' is at most r·θ² + 2·|Δr|·θ. A tool axis turned by joints moves at no more than the sum of their rates,
/// and bends by no more than its square.
Bend bendOf(const ExecutedMotion& motion, const ForwardChain& chain) {
    Bend bend;
    if (motion.arc) {
        const double sweep = std::abs(motion.arc->sweep_rad);
        bend.tip_mm = std::max(motion.arc->start_radius_mm, motion.arc->end_radius_mm) * sweep * sweep +
                      2.0 * std::abs(motion.arc->end_radius_mm - motion.arc->start_radius_mm) * sweep;
    }
    const std::size_t count = chain.rotaryCount();
    double turn = angleBetween(motion.start_pose->axis, motion.end_pose->axis);
    if (motion.orientation_path == OrientationPath::RotaryLinear && rotaryKnown(motion, count)) {
        turn = 0.0;
        for (std::size_t i = 0; i < count; ++i)
            turn += std::abs(*motion.end.rotary_rad[i] - *motion.start.rotary_rad[i]);
        if (motion.joint_linear)
            bend.tip_mm += chain.tipBend(motion.path_start_mm, valuesOf(motion.start), motion.path_end_mm,
                                         valuesOf(motion.end), motion.placement);
    }
    bend.axis_rad = turn * turn;
    return bend;
}

double rotaryTravel(const ExecutedMotion& motion) {
    double largest = 0.0;
    for (std::size_t i = 0; i < max_rotary_axes; ++i)
        if (motion.start.rotary_rad[i] && motion.end.rotary_rad[i])
            largest = std::max(largest, std::abs(*motion.end.rotary_rad[i] - *motion.start.rotary_rad[i]));
    return largest;
}

}  // namespace cusp::post::reader
