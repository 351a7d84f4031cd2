// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Fits a deviation field: the pose first, then a penalised spline whose smoothing is chosen by cross-validation.
#include "field_basis.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace cusp::geometry {
namespace {

using Data = DeviationField::Data;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr std::size_t least_samples = 12;
constexpr std::size_t most_coefficients = 400;
/// cos 78°: a sheet seen from its mean normal does not fold.
constexpr double least_lean = 0.2;
/// Of variances: a freedom known ten thousand times worse than the best one is left at zero.
constexpr double weakest_freedom = 1e-8;
/// Samples that fill less of an axis than this share of a wave do not show how the field changes along it.
constexpr double narrow_share = 0.05;

/// The samples that are used, the pose's share taken off once it is known.
struct Samples {
    std::vector<DeviationSample> used;
    std::vector<double> left_mm;
};

Samples thinned(std::span<const DeviationSample> samples, std::size_t most) {
    Samples out;
    const std::size_t wanted = std::clamp<std::size_t>(samples.size(), 1, std::max(most, least_samples));
    out.used.reserve(wanted);
    for (std::size_t i = 0; i < wanted && !samples.empty(); ++i)
        out.used.push_back(samples[i * samples.size() / wanted]);
    for (const DeviationSample& sample : out.used) out.left_mm.push_back(sample.deviation_mm);
    return out;
}

double meanSquare(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value * value;
    return sum / static_cast<double>(values.size());
}

/// Least squares of n·(t + ω × (p − pivot)), rotations scaled by the radius of gyration; freedoms the samples hardly show
/// stay at zero. Returns how many were found.
double separatePose(Samples& samples, Data& data) {
    const auto count = static_cast<double>(samples.used.size());
    for (const DeviationSample& s : samples.used) data.pivot_mm += s.position / count;
    double gyration = 0.0;
    for (const DeviationSample& s : samples.used) gyration += (s.position - data.pivot_mm).squaredNorm() / count;
    const double radius_mm = std::max(std::sqrt(gyration), 1e-9);
    const auto row_of = [&](const DeviationSample& s) {
        Vector6 row;
        row << s.normal, (s.position - data.pivot_mm).cross(s.normal) / radius_mm;
        return row;
    };
    Matrix6 normal = Matrix6::Zero();
    Vector6 right = Vector6::Zero();
    for (const DeviationSample& s : samples.used) {
        const Vector6 row = row_of(s);
        normal += row * row.transpose();
        right += s.deviation_mm * row;
    }
    const Eigen::SelfAdjointEigenSolver<Matrix6> eigen(normal);
    Vector6 found = Vector6::Zero();
    double freedoms = 0.0;
    for (Eigen::Index k = 0; k < 6; ++k) {
        const double value = eigen.eigenvalues()[k];
        if (value <= weakest_freedom * eigen.eigenvalues()[5]) continue;
        found += eigen.eigenvectors().col(k) * (eigen.eigenvectors().col(k).dot(right) / value);
        freedoms += 1.0;
    }
    data.pose_translation_mm = found.head<3>();
    data.pose_rotation_rad = found.tail<3>() / radius_mm;
    for (std::size_t i = 0; i < samples.used.size(); ++i) samples.left_mm[i] -= row_of(samples.used[i]).dot(found);
    return freedoms;
}

/// Axes of the spline: for a sheet its mean normal is the third, and nothing changes along it. Returns whether it is one.
bool chooseFrame(const Samples& samples, Data& data) {
    Vector3 mean = Vector3::Zero();
    for (const DeviationSample& s : samples.used) mean += s.normal;
    if (!(mean.norm() > 1e-6 * static_cast<double>(samples.used.size()))) return false;
    mean.normalize();
    for (const DeviationSample& s : samples.used)
        if (s.normal.dot(mean) < least_lean) return false;
    Eigen::Index across = 0;
    mean.cwiseAbs().minCoeff(&across);
    const Vector3 first = (Vector3::Unit(across) - mean[across] * mean).normalized();
    data.field_from_nominal.row(0) = first;
    data.field_from_nominal.row(1) = mean.cross(first);
    data.field_from_nominal.row(2) = mean;
    return true;
}

void boxSamples(const Samples& samples, Data& data) {
    Eigen::AlignedBox3d box;
    for (const DeviationSample& s : samples.used) box.extend(Vector3(data.field_from_nominal * s.position));
    for (std::size_t k = 0; k < 3; ++k) {
        data.axes[k].low_mm = box.min()[static_cast<Eigen::Index>(k)];
        data.axes[k].high_mm = box.max()[static_cast<Eigen::Index>(k)];
    }
}

std::size_t coefficientsOf(const Data& data) {
    std::size_t count = 1;
    for (const FieldAxis& axis : data.axes) count *= axis.coefficients();
    return count;
}

void divideAxes(Data& data, bool sheet) {
    for (std::size_t k = 0; k < 3; ++k) {
        FieldAxis& axis = data.axes[k];
        const double length_mm = axis.high_mm - axis.low_mm;
        const bool constant = (sheet && k == 2) || !(length_mm > narrow_share * data.shortest_wave_mm);
        axis.degree = constant ? 0 : 3;
        constexpr double most_cells = 1000.0;
        axis.cells =
            constant
                ? 1
                : static_cast<int>(std::clamp(std::floor(2.0 * length_mm / data.shortest_wave_mm), 1.0, most_cells));
    }
}

void chooseKnots(const DeviationFieldOptions& options, bool sheet, Data& data) {
    double longest_mm = 0.0;
    for (const FieldAxis& axis : data.axes) longest_mm = std::max(longest_mm, axis.high_mm - axis.low_mm);
    data.shortest_wave_mm = options.shortest_wave_mm > 0.0 ? options.shortest_wave_mm : longest_mm / 4.0;
    divideAxes(data, sheet);
    while (coefficientsOf(data) > most_coefficients) {
        constexpr double coarser = 1.1;
        data.shortest_wave_mm *= coarser;
        divideAxes(data, sheet);
    }
}

/// ∫(f_xx² + …) as a quadratic form of the coefficients, from their second differences along each axis.
Eigen::MatrixXd penaltyOf(const Data& data) {
    const std::array<std::size_t, 3> n{data.axes[0].coefficients(), data.axes[1].coefficients(),
                                       data.axes[2].coefficients()};
    const std::array<std::size_t, 3> stride{n[1] * n[2], n[2], 1};
    const auto total = static_cast<Eigen::Index>(coefficientsOf(data));
    Eigen::MatrixXd penalty = Eigen::MatrixXd::Zero(total, total);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (data.axes[axis].degree == 0) continue;
        const double step_mm = (data.axes[axis].high_mm - data.axes[axis].low_mm) / data.axes[axis].cells;
        const double weight = 1.0 / (step_mm * step_mm * step_mm * step_mm * static_cast<double>(total));
        for (std::size_t index = 0; index < static_cast<std::size_t>(total); ++index) {
            if ((index / stride[axis]) % n[axis] + 2 >= n[axis]) continue;
            const std::array<std::pair<std::size_t, double>, 3> terms{
                std::pair{index, 1.0}, {index + stride[axis], -2.0}, {index + 2 * stride[axis], 1.0}};
            for (const auto& [row, a] : terms)
                for (const auto& [column, b] : terms)
                    penalty(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)) += weight * a * b;
        }
    }
    return penalty;
}

