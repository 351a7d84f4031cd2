// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Convolution with the Gaussian inside, a local straight line at the ends.
#include <cusp/inspect/texture_filter.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace cusp::inspect {

namespace {

/// Half width of the weights, in cut-offs.
constexpr double reach_cutoffs = 1.3;

double sigmaOf(double cutoff_mm) { return cutoff_mm / std::numbers::pi * std::sqrt(std::numbers::ln2 / 2.0); }

/// Value at its middle of the straight line fitted to the samples under the weights around `center`.
double localLine(std::span<const double> z, const std::vector<double>& weights, std::size_t center) {
    const std::size_t reach = weights.size() - 1;
    const std::size_t first = center > reach ? center - reach : 0;
    const std::size_t last = std::min(z.size() - 1, center + reach);
    double w = 0.0;
    double wx = 0.0;
    double wxx = 0.0;
    double wz = 0.0;
    double wxz = 0.0;
    for (std::size_t i = first; i <= last; ++i) {
        const double x = static_cast<double>(i) - static_cast<double>(center);
        const double weight = weights[i > center ? i - center : center - i];
        w += weight;
        wx += weight * x;
        wxx += weight * x * x;
        wz += weight * z[i];
        wxz += weight * x * z[i];
    }
    const double determinant = w * wxx - wx * wx;
    // A cut-off below the spacing leaves one sample under the weights: the line is that sample.
    return determinant > 1e-300 ? (wxx * wz - wx * wxz) / determinant : wz / w;
}

double inside(std::span<const double> z, const std::vector<double>& weights, std::size_t center, double total) {
    double sum = weights[0] * z[center];
    for (std::size_t k = 1; k < weights.size(); ++k) sum += weights[k] * (z[center - k] + z[center + k]);
    return sum / total;
}

}  // namespace

std::vector<double> gaussianLowPass(std::span<const double> heights, double spacing_mm, double cutoff_mm) {
    const double sigma = sigmaOf(cutoff_mm) / spacing_mm;
    const auto reach = static_cast<std::size_t>(
        std::min(std::floor(reach_cutoffs * cutoff_mm / spacing_mm), static_cast<double>(heights.size())));
    std::vector<double> weights(reach + 1);
    double total = 0.0;
    for (std::size_t k = 0; k <= reach; ++k) {
        const double x = static_cast<double>(k) / sigma;
        weights[k] = std::exp(-0.5 * x * x);
        total += k == 0 ? weights[k] : 2.0 * weights[k];
    }
    std::vector<double> out(heights.size());
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const bool whole = i >= reach && i + reach < heights.size();
        out[i] = whole ? inside(heights, weights, i, total) : localLine(heights, weights, i);
    }
    return out;
}

double gaussianTransmission(double wavelength_mm, double cutoff_mm) {
    const double sigma = sigmaOf(cutoff_mm);
    const double turns = 2.0 * std::numbers::pi * sigma / wavelength_mm;
    return std::exp(-0.5 * turns * turns);
}

}  // namespace cusp::inspect
