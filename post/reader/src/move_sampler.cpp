// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Lines, arcs, linear rotary motion and great circles.
#include <cusp/post/reader/move_sampler.hpp>

#include <algorithm>

namespace cusp::post::reader {

namespace {

double& component(Vector3& v, std::size_t index) { return index == 0 ? v.x : index == 1 ? v.y : v.z; }

Vector3 tipOnArc(const Arc& arc, double fraction) {
    const double angle = arc.start_angle_rad + fraction * arc.sweep_rad;
    const double radius = arc.start_radius_mm + fraction * (arc.end_radius_mm - arc.start_radius_mm);
    Vector3 tip = arc.center_mm;
    component(tip, arc.first_axis) += radius * std::cos(angle);
    component(tip, arc.second_axis) += radius * std::sin(angle);
    component(tip, 3 - arc.first_axis - arc.second_axis) += fraction * arc.height_mm;
    return tip;
}

bool rotaryKnown(const ExecutedMotion& motion, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
        if (!motion.start.rotary_rad[i] || !motion.end.rotary_rad[i]) return false;
    return true;
}

}  // namespace

ToolPose poseAt(const ExecutedMotion& motion, const ForwardChain& chain, double fraction) {
    const ToolPose& start = *motion.start_pose;
    const ToolPose& end = *motion.end_pose;
    ToolPose pose;
    pose.tip_mm =
        motion.arc ? tipOnArc(*motion.arc, fraction) : (1.0 - fraction) * start.tip_mm + fraction * end.tip_mm;
    const std::size_t count = chain.rotaryCount();
    if (motion.orientation_path == OrientationPath::GreatCircle || !rotaryKnown(motion, count)) {
        pose.axis = onGreatCircle(start.axis, end.axis, fraction);
        return pose;
    }
    RotaryValues values{};
    for (std::size_t i = 0; i < count; ++i)
        values[i] = (1.0 - fraction) * *motion.start.rotary_rad[i] + fraction * *motion.end.rotary_rad[i];
    pose.axis = chain.toolAxis(values);
    return pose;
}

double rotaryTravel(const ExecutedMotion& motion) {
    double largest = 0.0;
    for (std::size_t i = 0; i < max_rotary_axes; ++i)
        if (motion.start.rotary_rad[i] && motion.end.rotary_rad[i])
            largest = std::max(largest, std::abs(*motion.end.rotary_rad[i] - *motion.start.rotary_rad[i]));
    return largest;
}

}  // namespace cusp::post::reader