/// Normal equations of the spline, divided by the number of samples.
struct NormalEquations {
    Eigen::MatrixXd matrix;
    Eigen::VectorXd right;
    double square = 0.0;
};

NormalEquations normalEquations(const Samples& samples, const Data& data) {
    const auto total = static_cast<Eigen::Index>(coefficientsOf(data));
    const auto count = static_cast<double>(samples.used.size());
    NormalEquations out{Eigen::MatrixXd::Zero(total, total), Eigen::VectorXd::Zero(total), meanSquare(samples.left_mm)};
    std::vector<std::pair<Eigen::Index, double>> terms;
    for (std::size_t i = 0; i < samples.used.size(); ++i) {
        terms.clear();
        detail::forEachTerm(data, samples.used[i].position, [&](std::size_t index, double value) {
            terms.emplace_back(static_cast<Eigen::Index>(index), value);
        });
        for (std::size_t a = 0; a < terms.size(); ++a) {
            out.right[terms[a].first] += terms[a].second * samples.left_mm[i];
            for (std::size_t b = 0; b <= a; ++b)
                out.matrix(terms[a].first, terms[b].first) += terms[a].second * terms[b].second;
        }
    }
    // Terms come with growing indices, so the lower triangle is filled.
    out.matrix = (out.matrix.selfadjointView<Eigen::Lower>() * Eigen::MatrixXd::Identity(total, total)).eval() / count;
    out.right /= count;
    return out;
}

struct Smoothed {
    Eigen::VectorXd coefficients;
    double lambda = 0.0;
    double freedoms = 0.0;
    double mean_square = 0.0;
};

