// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Points of a surface with their normals, laid out in tiles of neighbours.
#pragma once

#include <cusp/geometry/surface_face.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cusp::simulation {

struct GridPoint {
    geometry::Vector3 position = geometry::Vector3::Zero();
    geometry::Vector3 normal = geometry::Vector3::Zero();  ///< unit, out of the material
    double u = 0.0;
    double v = 0.0;
    double area_mm2 = 0.0;  ///< of the surface that the point stands for
    std::uint32_t face = 0;
};

/// Neighbouring points, `first` to `first + count` of SurfaceGrid::points, and a ball that holds them.
struct GridTile {
    std::size_t first = 0;
    std::size_t count = 0;
    geometry::Vector3 center = geometry::Vector3::Zero();
    double radius_mm = 0.0;
};

struct SurfaceGrid {
    std::vector<GridPoint> points;
    std::vector<GridTile> tiles;
};

/// Points on every face, ends included, equally spaced in each parameter so that neighbours are at most about `spacing_mm`
/// apart: the widest of the lines looked at decides. Where a face has no normal it has no point.
[[nodiscard]] SurfaceGrid surfaceGrid(std::span<const geometry::SurfaceFace> faces, double spacing_mm);

/// Points of the caller's choice, in their order; neighbours in the list should be neighbours in space.
[[nodiscard]] SurfaceGrid gridOfPoints(std::vector<GridPoint> points);

}  // namespace cusp::simulation
