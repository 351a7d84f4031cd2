// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Surfaces on which a nearest-point search goes wrong easily, and a brute force that cannot.
#pragma once

#include <cusp/geometry/surface_face.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace cusp::geometry::test {

struct HardSurface {
    std::string name;
    std::vector<SurfaceFace> faces;
};

/// The benchmark surface's control points (Fountas 2017, eq. 14), worked out by hand from its coefficients.
[[nodiscard]] SurfaceFace benchmarkFace();
/// A closed sphere of radius r about the centre: a rational face with two poles and a seam.
[[nodiscard]] SurfaceFace sphereFace(const Vector3& center, double radius_mm);
/// An open cylinder about Z of height `height_mm` from z = 0.
[[nodiscard]] SurfaceFace cylinderFace(double radius_mm, double height_mm);
/// A closed torus about Z.
[[nodiscard]] SurfaceFace torusFace(double major_mm, double minor_mm);
/// A bicubic B-spline over [0, 1]² with `patches` spans each way, heights drawn from the seed.
[[nodiscard]] SurfaceFace wavySheet(int patches, double side_mm, double height_mm, std::uint64_t seed);

/// Folded, nearly flat, closed, with poles, of several faces, far off the origin.
[[nodiscard]] std::vector<HardSurface> hardSurfaces();

/// The least distance over a fine grid of every face, each grid point's neighbourhood refined by pattern search, which
/// uses positions only: no derivative, no bound, nothing of the code under test but evaluate().
[[nodiscard]] double bruteForceDistance(const std::vector<SurfaceFace>& faces, const Vector3& query);

}  // namespace cusp::geometry::test
