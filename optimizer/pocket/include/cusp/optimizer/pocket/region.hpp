// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Plane regions with holes: contours with arcs, offsets, differences, and whether a point is inside.
#pragma once

#include <cusp/base/result.hpp>

#include <cstddef>
#include <vector>

namespace cusp::pocket {

struct Point {
    double x_mm = 0.0;
    double y_mm = 0.0;
    bool operator==(const Point&) const = default;
};

using Polygon = std::vector<Point>;

/// Polygons by the even–odd rule: outer ones counter-clockwise, holes clockwise.
using Region = std::vector<Polygon>;

/// A closed contour: its corners, and for each the bulge of the side that begins there, as DXF has it: tan of a quarter of
/// the arc's angle, above zero for an arc to the left; 0 is a straight side.
struct Contour {
    std::vector<Point> points;
    std::vector<double> bulges;  ///< empty, or one a point
};

/// The contour as a polygon whose chords miss the arcs by at most `tolerance_mm`.
/// Errors: `pocket.contour-points` (fewer than three corners, or two that are joined by arcs; bulges of another number),
/// `pocket.contour-crosses` (with the place), `pocket.contour-area`.
[[nodiscard]] base::Result<Polygon> toPolygon(const Contour& contour, double tolerance_mm);

[[nodiscard]] Region unite(const Region& a, const Region& b);
[[nodiscard]] Region subtract(const Region& a, const Region& b);
[[nodiscard]] Region intersect(const Region& a, const Region& b);
/// Grown by `distance_mm` with round corners (chords within 0.002 mm of the arc), shrunk where it is below zero.
[[nodiscard]] Region offset(const Region& region, double distance_mm);
[[nodiscard]] double areaOf(const Region& region);

struct Box {
    Point low;
    Point high;
};
[[nodiscard]] Box boxOf(const Region& region);
[[nodiscard]] Polygon rectangle(const Box& box);

/// Answers many questions about one region: edges sorted into bands of y.
class RegionIndex {
public:
    explicit RegionIndex(Region region);
    [[nodiscard]] const Region& region() const { return region_; }
    /// By the even–odd rule; on an edge either answer.
    [[nodiscard]] bool contains(const Point& p) const;
    /// To the nearest edge; infinite for a region without edges.
    [[nodiscard]] double distanceToEdge(const Point& p) const;

private:
    struct Edge {
        Point a;
        Point b;
    };
    Region region_;
    std::vector<Edge> edges_;
    std::vector<std::vector<std::size_t>> bands_;
    double low_y_ = 0.0;
    double band_mm_ = 1.0;
};

[[nodiscard]] double distanceToSegment(const Point& p, const Point& a, const Point& b);

}  // namespace cusp::pocket
