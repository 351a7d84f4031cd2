// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// How far apart the knots of the smoothed path may lie: as far as the tolerance allows.
#pragma once

#include "polyline.hpp"

#include <cstddef>
#include <vector>

namespace cusp::dynamics {

/// Largest spacing allowed at each vertex of a polyline up to a horizon, growing away from tight places by no more than a
/// fixed share of the distance.
class KnotSpacing {
public:
    /// `horizon`: index of the last vertex. `rest_mm`: the spacing wanted at the horizon, and at the start if `rests_at_start`.
    KnotSpacing(const Polyline& path, std::size_t horizon, double rest_mm, bool rests_at_start);

    /// Knots after `from` up to the horizon's vertex, ascending.
    void place(double from, std::vector<double>& knots) const;
    /// Halves what is allowed about `s`.
    void tighten(double s);

private:
    [[nodiscard]] double allowedAt(std::size_t vertex, double guess) const;
    void grade();
    [[nodiscard]] double at(double s) const;

    const Polyline& path_;
    std::size_t horizon_;
    std::vector<double> allowed_;
    std::vector<double> graded_;
};

}  // namespace cusp::dynamics
