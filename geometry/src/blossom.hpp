// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// From B-spline to Bézier: knots checked, spans found, each span's Bézier points.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/frames.hpp>

#include <cstddef>
#include <vector>

namespace cusp::geometry::detail {

/// Error `code` at `key` when the knots do not make a spline of this many points.
[[nodiscard]] base::Result<void> checkKnots(const std::vector<double>& knots, std::size_t points, std::size_t degree,
                                            const char* key, const char* code);
/// The different knots of the domain, ascending.
[[nodiscard]] std::vector<double> breaksOf(const std::vector<double>& knots, std::size_t points, std::size_t degree);
/// Bézier points of the spline on [a, b], a span without inner knots: its blossom at (a, …, a, b, …, b) (Ramshaw 1989).
[[nodiscard]] std::vector<Eigen::Vector4d> bezierSpan(const std::vector<Eigen::Vector4d>& points,
                                                      const std::vector<double>& knots, std::size_t degree, double a,
                                                      double b);

}  // namespace cusp::geometry::detail
