// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Parallel rows over the area, every other one backwards.
#include "dropped_line.hpp"

#include <algorithm>
#include <cmath>
#include <tbb/parallel_for.h>
#include <utility>

namespace cusp::tilt::detail {
namespace {

using Interval = std::pair<double, double>;

/// Where along the row (unit direction, from `origin`) the area lies.
std::vector<Interval> inArea(const PathArea& area, const Eigen::AlignedBox3d& box, const Eigen::Vector2d& origin,
                             const Eigen::Vector2d& direction) {
    double low = -1e9;
    double high = 1e9;
    for (int axis = 0; axis < 2; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        const double from = area.min_mm ? (*area.min_mm)[k] : box.min()[axis];
        const double to = area.max_mm ? (*area.max_mm)[k] : box.max()[axis];
        constexpr double parallel = 1e-12;
        if (std::abs(direction[axis]) < parallel) {
            if (origin[axis] < from || origin[axis] > to) return {};
            continue;
        }
        const double a = (from - origin[axis]) / direction[axis];
        const double b = (to - origin[axis]) / direction[axis];
        low = std::max(low, std::min(a, b));
        high = std::min(high, std::max(a, b));
    }
    const Eigen::Vector2d center(area.center_mm[0], area.center_mm[1]);
    const double middle = (center - origin).dot(direction);
    const double aside = (center - origin - middle * direction).norm();
    const auto half = [aside](double radius) {
        return radius > aside ? std::sqrt((radius - aside) * (radius + aside)) : 0.0;
    };
    if (area.radius_mm) {
        if (*area.radius_mm <= aside) return {};
        low = std::max(low, middle - half(*area.radius_mm));
        high = std::min(high, middle + half(*area.radius_mm));
    }
    std::vector<Interval> out;
    const double hole = area.inner_radius_mm ? half(*area.inner_radius_mm) : 0.0;
    if (hole > 0.0) {
        out.emplace_back(low, std::min(high, middle - hole));
        out.emplace_back(std::max(low, middle + hole), high);
    } else {
        out.emplace_back(low, high);
    }
    std::erase_if(out, [](const Interval& interval) { return interval.first >= interval.second; });
    return out;
}

}  // namespace

std::vector<Pass> zigZagPasses(const DropShape& shape, const ThreeAxisOptions& options) {
    const Eigen::AlignedBox3d box = shape.bounds();
    const Eigen::Vector2d along(std::cos(options.direction_rad), std::sin(options.direction_rad));
    const Eigen::Vector2d across(-along.y(), along.x());
    double first = std::numeric_limits<double>::infinity();
    double last = -first;
    const PathArea& area = options.area;
    for (const int i : {0, 1})
        for (const int j : {0, 1}) {
            const double x = i == 0 ? (area.min_mm ? (*area.min_mm)[0] : box.min().x())
                                    : (area.max_mm ? (*area.max_mm)[0] : box.max().x());
            const double y = j == 0 ? (area.min_mm ? (*area.min_mm)[1] : box.min().y())
                                    : (area.max_mm ? (*area.max_mm)[1] : box.max().y());
            first = std::min(first, across.dot(Eigen::Vector2d(x, y)));
            last = std::max(last, across.dot(Eigen::Vector2d(x, y)));
        }
    if (area.radius_mm) {
        const double middle = across.dot(Eigen::Vector2d(area.center_mm[0], area.center_mm[1]));
        first = std::max(first, middle - *area.radius_mm);
        last = std::min(last, middle + *area.radius_mm);
    }
    if (!(first <= last)) return {};
    const auto gaps =
        std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil((last - first) / options.step_over_mm)));
    std::vector<std::vector<Pass>> rows(gaps + 1);
    tbb::parallel_for(std::size_t{0}, rows.size(), [&](std::size_t row) {
        const double place = first + (last - first) * static_cast<double>(row) / static_cast<double>(gaps);
        const Eigen::Vector2d origin = place * across;
        for (const auto& [low, high] : inArea(area, box, origin, along)) {
            const Eigen::Vector2d a = origin + low * along;
            const Eigen::Vector2d b = origin + high * along;
            for (Pass& pass : droppedLine(shape, {a.x(), a.y()}, {b.x(), b.y()}, options))
                rows[row].push_back(std::move(pass));
        }
        if (row % 2 == 1) {
            std::reverse(rows[row].begin(), rows[row].end());
            for (Pass& pass : rows[row]) std::reverse(pass.begin(), pass.end());
        }
    });
    std::vector<Pass> passes;
    for (auto& row : rows)
        for (Pass& pass : row) passes.push_back(std::move(pass));
    return passes;
}

}  // namespace cusp::tilt::detail
