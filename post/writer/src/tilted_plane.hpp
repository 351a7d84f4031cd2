// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A plane of 3+2 machining as the three turns of CYCLE800.
#pragma once

#include <cusp/post/writer/nc_program.hpp>

namespace cusp::post {

/// Rx(a)·Ry(b)·Rz(c) = the turn of `workpiece_from_plane`; where b is ±90° and only a ± c counts, a is 0. The angles are
/// rounded to `decimals` of a degree: the plane is what the program says, and points are computed in that one.
[[nodiscard]] TiltedPlane tiltedPlane(const geometry::RigidTransform& workpiece_from_plane,
                                      const RotaryValues& rotary_rad, int decimals);

/// A plane through the workpiece's origin whose Z is `axis`, its X as level as can be.
[[nodiscard]] geometry::RigidTransform planeAcross(const geometry::Vector3& axis);

}  // namespace cusp::post
