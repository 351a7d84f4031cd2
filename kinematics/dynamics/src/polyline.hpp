// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A run of blocks as one polyline over its path length, with what is allowed along each edge.
#pragma once

#include <cusp/dynamics/path_block.hpp>

#include <cstddef>
#include <deque>

namespace cusp::dynamics {

struct PathVertex {
    double s = 0.0;  ///< path length: tip and tool axis (times `feed_radius_mm`) together
    PathPoint point;
};

struct PathEdge {
    double squared_speed = 0.0;  ///< of s, what the feed allows
    double tolerance_mm = 0.0;
    double orientation_tolerance_rad = 0.0;
    std::uint64_t block = 0;
    bool ends_block = false;
};

/// Grows at its end, is forgotten at its front.
class Polyline {
public:
    explicit Polyline(const PathPoint& start, std::size_t axis_count) : axis_count_(axis_count) {
        vertices_.push_back({0.0, start});
    }

    /// Appends all points but the first. Points that coincide are left out.
    void append(const PathBlock& block);
    /// Drops what lies wholly before `s`.
    void forget(double s);

    [[nodiscard]] const std::deque<PathVertex>& vertices() const { return vertices_; }
    [[nodiscard]] const std::deque<PathEdge>& edges() const { return edges_; }
    /// Index of the edge that holds `s`; at a vertex the one after it, except at the end.
    [[nodiscard]] std::size_t edgeAt(double s) const;
    [[nodiscard]] PathPoint at(double s) const;
    /// One edge as a path of its own, from length zero.
    [[nodiscard]] Polyline edgeAlone(std::size_t edge) const;
    [[nodiscard]] double end() const { return vertices_.back().s; }
    [[nodiscard]] std::size_t blocks() const { return blocks_; }

private:
    std::size_t axis_count_;
    std::deque<PathVertex> vertices_;
    std::deque<PathEdge> edges_;  ///< from vertex i to i + 1
    std::size_t blocks_ = 0;      ///< whose end is kept
};

/// Path length between two points.
[[nodiscard]] double pathLength(const PathPoint& a, const PathPoint& b, std::size_t axis_count);

}  // namespace cusp::dynamics
