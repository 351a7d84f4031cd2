// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The geometry of a tool on a surface point, in closed form.
#include <cusp/optimizer/finishing/tool_placement.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cusp::finishing {

namespace {

/// Below this the tool axis counts as standing on the normal: a quarter of a millionth of a degree.
constexpr double upright = 4e-9;

}  // namespace

FeedFrame feedFrame(const Vector3& normal, const Vector3& feed) {
    FeedFrame frame;
    frame.normal = normal;
    frame.feed = (feed - feed.dot(normal) * normal).normalized();
    frame.left = normal.cross(frame.feed);
    return frame;
}

Vector3 toolAxis(const FeedFrame& frame, double lead_rad, double tilt_rad) {
    const Vector3 leaned = std::cos(tilt_rad) * frame.normal + std::sin(tilt_rad) * frame.left;
    return (std::cos(lead_rad) * leaned + std::sin(lead_rad) * frame.feed).normalized();
}

LeadTilt leadTiltOf(const FeedFrame& frame, const Vector3& axis) {
    return {std::asin(std::clamp(axis.dot(frame.feed), -1.0, 1.0)),
            std::atan2(axis.dot(frame.left), axis.dot(frame.normal))};
}

toolpath::CutterLocation placeTool(const geometry::Cutter& cutter, const Vector3& contact, const FeedFrame& frame,
                                   const Vector3& axis) {
    Vector3 outward = frame.normal.dot(axis) * axis - frame.normal;
    if (outward.norm() < upright) outward = frame.feed - frame.feed.dot(axis) * axis;
    const Vector3 corner = contact + cutter.corner_radius_mm * frame.normal;
    return {corner - cutter.corner_e_mm * outward.normalized() - cutter.corner_f_mm * axis, axis};
}

double effectiveRadius(const geometry::Cutter& cutter, double lead_rad, double tilt_rad) {
    const double r = cutter.corner_radius_mm;
    if (cutter.corner_e_mm <= 0.0) return r;
    const double sine = std::abs(std::sin(lead_rad));
    if (sine == 0.0) return std::numeric_limits<double>::infinity();
    const double tilt_cos = std::cos(tilt_rad);
    const double tilt_sin = std::sin(tilt_rad);
    return cutter.corner_e_mm * tilt_cos * tilt_cos / (sine * (1.0 - tilt_sin * tilt_sin * sine * sine)) + r;
}

double scallopHeight(double step_over_mm, double effective_radius_mm, double curvature_per_mm) {
    const double half = step_over_mm / 2.0;
    const double relative = 1.0 / effective_radius_mm - curvature_per_mm;
    // Where surface or tool is so flat that centres lie far off, the parabola is exact and the circles are not.
    constexpr double flat_per_mm = 1e-7;
    if (std::abs(curvature_per_mm) < flat_per_mm) {
        if (!std::isfinite(effective_radius_mm)) return 0.0;
        const double inside = effective_radius_mm * effective_radius_mm - half * half;
        return inside > 0.0 ? effective_radius_mm - std::sqrt(inside) : effective_radius_mm;
    }
    if (!(effective_radius_mm < 1.0 / flat_per_mm)) return half * half * relative / 2.0;
    // Centre of the surface's circle at the origin, centres of the tool's at ± `angle` and `away` from it.
    const double radius = 1.0 / std::abs(curvature_per_mm);
    const double angle = half / radius;
    const double hollow = curvature_per_mm > 0.0 ? 1.0 : -1.0;
    const double away = radius - hollow * effective_radius_mm;
    const double across = away * std::sin(angle);
    const double inside = effective_radius_mm * effective_radius_mm - across * across;
    if (inside < 0.0) return effective_radius_mm;
    const double reach = away * std::cos(angle) + hollow * std::sqrt(inside);
    return hollow * (radius - reach);
}

std::optional<double> matchedLead(const geometry::Cutter& cutter, double curvature_per_mm) {
    const double r = cutter.corner_radius_mm;
    if (curvature_per_mm <= 0.0) return 0.0;
    const double room = 1.0 / curvature_per_mm - r;
    if (room <= 0.0) return std::nullopt;
    if (cutter.corner_e_mm <= 0.0) return 0.0;
    const double sine = cutter.corner_e_mm / room;
    if (sine > 1.0) return std::nullopt;
    return std::asin(sine);
}

double edgeUndercut(double edge_radius_mm, double lead_rad) {
    const double lead = std::abs(lead_rad);
    return edge_radius_mm * (std::sin(lead) + std::cos(lead) - 1.0);
}

}  // namespace cusp::finishing
