// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Circular blocks, and chords where the control's planes do not fit.
#include "arc_steps.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cusp::post {

using geometry::Vector3;
using toolpath::ArcMotion;
using toolpath::FeedRate;
using toolpath::MotionKind;

namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;
// A normal so close to Z that the circle leaves the plane by less than a tenth of what a block end may be off.
constexpr double plane_tolerance_mm = 1e-4;
// Linear axes that a rotary one stands between may shear a circle.
constexpr double rigid_tolerance = 1e-9;
// Below this, start and end are one point and the turn is a whole one or none.
constexpr double least_sweep_rad = 1e-12;

Vector3 acrossNormal(const ArcMotion& arc, const Vector3& point) {
    const Vector3 radius = point - arc.center_mm;
    return radius - arc.normal * arc.normal.dot(radius);
}

/// The point at `fraction` of the arc: radius and height run evenly from the start's to the end's.
struct ArcPoints {
    ArcPoints(const ArcMotion& arc, const Vector3& start_mm)
        : center(arc.center_mm),
          normal(arc.normal),
          out(acrossNormal(arc, start_mm)),
          side(normal.cross(out)),
          start_radius(out.norm()),
          end_radius(acrossNormal(arc, arc.end.tip_mm).norm()),
          start_height(normal.dot(start_mm - center)),
          end_height(normal.dot(arc.end.tip_mm - center)),
          sweep(arcSweep(arc, start_mm)) {}

    [[nodiscard]] Vector3 at(double fraction) const {
        const double angle = sweep * fraction;
        const double scale = std::lerp(start_radius, end_radius, fraction) / start_radius;
        return center + (out * std::cos(angle) + side * std::sin(angle)) * scale +
               normal * std::lerp(start_height, end_height, fraction);
    }

    Vector3 center;
    Vector3 normal;
    Vector3 out;
    Vector3 side;
    double start_radius;
    double end_radius;
    double start_height;
    double end_height;
    double sweep;
};

std::vector<NcItem> chords(const ArcMotion& arc, const Vector3& start_mm, const Eigen::Affine3d& frame,
                           const RotaryValues& rotary_rad, const FeedRate& feed, double chord_tolerance_mm) {
    const ArcPoints points(arc, start_mm);
    const double radius = std::max(points.start_radius, points.end_radius);
    const double cosine = std::max(-1.0, 1.0 - chord_tolerance_mm / radius);
    const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(points.sweep / (2.0 * std::acos(cosine)))));
    std::vector<NcItem> steps;
    steps.reserve(count);
    const auto add = [&](const Vector3& tip_mm) {
        steps.emplace_back(Move{frame * tip_mm, rotary_rad, MotionKind::Feed, feed, arc.end.axis});
    };
    for (std::size_t i = 1; i < count; ++i) add(points.at(static_cast<double>(i) / static_cast<double>(count)));
    add(arc.end.tip_mm);
    return steps;
}

}  // namespace

double arcSweep(const ArcMotion& arc, const Vector3& start_mm) {
    if (arc.full_circle) return full_turn;
    const Vector3 from = acrossNormal(arc, start_mm);
    const Vector3 to = acrossNormal(arc, arc.end.tip_mm);
    const double angle = std::atan2(arc.normal.dot(from.cross(to)), from.dot(to));
    return angle > least_sweep_rad ? angle : angle + full_turn;
}

double arcLength(const ArcMotion& arc, const Vector3& start_mm) {
    const ArcPoints points(arc, start_mm);
    const double radius = 0.5 * (points.start_radius + points.end_radius);
    return std::hypot(points.sweep * radius, points.end_height - points.start_height);
}

std::vector<NcItem> arcSteps(const ArcMotion& arc, const Vector3& start_mm,
                             const Eigen::Affine3d& programmed_from_workpiece, const RotaryValues& rotary_rad,
                             const FeedRate& feed, double chord_tolerance_mm) {
    const auto& turn = programmed_from_workpiece.linear();
    const Vector3 normal = turn * arc.normal;
    const bool clockwise = normal.z() < 0.0;
    const Vector3 along_z = clockwise ? Vector3(-Vector3::UnitZ()) : Vector3(Vector3::UnitZ());
    if (arc.radius_mm * geometry::angleBetween(normal, along_z) > plane_tolerance_mm ||
        !turn.isUnitary(rigid_tolerance))
        return chords(arc, start_mm, programmed_from_workpiece, rotary_rad, feed, chord_tolerance_mm);
    return {ArcMove{programmed_from_workpiece * arc.end.tip_mm, turn * (arc.center_mm - start_mm), clockwise,
                    rotary_rad, feed}};
}

}  // namespace cusp::post
