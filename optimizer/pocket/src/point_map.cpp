// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Grid, contour points and neighbourhoods.
#include <cusp/optimizer/pocket/point_map.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <tbb/parallel_for.h>
#include <utility>

namespace cusp::pocket {
namespace {

constexpr double on_edge_mm = 0.003;

/// Edges of the allowed region that are not its outer frame.
class Surveyor {
public:
    Surveyor(const PocketArea& area, double spacing_mm)
        : area_(area), spacing_mm_(spacing_mm), material_(area.material), allowed_(area.allowed), stock_(area.stock) {}

    [[nodiscard]] double toMaterial(const Point& p) const {
        return material_.contains(p) ? 0.0 : material_.distanceToEdge(p);
    }
    [[nodiscard]] bool isAllowed(const Point& p) const {
        return allowed_.contains(p) || allowed_.distanceToEdge(p) < on_edge_mm;
    }
    [[nodiscard]] bool isAllowed(const Point& a, const Point& b) const {
        const auto parts = std::max(2, static_cast<int>(std::ceil(std::hypot(b.x_mm - a.x_mm, b.y_mm - a.y_mm) / 0.4)));
        for (int i = 1; i < parts; ++i) {
            const double t = static_cast<double>(i) / parts;
            if (!isAllowed({a.x_mm + t * (b.x_mm - a.x_mm), a.y_mm + t * (b.y_mm - a.y_mm)})) return false;
        }
        return true;
    }
    /// Adds p where the tool there touches material, or nearly does.
    void consider(const Point& p, bool on_contour, PointMap& map) const {
        const double gap = toMaterial(p) - area_.radius_mm;
        if (gap > 1.6 * spacing_mm_) return;
        map.points.push_back(p);
        map.on_contour.push_back(on_contour);
        map.peripheral.push_back(gap > -1e-6);
        map.wall_mm.push_back(on_contour ? 0.0 : allowed_.distanceToEdge(p));
        map.depth_mm.push_back((stock_.contains(p) ? 1.0 : -1.0) * stock_.distanceToEdge(p));
    }
    [[nodiscard]] double toWall(const Point& p) const { return allowed_.distanceToEdge(p); }
    [[nodiscard]] bool contains(const Point& p) const { return allowed_.contains(p); }

private:
    const PocketArea& area_;
    double spacing_mm_;
    RegionIndex material_;
    RegionIndex allowed_;
    RegionIndex stock_;
};

void addGrid(const Surveyor& surveyor, const PocketArea& area, PointMap& map) {
    const Box box = boxOf(area.material);
    const double margin = area.radius_mm + 1.5 * map.spacing_mm;
    const auto columns = static_cast<std::size_t>((box.high.x_mm - box.low.x_mm + 2.0 * margin) / map.spacing_mm) + 1;
    const auto rows = static_cast<std::size_t>((box.high.y_mm - box.low.y_mm + 2.0 * margin) / map.spacing_mm) + 1;
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t c = 0; c < columns; ++c) {
            const Point p{box.low.x_mm - margin + static_cast<double>(c) * map.spacing_mm,
                          box.low.y_mm - margin + static_cast<double>(r) * map.spacing_mm};
            // Beside the contour its own points stand.
            if (surveyor.contains(p) && surveyor.toWall(p) > 0.25 * map.spacing_mm) surveyor.consider(p, false, map);
        }
}

void addContour(const Surveyor& surveyor, const PocketArea& area, PointMap& map) {
    for (const Polygon& polygon : area.allowed) {
        Point last{1e300, 1e300};
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const Point& a = polygon[i];
            const Point& b = polygon[(i + 1) % polygon.size()];
            const double length = std::hypot(b.x_mm - a.x_mm, b.y_mm - a.y_mm);
            const auto parts = std::max(1, static_cast<int>(std::ceil(length / map.spacing_mm)));
            for (int k = 0; k < parts; ++k) {
                const double t = static_cast<double>(k) / parts;
                const Point p{a.x_mm + t * (b.x_mm - a.x_mm), a.y_mm + t * (b.y_mm - a.y_mm)};
                if (std::hypot(p.x_mm - last.x_mm, p.y_mm - last.y_mm) < 1e-3) continue;
                last = p;
                if (surveyor.toMaterial(p) < area.radius_mm) surveyor.consider(p, true, map);
            }
        }
    }
}

void addNeighbours(const Surveyor& surveyor, PointMap& map) {
    const double reach = 2.9 * map.spacing_mm;
    std::map<std::pair<int, int>, std::vector<std::uint32_t>> cells;
    const auto cellOf = [&](const Point& p) {
        return std::pair{static_cast<int>(std::floor(p.x_mm / reach)), static_cast<int>(std::floor(p.y_mm / reach))};
    };
    for (std::size_t i = 0; i < map.points.size(); ++i)
        cells[cellOf(map.points[i])].push_back(static_cast<std::uint32_t>(i));
    map.neighbours.resize(map.points.size());
    tbb::parallel_for(std::size_t{0}, map.points.size(), [&](std::size_t i) {
        const Point& p = map.points[i];
        const auto [cx, cy] = cellOf(p);
        std::vector<std::pair<double, std::uint32_t>> near;
        for (int x = cx - 1; x <= cx + 1; ++x)
            for (int y = cy - 1; y <= cy + 1; ++y) {
                const auto cell = cells.find({x, y});
                if (cell == cells.end()) continue;
                for (const std::uint32_t j : cell->second) {
                    const double d = std::hypot(map.points[j].x_mm - p.x_mm, map.points[j].y_mm - p.y_mm);
                    if (j != i && d < reach) near.emplace_back(d, j);
                }
            }
        std::sort(near.begin(), near.end());
        for (const auto& [d, j] : near) {
            if (map.neighbours[i].size() == most_neighbours) break;
            if (surveyor.isAllowed(p, map.points[j])) map.neighbours[i].push_back(j);
        }
    });
}

}  // namespace

base::Result<PointMap> pointMap(const PocketArea& area, double spacing_mm, std::size_t most_points) {
    const Box box = boxOf(area.material);
    const double wide = box.high.x_mm - box.low.x_mm + 2.0 * area.radius_mm;
    const double high = box.high.y_mm - box.low.y_mm + 2.0 * area.radius_mm;
    if (wide * high / (spacing_mm * spacing_mm) > 4.0 * static_cast<double>(most_points))
        return base::fail("pocket.too-many-points",
                          fmt::format("a radial depth of {:.3f} mm needs about {:.0f} points; take {:.3f} mm or more",
                                      spacing_mm, wide * high / (spacing_mm * spacing_mm),
                                      std::sqrt(wide * high / static_cast<double>(most_points))));
    PointMap map;
    map.spacing_mm = spacing_mm;
    const Surveyor surveyor(area, spacing_mm);
    addGrid(surveyor, area, map);
    addContour(surveyor, area, map);
    addNeighbours(surveyor, map);
    return map;
}

}  // namespace cusp::pocket
