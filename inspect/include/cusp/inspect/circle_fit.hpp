// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Least-squares circle through measured points, in the plane that fits them best.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/frames.hpp>

#include <cstddef>
#include <span>

namespace cusp::inspect {

struct CircleFit {
    geometry::Vector3 center = geometry::Vector3::Zero();
    geometry::Vector3 normal = geometry::Vector3::UnitZ();  ///< of the plane; its largest component is positive
    double radius_mm = 0.0;
    double rms_radial_mm = 0.0;  ///< of (distance to the axis − radius)
    double rms_plane_mm = 0.0;   ///< of distances to the plane
    int iterations = 0;
};

/// Gaussian circle as ISO 10360-6 tests it: the plane by orthogonal regression, then in it the circle that minimises the
/// squares of the radial distances. Errors: `circle.too-few-points` (three are needed), `circle.not-determined` (the
/// points lie on a line or are one point), `circle.not-converged`.
[[nodiscard]] base::Result<CircleFit> fitCircle(std::span<const geometry::Vector3> points);

}  // namespace cusp::inspect
