// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The search behind the law "every branch is found".
#include "branch_search.hpp"

#include <cusp/kinematics/angles.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cusp::kinematics {
namespace {

using Jacobian = Eigen::Matrix<double, 3, 2>;

Jacobian jacobian(const Machine& machine, const RotaryValues& rotary_rad) {
    // Central differences: the search must not share a derivation with what it checks.
    constexpr double step = 1e-6;
    Jacobian out = Jacobian::Zero();
    for (std::size_t i = 0; i < machine.rotaryCount(); ++i) {
        RotaryValues forth = rotary_rad;
        RotaryValues back = rotary_rad;
        forth[i] += step;
        back[i] -= step;
        out.col(static_cast<Eigen::Index>(i)) = (machine.toolAxis(forth) - machine.toolAxis(back)) / (2.0 * step);
    }
    return out;
}

/// Damped Gauss-Newton on |toolAxis(q) − axis|².
RotaryValues refine(const Machine& machine, const Vector3& axis, RotaryValues rotary_rad) {
    double damping = 1e-3;
    double error = (machine.toolAxis(rotary_rad) - axis).squaredNorm();
    for (int iteration = 0; iteration < 60 && error > 1e-26; ++iteration) {
        const Vector3 residual = machine.toolAxis(rotary_rad) - axis;
        const Jacobian slope = jacobian(machine, rotary_rad);
        const Eigen::Matrix2d normal = slope.transpose() * slope + damping * Eigen::Matrix2d::Identity();
        const Eigen::Vector2d move = normal.ldlt().solve(slope.transpose() * residual);
        const RotaryValues tried{rotary_rad[0] - move[0], rotary_rad[1] - move[1]};
        const double tried_error = (machine.toolAxis(tried) - axis).squaredNorm();
        if (tried_error < error) {
            rotary_rad = tried;
            error = tried_error;
            damping *= 0.1;
        } else {
            damping *= 10.0;
        }
    }
    return {wrapAngle(rotary_rad[0]), wrapAngle(rotary_rad[1])};
}

}  // namespace

double distanceModuloTurns(const RotaryValues& a, const RotaryValues& b) {
    return std::max(std::abs(wrapAngle(a[0] - b[0])), std::abs(wrapAngle(a[1] - b[1])));
}

std::vector<RotaryValues> searchBranches(const Machine& machine, const Vector3& axis) {
    constexpr int cells = 24;
    constexpr double found = 1e-9;
    constexpr double same = 1e-4;
    const int first_cells = machine.rotaryCount() > 0 ? cells : 1;
    const int second_cells = machine.rotaryCount() > 1 ? cells : 1;
    std::vector<RotaryValues> branches;
    for (int i = 0; i < first_cells; ++i)
        for (int j = 0; j < second_cells; ++j) {
            const RotaryValues start{turn_rad * i / cells, turn_rad * j / cells};
            // Within a cell or two of a root; Newton does the rest.
            if ((machine.toolAxis(start) - axis).norm() > 3.0 * turn_rad / cells) continue;
            const RotaryValues root = refine(machine, axis, start);
            if ((machine.toolAxis(root) - axis).norm() > found) continue;
            if (std::none_of(branches.begin(), branches.end(),
                             [&](const RotaryValues& known) { return distanceModuloTurns(known, root) < same; }))
                branches.push_back(root);
        }
    return branches;
}

}  // namespace cusp::kinematics
