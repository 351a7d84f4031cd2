// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Knots as they have to be, and the blossom by de Boor's triangle with another argument in each step.
#include "blossom.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace cusp::geometry::detail {

using Vector4 = Eigen::Vector4d;

base::Result<void> checkKnots(const std::vector<double>& knots, std::size_t points, std::size_t degree, const char* key,
                              const char* code) {
    const auto fail = [&](std::string message) {
        base::Location where;
        where.key = key;
        return base::fail(code, std::move(message), std::move(where));
    };
    if (points < degree + 1) {
        return fail(fmt::format("degree {} needs at least {} points; there are {}", degree, degree + 1, points));
    }
    if (knots.size() != points + degree + 1) {
        return fail(fmt::format("{} points of degree {} need {} knots; there are {}", points, degree,
                                points + degree + 1, knots.size()));
    }
    for (std::size_t i = 0; i < knots.size(); ++i) {
        if (!(std::abs(knots[i]) <= 1e9) || (i > 0 && knots[i] < knots[i - 1])) {
            return fail(fmt::format("knot [{}] is {:g}; knots must not descend", i, knots[i]));
        }
        // degree + 1 equal knots inside would tear the surface apart.
        if (i >= degree + 1 && i + 1 < points && knots[i] == knots[i - degree]) {
            return fail(fmt::format("the knot {:g} stands more than {} times inside", knots[i], degree));
        }
    }
    if (!(knots[degree] < knots[points])) {
        return fail("the knots leave no range of the parameter");
    }
    return {};
}

std::vector<double> breaksOf(const std::vector<double>& knots, std::size_t points, std::size_t degree) {
    std::vector<double> breaks;
    const double smallest = 1e-12 * (knots[points] - knots[degree]);
    for (std::size_t i = degree; i <= points; ++i) {
        if (breaks.empty() || knots[i] > breaks.back() + smallest) breaks.push_back(knots[i]);
    }
    breaks.back() = knots[points];
    return breaks;
}

std::vector<Vector4> bezierSpan(const std::vector<Vector4>& points, const std::vector<double>& knots,
                                std::size_t degree, double a, double b) {
    const double middle = a + 0.5 * (b - a);
    const auto above = std::upper_bound(knots.begin(), knots.end(), middle);
    const std::size_t span = static_cast<std::size_t>(above - knots.begin()) - 1;
    std::vector<Vector4> out;
    for (std::size_t j = 0; j <= degree; ++j) {
        std::vector<Vector4> d(points.begin() + static_cast<std::ptrdiff_t>(span - degree),
                               points.begin() + static_cast<std::ptrdiff_t>(span + 1));
        for (std::size_t r = 1; r <= degree; ++r) {
            const double t = r <= degree - j ? a : b;
            for (std::size_t i = degree; i >= r; --i) {
                const double low = knots[span - degree + i];
                const double high = knots[span + 1 + i - r];
                const double x = (t - low) / (high - low);
                d[i] = (1.0 - x) * d[i - 1] + x * d[i];
            }
        }
        out.push_back(d[degree]);
    }
    return out;
}

}  // namespace cusp::geometry::detail
