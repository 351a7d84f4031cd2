// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Rounds of cutting anew and solving; then what is determined, and what is not.
#include <cusp/loop/calibration.hpp>

#include "calibration_columns.hpp"

#include <Eigen/SVD>
#include <ceres/ceres.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace cusp::loop {
namespace {

using Kind = ErrorParameter::Kind;

/// Singular values below this share of the largest are those of rounding and of the differences the columns are made by.
constexpr double rank_share = 1e-7;
/// The part of a unit step of a parameter that the points do not see, from which on it counts as inseparable.
constexpr double unseen_share = 1e-3;
/// In the solve alone: errors are not larger than so many times the typical ones, where nothing else says.
constexpr double largest_typical = 30.0;

/// Residuals (target − columns·x)/sigma.
class LinearCost : public ceres::CostFunction {
public:
    LinearCost(const Eigen::MatrixXd& columns, const Eigen::VectorXd& target) : columns_(columns), target_(target) {
        set_num_residuals(static_cast<int>(columns.rows()));
        mutable_parameter_block_sizes()->push_back(static_cast<int>(columns.cols()));
    }
    bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
        const Eigen::Map<const Eigen::VectorXd> at(x[0], columns_.cols());
        Eigen::Map<Eigen::VectorXd>(residuals, columns_.rows()) = target_ - columns_ * at;
        if (jacobians != nullptr && jacobians[0] != nullptr)
            Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
                jacobians[0], columns_.rows(), columns_.cols()) = -columns_;
        return true;
    }

private:
    const Eigen::MatrixXd& columns_;
    const Eigen::VectorXd& target_;
};

/// Columns and targets in standard deviations, stated values as rows of their own.
struct LinearProblem {
    Eigen::MatrixXd columns;
    Eigen::VectorXd target;
};

struct State {
    std::vector<ErrorParameter> parameters;
    std::vector<PreparedPart> parts;
    std::vector<Unknown> unknowns;
    std::vector<const KnownValue*> known;  ///< by parameter; null
    Eigen::VectorXd x;                     ///< scaled
    Eigen::VectorXd left_mm;               ///< measured − predicted, at x
    Eigen::MatrixXd columns;               ///< at x
    double noise_mm = 0.0;

    [[nodiscard]] MachineErrors errors() const {
        MachineErrors out;
        for (std::size_t j = 0; j < parameters.size(); ++j) {
            const double value = x[static_cast<Eigen::Index>(j)] * parameters[j].typical;
            // A lag below zero is the others' above it.
            out[parameters[j].name] = parameters[j].kind == Kind::Lag ? std::max(0.0, value) : value;
        }
        return out;
    }
    /// Where the parts were cut last: x, without lags below zero.
    [[nodiscard]] Eigen::VectorXd lookedAt() const {
        Eigen::VectorXd at = Eigen::VectorXd::Zero(x.size());
        const MachineErrors cut = errors();
        for (std::size_t j = 0; j < parameters.size(); ++j)
            at[static_cast<Eigen::Index>(j)] = cut.at(parameters[j].name) / parameters[j].typical;
        return at;
    }
    [[nodiscard]] std::size_t machineUnknowns() const { return parameters.size(); }
};

/// `offset_mm`: of the deviations at x = 0 of the linear model.
LinearProblem problemOf(const State& state, const Eigen::VectorXd& offset_mm, double noise_mm) {
    std::size_t stated = 0;
    for (const KnownValue* value : state.known)
        if (value != nullptr) ++stated;
    const Eigen::Index rows = state.columns.rows();
    LinearProblem out{.columns = Eigen::MatrixXd::Zero(rows + static_cast<Eigen::Index>(stated), state.columns.cols()),
                      .target = Eigen::VectorXd::Zero(rows + static_cast<Eigen::Index>(stated))};
    out.columns.topRows(rows) = state.columns / noise_mm;
    out.target.head(rows) = offset_mm / noise_mm;
    Eigen::Index row = rows;
    for (std::size_t j = 0; j < state.known.size(); ++j) {
        if (state.known[j] == nullptr) continue;
        out.columns(row, static_cast<Eigen::Index>(j)) = state.parameters[j].typical / state.known[j]->uncertainty;
        out.target[row++] = state.known[j]->value / state.known[j]->uncertainty;
    }
    return out;
}

