// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Sequential linear programming with CLP and a growing set of constraints.
#include "alignment/minimax.hpp"

#include <ClpSimplex.hpp>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace cusp::inspect {
namespace {

constexpr std::size_t first_constraints = 512;
constexpr std::size_t most_added = 256;

struct Row {
    double residual = 0.0;
    Vector6 gradient;
};

/// min t with |e_i + J_i·δ| ≤ t over the chosen points and |δ| ≤ radius; residuals in units of `scale_mm`, in which the
/// solver's tolerances mean something.
class LinearProgram {
public:
    LinearProgram(const std::array<bool, 6>& locked, double radius_mm, double scale_mm) : scale_mm_(scale_mm) {
        for (Eigen::Index i = 0; i < 6; ++i)
            if (!locked.at(static_cast<std::size_t>(i))) free_.push_back(i);
        model_.setLogLevel(0);
        model_.resize(0, static_cast<int>(free_.size()) + 1);
        for (int c = 0; c < tColumn(); ++c) model_.setColumnBounds(c, -radius_mm / scale_mm, radius_mm / scale_mm);
        model_.setColumnBounds(tColumn(), 0.0, COIN_DBL_MAX);
        model_.setObjectiveCoefficient(tColumn(), 1.0);
        model_.setPrimalTolerance(1e-11);
        model_.setDualTolerance(1e-11);
    }

    void add(const Row& row) {
        std::vector<int> columns;
        std::vector<double> values;
        for (std::size_t i = 0; i < free_.size(); ++i) {
            columns.push_back(static_cast<int>(i));
            values.push_back(row.gradient[free_[i]]);
        }
        columns.push_back(tColumn());
        const double e = row.residual / scale_mm_;
        values.push_back(-1.0);
        model_.addRow(static_cast<int>(columns.size()), columns.data(), values.data(), -COIN_DBL_MAX, -e);
        values.back() = 1.0;
        model_.addRow(static_cast<int>(columns.size()), columns.data(), values.data(), -e, COIN_DBL_MAX);
    }

    /// False when the solver gave up.
    [[nodiscard]] bool solve() { return model_.dual() == 0 && model_.isProvenOptimal(); }

    [[nodiscard]] Vector6 step() const {
        Vector6 out = Vector6::Zero();
        for (std::size_t i = 0; i < free_.size(); ++i) out[free_[i]] = scale_mm_ * model_.primalColumnSolution()[i];
        return out;
    }
    [[nodiscard]] double bound() const { return scale_mm_ * model_.primalColumnSolution()[free_.size()]; }

private:
    [[nodiscard]] int tColumn() const { return static_cast<int>(free_.size()); }

    std::vector<Eigen::Index> free_;
    double scale_mm_;
    ClpSimplex model_;
};

struct Linearisation {
    std::vector<Row> rows;

    explicit Linearisation(const ResidualField& field) {
        for (std::size_t i = 0; i < field.size(); ++i)
            if (field.takesPart(i)) rows.push_back({field.residual(i), field.gradient(i)});
    }
};

/// The points with the largest values come first; as many as asked for, or all.
std::vector<std::size_t> largest(const std::vector<double>& values, std::size_t wanted) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    wanted = std::min(wanted, order.size());
    std::nth_element(
        order.begin(), order.begin() + static_cast<std::ptrdiff_t>(wanted), order.end(),
        [&values](std::size_t a, std::size_t b) { return values[a] != values[b] ? values[a] > values[b] : a < b; });
    order.resize(wanted);
    std::sort(order.begin(), order.end());
    return order;
}

struct LinearStep {
    bool solved = false;
    Vector6 step = Vector6::Zero();
    double bound_mm = 0.0;  ///< largest |e + J·δ| over all points
};

LinearStep solveLinear(const Linearisation& lines, const std::array<bool, 6>& locked, double radius_mm,
                       double scale_mm) {
    LinearProgram program(locked, radius_mm, scale_mm);
    std::vector<std::uint8_t> inside(lines.rows.size(), 0);
    const auto take = [&](const std::vector<std::size_t>& chosen) {
        bool any = false;
        for (const std::size_t i : chosen) {
            if (inside[i] != 0) continue;
            inside[i] = 1;
            any = true;
            program.add(lines.rows[i]);
        }
        return any;
    };
    std::vector<double> sizes(lines.rows.size());
    std::transform(lines.rows.begin(), lines.rows.end(), sizes.begin(),
                   [](const Row& r) { return std::abs(r.residual); });
    take(largest(sizes, first_constraints));
    const std::size_t stride = std::max<std::size_t>(1, sizes.size() / first_constraints);
    std::vector<std::size_t> sample;
    for (std::size_t i = 0; i < sizes.size(); i += stride) sample.push_back(i);
    take(sample);
    LinearStep out;
    for (;;) {
        if (!program.solve()) return out;
        out.step = program.step();
        for (std::size_t i = 0; i < sizes.size(); ++i)
            sizes[i] = std::abs(lines.rows[i].residual + lines.rows[i].gradient.dot(out.step));
        out.bound_mm = *std::max_element(sizes.begin(), sizes.end());
        const bool violated = out.bound_mm > program.bound() + 1e-10 * scale_mm;
        if (!violated || !take(largest(sizes, most_added))) break;
    }
    out.solved = true;
    return out;
}

}  // namespace

SolveOutcome solveMinimax(ResidualField& field, const std::array<bool, 6>& locked, int max_iterations) {
    SolveOutcome out;
    field.moveTo(field.parameters());
    out.equations = field.normalEquations();
    Vector6 best = field.parameters();
    double radius_mm = std::max(1.0, 100.0 * out.equations.largest);
    const double rounding_mm = 64.0 * std::numeric_limits<double>::epsilon() * field.magnitude();
    const auto leave = [&](Termination termination) {
        field.moveTo(best);
        out.equations = field.normalEquations();
        out.termination = termination;
        return out;
    };
    while (out.iterations < max_iterations) {
        const double scale_mm = out.equations.largest;
        if (scale_mm <= rounding_mm) return leave(Termination::Converged);
        const LinearStep linear = solveLinear(Linearisation(field), locked, radius_mm, scale_mm);
        if (!linear.solved) return leave(Termination::Stalled);
        const double promised_mm = scale_mm - linear.bound_mm;
        if (promised_mm <= std::max(rounding_mm, 1e-10 * scale_mm)) return leave(Termination::Converged);
        ++out.iterations;
        field.moveTo(best + linear.step);
        const NormalEquations next = field.normalEquations();
        const double gained_mm = scale_mm - next.largest;
        if (gained_mm > 0.0) {
            best += linear.step;
            out.equations = next;
            if (gained_mm > 0.75 * promised_mm) radius_mm *= 2.0;
            continue;
        }
        // The bend of the surface ate up what the linear program promised; a shorter step keeps the promise.
        field.moveTo(best);
        radius_mm = 0.25 * linear.step.cwiseAbs().maxCoeff();
        if (radius_mm <= rounding_mm) return leave(Termination::Converged);
    }
    return leave(Termination::MaxIterations);
}

}  // namespace cusp::inspect
