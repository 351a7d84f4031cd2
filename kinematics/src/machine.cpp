// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Building the model from its definition, forward kinematics, and the linear part of the inverse.
#include <cusp/kinematics/machine.hpp>

#include <cusp/kinematics/angles.hpp>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace cusp::kinematics {
namespace {

// A position this far beyond a limit is the limit with a rounding error, and is taken as the limit.
constexpr double limit_rounding_rad = 1e-12;

}  // namespace

Machine::Machine(machine::MachineDefinition definition)
    : definition_(std::move(definition)),
      spindle_axis_(geometry::toVector(definition_.spindle.axis)),
      gauge_point_(geometry::toVector(definition_.spindle.gauge_point_mm)) {
    std::size_t linear_count = 0;
    for (const std::string& name : definition_.axisNames()) {
        if (const auto linear = definition_.linear.find(name); linear != definition_.linear.end()) {
            assert(linear_count < 3);
            linear_names_[linear_count] = name;
            linear_range_[linear_count] = {
                .endless = false, .min = linear->second.min_mm, .max = linear->second.max_mm};
            chain_.push_back({.is_rotary = false,
                              .index = linear_count++,
                              .direction = geometry::toVector(linear->second.direction),
                              .point = Vector3::Zero()});
            continue;
        }
        const machine::RotaryAxis& axis = definition_.rotary.at(name);
        const std::size_t i = rotary_names_.size();
        assert(i < 2);
        rotary_names_.push_back(name);
        rotary_range_[i] = {.endless = axis.winding == machine::RotaryAxis::Winding::Endless,
                            .min = axis.min_rad.value_or(0.0),
                            .max = axis.max_rad.value_or(0.0)};
        rotary_velocity_rad_per_s_[i] = axis.max_velocity_rad_per_s;
        rotary_home_rad_[i] = axis.home_rad;
        rotary_direction_[i] = geometry::toVector(axis.direction);
        chain_.push_back({.is_rotary = true,
                          .index = i,
                          .direction = rotary_direction_[i],
                          .point = geometry::toVector(axis.point_mm)});
    }
    assert(linear_count == 3);
    if (rotaryCount() == 2) prepareTwoRotaryAxes();
}

RigidTransform Machine::workpieceFromTool(const AxisValues& values, double tool_length_mm) const {
    Matrix3 rotation = Matrix3::Identity();
    Vector3 translation = Vector3::Zero();
    for (const Joint& joint : chain_) {
        if (joint.is_rotary) {
            const Matrix3 turn = Eigen::AngleAxisd(values.rotary_rad[joint.index], joint.direction).toRotationMatrix();
            translation += rotation * (joint.point - turn * joint.point);
            rotation = rotation * turn;
        } else {
            translation += rotation * joint.direction * values.linear_mm[static_cast<Eigen::Index>(joint.index)];
        }
    }
    RigidTransform workpiece_from_tool = RigidTransform::Identity();
    workpiece_from_tool.linear() = rotation;
    workpiece_from_tool.translation() = translation + rotation * (gauge_point_ - tool_length_mm * spindle_axis_);
    return workpiece_from_tool;
}

toolpath::CutterLocation Machine::forward(const AxisValues& values, double tool_length_mm) const {
    const RigidTransform workpiece_from_tool = workpieceFromTool(values, tool_length_mm);
    return {.tip_mm = workpiece_from_tool.translation(), .axis = workpiece_from_tool.linear() * spindle_axis_};
}

Vector3 Machine::toolAxis(const RotaryValues& rotary_rad) const {
    Vector3 axis = spindle_axis_;
    for (std::size_t i = rotaryCount(); i-- > 0;) {
        const Vector3 turned = Eigen::AngleAxisd(rotary_rad[i], rotary_direction_[i]) * axis;
        axis = turned;
    }
    return axis;
}

std::optional<Vector3> Machine::solveLinear(const Vector3& tip_mm, const RotaryValues& rotary_rad,
                                            double tool_length_mm) const {
    // The tip is affine in the linear positions: tip = tip_at_zero + directions · linear.
    Matrix3 directions = Matrix3::Zero();
    Matrix3 rotation = Matrix3::Identity();
    Vector3 tip_at_zero = Vector3::Zero();
    for (const Joint& joint : chain_) {
        if (joint.is_rotary) {
            const Matrix3 turn = Eigen::AngleAxisd(rotary_rad[joint.index], joint.direction).toRotationMatrix();
            tip_at_zero += rotation * (joint.point - turn * joint.point);
            rotation = rotation * turn;
        } else {
            directions.col(static_cast<Eigen::Index>(joint.index)) = rotation * joint.direction;
        }
    }
    tip_at_zero += rotation * (gauge_point_ - tool_length_mm * spindle_axis_);
    constexpr double singular = 1e-6;
    if (std::abs(directions.determinant()) < singular) return std::nullopt;
    Vector3 linear_mm = directions.partialPivLu().solve(tip_mm - tip_at_zero);
    return linear_mm;
}

std::vector<double> Machine::windings(std::size_t i, double angle_rad) const {
    const AxisRange& range = rotary_range_[i];
    if (range.endless) return {wrapAngle(angle_rad)};
    std::vector<double> positions;
    const double first = std::ceil((range.min - limit_rounding_rad - angle_rad) / turn_rad);
    for (double k = first;; k += 1.0) {
        const double position = angle_rad + k * turn_rad;
        if (position > range.max + limit_rounding_rad) return positions;
        positions.push_back(std::clamp(position, range.min, range.max));
    }
}

PoseSolutions Machine::inverse(const toolpath::CutterLocation& location, double tool_length_mm,
                               double axis_tolerance_rad) const {
    const AxisSolutions solved = solveAxis(location.axis);
    PoseSolutions out{.values = {}, .pole = solved.pole, .miss_rad = solved.miss_rad};
    if (solved.miss_rad > axis_tolerance_rad) return out;
    for (std::size_t b = 0; b < solved.count; ++b) {
        std::array<std::vector<double>, 2> positions{std::vector<double>{0.0}, std::vector<double>{0.0}};
        for (std::size_t i = 0; i < rotaryCount(); ++i) positions[i] = windings(i, solved.branch[b][i]);
        if (solved.pole) {
            const AxisRange& range = rotary_range_[0];
            positions[0] = {range.endless ? 0.0 : std::clamp(0.0, range.min, range.max)};
        }
        for (const double first : positions[0])
            for (const double second : positions[1])
                if (const auto linear_mm = solveLinear(location.tip_mm, {first, second}, tool_length_mm))
                    out.values.push_back({.linear_mm = *linear_mm, .rotary_rad = {first, second}});
    }
    return out;
}

}  // namespace cusp::kinematics
