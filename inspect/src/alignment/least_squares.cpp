// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The damped Gauss–Newton iteration and the rank of its normal matrix.
#include "alignment/least_squares.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cusp::inspect {
namespace {

using MatrixX = Eigen::MatrixXd;
using VectorX = Eigen::VectorXd;

std::vector<Eigen::Index> freeIndices(const std::array<bool, 6>& locked) {
    std::vector<Eigen::Index> out;
    for (Eigen::Index i = 0; i < 6; ++i)
        if (!locked.at(static_cast<std::size_t>(i))) out.push_back(i);
    return out;
}

/// Below, steps are noise: rounding leaves 1e-16 of the largest eigenvalue in directions that are not there at all.
constexpr double rank_tolerance = 1e-11;
/// A freedom known ten thousand times worse than the best one is called undetermined: what determines it is not the shape
/// but the last digit of the points.
constexpr double undetermined_ratio = 1e-8;
constexpr double weak_ratio = 1e-4;

/// As many freedoms as there are columns: the rows of the null space that span it best.
std::vector<Freedom> spanningRows(const MatrixX& space, const std::vector<Eigen::Index>& free) {
    const Eigen::ColPivHouseholderQR<MatrixX> qr(space.transpose());
    std::vector<Freedom> out;
    out.reserve(static_cast<std::size_t>(space.cols()));
    for (Eigen::Index i = 0; i < space.cols(); ++i)
        out.push_back(all_freedoms.at(
            static_cast<std::size_t>(free[static_cast<std::size_t>(qr.colsPermutation().indices()[i])])));
    std::sort(out.begin(), out.end());
    return out;
}

}  // namespace

Vector6 dampedStep(const NormalEquations& equations, const std::array<bool, 6>& locked, double damping) {
    const auto free = freeIndices(locked);
    Vector6 step = Vector6::Zero();
    if (free.empty()) return step;
    MatrixX H = equations.H(free, free);
    H.diagonal() *= 1.0 + damping;
    const Eigen::SelfAdjointEigenSolver<MatrixX> eigen(H);
    const double largest = eigen.eigenvalues().tail<1>()[0];
    VectorX solution = VectorX::Zero(H.rows());
    for (Eigen::Index i = 0; i < H.rows(); ++i) {
        const double value = eigen.eigenvalues()[i];
        if (value <= rank_tolerance * largest) continue;
        const auto vector = eigen.eigenvectors().col(i);
        solution -= vector.dot(VectorX(equations.g(free))) / value * vector;
    }
    for (std::size_t i = 0; i < free.size(); ++i) step[free[i]] = solution[static_cast<Eigen::Index>(i)];
    return step;
}

SolveOutcome solveLeastSquares(ResidualField& field, const std::array<bool, 6>& locked, int max_iterations,
                               double tolerance_mm) {
    SolveOutcome out;
    field.moveTo(field.parameters());
    out.equations = field.normalEquations();
    double damping = 0.0;
    double last_change_mm = std::numeric_limits<double>::infinity();
    bool moved = true;  // whether the field's footpoints are those of `best`
    Vector6 best = field.parameters();
    int refused = 0;
    constexpr int most_refused = 12;
    // What the rounding of the distances can do to a sum of their squares.
    const auto rounding_of = [tolerance_mm](const NormalEquations& at) {
        return 1e-13 * at.cost + 4.0 * std::sqrt(at.cost * at.weight_sum) * tolerance_mm;
    };
    const auto leave = [&](Termination termination) {
        if (!moved) field.moveTo(best);
        out.termination = termination;
        return out;
    };
    while (out.iterations < max_iterations) {
        const Vector6 step = dampedStep(out.equations, locked, damping);
        const double change_mm =
            std::sqrt(std::max(0.0, step.dot(out.equations.H * step)) / std::max(out.equations.weight_sum, 1e-300));
        if (change_mm <= tolerance_mm && damping < 1.0) return leave(Termination::Converged);
        // Steps that are small and no longer shrink are the rounding of footpoints.
        if (change_mm <= 1e2 * tolerance_mm && change_mm > 0.25 * last_change_mm) return leave(Termination::Converged);
        last_change_mm = change_mm;
        ++out.iterations;
        field.moveTo(best + step);
        const NormalEquations next = field.normalEquations();
        if (next.cost <= out.equations.cost + rounding_of(out.equations)) {
            best += step;
            moved = true;
            out.equations = next;
            damping = damping < 1e-6 ? 0.0 : 0.1 * damping;
            continue;
        }
        moved = false;
        damping = std::max(10.0 * damping, 1e-4);
        // Footpoints on edges give no true gradient; then no step helps, however short.
        if (++refused == most_refused) return leave(Termination::Stalled);
    }
    return leave(Termination::MaxIterations);
}

Determination determinationOf(const Matrix6& H, const std::array<bool, 6>& locked) {
    Determination out;
    const auto free = freeIndices(locked);
    if (free.empty()) return out;
    const Eigen::SelfAdjointEigenSolver<MatrixX> eigen{MatrixX(H(free, free))};
    const VectorX& values = eigen.eigenvalues();
    const double largest = values.tail<1>()[0];
    Eigen::Index missing = 0;
    Eigen::Index weak = 0;
    MatrixX inverse = MatrixX::Zero(values.size(), values.size());
    for (Eigen::Index i = 0; i < values.size(); ++i) {
        if (values[i] <= undetermined_ratio * largest) {
            ++missing;
            continue;
        }
        if (values[i] < weak_ratio * largest) ++weak;
        inverse += eigen.eigenvectors().col(i) * eigen.eigenvectors().col(i).transpose() / values[i];
    }
    out.condition = values[0] > 0.0 ? largest / values[0] : std::numeric_limits<double>::max();
    if (missing > 0) out.undetermined = spanningRows(eigen.eigenvectors().leftCols(missing), free);
    if (weak > 0) out.weak = spanningRows(eigen.eigenvectors().middleCols(missing, weak), free);
    for (std::size_t r = 0; r < free.size(); ++r)
        for (std::size_t c = 0; c < free.size(); ++c)
            out.inverse(free[r], free[c]) = inverse(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c));
    return out;
}

}  // namespace cusp::inspect
