// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Fits a deviation field: the pose first, then a penalised spline whose smoothing is chosen by cross-validation.
#include "field_basis.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>
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

/// Samples whose noise may hang together: those of one block, a quarter of the shortest wave long along every axis the
/// field changes along. In their order, block by block; `begin` has one more entry than there are blocks.
struct Blocks {
    std::vector<std::size_t> order;
    std::vector<std::size_t> begin;

    [[nodiscard]] std::size_t count() const { return begin.size() - 1; }
};

/// Every sample a block of its own.
Blocks singles(const Samples& samples) {
    Blocks out;
    out.order.resize(samples.used.size());
    out.begin.resize(samples.used.size() + 1);
    std::iota(out.order.begin(), out.order.end(), std::size_t{0});
    std::iota(out.begin.begin(), out.begin.end(), std::size_t{0});
    return out;
}

Blocks blocksOf(const Samples& samples, const Data& data) {
    const double length_mm = 0.25 * data.shortest_wave_mm;
    std::vector<std::array<double, 3>> cell(samples.used.size(), {0.0, 0.0, 0.0});
    for (std::size_t i = 0; i < cell.size(); ++i) {
        const Vector3 at = data.field_from_nominal * samples.used[i].position;
        for (std::size_t k = 0; k < 3; ++k)
            if (data.axes[k].degree > 0)
                cell[i][k] = std::floor((at[static_cast<Eigen::Index>(k)] - data.axes[k].low_mm) / length_mm);
    }
    Blocks out = singles(samples);
    std::ranges::sort(out.order,
                      [&](std::size_t a, std::size_t b) { return std::tie(cell[a], a) < std::tie(cell[b], b); });
    out.begin.clear();
    for (std::size_t i = 0; i < out.order.size(); ++i)
        if (i == 0 || cell[out.order[i]] != cell[out.order[i - 1]]) out.begin.push_back(i);
    out.begin.push_back(out.order.size());
    return out;
}

/// Normal equations of the spline, divided by the number of samples.
struct NormalEquations {
    Eigen::MatrixXd matrix;
    Eigen::VectorXd right;
    double square = 0.0;
};

/// Each block counts as the mean of its samples, as often as it has samples. The spline's values are averaged as the
/// deviations are, so that a spline without noise is met whatever the blocks.
NormalEquations normalEquations(const Samples& samples, const Blocks& blocks, const Data& data) {
    const auto total = static_cast<Eigen::Index>(coefficientsOf(data));
    const auto count = static_cast<double>(samples.used.size());
    NormalEquations out{Eigen::MatrixXd::Zero(total, total), Eigen::VectorXd::Zero(total), 0.0};
    std::map<Eigen::Index, double> sum;  // growing indices, so the lower triangle is filled
    for (std::size_t block = 0; block < blocks.count(); ++block) {
        sum.clear();
        double left_mm = 0.0;
        for (std::size_t k = blocks.begin[block]; k < blocks.begin[block + 1]; ++k) {
            const std::size_t i = blocks.order[k];
            detail::forEachTerm(data, samples.used[i].position, [&](std::size_t index, double value) {
                sum[static_cast<Eigen::Index>(index)] += value;
            });
            left_mm += samples.left_mm[i];
        }
        const double weight = 1.0 / (count * static_cast<double>(blocks.begin[block + 1] - blocks.begin[block]));
        out.square += weight * left_mm * left_mm;
        for (auto a = sum.begin(); a != sum.end(); ++a) {
            out.right[a->first] += weight * a->second * left_mm;
            for (auto b = sum.begin(); b != std::next(a); ++b)
                out.matrix(a->first, b->first) += weight * a->second * b->second;
        }
    }
    out.matrix = (out.matrix.selfadjointView<Eigen::Lower>() * Eigen::MatrixXd::Identity(total, total)).eval();
    return out;
}

struct Smoothed {
    Eigen::VectorXd scaled;  ///< coefficients in the basis of the spectrum
    double freedoms = 0.0;   ///< of the form
    double mean_square = 0.0;
};

