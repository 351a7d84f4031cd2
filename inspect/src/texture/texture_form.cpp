// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Legendre series of growing order, each solved by Ceres, and AICc to choose among them.
#include <cusp/inspect/texture_form.hpp>

#include <algorithm>
#include <ceres/cost_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace cusp::inspect {

namespace {

constexpr int highest_order = 20;

/// P₀ … P_order at t in −1 … 1, by Bonnet's recursion.
std::vector<double> legendreAt(double t, int order) {
    std::vector<double> p(static_cast<std::size_t>(order) + 1, 1.0);
    if (order > 0) p[1] = t;
    for (std::size_t n = 1; n + 1 < p.size(); ++n) {
        const auto k = static_cast<double>(n);
        p[n + 1] = ((2.0 * k + 1.0) * t * p[n] - k * p[n - 1]) / (k + 1.0);
    }
    return p;
}

/// Residuals form − height at every point; linear in the coefficients.
class SeriesCost : public ceres::CostFunction {
public:
    SeriesCost(const std::vector<std::vector<double>>& basis, std::span<const double> height_mm, int order)
        : basis_(basis), height_mm_(height_mm), terms_(static_cast<std::size_t>(order) + 1) {
        set_num_residuals(static_cast<int>(height_mm.size()));
        mutable_parameter_block_sizes()->push_back(order + 1);
    }

    bool Evaluate(double const* const* parameters, double* residuals,  // NOLINT(readability-identifier-naming)
                  double** jacobians) const override {
        for (std::size_t i = 0; i < height_mm_.size(); ++i) {
            double value = -height_mm_[i];
            for (std::size_t k = 0; k < terms_; ++k) value += parameters[0][k] * basis_[i][k];
            residuals[i] = value;
            if (jacobians != nullptr && jacobians[0] != nullptr)
                std::copy_n(basis_[i].begin(), terms_, jacobians[0] + i * terms_);
        }
        return true;
    }

private:
    const std::vector<std::vector<double>>& basis_;
    std::span<const double> height_mm_;
    std::size_t terms_;
};

std::vector<double> solve(const std::vector<std::vector<double>>& basis, std::span<const double> height_mm, int order) {
    std::vector<double> coefficients(static_cast<std::size_t>(order) + 1, 0.0);
    ceres::Problem problem;
    problem.AddResidualBlock(new SeriesCost(basis, height_mm, order), nullptr, coefficients.data());
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.logging_type = ceres::SILENT;
    // The problem is linear: with next to no damping the first step arrives, the second one polishes.
    options.initial_trust_region_radius = 1e16;
    options.max_trust_region_radius = 1e32;
    options.function_tolerance = 1e-16;
    options.gradient_tolerance = 0.0;
    options.parameter_tolerance = 1e-16;
    options.max_num_iterations = 5;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    return coefficients;
}

std::vector<double> residualsOf(const std::vector<std::vector<double>>& basis, std::span<const double> height_mm,
                                const std::vector<double>& coefficients) {
    std::vector<double> out(height_mm.begin(), height_mm.end());
    for (std::size_t i = 0; i < out.size(); ++i)
        for (std::size_t k = 0; k < coefficients.size(); ++k) out[i] -= coefficients[k] * basis[i][k];
    return out;
}

double sumOfSquares(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value * value;
    return sum;
}

/// Points that count as independent: n(1 − ρ)/(1 + ρ) of a first-order autoregression, but not fewer than the residuals
/// change sign, since ridges in a row are not one event however finely they are sampled.
double effectivePoints(const std::vector<double>& residuals) {
    const double variance = sumOfSquares(residuals);
    double covariance = 0.0;
    double changes = 0.0;
    for (std::size_t i = 1; i < residuals.size(); ++i) {
        covariance += residuals[i - 1] * residuals[i];
        if ((residuals[i - 1] < 0.0) != (residuals[i] < 0.0)) changes += 1.0;
    }
    const double correlation = variance > 0.0 ? std::clamp(covariance / variance, 0.0, 1.0) : 0.0;
    return std::max(static_cast<double>(residuals.size()) * (1.0 - correlation) / (1.0 + correlation), changes);
}

double correctedAkaike(double rss, double points, double effective, int order) {
    const double k = order + 2.0;
    if (effective <= k + 1.0) return std::numeric_limits<double>::infinity();
    // A profile the series meets exactly leaves rounding: every further order is as good, and the penalty decides.
    const double variance = std::max(rss / points, 1e-30);
    return effective * std::log(variance) + 2.0 * k + 2.0 * k * (k + 1.0) / (effective - k - 1.0);
}

base::Result<void> checkPoints(std::span<const double> position_mm, std::span<const double> height_mm,
                               std::size_t least) {
    if (position_mm.size() != height_mm.size())
        return base::fail("form.points",
                          fmt::format("{} positions, but {} heights", position_mm.size(), height_mm.size()));
    if (position_mm.size() < least)
        return base::fail("form.points", fmt::format("{} points; {} are needed at least", position_mm.size(), least));
    for (std::size_t i = 0; i < position_mm.size(); ++i)
        if (!std::isfinite(height_mm[i]) || !std::isfinite(position_mm[i]) ||
            (i > 0 && !(position_mm[i] > position_mm[i - 1])))
            return base::fail("form.points", fmt::format("positions must grow; point {} does not", i + 1));
    return {};
}

/// The highest order that may be tried.
int orderLimit(const FormOptions& options, double length_mm, std::size_t points) {
    int limit = std::min(options.largest_order, static_cast<int>(std::min<std::size_t>(points, 1000)) - 3);
    if (options.shortest_half_wave_mm > 0.0)
        limit = std::min(limit, static_cast<int>(std::min(1000.0, length_mm / options.shortest_half_wave_mm)));
    return std::max(limit, 0);
}

std::string textOf(const FormFit& fit, bool chosen) {
    if (!chosen) return fmt::format("Form: polynomial of order {}, as given.", fit.order);
    return fmt::format(
        "Form: polynomial of order {}, the smallest AICc of orders 0 to {} with {:.0f} effective points.", fit.order,
        fit.candidates.back().order, fit.effective_points);
}

}  // namespace

