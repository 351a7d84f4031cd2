// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Lays a grid over each face and cuts it into tiles.
#include <cusp/simulation/surface_grid.hpp>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cusp::simulation {

using geometry::SurfaceFace;
using geometry::Vector3;

namespace {

constexpr std::size_t tile_side = 8;
/// Lines and steps a line that decide how long a face is.
constexpr int measured = 16;

/// The longest line of the face along u (`along_u`) or v.
double longestLine(const SurfaceFace& face, bool along_u) {
    const auto at = [&](int along, int across) {
        const auto part = [](const std::vector<double>& breaks, int i) {
            return breaks.front() + (breaks.back() - breaks.front()) * i / measured;
        };
        return along_u ? face.evaluate(part(face.breaksU(), along), part(face.breaksV(), across)).position
                       : face.evaluate(part(face.breaksU(), across), part(face.breaksV(), along)).position;
    };
    double longest = 0.0;
    for (int across = 0; across <= measured; ++across) {
        double length = 0.0;
        for (int along = 0; along < measured; ++along) length += (at(along + 1, across) - at(along, across)).norm();
        longest = std::max(longest, length);
    }
    return longest;
}

std::size_t stepsFor(double length_mm, double spacing_mm) {
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(length_mm / spacing_mm)));
}

/// Trapezoidal rule: half a cell at an edge.
double share(std::size_t i, std::size_t steps) { return i == 0 || i == steps ? 0.5 : 1.0; }

class FaceGrid {
public:
    FaceGrid(const SurfaceFace& face, std::uint32_t index, double spacing_mm)
        : face_(face),
          index_(index),
          steps_u_(stepsFor(longestLine(face, true), spacing_mm)),
          steps_v_(stepsFor(longestLine(face, false), spacing_mm)) {}

    [[nodiscard]] std::size_t tilesU() const { return steps_u_ / tile_side + 1; }
    [[nodiscard]] std::size_t tilesV() const { return steps_v_ / tile_side + 1; }

    void fill(std::size_t tile, std::vector<GridPoint>& points) const {
        const std::size_t first_u = tile / tilesV() * tile_side;
        const std::size_t first_v = tile % tilesV() * tile_side;
        for (std::size_t i = first_u; i <= std::min(first_u + tile_side - 1, steps_u_); ++i)
            for (std::size_t j = first_v; j <= std::min(first_v + tile_side - 1, steps_v_); ++j) add(i, j, points);
    }

private:
    void add(std::size_t i, std::size_t j, std::vector<GridPoint>& points) const {
        const auto at = [](const std::vector<double>& breaks, std::size_t k, std::size_t steps) {
            return k == steps ? breaks.back()
                              : breaks.front() + (breaks.back() - breaks.front()) * static_cast<double>(k) /
                                                     static_cast<double>(steps);
        };
        GridPoint point;
        point.u = at(face_.breaksU(), i, steps_u_);
        point.v = at(face_.breaksV(), j, steps_v_);
        point.face = index_;
        const geometry::SurfacePoint surface = face_.evaluate(point.u, point.v);
        point.position = surface.position;
        const Vector3 cross = surface.du.cross(surface.dv);
        const double size = cross.norm();
        point.normal = size > 1e-9 * surface.du.norm() * surface.dv.norm() && size > 0.0
                           ? Vector3(face_.outwardSign() / size * cross)
                           : face_.normal(point.u, point.v);
        if (point.normal.squaredNorm() < 0.5) return;
        const double cell_u = (face_.breaksU().back() - face_.breaksU().front()) / static_cast<double>(steps_u_);
        const double cell_v = (face_.breaksV().back() - face_.breaksV().front()) / static_cast<double>(steps_v_);
        point.area_mm2 = size * cell_u * cell_v * share(i, steps_u_) * share(j, steps_v_);
        points.push_back(point);
    }

    const SurfaceFace& face_;
    std::uint32_t index_;
    std::size_t steps_u_;
    std::size_t steps_v_;
};

GridTile tileOf(std::span<const GridPoint> points, std::size_t first) {
    Eigen::AlignedBox3d box;
    for (const GridPoint& point : points) box.extend(point.position);
    GridTile tile{first, points.size(), box.center(), 0.0};
    for (const GridPoint& point : points)
        tile.radius_mm = std::max(tile.radius_mm, (point.position - tile.center).norm());
    return tile;
}

}  // namespace

SurfaceGrid surfaceGrid(std::span<const SurfaceFace> faces, double spacing_mm) {
    std::vector<std::vector<GridPoint>> parts;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const FaceGrid face(faces[f], static_cast<std::uint32_t>(f), spacing_mm);
        const std::size_t begin = parts.size();
        const std::size_t count = face.tilesU() * face.tilesV();
        parts.resize(begin + count);
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), [&](const auto& range) {
            for (std::size_t tile = range.begin(); tile < range.end(); ++tile) face.fill(tile, parts[begin + tile]);
        });
    }
    SurfaceGrid grid;
    std::size_t total = 0;
    for (const auto& part : parts) total += part.size();
    grid.points.reserve(total);
    grid.tiles.reserve(parts.size());
    for (const auto& part : parts) {
        if (part.empty()) continue;
        grid.tiles.push_back(tileOf(part, grid.points.size()));
        grid.points.insert(grid.points.end(), part.begin(), part.end());
    }
    return grid;
}

SurfaceGrid gridOfPoints(std::vector<GridPoint> points) {
    constexpr std::size_t tile_points = 16;
    SurfaceGrid grid;
    grid.points = std::move(points);
    for (std::size_t first = 0; first < grid.points.size(); first += tile_points) {
        GridTile tile{.first = first, .count = std::min(tile_points, grid.points.size() - first)};
        for (std::size_t i = first; i < first + tile.count; ++i) tile.center += grid.points[i].position;
        tile.center /= static_cast<double>(tile.count);
        for (std::size_t i = first; i < first + tile.count; ++i)
            tile.radius_mm = std::max(tile.radius_mm, (grid.points[i].position - tile.center).norm());
        grid.tiles.push_back(tile);
    }
    return grid;
}

}  // namespace cusp::simulation
