// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The chain of the machine file once more, as the post needs it: affine in the linear axes, bounded in the rotary ones.
#include "machine_axes.hpp"

#include "fixed_number.hpp"

#include <cusp/base/units.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cusp::post {

using geometry::Matrix3;
using geometry::Vector3;
using kinematics::RotaryValues;

namespace {

// Linear axes this far from spanning space give positions without meaning.
constexpr double singular = 1e-6;

double inPrint(double value, std::int64_t decimals) {
    return static_cast<double>(toFixed(value, static_cast<int>(decimals))) /
           powers_of_ten[static_cast<std::size_t>(decimals)];
}

Vector3 turned(const Vector3& vector, const Vector3& axis, double angle_rad) {
    return Eigen::AngleAxisd(angle_rad, axis) * vector;
}

}  // namespace

MachineAxes::MachineAxes(const kinematics::Machine& machine, NumberFormat format)
    : spindle_axis_(geometry::toVector(machine.definition().spindle.axis)),
      gauge_point_(geometry::toVector(machine.definition().spindle.gauge_point_mm)),
      format_(format) {
    const auto& definition = machine.definition();
    Eigen::Index linear = 0;
    Eigen::Index rotary = 0;
    for (const std::string& name : definition.axisNames()) {
        if (const auto axis = definition.linear.find(name); axis != definition.linear.end()) {
            directions_.col(linear) = geometry::toVector(axis->second.direction);
            chain_.push_back({false, linear++, geometry::toVector(axis->second.direction), Vector3::Zero()});
            needs_origin_ = needs_origin_ || rotary > 0;
            continue;
        }
        const auto& axis = definition.rotary.at(name);
        needs_tool_length_ = needs_tool_length_ || !definition.carriesWorkpiece(name);
        chain_.push_back({true, rotary++, geometry::toVector(axis.direction), geometry::toVector(axis.point_mm)});
    }
    positions_from_directions_ = directions_.inverse();
    setUp(0.0, Vector3::Zero());
}

void MachineAxes::setUp(double tool_length_mm, const Vector3& wcs_origin_mm) {
    tip_at_zero_ = gauge_point_ - tool_length_mm * spindle_axis_;
    origin_ = wcs_origin_mm;
    // Rotations keep the length of an error; three axes, half a unit each.
    const double half_unit = 0.5 / powers_of_ten[static_cast<std::size_t>(format_.linear_decimals)];
    print_error_mm_ = std::sqrt(3.0) * half_unit;
}

RotaryValues MachineAxes::printed(const RotaryValues& rotary_rad) const {
    RotaryValues out{};
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = base::radFromDeg(inPrint(base::degFromRad(rotary_rad[i]), format_.rotary_decimals));
    return out;
}

Vector3 MachineAxes::printed(const Vector3& point_mm) const {
    return point_mm.unaryExpr([this](double value) { return inPrint(value, format_.linear_decimals); });
}

std::optional<Eigen::Affine3d> MachineAxes::programmedFromWorkpiece(const RotaryValues& rotary_rad) const {
    Matrix3 turned_directions = Matrix3::Zero();
    Matrix3 rotation = Matrix3::Identity();
    Vector3 tip_without_linear = Vector3::Zero();
    for (const Joint& joint : chain_) {
        if (!joint.rotary) {
            turned_directions.col(joint.index) = rotation * joint.direction;
            continue;
        }
        const Matrix3 turn =
            Eigen::AngleAxisd(rotary_rad[static_cast<std::size_t>(joint.index)], joint.direction).toRotationMatrix();
        tip_without_linear += rotation * (joint.point - turn * joint.point);
        rotation = rotation * turn;
    }
    tip_without_linear += rotation * tip_at_zero_;
    if (std::abs(turned_directions.determinant()) < singular) return std::nullopt;
    Eigen::Affine3d programmed_from_workpiece = Eigen::Affine3d::Identity();
    programmed_from_workpiece.linear() = directions_ * turned_directions.inverse();
    programmed_from_workpiece.translation() =
        programmed_from_workpiece.linear() * (origin_ - tip_without_linear) + tip_at_zero_ - origin_;
    return programmed_from_workpiece;
}

Vector3 MachineAxes::linearPositions(const Vector3& point_mm) const {
    return positions_from_directions_ * (point_mm - tip_at_zero_ + origin_);
}

Vector3 MachineAxes::tip(const Vector3& linear_mm, const RotaryValues& rotary_rad) const {
    Vector3 point = tip_at_zero_;
    for (auto joint = chain_.rbegin(); joint != chain_.rend(); ++joint)
        if (joint->rotary)
            point = joint->point +
                    turned(point - joint->point, joint->direction, rotary_rad[static_cast<std::size_t>(joint->index)]);
        else
            point += joint->direction * linear_mm[joint->index];
    return point;
}

/// From the tool to the workpiece, with p the tip as the joint at hand sees it and ω what the joint turns by: a linear joint
/// adds its own even motion; a rotary one makes p' = ω×p + p' and so on, so that lengths are bounded by
/// p' ≤ p' + ωr, p'' ≤ p'' + 2ωp' + ω²r, p''' ≤ p''' + 3ωp'' + 3ω²p' + ω³r. The arm r is longest at an end, but for the
/// bulge of p between them, which is at most p''/8.
double MachineAxes::thirdDerivative(const Position& from, const Position& to) const {
    const Vector3 from_linear = linearPositions(from.point_mm);
    const Vector3 to_linear = linearPositions(to.point_mm);
    Vector3 first = tip_at_zero_;
    Vector3 last = tip_at_zero_;
    double velocity = 0.0;
    double acceleration = 0.0;
    double jerk = 0.0;
    for (auto joint = chain_.rbegin(); joint != chain_.rend(); ++joint) {
        const auto i = static_cast<std::size_t>(joint->index);
        if (!joint->rotary) {
            first += joint->direction * from_linear[joint->index];
            last += joint->direction * to_linear[joint->index];
            velocity += std::abs(to_linear[joint->index] - from_linear[joint->index]);
            continue;
        }
        const double turn = std::abs(to.rotary_rad[i] - from.rotary_rad[i]);
        const auto across = [&](const Vector3& point) { return (point - joint->point).cross(joint->direction).norm(); };
        const double arm = std::max(across(first), across(last)) + acceleration / 8.0;
        jerk += turn * (3.0 * acceleration + turn * (3.0 * velocity + turn * arm));
        acceleration += turn * (2.0 * velocity + turn * arm);
        velocity += turn * arm;
        first = joint->point + turned(first - joint->point, joint->direction, from.rotary_rad[i]);
        last = joint->point + turned(last - joint->point, joint->direction, to.rotary_rad[i]);
    }
    return jerk;
}

double MachineAxes::chordError(const Position& from, const Position& to) const {
    if (from.rotary_rad == to.rotary_rad) return 0.0;
    const double remainder = thirdDerivative(from, to) * std::numbers::sqrt3 / 216.0;
    const RotaryValues middle{0.5 * (from.rotary_rad[0] + to.rotary_rad[0]),
                              0.5 * (from.rotary_rad[1] + to.rotary_rad[1])};
    const Vector3 chord_middle =
        0.5 * (tip(linearPositions(from.point_mm), from.rotary_rad) + tip(linearPositions(to.point_mm), to.rotary_rad));
    const Vector3 true_middle = tip(linearPositions(0.5 * (from.point_mm + to.point_mm)), middle);
    return (true_middle - chord_middle).norm() + remainder;
}

}  // namespace cusp::post
