// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Products of Bernstein polynomials (Farin 2002, 6.8): scaled by their binomials, coefficients convolve.
#include "distance_polynomial.hpp"

#include "bernstein.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace cusp::geometry::detail {
namespace {

constexpr double rounding = 2e-15;

std::vector<double> binomials(int n) {
    std::vector<double> row;
    for (int k = 0; k <= n; ++k) row.push_back(binomial(static_cast<std::size_t>(n), static_cast<std::size_t>(k)));
    return row;
}

/// Coefficients of |N|² and of w², degree (2p, 2q), v running faster.
struct Squares {
    std::size_t rows;
    std::size_t columns;
    std::vector<double> space;
    std::vector<double> weight;
};

Squares squaresOf(const BezierPatch& patch) {
    const int p = patch.degreeU();
    const int q = patch.degreeV();
    const std::vector<double> in_u = binomials(p);
    const std::vector<double> in_v = binomials(q);
    const auto m = static_cast<std::size_t>(p) + 1;
    const auto n = static_cast<std::size_t>(q) + 1;
    std::vector<BezierPatch::Vector4> scaled = patch.net();
    for (std::size_t i = 0; i < m; ++i) {
        for (std::size_t j = 0; j < n; ++j) scaled[i * n + j] *= in_u[i] * in_v[j];
    }
    Squares out{2 * m - 1, 2 * n - 1, {}, {}};
    out.space.assign(out.rows * out.columns, 0.0);
    out.weight.assign(out.rows * out.columns, 0.0);
    for (std::size_t a = 0; a < m * n; ++a) {
        for (std::size_t b = a; b < m * n; ++b) {
            const double twice = a == b ? 1.0 : 2.0;
            const std::size_t to = (a / n + b / n) * out.columns + a % n + b % n;
            out.space[to] += twice * scaled[a].head<3>().dot(scaled[b].head<3>());
            out.weight[to] += twice * scaled[a][3] * scaled[b][3];
        }
    }
    const std::vector<double> square_u = binomials(2 * p);
    const std::vector<double> square_v = binomials(2 * q);
    for (std::size_t k = 0; k < out.rows; ++k) {
        for (std::size_t l = 0; l < out.columns; ++l) {
            out.space[k * out.columns + l] /= square_u[k] * square_v[l];
            out.weight[k * out.columns + l] /= square_u[k] * square_v[l];
        }
    }
    return out;
}

}  // namespace

DistancePolynomial::DistancePolynomial(const BezierPatch& patch) {
    const Squares s = squaresOf(patch);
    std::size_t least = 0;
    double largest = 0.0;
    least_squared_mm2 = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < s.space.size(); ++k) {
        const double quotient = s.space[k] / s.weight[k];
        largest = std::max(largest, quotient);
        if (quotient < least_squared_mm2) {
            least_squared_mm2 = quotient;
            least = k;
        }
    }
    place_u_ = static_cast<double>(least / s.columns) / static_cast<double>(s.rows - 1);
    place_v_ = static_cast<double>(least % s.columns) / static_cast<double>(s.columns - 1);

    // |N|² − least · w² is what has to be resolved; its second differences say in which direction it bends.
    std::vector<double> rest(s.space.size());
    for (std::size_t k = 0; k < rest.size(); ++k) rest[k] = s.space[k] - least_squared_mm2 * s.weight[k];
    // What rounding may have added to the least coefficient.
    least_squared_mm2 = std::max(0.0, least_squared_mm2 - rounding * largest);
    for (std::size_t k = 0; k < s.rows; ++k) {
        for (std::size_t l = 0; l < s.columns; ++l) {
            const double* const at = &rest[k * s.columns + l];
            if (k + 2 < s.rows) {
                bend_u = std::max(bend_u, std::abs(at[0] - 2.0 * at[s.columns] + at[2 * s.columns]));
            }
            if (l + 2 < s.columns) bend_v = std::max(bend_v, std::abs(at[0] - 2.0 * at[1] + at[2]));
        }
    }
    // Second differences of the size of rounding say nothing.
    const double noise = 4.0 * rounding * largest;
    if (bend_u < noise) bend_u = 0.0;
    if (bend_v < noise) bend_v = 0.0;
}

}  // namespace cusp::geometry::detail
