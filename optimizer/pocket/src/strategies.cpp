// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Zig-zag, rings and fronts.
#include <cusp/optimizer/pocket/strategies.hpp>

#include <algorithm>
#include <cmath>

namespace cusp::pocket {
namespace {

constexpr double last = 1e7;

std::vector<double> rows(const PointMap& map, bool to_and_fro) {
    double low_y = map.points.front().y_mm;
    double low_x = map.points.front().x_mm;
    double high_x = low_x;
    for (const Point& p : map.points) {
        low_y = std::min(low_y, p.y_mm);
        low_x = std::min(low_x, p.x_mm);
        high_x = std::max(high_x, p.x_mm);
    }
    std::vector<double> out;
    for (std::size_t i = 0; i < map.points.size(); ++i) {
        const double row = std::round((map.points[i].y_mm - low_y) / map.spacing_mm);
        const bool back = to_and_fro && std::fmod(row, 2.0) > 0.5;
        const double along = back ? high_x - map.points[i].x_mm : map.points[i].x_mm - low_x;
        out.push_back(row + along / (high_x - low_x + 1.0) + (map.on_contour[i] ? last : 0.0));
    }
    return out;
}

/// Fronts at one spacing from each other: by depth below the edge of the stock where the tool can come from outside, else by
/// distance from the point that is farthest from the walls.
std::vector<double> fronts(const PointMap& map) {
    const bool open = std::find(map.peripheral.begin(), map.peripheral.end(), true) != map.peripheral.end();
    const auto widest =
        static_cast<std::size_t>(std::max_element(map.wall_mm.begin(), map.wall_mm.end()) - map.wall_mm.begin());
    std::vector<double> out;
    for (std::size_t i = 0; i < map.points.size(); ++i) {
        const double way = open ? map.depth_mm[i]
                                : std::hypot(map.points[i].x_mm - map.points[widest].x_mm,
                                             map.points[i].y_mm - map.points[widest].y_mm);
        out.push_back(std::round(way / map.spacing_mm) + (map.on_contour[i] ? last : 0.0));
    }
    return out;
}

}  // namespace

std::string toText(Strategy strategy) {
    switch (strategy) {
        case Strategy::ZigZag: return "zig_zag";
        case Strategy::OneWay: return "one_way";
        case Strategy::ContourParallel: return "contour_parallel";
        case Strategy::ConstantEngagement: return "constant_engagement";
    }
    return {};
}

std::vector<double> preferenceOf(const PointMap& map, Strategy strategy) {
    if (map.points.empty()) return {};
    switch (strategy) {
        case Strategy::ZigZag: return rows(map, true);
        case Strategy::OneWay: return rows(map, false);
        case Strategy::ConstantEngagement: return fronts(map);
        case Strategy::ContourParallel: break;
    }
    std::vector<double> out;
    for (const double wall : map.wall_mm) out.push_back(-std::round(wall / map.spacing_mm));
    return out;
}

}  // namespace cusp::pocket
