// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The smoothed path: a cubic spline whose control points lie on the programmed polyline.
#pragma once

#include "polyline.hpp"

#include <cusp/dynamics/motion_piece.hpp>

#include <cstddef>
#include <vector>

namespace cusp::dynamics {

/// Schoenberg's variation diminishing spline: knots t, control points P((t[i] + t[i+1] + t[i+2]) / 3). It is C2, keeps
/// straight lines with their speed, never leaves the hull of four neighbouring points, and turns no more often than the path.
class PathSpline {
public:
    /// `knots`: the two knots before the first span (equal to its start where the path begins at rest), the knots of the
    /// spans; the last is repeated here.
    PathSpline(const Polyline& path, std::vector<double> knots);

    [[nodiscard]] std::size_t spans() const { return curves_.size(); }
    [[nodiscard]] const AxisCurve& curve(std::size_t span) const { return curves_[span]; }
    [[nodiscard]] double knot(std::size_t span) const { return knots_[span + 2]; }
    [[nodiscard]] std::size_t spanAt(double s) const;
    [[nodiscard]] const std::vector<double>& knots() const { return knots_; }

private:
    std::vector<double> knots_;
    std::vector<AxisCurve> curves_;
};

}  // namespace cusp::dynamics
