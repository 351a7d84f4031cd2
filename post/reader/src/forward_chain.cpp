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
/// Volume that directions of unit length span; below it they lie in one plane.
constexpr double flat = 1e-6;

double determinant(const Vector3& a, const Vector3& b, const Vector3& c) { return dot(a, cross(b, c)); }

/// The parts of `way` along three directions (Cramer's rule).
std::array<double, 3> solved(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& way) {
    const double whole = determinant(a, b, c);
    return {determinant(way, b, c) / whole, determinant(a, way, c) / whole, determinant(a, b, way) / whole};
}

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

ForwardChain::ForwardChain(const machine::MachineDefinition& machine)
    : spindle_axis_(unit(machine.spindle.axis)), gauge_point_mm_(toVector(machine.spindle.gauge_point_mm)) {
    for (const std::string& name : machine.chain) {
        if (const auto found = machine.rotary.find(name); found != machine.rotary.end()) {
            places_.push_back({joints_.size(), toVector(found->second.point_mm), 0});
            joints_.push_back({name, found->second, unit(found->second.direction)});
        }
        if (const auto found = machine.linear.find(name); found != machine.linear.end()) {
            places_.push_back({std::nullopt, {}, linear_.size()});
            linear_.push_back({name, found->second, unit(found->second.direction)});
            carried_ = carried_ || !joints_.empty();
        }
    }
    spans_ = linear_.size() == 3 &&
             std::abs(determinant(linear_[0].direction, linear_[1].direction, linear_[2].direction)) > flat;
}

bool ForwardChain::placesTip(const Placement& placement) const {
    return spans_ && placement.tool_length_mm && (placement.origin_mm || !carried_);
}

Vector3 ForwardChain::tipAtZero(const Placement& placement) const {
    return gauge_point_mm_ - placement.tool_length_mm.value_or(0.0) * spindle_axis_;
}

/// From the definition of the programmed values.
std::array<double, 3> ForwardChain::linearValues(const Vector3& programmed_mm, const Placement& placement) const {
    const Vector3 way = programmed_mm + placement.origin_mm.value_or(Vector3{}) - tipAtZero(placement);
    return solved(linear_[0].direction, linear_[1].direction, linear_[2].direction, way);
}

/// Joint by joint from the tool to the workpiece, each turning or moving everything behind it.
Vector3 ForwardChain::tipOf(const std::array<double, 3>& linear_mm, const RotaryValues& rotary_rad,
                            const Placement& placement) const {
    Vector3 point = tipAtZero(placement);
    for (std::size_t i = places_.size(); i-- > 0;) {
        const Place& place = places_[i];
        if (place.rotary)
            point = place.point_mm +
                    rotated(point - place.point_mm, joints_[*place.rotary].direction, rotary_rad[*place.rotary]);
        else
            point = point + linear_mm[place.linear] * linear_[place.linear].direction;
    }
    return point;
}

Vector3 ForwardChain::tip(const Vector3& programmed_mm, const RotaryValues& rotary_rad,
                          const Placement& placement) const {
    return tipOf(linearValues(programmed_mm, placement), rotary_rad, placement) -
           placement.origin_mm.value_or(Vector3{});
}

/// With the rotary axes at rest the tip follows the linear ones in constant proportions.
std::optional<std::array<double, 3>>
ForwardChain::linearPositions(const Vector3& tip_mm, const RotaryValues& rotary_rad, const Placement& placement) const {
    if (!spans_ || !placement.tool_length_mm || !placement.origin_mm) return std::nullopt;
    const Vector3 at_zero = tipOf({}, rotary_rad, placement);
    const Vector3 along0 = tipOf({1.0, 0.0, 0.0}, rotary_rad, placement) - at_zero;
    const Vector3 along1 = tipOf({0.0, 1.0, 0.0}, rotary_rad, placement) - at_zero;
    const Vector3 along2 = tipOf({0.0, 0.0, 1.0}, rotary_rad, placement) - at_zero;
    if (std::abs(determinant(along0, along1, along2)) < flat) return std::nullopt;
    return solved(along0, along1, along2, tip_mm + *placement.origin_mm - at_zero);
}

/// A point that moves with at most `speed` and `bend` (first and second derivative) stays within `speed` of where it was;
/// y = c + R(ωt)(x − c) then has |y'| ≤ speed + ωr and |y''| ≤ bend + 2ω·speed + ω²r, r the largest distance from the axis.
double ForwardChain::tipBend(const Vector3& from_mm, const RotaryValues& from_rad, const Vector3& to_mm,
                             const RotaryValues& to_rad, const Placement& placement) const {
    const std::array<double, 3> from = linearValues(from_mm, placement);
    const std::array<double, 3> to = linearValues(to_mm, placement);
    Vector3 point = tipAtZero(placement);
    double speed = 0.0;
    double bend = 0.0;
    for (std::size_t i = places_.size(); i-- > 0;) {
        const Place& place = places_[i];
        if (!place.rotary) {
            point = point + from[place.linear] * linear_[place.linear].direction;
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
    const auto angle_about = [](const Vector3& direction, const Vector3& from, const Vector3& to) {
        const Vector3 a = from - dot(from, direction) * direction;
        const Vector3 b = to - dot(to, direction) * direction;
        return std::atan2(dot(direction, cross(a, b)), dot(a, b));
    };
    const auto first_fits = [&](const Vector3& from) {
        if (angleBetween(from, joints_[0].direction) < pole_rad ||
            angleBetween(-1.0 * from, joints_[0].direction) < pole_rad)
            return true;  // at the pole any angle does
        return withinLimits(0, angle_about(joints_[0].direction, from, axis));
    };
    if (joints_.empty()) return angleBetween(axis, spindle_axis_) < reach_rad;
    if (joints_.size() == 1)
        return std::abs(dot(joints_[0].direction, axis - spindle_axis_)) < reach_rad && first_fits(spindle_axis_);
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
        if (withinLimits(1, q1) && first_fits(rotated(spindle_axis_, d1, q1))) return true;
    return false;
}

double ForwardChain::poleAngle(const Vector3& axis) const {
    if (joints_.empty()) return std::numbers::pi;
    const double angle = angleBetween(axis, joints_.front().direction);
    return std::min(angle, std::numbers::pi - angle);
}

Vector3 ForwardChain::toolAxis(const RotaryValues& rotary_rad) const {
    Vector3 axis = spindle_axis_;
    for (std::size_t i = joints_.size(); i-- > 0;) axis = rotated(axis, joints_[i].direction, rotary_rad[i]);
    return axis;
}

}  // namespace cusp::post::reader
