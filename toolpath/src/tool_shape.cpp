// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Where the corner circle lies.
#include "tool_shape.hpp"

#include <cmath>
#include <numbers>

namespace cusp::toolpath::detail {
namespace {

/// The corner circle that touches the tip's cone (angle a from the horizontal) and the flank (angle b from the axis),
/// where both would meet at d/2: at distance r from both lines.
void placeCornerCircle(geometry::Cutter& cutter) {
    const double a = cutter.point_angle_rad;
    const double b = cutter.taper_angle_rad;
    const double r = cutter.corner_radius_mm;
    const double edge_radius = cutter.diameter_mm / 2.0;
    const double edge_height = edge_radius * std::tan(a);
    // −e·sin a + f·cos a = r  and  −(e − R)·cos b + (f − h)·sin b = r
    const double determinant = std::cos(a) * std::cos(b) - std::sin(a) * std::sin(b);
    const double right = r - edge_radius * std::cos(b) + edge_height * std::sin(b);
    cutter.corner_e_mm = (r * std::sin(b) - right * std::cos(a)) / determinant;
    cutter.corner_f_mm = (r * std::cos(b) - right * std::sin(a)) / determinant;
}

}  // namespace

bool isPossible(const geometry::Cutter& cutter) {
    constexpr double right_angle_rad = std::numbers::pi / 2.0;
    return cutter.diameter_mm > 0.0 && cutter.corner_radius_mm >= 0.0 && cutter.cutting_height_mm >= 0.0 &&
           std::abs(cutter.point_angle_rad) < right_angle_rad && std::abs(cutter.taper_angle_rad) < right_angle_rad;
}

geometry::Cutter millShape(double diameter_mm, double corner_radius_mm, double cutting_height_mm,
                           double taper_angle_rad, double point_angle_rad) {
    geometry::Cutter cutter;
    cutter.diameter_mm = diameter_mm;
    cutter.corner_radius_mm = corner_radius_mm;
    cutter.cutting_height_mm = cutting_height_mm;
    cutter.taper_angle_rad = taper_angle_rad;
    cutter.point_angle_rad = point_angle_rad;
    if (isPossible(cutter)) {
        placeCornerCircle(cutter);
    }
    return cutter;
}

}  // namespace cusp::toolpath::detail
