// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Centres from I, J, K, CR or AR; sweeps with their full turns; circles through three points (PM12, circular and helical
// interpolation).
#include "arc.hpp"

#include <cusp/base/units.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace cusp::post::reader {

namespace {

/// What the control allows between the radii at start and end: MD21000 (0.01 mm) and MD21010 (0.001 of the radius).
double radiusTolerance(double radius_mm) { return std::max(0.01, 0.001 * radius_mm); }

/// Start and end closer than this are one point: a full circle.
constexpr double same_point_mm = 1e-9;
constexpr double most_turns = 999.0;
constexpr double full_turn = 2.0 * std::numbers::pi;

struct Plane {
    std::size_t first;
    std::size_t second;
};

Plane planeOf(std::string_view code) {
    if (code == "G18") return {2, 0};
    if (code == "G19") return {1, 2};
    return {0, 1};
}

std::array<double, 3> toArray(const Vector3& v) { return {v.x, v.y, v.z}; }

Vector3 unitVector(std::size_t axis) {
    return axis == 0 ? Vector3{1, 0, 0} : axis == 1 ? Vector3{0, 1, 0} : Vector3{0, 0, 1};
}

struct Point2 {
    double first = 0.0;
    double second = 0.0;
};

double distance(const Point2& a, const Point2& b) { return std::hypot(b.first - a.first, b.second - a.second); }

std::optional<Point2> centerFromRadius(const Point2& start, const Point2& end, double radius, bool clockwise,
                                       std::string& problem) {
    const double chord = distance(start, end);
    if (chord < same_point_mm) {
        problem = "a full circle cannot be given by its radius";
        return std::nullopt;
    }
    const double size = std::abs(radius);
    if (chord / 2.0 > size + radiusTolerance(size)) {
        problem = fmt::format("start and end are {:.4f} mm apart, too far for CR={:.4f} mm", chord, radius);
        return std::nullopt;
    }
    // The centre lies left of the chord for a counter-clockwise arc of at most half a turn (CR > 0).
    const double height = std::sqrt(std::max(0.0, size * size - chord * chord / 4.0));
    const double side = (clockwise != (radius < 0.0)) ? -height : height;
    const double along_first = (end.first - start.first) / chord;
    const double along_second = (end.second - start.second) / chord;
    return Point2{(start.first + end.first) / 2.0 - side * along_second,
                  (start.second + end.second) / 2.0 + side * along_first};
}

Point2 centerFromWords(const BlockContent& content, const Point2& start, const Plane& plane, double mm_per_unit) {
    const auto component = [&](std::size_t axis, double from) {
        const auto& word = content.center[axis];
        if (!word) return from;
        const double value = word->value * mm_per_unit;
        return word->mode == AxisTarget::Mode::Absolute ? value : from + value;
    };
    return {component(plane.first, start.first), component(plane.second, start.second)};
}

bool validAngle(double angle_deg, std::string& problem) {
    if (angle_deg > 0.0 && angle_deg < 360.0) return true;
    problem = "AR lies between 0 and 360";
    return false;
}

/// The centre lies left of the chord of a counter-clockwise arc of less than half a turn.
std::optional<Point2> centerFromAngle(const Point2& start, const Point2& end, double angle_deg, bool clockwise,
                                      std::string& problem) {
    if (distance(start, end) < same_point_mm) {
        problem = "an arc given by its angle needs another end point, or its centre";
        return std::nullopt;
    }
    if (!validAngle(angle_deg, problem)) return std::nullopt;
    const double lean = (clockwise ? -0.5 : 0.5) / std::tan(base::radFromDeg(angle_deg) / 2.0);
    return Point2{(start.first + end.first) / 2.0 - lean * (end.second - start.second),
                  (start.second + end.second) / 2.0 + lean * (end.first - start.first)};
}

/// CIP: the circle through start, intermediate point and end, in the order of these.
std::optional<Arc> arcThrough(const BlockContent& content, const ArcRequest& request, std::string& problem) {
    if (!content.hasThrough() || content.radius || content.turns || content.arc_angle_deg || content.center[0] ||
        content.center[1] || content.center[2]) {
        problem = "CIP needs an intermediate point I1, J1, K1 and nothing else";
        return std::nullopt;
    }
    const auto from = toArray(request.start_mm);
    std::array<double, 3> middle = from;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& word = content.through[i];
        if (!word) continue;
        const bool incremental = word->mode == AxisTarget::Mode::Incremental ||
                                 (word->mode == AxisTarget::Mode::Modal && request.incremental);
        middle[i] = word->value * request.mm_per_unit + (incremental ? from[i] : 0.0);
    }
    const Vector3 a = Vector3{middle[0], middle[1], middle[2]} - request.start_mm;
    const Vector3 b = request.end_mm - request.start_mm;
    const Vector3 across = cross(a, b);
    const double square = dot(across, across);
    // Twice the area of the triangle against its sides: nearly in line means nearly no circle.
    if (!(square > 1e-12 * dot(a, a) * dot(b, b))) {
        problem = "start, intermediate point and end lie in one line";
        return std::nullopt;
    }
    Arc arc;
    const Vector3 out = (0.5 / square) * (dot(a, a) * cross(b, across) + dot(b, b) * cross(across, a));
    arc.center_mm = request.start_mm + out;
    arc.start_radius_mm = arc.end_radius_mm = norm(out);
    arc.normal = (1.0 / std::sqrt(square)) * across;
    arc.first = (-1.0 / norm(out)) * out;
    arc.second = cross(arc.normal, arc.first);
    const Vector3 to_end = request.end_mm - arc.center_mm;
    arc.sweep_rad = std::atan2(dot(arc.second, to_end), dot(arc.first, to_end));
    if (arc.sweep_rad <= 0.0) arc.sweep_rad += full_turn;
    return arc;
}

}  // namespace

