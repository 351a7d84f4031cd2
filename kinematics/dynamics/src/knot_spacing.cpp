// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The spacing at which a spline with control points on the path keeps its tolerance.
#include "knot_spacing.hpp"

#include <algorithm>
#include <cmath>

namespace cusp::dynamics {

namespace {

constexpr double largest_mm = 20.0;
constexpr double growth = 0.3;
/// With uniform knots h the spline passes a control point at (P(s-h) + P(s+h) - 2 P(s)) / 6, a third of the distance to the
/// chord, when the point lies at a corner, and up to twice as far when the corner lies between control points. So this many
/// times the tolerance is what the chord may miss.
constexpr double chord_per_tolerance = 1.5;

}  // namespace

KnotSpacing::KnotSpacing(const Polyline& path, std::size_t horizon, double rest_mm, bool rests_at_start)
    : path_(path), horizon_(horizon), allowed_(horizon + 1) {
    double guess = largest_mm;
    for (std::size_t i = 1; i < horizon; ++i) {
        allowed_[i] = allowedAt(i, guess);
        guess = std::min(largest_mm, 4.0 * allowed_[i]);
    }
    allowed_[0] = rests_at_start ? rest_mm : largest_mm;
    allowed_[horizon] = rest_mm;
    grade();
}

double KnotSpacing::allowedAt(std::size_t vertex, double guess) const {
    const PathVertex& here = path_.vertices()[vertex];
    const PathEdge& before = path_.edges()[vertex - 1];
    const PathEdge& after = path_.edges()[vertex];
    const double begin = path_.vertices().front().s;
    const double end = path_.vertices()[horizon_].s;
    const double tip = chord_per_tolerance * std::min(before.tolerance_mm, after.tolerance_mm);
    const double turn =
        chord_per_tolerance * std::min(before.orientation_tolerance_rad, after.orientation_tolerance_rad);
    double h = before.squared_speed == after.squared_speed ? guess : std::min(guess, 0.5);
    for (;; h *= 0.5) {
        const double left = std::max(begin, here.s - h);
        const double right = std::min(end, here.s + h);
        const PathPoint a = path_.at(left);
        const PathPoint b = path_.at(right);
        const double u = (here.s - left) / (right - left);
        const geometry::Vector3 chord_tip = (1.0 - u) * a.tool.tip_mm + u * b.tool.tip_mm;
        const geometry::Vector3 chord_axis = (1.0 - u) * a.tool.axis + u * b.tool.axis;
        if ((chord_tip - here.point.tool.tip_mm).norm() <= tip && (chord_axis - here.point.tool.axis).norm() <= turn)
            return h;
    }
}

void KnotSpacing::grade() {
    graded_ = allowed_;
    const auto& vertices = path_.vertices();
    for (std::size_t i = 1; i <= horizon_; ++i)
        graded_[i] = std::min(graded_[i], graded_[i - 1] + growth * (vertices[i].s - vertices[i - 1].s));
    for (std::size_t i = horizon_; i-- > 0;)
        graded_[i] = std::min(graded_[i], graded_[i + 1] + growth * (vertices[i + 1].s - vertices[i].s));
}

double KnotSpacing::at(double s) const {
    const std::size_t edge = std::min(path_.edgeAt(s), horizon_ - 1);
    const auto& vertices = path_.vertices();
    return std::min({largest_mm, graded_[edge] + growth * std::abs(s - vertices[edge].s),
                     graded_[edge + 1] + growth * std::abs(vertices[edge + 1].s - s)});
}

void KnotSpacing::place(double from, std::vector<double>& knots) const {
    const double end = path_.vertices()[horizon_].s;
    for (double s = from; s < end;) {
        double h = at(s);
        h = std::min(h, at(std::min(end, s + h)));
        const double left = end - s;
        if (left < 1.4 * h)
            h = left;
        else if (left < 2.4 * h)
            h = 0.5 * left;
        s = h == left ? end : s + h;
        knots.push_back(s);
    }
}

void KnotSpacing::tighten(double s) {
    const std::size_t edge = std::min(path_.edgeAt(s), horizon_ - 1);
    for (const std::size_t i : {edge, edge + 1}) allowed_[i] = std::min(allowed_[i], 0.5 * graded_[i]);
    grade();
}

}  // namespace cusp::dynamics
