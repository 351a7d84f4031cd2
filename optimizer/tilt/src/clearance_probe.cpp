// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A field of distances, and spheres of the tool looked up in it; the exact nearest point where the field does not decide.
#include "clearance_probe.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tbb/parallel_for.h>

namespace cusp::tilt::detail {

using geometry::Vector3;

namespace {

constexpr double missed_mm = 0.01;
constexpr double guard_mm = 0.05;
constexpr double face_spacing_mm = 2.0;

/// Area of the part of a disc that lies beyond a line `depth` inside its rim.
double segmentArea(double radius, double depth) {
    if (depth >= 2.0 * radius) return std::numbers::pi * radius * radius;
    const double rest = radius - depth;
    return radius * radius * std::acos(rest / radius) - rest * std::sqrt(depth * (2.0 * radius - depth));
}

/// Any two unit vectors that with `axis` make a right-handed frame.
std::array<Vector3, 2> across(const Vector3& axis) {
    const Vector3 other = std::abs(axis.x()) < 0.9 ? Vector3::UnitX() : Vector3::UnitY();
    const Vector3 u = axis.cross(other).normalized();
    return {u, axis.cross(u)};
}

}  // namespace

ClearanceProbe::ClearanceProbe(const geometry::NominalShape& shape, const TiltTool& tool, double stick_out_mm,
                               double cell_mm)
    : shape_(&shape) {
    place(tool, stick_out_mm);
    double reach = 0.0;
    for (const Sphere& sphere : spheres_) reach = std::max(reach, sphere.radius);
    for (const Face& face : faces_) reach = std::max(reach, face.radius);
    fill(cell_mm, reach);
}

ClearanceProbe::ClearanceProbe(const ClearanceProbe& other, const TiltTool& tool, double stick_out_mm)
    : shape_(other.shape_), field_(other.field_) {
    place(tool, stick_out_mm);
}

void ClearanceProbe::place(const TiltTool& tool, double stick_out_mm) {
    double height = tool.cutting_height_mm;
    double before = tool.diameter_mm / 2.0;
    const double grown = tool.clearance_mm;
    const auto add = [&](const std::array<double, 3>& ring, bool fades) {
        const double lower = ring[1] / 2.0 + grown;
        const double upper = ring[2] / 2.0 + grown;
        constexpr double wider_mm = 0.05;
        if (lower > before + wider_mm) addFace(height, before, lower);
        addRing(height, lower, height + ring[0], upper, fades);
        height += ring[0];
        before = upper;
    };
    for (std::size_t i = 0; i < tool.shank_mm.size(); ++i) add(tool.shank_mm[i], i == 0);
    height = stick_out_mm;
    before = 0.0;
    for (const auto& ring : tool.holder_mm) add(ring, false);
}

/// Spheres with centres on the axis that touch the side of the ring from within.
void ClearanceProbe::addRing(double from, double lower_radius, double to, double upper_radius, bool fades) {
    const double slope = (upper_radius - lower_radius) / (to - from);
    const double lean = 1.0 / std::sqrt(1.0 + slope * slope);
    double height = from;
    while (height < to) {
        const double radius = (lower_radius + slope * (height - from)) * lean;
        const double guard = fades ? guard_mm * std::min(1.0, (height - from) / (2.0 * lower_radius)) : guard_mm;
        const double step = std::min(std::sqrt(8.0 * radius * missed_mm), to - height);
        spheres_.push_back({height, radius + guard, step});
        height += std::max(step, missed_mm);
    }
}

void ClearanceProbe::addFace(double height, double inner_radius, double radius) {
    Face face{height, radius, 0.0, {}};
    const int rings = std::max(1, static_cast<int>(std::ceil((radius - inner_radius) / face_spacing_mm)));
    for (int ring = 0; ring <= rings; ++ring) {
        const double r = inner_radius + (radius - inner_radius) * ring / rings;
        const int points = std::max(1, static_cast<int>(std::ceil(2.0 * std::numbers::pi * r / face_spacing_mm)));
        for (int k = 0; k < points; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / points;
            face.points.push_back({r * std::cos(angle), r * std::sin(angle)});
        }
    }
    face.area =
        std::numbers::pi * (radius * radius - inner_radius * inner_radius) / static_cast<double>(face.points.size());
    faces_.push_back(std::move(face));
}

void ClearanceProbe::fill(double cell_mm, double reach_mm) {
    field_ = std::make_shared<Field>();
    Field& field = *field_;
    field.part = shape_->bounds();
    field.box = {field.part.min(), field.part.max() + Vector3::Constant(reach_mm + cell_mm)};
    field.box.min().head<2>() -= Eigen::Vector2d::Constant(reach_mm + cell_mm);
    field.cell = cell_mm;
    for (int axis = 0; axis < 3; ++axis)
        field.count[static_cast<std::size_t>(axis)] =
            static_cast<int>(std::ceil(field.box.sizes()[axis] / cell_mm)) + 2;
    const auto plane = static_cast<std::size_t>(field.count[0]) * static_cast<std::size_t>(field.count[1]);
    field.distance.resize(plane * static_cast<std::size_t>(field.count[2]));
    tbb::parallel_for(0, field.count[2], [&](int k) {
        std::vector<Vector3> points;
        points.reserve(plane);
        for (int j = 0; j < field.count[1]; ++j)
            for (int i = 0; i < field.count[0]; ++i) points.emplace_back(field.box.min() + cell_mm * Vector3(i, j, k));
        for (std::size_t at = 0; at < points.size(); ++at)
            field.distance[static_cast<std::size_t>(k) * plane + at] =
                static_cast<float>(shape_->closest(points[at]).distance_mm);
    });
}

double ClearanceProbe::distance(const Vector3& point, double wanted, Look look) const {
    const Field& field = *field_;
    const Vector3 place = (point - field.box.min()) / field.cell;
    for (int axis = 0; axis < 3; ++axis)
        if (!(place[axis] >= 0.0 && place[axis] < field.count[static_cast<std::size_t>(axis)] - 1)) {
            // Below the part there is its underside; beside and above it, air.
            const double outside = field.part.exteriorDistance(point);
            return outside > 0.0 ? outside : shape_->closest(point).distance_mm;
        }
    const std::array<std::size_t, 3> cell = {static_cast<std::size_t>(place.x()), static_cast<std::size_t>(place.y()),
                                             static_cast<std::size_t>(place.z())};
    const auto columns = static_cast<std::size_t>(field.count[0]);
    const auto rows = static_cast<std::size_t>(field.count[1]);
    const double fx = place.x() - static_cast<double>(cell[0]);
    const double fy = place.y() - static_cast<double>(cell[1]);
    const double fz = place.z() - static_cast<double>(cell[2]);
    const auto at = [&](std::size_t i, std::size_t j, std::size_t k) {
        return static_cast<double>(field.distance[((cell[2] + k) * rows + cell[1] + j) * columns + cell[0] + i]);
    };
    const auto alongX = [&](std::size_t j, std::size_t k) { return std::lerp(at(0, j, k), at(1, j, k), fx); };
    const double value =
        std::lerp(std::lerp(alongX(0, 0), alongX(1, 0), fy), std::lerp(alongX(0, 1), alongX(1, 1), fy), fz);
    // A distance changes by at most the way: interpolated it is off by less than a cell.
    if (std::abs(value - wanted) > field.cell) return value;
    if (look == Look::Sure) return std::max(value, wanted);
    return shape_->closest(point).distance_mm;
}

double ClearanceProbe::overlapAt(const toolpath::CutterLocation& pose, Look look) const {
    double volume = 0.0;
    for (std::size_t i = 0; i < spheres_.size();) {
        const Sphere& sphere = spheres_[i];
        const double clear = distance(pose.tip_mm + sphere.height * pose.axis, sphere.radius, look) - sphere.radius;
        if (clear < 0.0) {
            volume += segmentArea(sphere.radius, -clear) * sphere.step;
            ++i;
            continue;
        }
        // Free at least until the way and the growing radius have used up the clearance.
        ++i;
        while (i < spheres_.size() &&
               (spheres_[i].height - sphere.height) + std::max(0.0, spheres_[i].radius - sphere.radius) <= clear)
            ++i;
    }
    for (const Face& face : faces_) volume += overlapOfFace(face, pose, look);
    return volume;
}

double ClearanceProbe::overlapOfFace(const Face& face, const toolpath::CutterLocation& pose, Look look) const {
    const Vector3 center = pose.tip_mm + face.height * pose.axis;
    const double far = face.radius + guard_mm;
    if (distance(center, far, look) >= far) return 0.0;
    const auto [u, v] = across(pose.axis);
    double volume = 0.0;
    for (const auto& point : face.points) {
        const double inside = guard_mm - distance(center + point[0] * u + point[1] * v, guard_mm, look);
        if (inside > 0.0) volume += inside * face.area;
    }
    return volume;
}

double ClearanceProbe::overlap(std::span<const toolpath::CutterLocation> poses, Look look) const {
    double volume = 0.0;
    for (const auto& pose : poses) volume += overlapAt(pose, look);
    return poses.empty() ? 0.0 : volume / static_cast<double>(poses.size());
}

}  // namespace cusp::tilt::detail
