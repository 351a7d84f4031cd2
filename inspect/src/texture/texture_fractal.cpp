// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Extremes over windows that double, and a straight line through the logarithms.
#include "texture/texture_fractal.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

namespace cusp::inspect {

namespace {

constexpr std::size_t smallest_radius = 8;
constexpr std::size_t radii_in_length = 16;
constexpr std::size_t least_scales = 3;

/// From the extremes within ± radius to those within ± 2·radius: three windows cover it, ends cut off.
template <class Better>
void widen(std::vector<double>& extreme, std::size_t radius, Better better) {
    const std::vector<double> narrow = extreme;
    const std::size_t last = narrow.size() - 1;
    for (std::size_t i = 0; i < narrow.size(); ++i) {
        const double left = narrow[i > radius ? i - radius : 0];
        const double right = narrow[std::min(last, i + radius)];
        extreme[i] = better(narrow[i], better(left, right));
    }
}

double slopeThrough(const std::vector<double>& x, const std::vector<double>& y) {
    const auto n = static_cast<double>(x.size());
    double sx = 0.0;
    double sy = 0.0;
    double sxx = 0.0;
    double sxy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        sx += x[i];
        sy += y[i];
        sxx += x[i] * x[i];
        sxy += x[i] * y[i];
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace

std::optional<double> fractalDimension(std::span<const double> heights) {
    std::vector<double> high(heights.begin(), heights.end());
    std::vector<double> low = high;
    const auto larger = [](double a, double b) { return std::max(a, b); };
    const auto smaller = [](double a, double b) { return std::min(a, b); };
    std::vector<double> log_radius;
    std::vector<double> log_variation;
    // Radius 1 comes from the samples themselves: their windows reach to the neighbours.
    widen(high, 1, larger);
    widen(low, 1, smaller);
    for (std::size_t radius = 1; radius * radii_in_length <= heights.size(); radius *= 2) {
        double variation = 0.0;
        for (std::size_t i = 0; i < high.size(); ++i) variation += high[i] - low[i];
        if (!(variation > 0.0)) return std::nullopt;
        if (radius >= smallest_radius) {
            log_radius.push_back(std::log(static_cast<double>(radius)));
            log_variation.push_back(std::log(variation));
        }
        widen(high, radius, larger);
        widen(low, radius, smaller);
    }
    if (log_radius.size() < least_scales) return std::nullopt;
    return 2.0 - slopeThrough(log_radius, log_variation);
}

}  // namespace cusp::inspect