base::Result<Eigen::VectorXd> solve(const LinearProblem& problem, std::size_t machine_unknowns) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(problem.columns.cols());
    // What the points do not see must not run away: a pull so weak that it does not show in what they do see.
    const auto pulled = static_cast<Eigen::Index>(machine_unknowns);
    Eigen::MatrixXd pull = Eigen::MatrixXd::Zero(pulled, x.size());
    pull.leftCols(pulled).diagonal().setConstant(1.0 / largest_typical);
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(pulled);
    ceres::Problem solver_problem;
    solver_problem.AddResidualBlock(new LinearCost(problem.columns, problem.target), nullptr, x.data());
    solver_problem.AddResidualBlock(new LinearCost(pull, zero), nullptr, x.data());
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.logging_type = ceres::SILENT;
    options.num_threads = 1;
    options.max_num_iterations = 100;
    options.function_tolerance = 1e-14;
    options.gradient_tolerance = 1e-12;
    options.parameter_tolerance = 1e-12;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &solver_problem, &summary);
    if (!summary.IsSolutionUsable() || !x.allFinite())
        return base::fail("calibrate.solver", "no solution: " + summary.message);
    return x;
}

/// Of all unknowns, scaled; what is not determined takes no part.
base::Result<Eigen::MatrixXd> covarianceOf(const LinearProblem& problem) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(problem.columns.cols());
    ceres::Problem covariance_problem;
    covariance_problem.AddResidualBlock(new LinearCost(problem.columns, problem.target), nullptr, x.data());
    ceres::Covariance::Options options;
    options.algorithm_type = ceres::DENSE_SVD;
    options.null_space_rank = -1;
    options.min_reciprocal_condition_number = rank_share * rank_share;
    options.num_threads = 1;
    ceres::Covariance covariance(options);
    const std::vector<std::pair<const double*, const double*>> all{{x.data(), x.data()}};
    if (!covariance.Compute(all, &covariance_problem))
        return base::fail("calibrate.solver", "the covariance cannot be computed");
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> out(x.size(), x.size());
    covariance.GetCovarianceBlock(x.data(), x.data(), out.data());
    return Eigen::MatrixXd(out);
}

base::Result<void> lookAgain(const machine::MachineDefinition& nominal, const CuttingSetup& setup,
                             const CalibrationOptions& options, State& state) {
    const MachineErrors at = state.errors();
    const auto real = realMachine(nominal, at, setup);
    if (!real) return base::fail(real.error());
    Eigen::Index row = 0;
    for (const PreparedPart& part : state.parts) {
        const auto predicted = predict(part, *real);
        if (!predicted) return base::fail(predicted.error());
        for (std::size_t i = 0; i < predicted->size(); ++i)
            state.left_mm[row++] = part.measured_mm[i] - (*predicted)[i];
    }
    auto columns = columnsOf(nominal, setup, state.parameters, at, state.parts, options);
    if (!columns) return base::fail(columns.error());
    state.columns = *std::move(columns);
    return {};
}

base::Result<State> prepare(const machine::MachineDefinition& nominal, const CuttingSetup& setup,
                            const std::vector<CalibrationPart>& parts, const CalibrationOptions& options) {
    if (parts.empty()) return base::fail("calibrate.no-parts", "there is no part to calibrate from");
    const auto exact = realMachine(nominal, {}, setup);
    if (!exact) return base::fail(exact.error());
    State out;
    out.parameters = errorParameters(exact->model);
    Eigen::Index rows = 0;
    for (const CalibrationPart& part : parts) {
        auto prepared = preparePart(part, *exact);
        if (!prepared) return base::fail(prepared.error());
        rows += static_cast<Eigen::Index>(prepared->measured_mm.size());
        out.parts.push_back(*std::move(prepared));
    }
    out.unknowns = unknownsOf(out.parameters, out.parts, options);
    const auto unknowns = static_cast<Eigen::Index>(out.unknowns.size());
    if (rows < 2 * unknowns)
        return base::fail("calibrate.points", fmt::format("{} points for {} unknowns; at least {} are needed", rows,
                                                          unknowns, 2 * unknowns));
    out.known.assign(out.parameters.size(), nullptr);
    for (const KnownValue& value : options.known) {
        const auto found = std::ranges::find(out.parameters, value.name, &ErrorParameter::name);
        if (found == out.parameters.end() || !(value.uncertainty > 0.0))
            return base::fail("calibrate.known",
                              found == out.parameters.end()
                                  ? fmt::format("this machine has no error '{}' to be known", value.name)
                                  : fmt::format("{} is known with an uncertainty of {}; it must be above 0", value.name,
                                                value.uncertainty));
        out.known[static_cast<std::size_t>(found - out.parameters.begin())] = &value;
    }
    out.x = Eigen::VectorXd::Zero(unknowns);
    out.left_mm = Eigen::VectorXd::Zero(rows);
    return out;
}