base::Result<FormFit> fitForm(std::span<const double> position_mm, std::span<const double> height_mm,
                              const FormOptions& options) {
    const int asked = options.order.value_or(options.largest_order);
    if (asked < 0 || asked > highest_order)
        return base::fail("form.order", fmt::format("order {} of a form; 0 to {} can be fitted", asked, highest_order));
    const auto least = static_cast<std::size_t>(options.order.value_or(0)) + 3;
    if (const auto checked = checkPoints(position_mm, height_mm, least); !checked) return base::fail(checked.error());

    const double begin = position_mm.front();
    const double length_mm = position_mm.back() - begin;
    const int limit = options.order.value_or(orderLimit(options, length_mm, position_mm.size()));
    std::vector<std::vector<double>> basis;
    basis.reserve(position_mm.size());
    for (const double x : position_mm) basis.push_back(legendreAt(2.0 * (x - begin) / length_mm - 1.0, limit));

    FormFit best;
    const auto points = static_cast<double>(height_mm.size());
    best.effective_points = effectivePoints(residualsOf(basis, height_mm, solve(basis, height_mm, limit)));
    double smallest = std::numeric_limits<double>::infinity();
    for (int order = options.order.value_or(0); order <= limit; ++order) {
        const std::vector<double> coefficients = solve(basis, height_mm, order);
        const double rss = sumOfSquares(residualsOf(basis, height_mm, coefficients));
        const double aicc = correctedAkaike(rss, points, best.effective_points, order);
        best.candidates.push_back({order, std::sqrt(rss / points), aicc});
        if (aicc < smallest || best.coefficients_mm.empty()) {
            smallest = aicc;
            best.order = order;
            best.coefficients_mm = coefficients;
            best.rms_mm = best.candidates.back().rms_mm;
        }
    }
    const std::vector<double> residuals = residualsOf(basis, height_mm, best.coefficients_mm);
    best.form_mm.resize(residuals.size());
    for (std::size_t i = 0; i < residuals.size(); ++i) best.form_mm[i] = height_mm[i] - residuals[i];
    best.text = textOf(best, !options.order);
    return best;
}

}  // namespace cusp::inspect
