// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Contours to polygons, and questions about regions.
#include <cusp/optimizer/pocket/region.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace cusp::pocket {
namespace {

double cross(const Point& o, const Point& a, const Point& b) {
    return (a.x_mm - o.x_mm) * (b.y_mm - o.y_mm) - (a.y_mm - o.y_mm) * (b.x_mm - o.x_mm);
}

/// Points of the side from a to b, a included and b not.
void appendSide(Polygon& out, const Point& a, const Point& b, double bulge, double tolerance_mm) {
    out.push_back(a);
    if (bulge == 0.0) return;
    const double angle = 4.0 * std::atan(bulge);
    const double chord = std::hypot(b.x_mm - a.x_mm, b.y_mm - a.y_mm);
    const double radius = chord / (2.0 * std::abs(std::sin(angle / 2.0)));
    // From the middle of the chord to the centre, to the left of a → b where the arc is less than a half turn to the left.
    const double rise = chord / (2.0 * std::tan(angle / 2.0));
    const Point centre{(a.x_mm + b.x_mm) / 2.0 - rise * (b.y_mm - a.y_mm) / chord,
                       (a.y_mm + b.y_mm) / 2.0 + rise * (b.x_mm - a.x_mm) / chord};
    const double step = 2.0 * std::acos(std::max(0.0, 1.0 - tolerance_mm / radius));
    const auto parts = static_cast<std::size_t>(std::ceil(std::abs(angle) / std::max(step, 1e-3)));
    const double start = std::atan2(a.y_mm - centre.y_mm, a.x_mm - centre.x_mm);
    for (std::size_t i = 1; i < parts; ++i) {
        const double at = start + angle * static_cast<double>(i) / static_cast<double>(parts);
        out.push_back({centre.x_mm + radius * std::cos(at), centre.y_mm + radius * std::sin(at)});
    }
}

bool sidesCross(const Point& a, const Point& b, const Point& c, const Point& d) {
    return cross(a, b, c) * cross(a, b, d) < 0.0 && cross(c, d, a) * cross(c, d, b) < 0.0;
}

base::Result<void> checkSimple(const Polygon& polygon) {
    const std::size_t n = polygon.size();
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = i + 2; j < n; ++j) {
            if (i == 0 && j + 1 == n) continue;
            if (sidesCross(polygon[i], polygon[(i + 1) % n], polygon[j], polygon[(j + 1) % n]))
                return base::fail(
                    "pocket.contour-crosses",
                    fmt::format("the contour crosses itself near x {:.3f}, y {:.3f}; draw it so that it does not",
                                polygon[j].x_mm, polygon[j].y_mm));
        }
    return {};
}

}  // namespace

base::Result<Polygon> toPolygon(const Contour& contour, double tolerance_mm) {
    const std::size_t n = contour.points.size();
    if (!contour.bulges.empty() && contour.bulges.size() != n)
        return base::fail(
            "pocket.contour-points",
            fmt::format("{} bulges for {} points; give one for each, 0 for a straight side", contour.bulges.size(), n));
    const bool has_arc = std::any_of(contour.bulges.begin(), contour.bulges.end(), [](double b) { return b != 0.0; });
    if (n < 2 || (n == 2 && !has_arc))
        return base::fail(
            "pocket.contour-points",
            fmt::format("{} points enclose nothing; a contour has at least three, or two joined by arcs", n));
    Polygon out;
    for (std::size_t i = 0; i < n; ++i) {
        const Point& a = contour.points[i];
        const Point& b = contour.points[(i + 1) % n];
        if (!std::isfinite(a.x_mm) || !std::isfinite(a.y_mm))
            return base::fail("pocket.contour-points", "a point is not finite");
        if (a == b) continue;  // a contour closed by repeating its first point
        appendSide(out, a, b, contour.bulges.empty() ? 0.0 : contour.bulges[i], tolerance_mm);
    }
    if (auto simple = checkSimple(out); !simple) return tl::unexpected(std::move(simple.error()));
    double area = 0.0;
    for (std::size_t i = 1; i + 1 < out.size(); ++i) area += cross(out[0], out[i], out[i + 1]) / 2.0;
    if (std::abs(area) < 1e-6) return base::fail("pocket.contour-area", "the contour encloses no area");
    if (area < 0.0) std::reverse(out.begin(), out.end());
    return out;
}

Box boxOf(const Region& region) {
    constexpr double far = std::numeric_limits<double>::infinity();
    Box out{{far, far}, {-far, -far}};
    for (const Polygon& polygon : region)
        for (const Point& p : polygon) {
            out.low = {std::min(out.low.x_mm, p.x_mm), std::min(out.low.y_mm, p.y_mm)};
            out.high = {std::max(out.high.x_mm, p.x_mm), std::max(out.high.y_mm, p.y_mm)};
        }
    return out;
}

Polygon rectangle(const Box& box) {
    return {box.low, {box.high.x_mm, box.low.y_mm}, box.high, {box.low.x_mm, box.high.y_mm}};
}

double distanceToSegment(const Point& p, const Point& a, const Point& b) {
    const double dx = b.x_mm - a.x_mm;
    const double dy = b.y_mm - a.y_mm;
    const double square = dx * dx + dy * dy;
    const double t =
        square > 0.0 ? std::clamp(((p.x_mm - a.x_mm) * dx + (p.y_mm - a.y_mm) * dy) / square, 0.0, 1.0) : 0.0;
    return std::hypot(p.x_mm - a.x_mm - t * dx, p.y_mm - a.y_mm - t * dy);
}

RegionIndex::RegionIndex(Region region) : region_(std::move(region)) {
    for (const Polygon& polygon : region_)
        for (std::size_t i = 0; i < polygon.size(); ++i)
            edges_.push_back({polygon[i], polygon[(i + 1) % polygon.size()]});
    if (edges_.empty()) return;
    const Box box = boxOf(region_);
    low_y_ = box.low.y_mm;
    band_mm_ = std::max((box.high.y_mm - low_y_) / 512.0, 1e-6);
    bands_.resize(514);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
        const auto [low, high] = std::minmax(edges_[e].a.y_mm, edges_[e].b.y_mm);
        const auto first = static_cast<std::size_t>((low - low_y_) / band_mm_);
        const auto last = static_cast<std::size_t>((high - low_y_) / band_mm_);
        for (std::size_t b = first; b <= last; ++b) bands_[b].push_back(e);
    }
}

bool RegionIndex::contains(const Point& p) const {
    if (edges_.empty() || p.y_mm < low_y_) return false;
    const auto band = static_cast<std::size_t>((p.y_mm - low_y_) / band_mm_);
    if (band >= bands_.size()) return false;
    bool inside = false;
    for (const std::size_t e : bands_[band]) {
        const Point& a = edges_[e].a;
        const Point& b = edges_[e].b;
        if ((a.y_mm > p.y_mm) == (b.y_mm > p.y_mm)) continue;
        if (p.x_mm < a.x_mm + (p.y_mm - a.y_mm) * (b.x_mm - a.x_mm) / (b.y_mm - a.y_mm)) inside = !inside;
    }
    return inside;
}

double RegionIndex::distanceToEdge(const Point& p) const {
    double out = std::numeric_limits<double>::infinity();
    for (const Edge& edge : edges_) out = std::min(out, distanceToSegment(p, edge.a, edge.b));
    return out;
}

}  // namespace cusp::pocket
