// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// From APT's seven values to a convex body, or the reason why they describe none.
#include <cusp/simulation/cutter_body.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace cusp::simulation {
namespace {

/// CL files round the seven values; a corner that misses bottom or flank by less is taken as tangent.
constexpr double rounding_mm = 0.01;

base::Result<void> check(bool sound, const std::string& why) {
    if (sound) return {};
    return base::fail("simulation.cutter", why);
}

}  // namespace

base::Result<CutterBody> CutterBody::make(const geometry::Cutter& cutter) {
    const double radius = cutter.diameter_mm / 2.0;
    const double corner = cutter.corner_radius_mm;
    const double bottom = cutter.point_angle_rad;
    const double flank = cutter.taper_angle_rad;
    if (const auto ok = check(radius > 0.0 && corner >= 0.0 && corner <= radius + rounding_mm,
                              fmt::format("a cutter of diameter {} mm and corner radius {} mm is not possible",
                                          cutter.diameter_mm, corner));
        !ok)
        return base::fail(ok.error());
    if (const auto ok =
            check(bottom >= 0.0 && flank >= 0.0 && bottom + flank < std::numbers::pi / 2.0,
                  "the bottom of the cutter must rise outwards and its flank widen upwards, by less than 90° "
                  "together");
        !ok)
        return base::fail(ok.error());

    CutterBody body;
    body.bottom_sin_ = std::sin(bottom);
    body.bottom_cos_ = std::cos(bottom);
    body.flank_sin_ = std::sin(flank);
    body.flank_cos_ = std::cos(flank);
    body.corner_radius_mm_ = corner;
    // The corner's centre is a corner radius above the bottom line through the tip, and as far inside the flank line, which
    // meets the tip's plane at d/2.
    const double reach = radius * body.flank_cos_ - corner;
    const double across = std::cos(bottom + flank);
    body.corner_rho_mm_ = (reach * body.bottom_cos_ + corner * body.flank_sin_) / across;
    body.corner_z_mm_ = (reach * body.bottom_sin_ + corner * body.flank_cos_) / across;
    const bool stated = cutter.corner_e_mm > 0.0 || cutter.corner_f_mm > 0.0;
    if (const auto ok =
            check(!stated || corner == 0.0 ||
                      (std::abs(cutter.corner_e_mm - body.corner_rho_mm_) <= rounding_mm &&
                       std::abs(cutter.corner_f_mm - body.corner_z_mm_) <= rounding_mm),
                  fmt::format(
                      "the corner arc of the cutter does not meet its bottom and flank: its centre is stated at e = {} "
                      "mm, f = {} mm, where e = {:.4f} mm, f = {:.4f} mm would be",
                      cutter.corner_e_mm, cutter.corner_f_mm, body.corner_rho_mm_, body.corner_z_mm_));
        !ok)
        return base::fail(ok.error());

    // Files that give no height mean a flank that is long enough.
    constexpr double long_enough_diameters = 10.0;
    body.height_mm_ =
        cutter.cutting_height_mm > 0.0 ? cutter.cutting_height_mm : long_enough_diameters * cutter.diameter_mm;
    body.largest_radius_mm_ = radius + body.height_mm_ * std::tan(flank);
    return body;
}

base::Result<CutterBody> CutterBody::frustum(double from_mm, double from_diameter_mm, double to_mm,
                                             double to_diameter_mm) {
    const double height = to_mm - from_mm;
    if (!(height > 0.0 && from_diameter_mm >= 0.0 && to_diameter_mm >= 0.0 && from_diameter_mm + to_diameter_mm > 0.0))
        return base::fail("simulation.part",
                          fmt::format("a part of the tool from {} to {} mm above the tip, {} mm wide below and {} mm "
                                      "above, is not possible: it needs a height and a width above 0",
                                      from_mm, to_mm, from_diameter_mm, to_diameter_mm));
    const double widening = 0.5 * (to_diameter_mm - from_diameter_mm);
    const double flank = std::hypot(widening, height);
    CutterBody body;
    body.corner_rho_mm_ = 0.5 * from_diameter_mm;
    body.corner_z_mm_ = from_mm;
    body.flank_sin_ = widening / flank;
    body.flank_cos_ = height / flank;
    body.base_mm_ = from_mm;
    body.height_mm_ = to_mm;
    body.largest_radius_mm_ = 0.5 * std::max(from_diameter_mm, to_diameter_mm);
    return body;
}

}  // namespace cusp::simulation
