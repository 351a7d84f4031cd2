// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// One walk over the records, carrying what is modal in a CL file.
#include "expected_path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cusp::post::verify {

namespace {

/// Frames of one CL file that agree to its last decimals are one.
constexpr double same_frame = 1e-6;
/// Of a CL file's seventh decimal.
constexpr double same_axis_rad = 1e-6;
constexpr reader::Vector3 upright{0.0, 0.0, 1.0};
constexpr double full_turn = 2.0 * std::numbers::pi;

reader::Vector3 toReader(const geometry::Vector3& v) { return {v.x(), v.y(), v.z()}; }
reader::ToolPose toReader(const toolpath::CutterLocation& at) { return {toReader(at.tip_mm), toReader(at.axis)}; }

class Walk {
public:
    explicit Walk(ExpectedPath& out) : out_(out) {}

    void operator()(const toolpath::LinearMotion& motion) {
        choosePlane(toReader(motion.location).axis, false);
        add(toReader(motion.location), motion.kind == toolpath::MotionKind::Rapid);
    }

    void operator()(const toolpath::ArcMotion& motion) {
        const reader::ToolPose end = toReader(motion.end);
        choosePlane(end.axis, false);
        const reader::Vector3 normal = toReader(motion.normal);
        ExpectedArc arc;
        arc.start_mm = tip_mm_;
        arc.normal = normal;
        const auto height = [&](const reader::Vector3& point) { return reader::dot(normal, point - arc.start_mm); };
        const reader::Vector3 center = toReader(motion.center_mm);
        arc.center_mm = center - height(center) * normal;
        arc.height_mm = height(end.tip_mm);
        const reader::Vector3 from = arc.start_mm - arc.center_mm;
        const reader::Vector3 to = end.tip_mm - arc.center_mm - arc.height_mm * normal;
        arc.end_radius_mm = reader::norm(to);
        arc.sweep_rad = std::atan2(reader::dot(normal, reader::cross(from, to)), reader::dot(from, to));
        if (motion.full_circle)
            arc.sweep_rad = full_turn;
        else if (arc.sweep_rad <= 0.0)
            arc.sweep_rad += full_turn;
        ExpectedPoint& point = add(end, false);
        point.arc = static_cast<std::uint32_t>(out_.arcs.size());
        out_.arcs.push_back(arc);
    }

    void operator()(const toolpath::StartPosition& start) {
        tip_mm_ = toReader(start.location.tip_mm);
        opens_ = true;
    }
    void operator()(const toolpath::HomeReturn&) { opens_ = true; }

    void operator()(const toolpath::CycleStart& cycle) {
        using Kind = toolpath::CycleStart::Kind;
        cycle_ = cycle;
        ExpectedCycle expected;
        expected.approach_mm = cycle.clearance_mm.value_or(cycle.retract_mm.value_or(0.0));
        expected.depth_mm = cycle.depth_mm;
        expected.dwell_s = cycle.dwell_s;
        expected.comes_out = cycle.kind == Kind::Deep;
        if ((cycle.kind == Kind::Deep || cycle.kind == Kind::BreakChip) && cycle.peck_mm) {
            const double first = cycle.first_peck_mm.value_or(*cycle.peck_mm);
            expected.smallest_peck_mm = std::min(*cycle.peck_mm, first);
            expected.largest_peck_mm = std::max(*cycle.peck_mm, first);
        }
        out_.cycles.push_back(expected);
        modal_feed_ = process_.feed;
        if (cycle.feed) change().feed = cycle.feed;
    }

