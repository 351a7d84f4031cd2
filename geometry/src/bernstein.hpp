// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The Bernstein polynomials of one degree with their first two derivatives.
#pragma once

#include <cusp/geometry/bezier_patch.hpp>

#include <array>
#include <cstddef>

namespace cusp::geometry::detail {

[[nodiscard]] inline double binomial(std::size_t n, std::size_t k) {
    double out = 1.0;
    for (std::size_t i = 1; i <= k; ++i) out = out * static_cast<double>(n - k + i) / static_cast<double>(i);
    return out;
}

/// Bᵢⁿ(t) and derivatives for i = 0 … n, by the recurrence Bᵢⁿ = (1 − t) Bᵢⁿ⁻¹ + t Bᵢ₋₁ⁿ⁻¹; all terms are positive on
/// [0, 1], so nothing cancels.
struct BernsteinBasis {
    using Values = std::array<double, max_surface_degree + 1>;
    Values value;
    Values first;
    Values second;

    BernsteinBasis(int degree, double t) {
        const auto n = static_cast<std::size_t>(degree);
        const double s = 1.0 - t;
        Values two_less;
        Values one_less;
        two_less[0] = one_less[0] = value[0] = 1.0;
        for (std::size_t k = 1; k <= n; ++k) {
            two_less = one_less;
            one_less = value;
            value[k] = t * one_less[k - 1];
            for (std::size_t i = k - 1; i > 0; --i) value[i] = s * one_less[i] + t * one_less[i - 1];
            value[0] = s * one_less[0];
        }
        derive(n, one_less, two_less);
    }

private:
    // Bᵢⁿ' = n (Bᵢ₋₁ⁿ⁻¹ − Bᵢⁿ⁻¹), and once more.
    void derive(std::size_t n, const Values& one_less, const Values& two_less) {
        const auto factor = static_cast<double>(n);
        const auto of = [](const Values& values, std::size_t i, std::size_t count) {
            return i < count ? values[i] : 0.0;  // also for i = −1, which wraps around
        };
        for (std::size_t i = 0; i <= n; ++i) {
            first[i] = n < 1 ? 0.0 : factor * (of(one_less, i - 1, n) - of(one_less, i, n));
            second[i] =
                n < 2 ? 0.0
                      : factor * (factor - 1.0) *
                            (of(two_less, i - 2, n - 1) - 2.0 * of(two_less, i - 1, n - 1) + of(two_less, i, n - 1));
        }
    }
};

}  // namespace cusp::geometry::detail