/// The λ with the least GCV score among powers of 10^(1/4), or the largest of equals. In the basis that makes the matrix
/// plus a penalty the identity every λ costs one pass over the eigenvalues.
Smoothed smoothed(const NormalEquations& equations, Eigen::MatrixXd penalty, double samples, double pose_freedoms) {
    const Eigen::Index n = equations.matrix.rows();
    // What neither samples nor second differences see is drawn to zero.
    penalty += Eigen::MatrixXd::Identity(n, n) * (1e-10 * std::max(penalty.trace(), 1e-30) / static_cast<double>(n));
    const double kappa = equations.matrix.trace() / penalty.trace();
    const Eigen::LLT<Eigen::MatrixXd> factor(equations.matrix + kappa * penalty);
    Eigen::MatrixXd inner = factor.matrixL().solve(penalty);
    inner = factor.matrixL().solve(inner.transpose()).eval();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(0.5 * (inner + inner.transpose()));
    const Eigen::VectorXd right = eigen.eigenvectors().transpose() * factor.matrixL().solve(equations.right);
    Smoothed best;
    Eigen::VectorXd scaled(n);
    double least = std::numeric_limits<double>::infinity();
    constexpr int steps_per_decade = 4;
    constexpr int decades_up = 6;
    constexpr int decades_down = 8;
    for (int step = decades_up * steps_per_decade; step >= -decades_down * steps_per_decade; --step) {
        const double lambda = kappa * std::pow(10.0, static_cast<double>(step) / steps_per_decade);
        double freedoms = pose_freedoms;
        double left = equations.square;
        for (Eigen::Index k = 0; k < n; ++k) {
            const double gamma = std::clamp(eigen.eigenvalues()[k], 0.0, 1.0 / kappa);
            const double seen = 1.0 - kappa * gamma;
            const double divisor = seen + lambda * gamma;
            scaled[k] = right[k] / divisor;
            freedoms += seen / divisor;
            left += scaled[k] * (seen * scaled[k] - 2.0 * right[k]);
        }
        left = std::max(left, 1e-30 * equations.square);
        const double open = samples - freedoms;
        if (!(open > 0.0)) continue;
        const double score = left / (open * open);
        if (!(score < least)) continue;
        least = score;
        best = {factor.matrixU().solve(eigen.eigenvectors() * scaled), lambda, freedoms, left};
    }
    return best;
}

base::Result<void> check(std::span<const DeviationSample> samples, const DeviationFieldOptions& options) {
    if (!(options.shortest_wave_mm >= 0.0) || !std::isfinite(options.shortest_wave_mm))
        return base::fail("deviation-field.wave",
                          "the shortest wave of a deviation field must be a length in mm, or 0");
    if (samples.size() < least_samples)
        return base::fail(
            "deviation-field.too-few",
            fmt::format("{} points for a deviation field; {} at least are needed", samples.size(), least_samples));
    for (std::size_t i = 0; i < samples.size(); ++i)
        if (!samples[i].position.allFinite() || !samples[i].normal.allFinite() ||
            !std::isfinite(samples[i].deviation_mm))
            return base::fail("deviation-field.not-finite", fmt::format("sample {} is not finite", i));
    return {};
}

}  // namespace

base::Result<DeviationField> DeviationField::fit(std::span<const DeviationSample> samples,
                                                 const DeviationFieldOptions& options) {
    if (auto checked = check(samples, options); !checked) return base::fail(std::move(checked).error());
    Data data;
    Samples used = thinned(samples, options.most_samples);
    const auto count = static_cast<double>(used.used.size());
    data.samples = used.used.size();
    data.rms_mm = std::sqrt(meanSquare(used.left_mm));
    const double pose_freedoms = options.separate_pose ? separatePose(used, data) : 0.0;
    const bool sheet = chooseFrame(used, data);
    boxSamples(used, data);
    chooseKnots(options, sheet, data);
    const Smoothed found = smoothed(normalEquations(used, data), penaltyOf(data), count, pose_freedoms);
    if (!found.coefficients.allFinite() || found.coefficients.size() == 0)
        return base::fail("deviation-field.too-few", "the points do not determine a deviation field");
    data.coefficients_mm.assign(found.coefficients.begin(), found.coefficients.end());
    data.smoothing = found.lambda;
    data.effective_freedoms = found.freedoms;
    data.residual_mm = std::sqrt(found.mean_square * count / (count - found.freedoms));
    return DeviationField(std::move(data));
}

}  // namespace cusp::geometry