    /// Above the hole, down to where the feed begins, to the bottom, and out; a bore and a tap leave at the feed.
    void operator()(const toolpath::HoleLocation& hole) {
        const reader::ToolPose at = toReader(hole.location);
        const auto above = [&](double height) { return reader::ToolPose{at.tip_mm + height * at.axis, at.axis}; };
        const ExpectedCycle& cycle = out_.cycles.back();
        // A tool never leaves a hole below where it went in at feed.
        const double retract = std::max(cycle_.retract_mm.value_or(cycle.approach_mm), cycle.approach_mm);
        using Kind = toolpath::CycleStart::Kind;
        choosePlane(at.axis, true);
        goAbove(above(retract));
        add(above(retract), true).optional = true;
        add(above(cycle.approach_mm), true).optional = !cycle_.clearance_mm;
        add(above(-cycle.depth_mm), false).cycle = static_cast<std::uint32_t>(out_.cycles.size() - 1);
        const bool at_feed = cycle_.kind == Kind::Bore || cycle_.kind == Kind::Tap;
        if (cycle_.kind == Kind::Tap) reverseSpindle();
        if (at_feed) add(above(cycle.approach_mm), false).leaves_hole = true;
        if (cycle_.kind == Kind::Tap) reverseSpindle();
        add(above(retract), true).leaves_hole = !at_feed;
    }

    void operator()(const toolpath::CycleEnd&) {
        if (cycle_.feed) change().feed = modal_feed_;
        cycle_ = {};
    }

    void operator()(const toolpath::WorkPlane& plane) {
        opens_ = true;
        const geometry::Vector3 axis = plane.programming_from_plane.linear().col(2);
        plane_axis_ = work_axis_ = toReader(axis);
    }
    void operator()(const toolpath::FeedRate& feed) { change().feed = feed; }
    void operator()(const toolpath::SpindleCommand& command) {
        change().turn = command.turn;
        if (command.speed)
            process_.rpm = command.unit == toolpath::SpindleCommand::Unit::Rpm ? command.speed : std::nullopt;
    }
    void operator()(const toolpath::CoolantCommand& command) { change().coolant = command.kind; }
    void operator()(const toolpath::ToolCall& call) {
        change().tool_number = call.number;
        process_.tool_name = call.name;
        opens_ = true;
    }
    void operator()(const toolpath::OperationStart&) { opens_ = true; }
    void operator()(const toolpath::ProgrammingFrame& frame) {
        opens_ = true;
        const auto same = [&](const geometry::RigidTransform& other) {
            return (other.matrix() - frame.part_from_programming.matrix()).cwiseAbs().maxCoeff() < same_frame;
        };
        const auto known = std::find_if(frames_.begin(), frames_.end(), same);
        change().frame = static_cast<std::size_t>(known - frames_.begin());
        if (known == frames_.end()) frames_.push_back(frame.part_from_programming);
    }
    void operator()(const toolpath::ProgramStop&) { opens_ = true; }
    void operator()(const toolpath::Remark&) {}
    void operator()(const toolpath::Dwell&) {}
    void operator()(const toolpath::ProgramEnd&) {}
    void operator()(const toolpath::CutterCompensation& command) {
        change().compensation = command.side;
        const bool off = command.side == toolpath::CutterCompensation::Side::Off;
        if (off || command.offset_number) process_.edge = off ? std::nullopt : command.offset_number;
    }
    void operator()(const toolpath::PathTolerance&) {}
    /// Refused before it gets here.
    void operator()(const toolpath::SplineMotion&) {}

    std::uint32_t line = 0;

private:
    /// In 3+2 and for holes off Z the program stands in a plane of its own (CYCLE800): it goes home to tilt it, and home
    /// again where the tool leaves that axis.
    void choosePlane(const reader::Vector3& axis, bool hole) {
        const auto along = [&](const reader::Vector3& other) {
            return reader::angleBetween(axis, other) <= same_axis_rad;
        };
        const reader::Vector3 wanted = along(work_axis_) ? work_axis_ : along(plane_axis_) || hole ? axis : upright;
        if (reader::angleBetween(wanted, plane_axis_) <= same_axis_rad) return;
        opens_ = true;
        plane_axis_ = wanted;
    }

