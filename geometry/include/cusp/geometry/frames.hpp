// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Points, directions and rigid transforms; transforms are named target_from_source so that products read off.
#pragma once

#include <Eigen/Geometry>

#include <array>

namespace cusp::geometry {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
/// A rigid motion. `a_from_b * b_from_c` is `a_from_c`.
using RigidTransform = Eigen::Isometry3d;

[[nodiscard]] inline Vector3 toVector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

/// Angle between two directions in [0, π]; accurate near 0 and π, where acos of the dot product is not.
[[nodiscard]] inline double angleBetween(const Vector3& a, const Vector3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace cusp::geometry
