// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Cutter shapes from fewer values than APT's seven.
#pragma once

#include <cusp/geometry/cutter.hpp>

namespace cusp::toolpath::detail {

/// Diameters positive, radii and heights not negative, angles below 90°.
[[nodiscard]] bool isPossible(const geometry::Cutter& cutter);

/// A mill given as NX's TLDATA/MILL does: the corner circle touches the tip's cone and the flank.
[[nodiscard]] geometry::Cutter millShape(double diameter_mm, double corner_radius_mm, double cutting_height_mm,
                                         double taper_angle_rad, double point_angle_rad);

}  // namespace cusp::toolpath::detail