double rmsOf(const Eigen::VectorXd& values) { return values.norm() / std::sqrt(static_cast<double>(values.size())); }

/// 97.5 % quantile of Student's t, to 0.1 % from 20 freedoms on (Cornish and Fisher's first two terms).
double studentQuantile(double freedoms) {
    constexpr double z = 1.959963984540054;
    return z + (z * z * z + z) / (4.0 * freedoms) +
           (5.0 * std::pow(z, 5) + 16.0 * z * z * z + 3.0 * z) / (96.0 * freedoms * freedoms);
}

std::string remedyFor(const ErrorParameter& parameter) {
    switch (parameter.kind) {
        case Kind::ToolLength:
            return "measure the tool on a presetter and state it under [[known]]; pivot and tool length act only as a sum";
        case Kind::PivotLength:
            return "state the tool's measured length under [[known]], and cut a part with tilts of 25° and more "
                   "(cusp calibrate --plan)";
        case Kind::ToolRadius:
            return "measure the tool's radius on a presetter and state it under [[known]], or measure walls on both sides";
        case Kind::AxisZero:
            return "tram the spindle with an indicator and state the zero under [[known]]: the ball of a mill hides how the "
                   "tool leans, and its tip moves as if axes lay elsewhere";
        case Kind::AxisPoint:
            return "tram the spindle and state the zero of the axis under [[known]], and cut a part with tilts to all sides, "
                   "25° and more (cusp calibrate --plan)";
        case Kind::AxisTilt:
            return "cut and measure a part with tilts to all sides, 25° and more (cusp calibrate --plan)";
        case Kind::Squareness:
            return "measure faces that stand across each other, far apart (cusp calibrate --plan), or a ball bar's circle";
        case Kind::Lag:
            return "a part shows only how lags differ: record a circular test with a ball bar or a grid plate at two feeds";
    }
    return {};
}

class Judge {
public:
    Judge(const State& state, const LinearProblem& problem)
        : state_(state), svd_(problem.columns, Eigen::ComputeThinU | Eigen::ComputeFullV) {
        const auto& sizes = svd_.singularValues();
        while (rank_ < sizes.size() && sizes[rank_] > rank_share * sizes[0]) ++rank_;
        unseen_ = svd_.matrixV().rightCols(svd_.matrixV().cols() - rank_);
    }
    [[nodiscard]] std::size_t rank() const { return static_cast<std::size_t>(rank_); }
    [[nodiscard]] double condition() const {
        return rank_ > 0 ? svd_.singularValues()[0] / svd_.singularValues()[rank_ - 1] : 0.0;
    }

    void judge(std::size_t j, const Eigen::MatrixXd& covariance, double quantile, FoundParameter& out) const {
        const auto column = static_cast<Eigen::Index>(j);
        out.parameter = state_.parameters[j];
        out.known = state_.known[j] != nullptr;
        out.value = state_.x[column] * out.parameter.typical;
        out.remedy = remedyFor(out.parameter);
        const double unseen = unseen_.cols() > 0 ? unseen_.row(column).norm() : 0.0;
        if (unseen > unseen_share) {
            out.state = ParameterState::Inseparable;
            out.with = partnersOf(column);
            return;
        }
        out.standard_uncertainty = std::sqrt(std::max(0.0, covariance(column, column))) * out.parameter.typical;
        out.interval_95 = quantile * out.standard_uncertainty;
        out.state = out.interval_95 <= out.parameter.typical ? ParameterState::Identified : ParameterState::Weak;
        out.significant = out.state == ParameterState::Identified && std::abs(out.value) > out.interval_95;
    }

private:
    /// Unknowns that move together with this one in what the points do not see.
    [[nodiscard]] std::vector<std::string> partnersOf(Eigen::Index j) const {
        constexpr double together = 0.05;
        std::vector<std::string> out;
        const Eigen::VectorXd moved = unseen_ * unseen_.row(j).transpose();
        for (Eigen::Index k = 0; k < moved.size(); ++k)
            if (k != j && std::abs(moved[k]) > together * moved.cwiseAbs().maxCoeff())
                out.push_back(state_.unknowns[static_cast<std::size_t>(k)].name);
        return out;
    }