    /// To a hole the tool goes across at the greater of two heights: where it is and the hole's retract plane. Below it
    /// would be a rapid through whatever stands there: so first up along the tool axis, or, where that lies flat against
    /// the hole's, by way of home. From above it may come down on the way, or over the hole.
    void goAbove(const reader::ToolPose& above) {
        constexpr double noticeable_mm = 1e-4;
        constexpr double asked_for_mm = 0.01;
        constexpr double least_slope = 0.5;
        if (opens_ || out_.points.empty()) return;
        const reader::Vector3 way = above.tip_mm - tip_mm_;
        const double rise_mm = reader::dot(way, above.axis);
        const double across_mm = reader::norm(way - rise_mm * above.axis);
        if (std::abs(rise_mm) <= noticeable_mm || across_mm <= noticeable_mm) return;
        if (rise_mm < 0.0) {
            add({above.tip_mm - rise_mm * above.axis, above.axis}, true).optional = true;
            return;
        }
        const reader::Vector3 axis = out_.points.back().pose.axis;
        const double slope = reader::dot(axis, above.axis);
        if (slope < least_slope) {
            opens_ = true;
            return;
        }
        ExpectedPoint& up = add({tip_mm_ + (rise_mm / slope) * axis, axis}, true);
        up.lifts = true;
        up.optional = rise_mm < asked_for_mm || across_mm < asked_for_mm;
    }

    void reverseSpindle() {
        using Turn = toolpath::SpindleCommand::Turn;
        if (!process_.turn || *process_.turn == Turn::Off) return;
        change().turn = *process_.turn == Turn::Clockwise ? Turn::CounterClockwise : Turn::Clockwise;
    }

    ExpectedPoint& add(const reader::ToolPose& pose, bool rapid) {
        if (process_changed_ || out_.processes.empty()) out_.processes.push_back(process_);
        process_changed_ = false;
        ExpectedPoint& point = out_.points.emplace_back();
        point.pose = pose;
        point.line = line;
        point.process = static_cast<std::uint32_t>(out_.processes.size() - 1);
        point.rapid = rapid;
        point.opens = opens_;
        opens_ = false;
        tip_mm_ = pose.tip_mm;
        return point;
    }

    ExpectedProcess& change() {
        process_changed_ = true;
        return process_;
    }

    ExpectedPath& out_;
    ExpectedProcess process_;
    bool process_changed_ = true;
    bool opens_ = true;
    reader::Vector3 work_axis_ = upright;   ///< of the plane the CL file is in
    reader::Vector3 plane_axis_ = upright;  ///< of the plane the program may stand in
    reader::Vector3 tip_mm_;
    std::vector<geometry::RigidTransform> frames_;
    toolpath::CycleStart cycle_;
    std::optional<toolpath::FeedRate> modal_feed_;
};

}  // namespace

reader::Vector3 ExpectedArc::at(double fraction) const {
    const reader::Vector3 from = start_mm - center_mm;
    const double radius = reader::norm(from);
    const double scale = radius > 0.0 ? 1.0 + fraction * (end_radius_mm / radius - 1.0) : 1.0;
    return center_mm + scale * reader::rotated(from, normal, fraction * sweep_rad) + (fraction * height_mm) * normal;
}

double ExpectedArc::fractionOf(const reader::Vector3& point) const {
    const reader::Vector3 from = start_mm - center_mm;
    const reader::Vector3 to = point - center_mm;
    double angle = std::atan2(reader::dot(normal, reader::cross(from, to)), reader::dot(from, to));
    if (angle < 0.0) angle += full_turn;
    // Off both ends: the nearer one.
    if (angle > sweep_rad) return angle - sweep_rad < full_turn - angle ? 1.0 : 0.0;
    return angle / sweep_rad;
}

double ExpectedArc::length() const {
    return std::hypot((reader::norm(start_mm - center_mm) + end_radius_mm) / 2.0 * sweep_rad, height_mm);
}

double ExpectedArc::bend() const {
    const double start_radius_mm = reader::norm(start_mm - center_mm);
    return std::max(start_radius_mm, end_radius_mm) * sweep_rad * sweep_rad +
           2.0 * std::abs(end_radius_mm - start_radius_mm) * sweep_rad;
}

ExpectedPath expectedPath(const toolpath::ToolPath& path) {
    ExpectedPath out;
    Walk walk(out);
    for (const toolpath::ClRecord& record : path.records) {
        walk.line = record.line;
        std::visit(walk, record.statement);
    }
    return out;
}

}  // namespace cusp::post::verify
