// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Great circles and what rotary axes make of them; the reasoning is in README.md, "Following".
#include <cusp/kinematics/axis_following.hpp>

#include <cusp/base/units.hpp>
#include <cusp/kinematics/angles.hpp>

#include <algorithm>
#include <cmath>

namespace cusp::kinematics {

using geometry::angleBetween;

namespace {

/// Perpendicular to both, of unit length; any perpendicular when the two are parallel.
Vector3 circleNormal(const Vector3& from, const Vector3& to) {
    const Vector3 normal = from.cross(to);
    constexpr double parallel = 1e-15;
    if (normal.norm() > parallel) return normal.normalized();
    return from.unitOrthogonal();
}

}  // namespace

Vector3 onGreatCircle(const Vector3& from, const Vector3& to, double fraction) {
    const double angle = fraction * angleBetween(from, to);
    const Vector3 sideways = circleNormal(from, to).cross(from);
    return (std::cos(angle) * from + std::sin(angle) * sideways).normalized();
}

RotaryValues followStep(const AxisSolutions& from, const AxisSolutions& to, std::size_t branch) {
    const double azimuth = wrapAngle(to.alpha_rad - from.alpha_rad);
    const double lead = to.beta_rad - from.beta_rad;
    return {branch == 0 ? azimuth - lead : azimuth + lead, wrapAngle(to.branch[branch][1] - from.branch[branch][1])};
}

BranchMeeting nearestMeeting(const Machine& machine, const Vector3& from, const Vector3& to) {
    BranchMeeting nearest{.gap_rad = machine.branchGap(from), .fraction = 0.0};
    const auto consider = [&](const Vector3& axis, double fraction) {
        const double gap = machine.branchGap(axis);
        if (gap < nearest.gap_rad) nearest = {.gap_rad = gap, .fraction = fraction};
    };
    consider(to, 1.0);
    const double whole = angleBetween(from, to);
    if (whole == 0.0 || machine.rotaryCount() < 2) return nearest;
    // The point of the whole circle nearest to the first rotary axis, and the one opposite, where they lie on the arc.
    const Vector3 normal = circleNormal(from, to);
    const Vector3& pole = machine.rotaryDirection(0);
    const Vector3 towards_pole = pole - normal.dot(pole) * normal;
    for (const double sign : {1.0, -1.0}) {
        const double angle = std::atan2(sign * towards_pole.dot(normal.cross(from)), sign * towards_pole.dot(from));
        if (angle > 0.0 && angle < whole) consider(onGreatCircle(from, to, angle / whole), angle / whole);
    }
    return nearest;
}

double linearTurnDeviation(const Machine& machine, const RotaryValues& from, const RotaryValues& to) {
    const double travel = std::abs(to[0] - from[0]) + std::abs(to[1] - from[1]);
    // The maximum of a smooth bulge between two zeros is missed by 0.3 % at worst with 20 samples.
    constexpr double step_rad = base::radFromDeg(1.0);
    const double count = std::clamp(std::ceil(travel / step_rad), 20.0, 720.0);
    const Vector3 first = machine.toolAxis(from);
    const Vector3 last = machine.toolAxis(to);
    double worst = 0.0;
    for (double sample = 1.0; sample < count; sample += 1.0) {
        const double fraction = sample / count;
        const RotaryValues at{from[0] + fraction * (to[0] - from[0]), from[1] + fraction * (to[1] - from[1])};
        worst = std::max(worst, angleBetween(machine.toolAxis(at), onGreatCircle(first, last, fraction)));
    }
    return worst;
}

}  // namespace cusp::kinematics
