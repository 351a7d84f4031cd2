// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Rotations and the product along the chain.
#include <cusp/post/reader/forward_chain.hpp>

#include <algorithm>
#include <numbers>

namespace cusp::post::reader {

namespace {

Vector3 unit(const std::array<double, 3>& v) {
    const Vector3 vector{v[0], v[1], v[2]};
    const double length = norm(vector);
    return length > 0.0 ? (1.0 / length) * vector : Vector3{0.0, 0.0, 1.0};
}

Vector3 toVector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

constexpr double full_turn = 2.0 * std::numbers::pi;
/// Printed values and limits are rounded: a position this far beyond a limit is at it.
constexpr double limit_slack_rad = 1e-6;
constexpr double reach_rad = 1e-6;
constexpr double pole_rad = 1e-6;

}  // namespace

Vector3 rotated(const Vector3& v, const Vector3& axis, double angle_rad) {
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    return c * v + s * cross(axis, v) + ((1.0 - c) * dot(axis, v)) * axis;
}

Vector3 onGreatCircle(const Vector3& a, const Vector3& b, double fraction) {
    const Vector3 normal = cross(a, b);
    const double sine = norm(normal);
    if (sine < 1e-12) {
        const Vector3 mean = (1.0 - fraction) * a + fraction * b;
        const double length = norm(mean);
        return length > 0.5 ? (1.0 / length) * mean : a;
    }
    return rotated(a, (1.0 / sine) * normal, fraction * std::atan2(sine, dot(a, b)));
}

ForwardChain::ForwardChain(const machine::MachineDefinition& machine, const MachineSetup& setup)
    : spindle_axis_(unit(machine.spindle.axis)) {
    bool carried = false;  // a linear axis between a rotary one and the tool
    for (const std::string& name : machine.chain) {
        if (const auto found = machine.rotary.find(name); found != machine.rotary.end()) {
            places_.push_back({joints_.size(), toVector(found->second.point_mm), 0});
            joints_.push_back({name, found->second, unit(found->second.direction)});
        }
        if (const auto found = machine.linear.find(name); found != machine.linear.end()) {
            places_.push_back({std::nullopt, {}, linear_directions_.size()});
            linear_directions_.push_back(unit(found->second.direction));
            carried = carried || !joints_.empty();
        }
    }
    if (!setup.tool_length_mm || linear_directions_.size() != 3 || (carried && !setup.wcs_origin_mm)) return;
    tip_at_zero_mm_ = toVector(machine.spindle.gauge_point_mm) - *setup.tool_length_mm * spindle_axis_;
    if (setup.wcs_origin_mm) origin_mm_ = toVector(*setup.wcs_origin_mm);
    const auto& d = linear_directions_;
    places_tip_ = std::abs(dot(d[0], cross(d[1], d[2]))) > 1e-6;
}

/// By Cramer's rule, from the definition of the programmed values.
std::array<double, 3> ForwardChain::linearValues(const Vector3& programmed_mm) const {
    const Vector3 way = programmed_mm + origin_mm_ - tip_at_zero_mm_;
    const auto& d = linear_directions_;
    const double whole = dot(d[0], cross(d[1], d[2]));
    return {dot(way, cross(d[1], d[2])) / whole, dot(d[0], cross(way, d[2])) / whole,
            dot(d[0], cross(d[1], way)) / whole};
}

/// Joint by joint from the tool to the workpiece, each turning or moving everything behind it.
Vector3 ForwardChain::tip(const Vector3& programmed_mm, const RotaryValues& rotary_rad) const {
    const std::array<double, 3> values = linearValues(programmed_mm);
    const auto& d = linear_directions_;
    Vector3 point = tip_at_zero_mm_;
    for (std::size_t i = places_.size(); i-- > 0;) {
        const Place& place = places_[i];
        if (place.rotary)
            point = place.point_mm +
                    rotated(point - place.point_mm, joints_[*place.rotary].direction, rotary_rad[*place.rotary]);
        else
            point = point + values[place.linear] * d[place.linear];
    }
    return point - origin_mm_;
}

/// A point that moves with at most `speed` and `bend` (first and second derivative) stays within `speed` of where it was;
/// y = c + R(ωt)(x − c) then has |y'| ≤ speed + ωr and |y''| ≤ bend + 2ω·speed + ω²r, r the largest distance from the axis.
double ForwardChain::tipBend(const Vector3& from_mm, const RotaryValues& from_rad, const Vector3& to_mm,
                             const RotaryValues& to_rad) const {
    const std::array<double, 3> from = linearValues(from_mm);
    const std::array<double, 3> to = linearValues(to_mm);
    Vector3 point = tip_at_zero_mm_;
    double speed = 0.0;
    double bend = 0.0;
    for (std::size_t i = places_.size(); i-- > 0;) {
        const Place& place = places_[i];
        if (!place.rotary) {
            point = point + from[place.linear] * linear_directions_[place.linear];
            speed += std::abs(to[place.linear] - from[place.linear]);
            continue;
        }
        const Vector3& direction = joints_[*place.rotary].direction;
        const double turn = std::abs(to_rad[*place.rotary] - from_rad[*place.rotary]);
        const double radius = norm(cross(direction, point - place.point_mm)) + speed;
        bend += 2.0 * turn * speed + turn * turn * radius;
        speed += turn * radius;
        point = place.point_mm + rotated(point - place.point_mm, direction, from_rad[*place.rotary]);
    }
    return bend;
}

bool ForwardChain::withinLimits(std::size_t joint, double angle_rad) const {
    const machine::RotaryAxis& axis = joints_[joint].axis;
    if (!axis.min_rad || !axis.max_rad) return true;
    const double turns = std::ceil((*axis.min_rad - limit_slack_rad - angle_rad) / full_turn);
    return angle_rad + turns * full_turn <= *axis.max_rad + limit_slack_rad;
}

/// axis = R0(q0)·R1(q1)·s. Along the first direction d0 only q1 counts: d0·axis = d0·R1(q1)·s, which is of the form
/// a + b·cos q1 + c·sin q1 and has two solutions; q0 is then the angle about d0.
std::optional<bool> ForwardChain::reaches(const Vector3& axis) const {
    if (joints_.size() > 2) return std::nullopt;
    const auto angleAbout = [](const Vector3& direction, const Vector3& from, const Vector3& to) {
        const Vector3 a = from - dot(from, direction) * direction;
        const Vector3 b = to - dot(to, direction) * direction;
        return std::atan2(dot(direction, cross(a, b)), dot(a, b));
    };
    const auto firstFits = [&](const Vector3& from) {
        if (angleBetween(from, joints_[0].direction) < pole_rad ||
            angleBetween(-1.0 * from, joints_[0].direction) < pole_rad)
            return true;  // at the pole any angle does
        return withinLimits(0, angleAbout(joints_[0].direction, from, axis));
    };
    if (joints_.empty()) return angleBetween(axis, spindle_axis_) < reach_rad;
    if (joints_.size() == 1)
        return std::abs(dot(joints_[0].direction, axis - spindle_axis_)) < reach_rad && firstFits(spindle_axis_);
    const Vector3& d0 = joints_[0].direction;
    const Vector3& d1 = joints_[1].direction;
    const Vector3 along = dot(d1, spindle_axis_) * d1;
    const Vector3 across = spindle_axis_ - along;
    const double b = dot(d0, across);
    const double c = dot(d0, cross(d1, spindle_axis_));
    const double size = std::hypot(b, c);
    if (size < reach_rad) return std::nullopt;  // the second axis tilts nothing against the first
    const double ratio = (dot(d0, axis) - dot(d0, along)) / size;
    if (std::abs(ratio) > 1.0 + reach_rad) return false;
    const double middle = std::atan2(c, b);
    const double half = std::acos(std::clamp(ratio, -1.0, 1.0));
    for (const double q1 : {middle - half, middle + half})
        if (withinLimits(1, q1) && firstFits(rotated(spindle_axis_, d1, q1))) return true;
    return false;
}

Vector3 ForwardChain::toolAxis(const RotaryValues& rotary_rad) const {
    Vector3 axis = spindle_axis_;
    for (std::size_t i = joints_.size(); i-- > 0;) axis = rotated(axis, joints_[i].direction, rotary_rad[i]);
    return axis;
}

}  // namespace cusp::post::reader