    const State& state_;
    Eigen::JacobiSVD<Eigen::MatrixXd> svd_;
    Eigen::Index rank_ = 0;
    Eigen::MatrixXd unseen_;
};

}  // namespace

std::string_view stateName(ParameterState state) {
    switch (state) {
        case ParameterState::Identified: return "identified";
        case ParameterState::Weak: return "weak";
        case ParameterState::Inseparable: return "inseparable";
    }
    return "inseparable";
}

MachineErrors CalibrationResult::corrections() const {
    MachineErrors out;
    for (const FoundParameter& found : parameters)
        if (found.significant) out[found.parameter.name] = found.value;
    return out;
}

base::Result<CalibrationResult> calibrate(const machine::MachineDefinition& nominal, const CuttingSetup& setup,
                                          const std::vector<CalibrationPart>& parts,
                                          const CalibrationOptions& options) {
    auto state = prepare(nominal, setup, parts, options);
    if (!state) return base::fail(state.error());
    CalibrationResult out;
    if (const auto ok = lookAgain(nominal, setup, options, *state); !ok) return base::fail(ok.error());
    out.points = static_cast<std::size_t>(state->left_mm.size());
    out.unknowns = state->unknowns.size();
    out.start_rms_mm = rmsOf(state->left_mm);
    constexpr double first_guess_mm = 0.001;
    double noise_mm = options.noise_mm > 0.0 ? options.noise_mm : first_guess_mm;
    const auto machine_unknowns = static_cast<Eigen::Index>(state->machineUnknowns());
    LinearProblem problem;
    Eigen::VectorXd left_mm;
    for (out.rounds = 1; out.rounds <= std::max(1, options.rounds); ++out.rounds) {
        // The linear model through the machine of the last round: what it leaves, plus what it already explains.
        const Eigen::VectorXd at = state->lookedAt();
        const Eigen::VectorXd offset_mm = state->left_mm + state->columns * at;
        problem = problemOf(*state, offset_mm, noise_mm);
        const auto x = solve(problem, state->machineUnknowns());
        if (!x) return base::fail(x.error());
        const double moved =
            (state->columns.leftCols(machine_unknowns) * (*x - state->x).head(machine_unknowns)).cwiseAbs().maxCoeff();
        state->x = *x;
        left_mm = offset_mm - state->columns * state->x;
        constexpr double settled_mm = 2e-5;
        if (moved < settled_mm) {
            out.converged = true;
            break;
        }
        if (const auto ok = lookAgain(nominal, setup, options, *state); !ok) return base::fail(ok.error());
    }
    out.rounds = std::min(out.rounds, std::max(1, options.rounds));
    out.rms_mm = rmsOf(left_mm);
    const Judge rough(*state, problem);
    const double freedoms = static_cast<double>(out.points) - static_cast<double>(rough.rank());
    out.noise_mm = options.noise_mm > 0.0 ? options.noise_mm : left_mm.norm() / std::sqrt(freedoms);
    problem = problemOf(*state, left_mm, std::max(out.noise_mm, 1e-9));
    const Judge judge(*state, problem);
    const auto covariance = covarianceOf(problem);
    if (!covariance) return base::fail(covariance.error());
    out.rank = judge.rank();
    out.condition = judge.condition();
    const double quantile = options.noise_mm > 0.0 ? 1.959963984540054 : studentQuantile(freedoms);
    out.parameters.resize(state->parameters.size());
    for (std::size_t j = 0; j < out.parameters.size(); ++j) judge.judge(j, *covariance, quantile, out.parameters[j]);
    return out;
}

}  // namespace cusp::loop
