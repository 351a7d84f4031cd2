// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// How a tool stands on a point of a surface: feed frame, lead and tilt, effective radius, scallop, matched lead.
#pragma once

#include <cusp/geometry/cutter.hpp>
#include <cusp/geometry/surface_point.hpp>
#include <cusp/toolpath/cl_record.hpp>

#include <optional>

namespace cusp::finishing {

using geometry::Vector3;

/// Right-handed, orthonormal: feed × left = normal.
struct FeedFrame {
    Vector3 normal = Vector3::UnitZ();  ///< out of the material
    Vector3 feed = Vector3::UnitX();    ///< along the pass, in the direction of travel
    Vector3 left = Vector3::UnitY();
};

/// `feed` need not be a unit vector, and only its part across `normal` counts; it must not vanish.
[[nodiscard]] FeedFrame feedFrame(const Vector3& normal, const Vector3& feed);

/// Unit tool axis. Lead > 0 leans it towards the feed, tilt > 0 to the left of the feed; lead is applied first.
[[nodiscard]] Vector3 toolAxis(const FeedFrame& frame, double lead_rad, double tilt_rad);

/// The angles of an axis in a frame: the inverse of `toolAxis`.
struct LeadTilt {
    double lead_rad = 0.0;
    double tilt_rad = 0.0;
};
[[nodiscard]] LeadTilt leadTiltOf(const FeedFrame& frame, const Vector3& axis);

/// The location at which the corner of the cutter touches `contact` with the surface's normal there. Where the axis stands on
/// the normal the whole bottom of a flat or toroidal cutter touches; the contact then counts as the foremost point.
[[nodiscard]] toolpath::CutterLocation placeTool(const geometry::Cutter& cutter, const Vector3& contact,
                                                 const FeedFrame& frame, const Vector3& axis);

/// Fountas 2017, eq. 4: the radius (mm) of the circle that the cutter's silhouette along the feed makes at the contact. Of a
/// ball its radius; infinite for any other cutter at lead 0, where the equation is singular.
[[nodiscard]] double effectiveRadius(const geometry::Cutter& cutter, double lead_rad, double tilt_rad);

/// Height (mm) of the ridge left midway between two passes `step_over_mm` apart (along the surface) by circles of
/// `effective_radius_mm` on a surface of cross-feed curvature `curvature_per_mm` (> 0: concave). Negative where the circle is
/// flatter than a concave surface: then the passes cut into it by about as much.
[[nodiscard]] double scallopHeight(double step_over_mm, double effective_radius_mm, double curvature_per_mm);

/// The smallest lead at zero tilt with an effective radius of no more than 1 / `curvature_per_mm`: a cutter that leans less cuts
/// into the surface. 0 for balls and where the surface is not concave; empty where no lead does, because the corner itself is
/// rounder than the surface is hollow.
[[nodiscard]] std::optional<double> matchedLead(const geometry::Cutter& cutter, double curvature_per_mm);

/// Depth (mm) by which the rounded edge of an insert stays above the place of the sharp corner a flat cutter is programmed
/// with: ε (sin α + cos α − 1), from the support of a torus. The paper names this h_u after Bedi 1996 and prints no formula.
[[nodiscard]] double edgeUndercut(double edge_radius_mm, double lead_rad);

}  // namespace cusp::finishing
