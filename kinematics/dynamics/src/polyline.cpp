// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Path length, and places along it.
#include "polyline.hpp"

#include <algorithm>
#include <cmath>

namespace cusp::dynamics {

namespace {

/// Shorter edges are rounding: twelve digits of a metre.
constexpr double coincident_mm = 1e-9;
/// Below this share of tip motion a block counts as one of rotary axes only.
constexpr double tip_share = 1e-6;
/// A feed below this is none: a metre would take eleven days.
constexpr double least_speed_mm_per_s = 1e-3;

double rotaryLength(const PathPoint& a, const PathPoint& b, std::size_t axis_count) {
    double sum = 0.0;
    for (std::size_t i = 3; i < axis_count; ++i) sum += (b.axes[i] - a.axes[i]) * (b.axes[i] - a.axes[i]);
    return feed_radius_mm * std::sqrt(sum);
}

/// The tip's speed limit, as one of s.
double squaredSpeed(const PathBlock& block, double tip_mm, double length_mm) {
    const double share = tip_mm / length_mm;
    const double feed = std::max(block.feed_mm_per_s, least_speed_mm_per_s);
    const double speed = share > tip_share ? feed / share : feed;
    return speed * speed;
}

}  // namespace

double pathLength(const PathPoint& a, const PathPoint& b, std::size_t axis_count) {
    return std::hypot((b.tool.tip_mm - a.tool.tip_mm).norm(), rotaryLength(a, b, axis_count));
}

void Polyline::append(const PathBlock& block) {
    bool grew = false;
    for (std::size_t i = 1; i < block.points.size(); ++i) {
        const PathVertex& last = vertices_.back();
        const double length = pathLength(last.point, block.points[i], axis_count_);
        if (!(length >= coincident_mm)) continue;
        const double tip = (block.points[i].tool.tip_mm - last.point.tool.tip_mm).norm();
        edges_.push_back(
            {squaredSpeed(block, tip, length), block.tolerance_mm, block.orientation_tolerance_rad, block.id, false});
        vertices_.push_back({last.s + length, block.points[i]});
        grew = true;
    }
    if (!grew) return;
    edges_.back().ends_block = true;
    ++blocks_;
}

void Polyline::forget(double s) {
    while (vertices_.size() > 2 && vertices_[1].s <= s) {
        if (edges_.front().ends_block) --blocks_;
        vertices_.pop_front();
        edges_.pop_front();
    }
}

Polyline Polyline::edgeAlone(std::size_t edge) const {
    Polyline out(vertices_[edge].point, axis_count_);
    out.vertices_.push_back({vertices_[edge + 1].s - vertices_[edge].s, vertices_[edge + 1].point});
    out.edges_.push_back(edges_[edge]);
    return out;
}

std::size_t Polyline::edgeAt(double s) const {
    const auto after = std::upper_bound(vertices_.begin(), vertices_.end(), s,
                                        [](double value, const PathVertex& vertex) { return value < vertex.s; });
    const auto index = static_cast<std::size_t>(after - vertices_.begin());
    return std::clamp<std::size_t>(index, 1, edges_.size()) - 1;
}

PathPoint Polyline::at(double s) const {
    const std::size_t edge = edgeAt(s);
    const PathVertex& a = vertices_[edge];
    const PathVertex& b = vertices_[edge + 1];
    const double u = std::clamp((s - a.s) / (b.s - a.s), 0.0, 1.0);
    PathPoint out;
    for (std::size_t i = 0; i < max_axes; ++i) out.axes[i] = (1.0 - u) * a.point.axes[i] + u * b.point.axes[i];
    out.tool.tip_mm = (1.0 - u) * a.point.tool.tip_mm + u * b.point.tool.tip_mm;
    out.tool.axis = (1.0 - u) * a.point.tool.axis + u * b.point.tool.axis;
    return out;
}

}  // namespace cusp::dynamics
