// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The shape of a milling cutter as APT's seven CUTTER values describe it.
#pragma once

namespace cusp::geometry {

/// APT cutter (ISO 4343 CUTTER/d,r,e,f,a,b,h), lengths in mm, angles in rad. A flat end mill has r = 0; a ball end mill
/// r = d/2, e = 0, f = d/2; a toroidal cutter 0 < r < d/2, e = d/2 − r, f = r.
struct Cutter {
    double diameter_mm = 0.0;        ///< d
    double corner_radius_mm = 0.0;   ///< r
    double corner_e_mm = 0.0;        ///< e: radial distance from the tool axis to the corner circle's centre
    double corner_f_mm = 0.0;        ///< f: height of the corner circle's centre above the tip
    double point_angle_rad = 0.0;    ///< a: from the horizontal to the line through the tip
    double taper_angle_rad = 0.0;    ///< b: of the flank against the tool axis, > 0 widening upwards
    double cutting_height_mm = 0.0;  ///< h
};

}  // namespace cusp::geometry