std::optional<Vector3> endByAngle(const BlockContent& content, const ArcRequest& request, std::string& problem) {
    const Plane plane = planeOf(request.plane);
    const bool has_center = content.center[plane.first] || content.center[plane.second];
    const bool has_end = content.linear[plane.first] || content.linear[plane.second];
    if (!content.arc_angle_deg || !has_center || has_end) return std::nullopt;
    if (!validAngle(*content.arc_angle_deg, problem)) return std::nullopt;
    auto at = toArray(request.start_mm);
    const Point2 center = centerFromWords(content, {at[plane.first], at[plane.second]}, plane, request.mm_per_unit);
    const double angle = base::radFromDeg(*content.arc_angle_deg) * (request.clockwise ? -1.0 : 1.0);
    const double first = at[plane.first] - center.first;
    const double second = at[plane.second] - center.second;
    at[plane.first] = center.first + std::cos(angle) * first - std::sin(angle) * second;
    at[plane.second] = center.second + std::sin(angle) * first + std::cos(angle) * second;
    return Vector3{at[0], at[1], at[2]};
}

std::optional<Arc> makeArc(const BlockContent& content, const ArcRequest& request, std::string& problem) {
    if (request.through) return arcThrough(content, request, problem);
    const Plane plane = planeOf(request.plane);
    const std::size_t normal = 3 - plane.first - plane.second;
    const auto from = toArray(request.start_mm);
    const auto to = toArray(request.end_mm);
    const Point2 start{from[plane.first], from[plane.second]};
    const Point2 end{to[plane.first], to[plane.second]};
    const bool has_center = content.center[plane.first] || content.center[plane.second];
    // The angle goes with a centre only where it is what says the end.
    const bool by_angle = content.arc_angle_deg && !has_center;
    const bool has_end = content.linear[plane.first] || content.linear[plane.second];
    const int given = (has_center ? 1 : 0) + (content.radius ? 1 : 0) + (by_angle ? 1 : 0);
    if (given != 1 || content.center[normal] || content.hasThrough() ||
        (content.arc_angle_deg && (content.turns || has_end != by_angle))) {
        problem = "it needs either its centre, in the active plane, or CR, or AR with its end or its centre";
        return std::nullopt;
    }
    const auto center =
        has_center ? std::optional<Point2>(centerFromWords(content, start, plane, request.mm_per_unit))
        : by_angle ? centerFromAngle(start, end, *content.arc_angle_deg, request.clockwise, problem)
                   : centerFromRadius(start, end, *content.radius * request.mm_per_unit, request.clockwise, problem);
    if (!center) return std::nullopt;
    Arc arc;
    arc.first = unitVector(plane.first);
    arc.second = unitVector(plane.second);
    arc.normal = unitVector(normal);
    arc.start_radius_mm = distance(*center, start);
    arc.end_radius_mm = distance(*center, end);
    arc.height_mm = to[normal] - from[normal];
    if (std::abs(arc.start_radius_mm - arc.end_radius_mm) > radiusTolerance(arc.start_radius_mm)) {
        problem = fmt::format("its start is {:.4f} mm and its end {:.4f} mm from its centre", arc.start_radius_mm,
                              arc.end_radius_mm);
        return std::nullopt;
    }
    auto center_mm = from;
    center_mm[plane.first] = center->first;
    center_mm[plane.second] = center->second;
    arc.center_mm = {center_mm[0], center_mm[1], center_mm[2]};
    arc.start_angle_rad = std::atan2(start.second - center->second, start.first - center->first);
    const double end_angle = std::atan2(end.second - center->second, end.first - center->first);
    double sweep = (request.clockwise ? -1.0 : 1.0) * (end_angle - arc.start_angle_rad);
    if (sweep < 0.0) sweep += full_turn;
    if (distance(start, end) < same_point_mm) sweep = full_turn;
    const double turns = content.turns.value_or(0.0);
    if (turns < 0.0 || turns > most_turns || turns != std::floor(turns)) {
        problem = "TURN is a whole number from 0 to 999";
        return std::nullopt;
    }
    arc.sweep_rad = (request.clockwise ? -1.0 : 1.0) * (sweep + turns * full_turn);
    return arc;
}

}  // namespace cusp::post::reader
