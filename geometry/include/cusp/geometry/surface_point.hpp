// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A point of a parametric surface with its derivatives, and what differential geometry makes of them.
#pragma once

#include <cusp/geometry/frames.hpp>

namespace cusp::geometry {

/// Position (mm) and partial derivatives by the parameters u and v.
struct SurfacePoint {
    Vector3 position = Vector3::Zero();
    Vector3 du = Vector3::Zero();
    Vector3 dv = Vector3::Zero();
    Vector3 duu = Vector3::Zero();
    Vector3 duv = Vector3::Zero();
    Vector3 dvv = Vector3::Zero();
};

/// Unit vector along du × dv; zero where the two are parallel or one vanishes beside the other (a pole).
[[nodiscard]] Vector3 crossNormal(const SurfacePoint& point);

/// Principal curvatures in 1/mm: positive where the surface bends towards `normal`, as the inside of a bowl does seen from
/// the open side.
struct PrincipalCurvatures {
    double smallest = 0.0;
    double largest = 0.0;
    Vector3 smallest_direction = Vector3::Zero();  ///< unit, in the tangent plane
    Vector3 largest_direction = Vector3::Zero();   ///< unit, in the tangent plane

    [[nodiscard]] double gaussian() const { return smallest * largest; }
    [[nodiscard]] double mean() const { return (smallest + largest) / 2.0; }
};

/// Of a regular point (du × dv ≠ 0), seen from the side `normal` points to (unit, along ± du × dv); do Carmo 1976, 3-3.
[[nodiscard]] PrincipalCurvatures principalCurvatures(const SurfacePoint& point, const Vector3& normal);

/// Curvature (1/mm) of the normal section along `direction`, of which the part in the tangent plane counts; must not vanish.
[[nodiscard]] double normalCurvature(const SurfacePoint& point, const Vector3& normal, const Vector3& direction);

}  // namespace cusp::geometry
