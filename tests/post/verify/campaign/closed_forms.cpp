// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Products of elementary rotations, multiplied out for the axis.
#include "closed_forms.hpp"

#include <cusp/base/units.hpp>

#include <Eigen/Geometry>

#include <cmath>

namespace cusp::post::verify::test {

namespace {

using base::radFromDeg;

Eigen::Matrix3d turn(double angle_deg, const Vector3d& about) {
    return Eigen::AngleAxisd(radFromDeg(angle_deg), about).toRotationMatrix();
}

/// C carries A: the head of the Fooke class, and in the frame of the workpiece the A/C trunnion too.
Vector3d axisCA(double c_deg, double a_deg) {
    const double c = radFromDeg(c_deg);
    const double a = radFromDeg(a_deg);
    return {std::sin(c) * std::sin(a), -std::cos(c) * std::sin(a), std::cos(a)};
}

/// The dual table of the Haas class: Rz(C)·Ry(B)·ez.
Vector3d axisCB(double c_deg, double b_deg) {
    const double c = radFromDeg(c_deg);
    const double b = radFromDeg(b_deg);
    return {std::cos(c) * std::sin(b), std::sin(c) * std::sin(b), std::cos(b)};
}

/// The head alone: ((1 − cos B)/2, sin B/√2, (1 + cos B)/2).
Vector3d nutated(double b_deg) {
    const double b = radFromDeg(b_deg);
    return {(1.0 - std::cos(b)) / 2.0, std::sin(b) / std::sqrt(2.0), (1.0 + std::cos(b)) / 2.0};
}

Vector3d axisNutating(double c_deg, double b_deg) { return turn(-c_deg, Vector3d::UnitZ()) * nutated(b_deg); }

/// M = P + L·(u − ez): what a head adds, L from its pivot to the tip.
template <int pivot_mm>
Vector3d headTip(const AxisValues& at, const Vector3d& /*origin_mm*/, double tool_length_mm) {
    return at.linear_mm - (pivot_mm + tool_length_mm) * (axisCA(at.first_deg, at.second_deg) - Vector3d::UnitZ());
}
template <int pivot_mm>
Vector3d headProgrammed(const Vector3d& tip, const AxisValues& at, const Vector3d& /*origin_mm*/,
                        double tool_length_mm) {
    return tip + (pivot_mm + tool_length_mm) * (axisCA(at.first_deg, at.second_deg) - Vector3d::UnitZ());
}

Vector3d haasTip(const AxisValues& at, const Vector3d& origin_mm, double /*tool_length_mm*/) {
    return turn(at.first_deg, Vector3d::UnitZ()) * turn(at.second_deg, Vector3d::UnitY()) * (at.linear_mm + origin_mm) -
           origin_mm;
}
Vector3d haasProgrammed(const Vector3d& tip, const AxisValues& at, const Vector3d& origin_mm,
                        double /*tool_length_mm*/) {
    return turn(-at.second_deg, Vector3d::UnitY()) * turn(-at.first_deg, Vector3d::UnitZ()) * (tip + origin_mm) -
           origin_mm;
}

/// The trunnion's A runs 50 mm below the table's zero.
const Vector3d trunnion_mm(0.0, 0.0, -50.0);

Vector3d trunnionTip(const AxisValues& at, const Vector3d& origin_mm, double /*tool_length_mm*/) {
    const Vector3d tilted =
        trunnion_mm + turn(at.second_deg, Vector3d::UnitX()) * (at.linear_mm + origin_mm - trunnion_mm);
    return turn(at.first_deg, Vector3d::UnitZ()) * tilted - origin_mm;
}
Vector3d trunnionProgrammed(const Vector3d& tip, const AxisValues& at, const Vector3d& origin_mm,
                            double /*tool_length_mm*/) {
    const Vector3d tilted = turn(-at.first_deg, Vector3d::UnitZ()) * (tip + origin_mm);
    return trunnion_mm + turn(-at.second_deg, Vector3d::UnitX()) * (tilted - trunnion_mm) - origin_mm;
}

/// Where B turns, above the gauge point.
constexpr double nutation_mm = 150.0;

Vector3d nutatingTip(const AxisValues& at, const Vector3d& origin_mm, double tool_length_mm) {
    const Vector3d lever = (tool_length_mm + nutation_mm) * (Vector3d::UnitZ() - nutated(at.second_deg));
    return turn(-at.first_deg, Vector3d::UnitZ()) * (at.linear_mm + origin_mm + lever) - origin_mm;
}
Vector3d nutatingProgrammed(const Vector3d& tip, const AxisValues& at, const Vector3d& origin_mm,
                            double tool_length_mm) {
    const Vector3d lever = (tool_length_mm + nutation_mm) * (Vector3d::UnitZ() - nutated(at.second_deg));
    return turn(at.first_deg, Vector3d::UnitZ()) * (tip + origin_mm) - lever - origin_mm;
}

}  // namespace

const std::vector<ClosedForm>& fiveAxisMachines() {
    static const std::vector<ClosedForm> all = {
        {"head-c200-a95", "C", "A", axisCA, headTip<220>, headProgrammed<220>},
        {"fooke-endura-ca", "C", "A", axisCA, headTip<250>, headProgrammed<250>},
        {"haas-umc-bc", "C", "B", axisCB, haasTip, haasProgrammed},
        {"trunnion-ac", "C", "A", axisCA, trunnionTip, trunnionProgrammed},
        {"nutating-45", "C", "B", axisNutating, nutatingTip, nutatingProgrammed},
    };
    return all;
}

}  // namespace cusp::post::verify::test
