// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Tool axes of a tilted path, and the records it is written with.
#include <cusp/optimizer/tilt/tilted_path.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cusp::tilt {

using geometry::Vector3;
using toolpath::CutterLocation;

namespace {

double smoothStep(double t) {
    const double x = std::clamp(t, 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
}

/// On the great circle from `from` to `to`.
Vector3 between(const Vector3& from, const Vector3& to, double share) {
    if (share >= 1.0) return to;
    const double angle = geometry::angleBetween(from, to);
    constexpr double small_rad = 1e-9;
    if (share <= 0.0 || angle < small_rad) return from;
    return (std::sin((1.0 - share) * angle) * from + std::sin(share * angle) * to).normalized();
}

}  // namespace

double TiltArea::weight(const Vector3& tip_mm) const {
    double squared = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        double outside = 0.0;
        if (min_mm) outside = std::max(outside, (*min_mm)[k] - tip_mm[axis]);
        if (max_mm) outside = std::max(outside, tip_mm[axis] - (*max_mm)[k]);
        squared += outside * outside;
    }
    if (squared <= 0.0) return 1.0;
    return blend_mm > 0.0 ? 1.0 - smoothStep(std::sqrt(squared) / blend_mm) : 0.0;
}

const base::Section<TiltArea>& tiltAreaSection() {
    static const auto section =
        base::Section<TiltArea>("The part of the path that is tilted; what is absent does not restrict.")
            .field("min_mm", &TiltArea::min_mm, "Lower corner of a box of tips.")
            .field("max_mm", &TiltArea::max_mm, "Upper corner of it.")
            .field("blend_mm", &TiltArea::blend_mm, "Outside the box the tilt fades out over this distance.",
                   {.min = 0.0});
    return section;
}

Vector3 TiltPlan::pointAt(double share) const {
    if (points.size() == 1) return points.front();
    const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(points.size() - 1);
    const auto k = std::min(points.size() - 2, static_cast<std::size_t>(place));
    return points[k] + smoothStep(place - static_cast<double>(k)) * (points[k + 1] - points[k]);
}

Vector3 axisThrough(const Vector3& tilt_point_mm, const Vector3& center_mm) {
    const Vector3 way = tilt_point_mm - center_mm;
    const double length = way.norm();
    constexpr double same_mm = 1e-9;
    if (length < same_mm) return Vector3::UnitZ();
    return way / (way.z() < 0.0 ? -length : length);
}

double StartPath::lengthMm() const {
    double length = 0.0;
    for (std::size_t i = 1; i < locations.size(); ++i)
        length += (locations[i].location.tip_mm - locations[i - 1].location.tip_mm).norm();
    return length;
}

StartPath StartPath::coarse(double spacing_mm) const {
    StartPath out;
    out.cutter = cutter;
    out.spindle_rpm = spindle_rpm;
    std::vector<char> stays(locations.size(), 0);
    for (std::size_t i = 0; i < locations.size(); ++i) {
        const bool rapid_beside = locations[i].kind == toolpath::MotionKind::Rapid ||
                                  (i + 1 < locations.size() && locations[i + 1].kind == toolpath::MotionKind::Rapid) ||
                                  (i > 0 && locations[i - 1].kind == toolpath::MotionKind::Rapid);
        if (rapid_beside || i + 1 == locations.size()) stays[i] = 1;
        if (locations[i].above) stays[*locations[i].above] = 1;
    }
    std::vector<std::uint32_t> place(locations.size(), 0);
    Vector3 last = Vector3::Constant(std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < locations.size(); ++i) {
        const Vector3& tip = locations[i].location.tip_mm;
        if (stays[i] == 0 && (tip - last).norm() < spacing_mm) continue;
        last = tip;
        place[i] = static_cast<std::uint32_t>(out.locations.size());
        out.locations.push_back(locations[i]);
    }
    for (StartLocation& at : out.locations)
        if (at.above) at.above = place[*at.above];
    return out;
}

std::vector<CutterLocation> tilted(const StartPath& path, const TiltPlan& plan) {
    std::vector<CutterLocation> out;
    out.reserve(path.locations.size());
    const double radius = path.cutter.diameter_mm / 2.0;
    const auto poseAt = [&](std::size_t i) -> CutterLocation {
        const CutterLocation& start = path.locations[i].location;
        const double weight = plan.area.weight(start.tip_mm);
        if (weight <= 0.0) return start;
        const Vector3 center = path.center(i);
        const Vector3 axis = between(start.axis, axisThrough(plan.pointAt(path.locations[i].share), center), weight);
        return {center - radius * axis, axis};
    };
    for (std::size_t i = 0; i < path.locations.size(); ++i) {
        const StartLocation& at = path.locations[i];
        if (!at.above) {
            out.push_back(poseAt(i));
            continue;
        }
        // Up and down along the tool axis, to the height the link had.
        const CutterLocation cut = poseAt(*at.above);
        const double rise = at.location.tip_mm.z() - path.locations[*at.above].location.tip_mm.z();
        constexpr double flattest = 0.1;
        out.push_back({cut.tip_mm + cut.axis * (rise / std::max(cut.axis.z(), flattest)), cut.axis});
    }
    return out;
}

double largestCenterError(const StartPath& path, const std::vector<CutterLocation>& poses) {
    double largest = 0.0;
    for (std::size_t i = 1; i < poses.size(); ++i) {
        if (path.locations[i].kind != toolpath::MotionKind::Feed) continue;
        const double turn = geometry::angleBetween(poses[i - 1].axis, poses[i].axis);
        largest = std::max(largest, path.cutter.diameter_mm / 2.0 * turn * turn / 8.0);
    }
    return largest;
}

std::vector<toolpath::ClRecord> tiltedRecords(const StartPath& path, const TiltPlan& plan) {
    const std::vector<CutterLocation> poses = tilted(path, plan);
    std::vector<toolpath::ClRecord> out = path.records;
    std::size_t next = 0;
    for (toolpath::ClRecord& record : out)
        if (auto* motion = std::get_if<toolpath::LinearMotion>(&record.statement)) motion->location = poses[next++];
    return out;
}

}  // namespace cusp::tilt