/// The basis that makes the matrix plus kappa times the penalty the identity: every λ costs one pass over the eigenvalues.
class Spectrum {
public:
    Spectrum(const NormalEquations& equations, const Eigen::MatrixXd& penalty)
        : kappa_(equations.matrix.trace() / penalty.trace()),
          factor_(equations.matrix + kappa_ * penalty),
          square_(equations.square) {
        Eigen::MatrixXd inner = factor_.matrixL().solve(penalty);
        inner = factor_.matrixL().solve(inner.transpose()).eval();
        eigen_.compute(0.5 * (inner + inner.transpose()));
        right_ = eigen_.eigenvectors().transpose() * factor_.matrixL().solve(equations.right);
    }

    /// The λ at which samples and penalty weigh the same.
    [[nodiscard]] double kappa() const { return kappa_; }
    [[nodiscard]] Smoothed at(double lambda) const {
        Smoothed out{Eigen::VectorXd(right_.size()), 0.0, square_};
        for (Eigen::Index k = 0; k < right_.size(); ++k) {
            const double gamma = std::clamp(eigen_.eigenvalues()[k], 0.0, 1.0 / kappa_);
            const double seen = 1.0 - kappa_ * gamma;
            const double divisor = seen + lambda * gamma;
            out.scaled[k] = right_[k] / divisor;
            out.freedoms += seen / divisor;
            out.mean_square += out.scaled[k] * (seen * out.scaled[k] - 2.0 * right_[k]);
        }
        out.mean_square = std::max(out.mean_square, 1e-30 * square_);
        return out;
    }
    [[nodiscard]] Eigen::VectorXd coefficients(const Smoothed& found) const {
        return factor_.matrixU().solve(eigen_.eigenvectors() * found.scaled);
    }

private:
    double kappa_;
    Eigen::LLT<Eigen::MatrixXd> factor_;
    double square_;
    Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen_;
    Eigen::VectorXd right_;
};

/// The λ with the least GCV score among powers of 10^(1/4), or the largest of equals. Points along a section lie closer than
/// scallops and chords are long, so their noise hangs together; left out one by one each is foretold by its neighbours
/// however rough the field is elsewhere, and λ could be next to nothing, the field wild between the sections. The score
/// therefore leaves out blocks.
double chooseLambda(const Spectrum& spectrum, double blocks, double pose_freedoms) {
    double best = 0.0;
    double least = std::numeric_limits<double>::infinity();
    constexpr int steps_per_decade = 4;
    constexpr int decades_up = 6;
    constexpr int decades_down = 8;
    /// A freedom counts more than once (Kim & Gu 2004), or one choice in many follows the noise.
    constexpr double dearer = 1.4;
    for (int step = decades_up * steps_per_decade; step >= -decades_down * steps_per_decade; --step) {
        const double lambda = spectrum.kappa() * std::pow(10.0, static_cast<double>(step) / steps_per_decade);
        const Smoothed tried = spectrum.at(lambda);
        const double open = blocks - dearer * (tried.freedoms + pose_freedoms);
        if (best > 0.0 && !(open > 0.0)) break;
        const double score = open > 0.0 ? tried.mean_square / (open * open) : least;
        if (best > 0.0 && !(score < least)) continue;
        least = score;
        best = lambda;
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
    Eigen::MatrixXd penalty = penaltyOf(data);
    // What neither samples nor second differences see is drawn to zero.
    penalty.diagonal().array() += 1e-10 * std::max(penalty.trace(), 1e-30) / static_cast<double>(penalty.rows());
    const Blocks blocks = blocksOf(used, data);
    const Spectrum left_out(normalEquations(used, blocks, data), penalty);
    data.smoothing = chooseLambda(left_out, static_cast<double>(blocks.count()), pose_freedoms);
    const Spectrum spectrum(normalEquations(used, singles(used), data), penalty);
    const Smoothed found = spectrum.at(data.smoothing);
    const Eigen::VectorXd coefficients = spectrum.coefficients(found);
    data.effective_freedoms = found.freedoms + pose_freedoms;
    if (!coefficients.allFinite() || !(count > data.effective_freedoms))
        return base::fail("deviation-field.too-few", "the points do not determine a deviation field");
    data.coefficients_mm.assign(coefficients.begin(), coefficients.end());
    data.residual_mm = std::sqrt(found.mean_square * count / (count - data.effective_freedoms));
    return DeviationField(std::move(data));
}

}  // namespace cusp::geometry
