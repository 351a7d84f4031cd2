// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The one file that knows the Clipper library: regions combined and offset on its integer grid of 10 nm.
#include <cusp/optimizer/pocket/region.hpp>

#include <cmath>
#include <polyclipping/clipper.hpp>

namespace cusp::pocket {
namespace {

constexpr double units_per_mm = 1e5;

ClipperLib::Paths toPaths(const Region& region) {
    ClipperLib::Paths out;
    for (const Polygon& polygon : region) {
        ClipperLib::Path path;
        for (const Point& p : polygon)
            path.emplace_back(static_cast<ClipperLib::cInt>(std::llround(p.x_mm * units_per_mm)),
                              static_cast<ClipperLib::cInt>(std::llround(p.y_mm * units_per_mm)));
        out.push_back(std::move(path));
    }
    return out;
}

Region toRegion(const ClipperLib::Paths& paths) {
    Region out;
    for (const ClipperLib::Path& path : paths) {
        Polygon polygon;
        for (const ClipperLib::IntPoint& p : path)
            polygon.push_back({static_cast<double>(p.X) / units_per_mm, static_cast<double>(p.Y) / units_per_mm});
        if (polygon.size() >= 3) out.push_back(std::move(polygon));
    }
    return out;
}

Region combine(ClipperLib::ClipType type, const Region& a, const Region& b) {
    ClipperLib::Clipper clipper;
    clipper.AddPaths(toPaths(a), ClipperLib::ptSubject, true);
    clipper.AddPaths(toPaths(b), ClipperLib::ptClip, true);
    ClipperLib::Paths out;
    clipper.Execute(type, out, ClipperLib::pftEvenOdd, ClipperLib::pftEvenOdd);
    return toRegion(out);
}

}  // namespace

Region unite(const Region& a, const Region& b) { return combine(ClipperLib::ctUnion, a, b); }
Region subtract(const Region& a, const Region& b) { return combine(ClipperLib::ctDifference, a, b); }
Region intersect(const Region& a, const Region& b) { return combine(ClipperLib::ctIntersection, a, b); }

Region offset(const Region& region, double distance_mm) {
    ClipperLib::ClipperOffset clipper(2.0, 0.002 * units_per_mm);
    // Holes must run against their outlines: what the even–odd rule means, made so first.
    clipper.AddPaths(toPaths(unite(region, {})), ClipperLib::jtRound, ClipperLib::etClosedPolygon);
    ClipperLib::Paths out;
    clipper.Execute(out, distance_mm * units_per_mm);
    return toRegion(out);
}

double areaOf(const Region& region) {
    double sum = 0.0;
    for (const ClipperLib::Path& path : toPaths(unite(region, {}))) sum += ClipperLib::Area(path);
    return sum / (units_per_mm * units_per_mm);
}

}  // namespace cusp::pocket
