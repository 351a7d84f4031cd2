// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Bernstein coefficients to Taylor coefficients at the middle of the cell.
#include "cell_polynomial.hpp"

#include <algorithm>
#include <cassert>
#include <vector>

namespace cusp::geometry::detail {
namespace {

using Vector4 = BezierPatch::Vector4;

/// Taylor coefficients at x = 1/2 by h = 2x − 1 of Bernstein coefficients of degree n, `stride` apart, in place: derivatives
/// at the middle are differences, averaged down by de Casteljau; fₖ = n!/(n − k)! Δᵏ / (k! 2ᵏ).
void bernsteinToMiddle(Vector4* b, std::size_t n, std::size_t stride) {
    std::array<Vector4, fast_degree + 1> taylor;
    std::array<Vector4, fast_degree + 1> differences;
    for (std::size_t i = 0; i <= n; ++i) differences[i] = b[i * stride];
    double factor = 1.0;
    for (std::size_t k = 0; k <= n; ++k) {
        std::array<Vector4, fast_degree + 1> level = differences;
        for (std::size_t r = n - k; r > 0; --r) {
            for (std::size_t i = 0; i < r; ++i) level[i] = 0.5 * (level[i] + level[i + 1]);
        }
        taylor[k] = factor * level[0];
        for (std::size_t i = 0; i + k < n; ++i) differences[i] = differences[i + 1] - differences[i];
        factor *= static_cast<double>(n - k) / (2.0 * static_cast<double>(k + 1));
    }
    for (std::size_t k = 0; k <= n; ++k) b[k * stride] = taylor[k];
}

}  // namespace

CellPolynomial::CellPolynomial(const BezierPatch& part)
    : degree_(std::max(part.degreeU(), part.degreeV())), rational_(part.isRational()) {
    assert(canHold(part));
    const auto rows = static_cast<std::size_t>(part.degreeU()) + 1;
    const auto columns = static_cast<std::size_t>(part.degreeV()) + 1;
    std::vector<Vector4> net = part.net();
    for (std::size_t i = 0; i < rows; ++i) bernsteinToMiddle(&net[i * columns], columns - 1, 1);
    for (std::size_t j = 0; j < columns; ++j) bernsteinToMiddle(&net[j], rows - 1, columns);
    for (std::size_t i = 0; i < rows; ++i) {
        for (std::size_t j = 0; j < columns; ++j) {
            const Vector4& c = net[i * columns + j];
            coefficients_[i][j] = {Lanes::Pair{c[0], c[1]}, Lanes::Pair{c[2], c[3]}};
        }
    }
}

}  // namespace cusp::geometry::detail
