// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Turns about X, the new Y, the new Z out of a rotation matrix.
#include "tilted_plane.hpp"

#include "fixed_number.hpp"

#include <cusp/base/units.hpp>

#include <cmath>

namespace cusp::post {

using geometry::Matrix3;
using geometry::RigidTransform;
using geometry::Vector3;

namespace {

// Beyond this sine of b the first and the third turn are about one axis, to within a file's seventh decimal.
constexpr double gimbal_cosine = 1e-7;

}  // namespace

TiltedPlane tiltedPlane(const RigidTransform& workpiece_from_plane, const RotaryValues& rotary_rad, int decimals) {
    const Matrix3 turn = workpiece_from_plane.linear();
    const double cosine = std::hypot(turn(0, 0), turn(0, 1));
    TiltedPlane plane;
    plane.angles_rad[1] = std::atan2(turn(0, 2), cosine);
    if (cosine > gimbal_cosine) {
        plane.angles_rad[0] = std::atan2(-turn(1, 2), turn(2, 2));
        plane.angles_rad[2] = std::atan2(-turn(0, 1), turn(0, 0));
    } else {
        plane.angles_rad[2] = std::atan2(turn(1, 0), turn(1, 1));
    }
    for (double& angle : plane.angles_rad)
        angle = base::radFromDeg(static_cast<double>(toFixed(base::degFromRad(angle), decimals)) /
                                 powers_of_ten[static_cast<std::size_t>(decimals)]);
    plane.origin_mm = workpiece_from_plane.translation();
    plane.rotary_rad = rotary_rad;
    return plane;
}

RigidTransform planeAcross(const Vector3& axis) {
    RigidTransform workpiece_from_plane = RigidTransform::Identity();
    const Vector3 level = Vector3::UnitZ().cross(axis);
    const Vector3 x = level.norm() > gimbal_cosine ? Vector3(level.normalized()) : Vector3(Vector3::UnitX());
    workpiece_from_plane.linear().col(0) = x;
    workpiece_from_plane.linear().col(1) = axis.cross(x).normalized();
    workpiece_from_plane.linear().col(2) = axis;
    return workpiece_from_plane;
}

}  // namespace cusp::post
