// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Closed-form rotary positions for a tool axis; the derivation is in README.md.
#include <cusp/kinematics/angles.hpp>
#include <cusp/kinematics/machine.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cusp::kinematics {

using geometry::angleBetween;
using std::numbers::pi;

void Machine::prepareTwoRotaryAxes() {
    const Vector3& d1 = rotary_direction_[0];
    const Vector3& d2 = rotary_direction_[1];
    const Vector3& t = spindle_axis_;
    e1_ = (d2 - d1.dot(d2) * d1).normalized();
    e2_ = d1.cross(e1_);
    theta_12_ = angleBetween(d1, d2);
    theta_2t_ = angleBetween(d2, t);
    const double sum = theta_12_ + theta_2t_;
    theta_min_ = std::abs(theta_12_ - theta_2t_);
    theta_max_ = std::min(sum, 2.0 * pi - sum);
    phi_ = std::atan2(d1.dot(d2.cross(t)), d1.dot(t - d2.dot(t) * d2));
    constexpr double rounding = 1e-15;
    orthogonal_ = std::abs(theta_12_ - pi / 2.0) < rounding && std::abs(theta_2t_ - pi / 2.0) < rounding;
}

AxisSolutions Machine::solveAxis(const Vector3& axis, double pole_tolerance_rad) const {
    if (rotaryCount() == 2) return solveTwo(axis, pole_tolerance_rad);
    if (rotaryCount() == 1) return solveOne(axis, pole_tolerance_rad);
    AxisSolutions out;
    out.count = 1;
    out.miss_rad = angleBetween(spindle_axis_, axis);
    return out;
}

double Machine::branchGap(const Vector3& axis) const {
    if (rotaryCount() < 2) return std::numeric_limits<double>::infinity();
    const double theta = angleBetween(rotary_direction_[0], axis);
    return std::min(theta - theta_min_, theta_max_ - theta);
}

AxisSolutions Machine::solveOne(const Vector3& axis, double pole_tolerance_rad) const {
    const Vector3& d = rotary_direction_[0];
    const Vector3& t = spindle_axis_;
    AxisSolutions out;
    out.count = 1;
    out.miss_rad = std::abs(angleBetween(d, axis) - angleBetween(d, t));
    const Vector3 across = d.cross(t);
    if (across.norm() <= pole_tolerance_rad) {
        out.pole = true;
        return out;
    }
    // `across` and t's part across d are two axes of one length, a right angle apart: the angle from one to the other
    // needs no normalising.
    const Vector3 along = across.cross(d);
    out.branch[0] = {std::atan2(axis.dot(across), axis.dot(along)), 0.0};
    return out;
}

AxisSolutions Machine::solveTwo(const Vector3& axis, double pole_tolerance_rad) const {
    AxisSolutions out;
    const double u1 = axis.dot(e1_);
    const double u2 = axis.dot(e2_);
    const double across = std::sqrt(u1 * u1 + u2 * u2);
    const double along = axis.dot(rotary_direction_[0]);
    const double theta = std::atan2(across, along);
    out.gap_rad = std::min(theta - theta_min_, theta_max_ - theta);
    out.miss_rad = std::max(0.0, -out.gap_rad);
    out.pole = across <= pole_tolerance_rad && (along > 0.0 ? theta_min_ : pi - theta_max_) <= pole_tolerance_rad;
    if (out.pole) {
        out.count = 1;
        out.miss_rad = 0.0;
        out.branch[0] = {0.0, along > 0.0 ? phi_ : wrapAngle(phi_ + pi)};
        return out;
    }

    // psi: how far the second axis has turned from where the tool is nearest to the first.
    double psi = theta;
    double beta = -pi / 2.0;
    if (!orthogonal_) {
        const double near_part =
            std::max(0.0, std::sin(0.5 * (theta + theta_min_)) * std::sin(0.5 * (theta - theta_min_)));
        const double far_part =
            std::max(0.0, std::sin(0.5 * (theta_max_ + theta)) * std::sin(0.5 * (theta_max_ - theta)));
        psi = 2.0 * std::atan2(std::sqrt(near_part), std::sqrt(far_part));
        const double half_sine = std::sin(0.5 * psi);
        beta = std::atan2(-std::sin(theta_2t_) * std::sin(psi),
                          std::sin(theta_12_ - theta_2t_) +
                              2.0 * half_sine * half_sine * std::sin(theta_2t_) * std::cos(theta_12_));
    }
    const double alpha = across > 0.0 ? std::atan2(u2, u1) : 0.0;
    out.alpha_rad = alpha;
    out.beta_rad = beta;
    out.branch[0] = {wrapAngle(alpha - beta), wrapAngle(phi_ + psi)};
    out.branch[1] = {wrapAngle(alpha + beta), wrapAngle(phi_ - psi)};
    // At either end of the range both branches are one.
    out.count = psi > 0.0 && psi < pi ? 2 : 1;
    return out;
}

}  // namespace cusp::kinematics
