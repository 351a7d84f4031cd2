// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Motions, and the sequences around them.
#include "hole_plan.hpp"
#include "planner_state.hpp"
#include "tilted_plane.hpp"

#include <cusp/base/units.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cusp::post {

using geometry::Vector3;
using toolpath::CutterCompensation;
using toolpath::MotionKind;
using toolpath::SpindleCommand;

namespace {

// A tool axis this close to a plane's Z is along it.
constexpr double same_axis_rad = 1e-6;

}  // namespace

// --- motions ---

ToolPose ProgramPlanner::State::poseAt(const toolpath::CutterLocation& location) const {
    return {location.tip_mm, location.axis, planned.rotary_rad, line};
}

void ProgramPlanner::State::take(const toolpath::LinearMotion& motion) {
    beginMotion(motion.location, motion.kind == MotionKind::Feed, false);
    const toolpath::FeedRate rate = feed.value_or(toolpath::FeedRate{});
    log.motion(to.tip_mm, motion.kind, cutting ? (to.tip_mm - last_tip).norm() : 0.0, rate, process.spindle.speed_rpm);
    last_tip = to.tip_mm;
    if (!cutting) return reachPart(to, motion.kind, rate);
    beginCompensation(true);
    if (planned.rewind && unwinds) return way.unwindTo(to, rate);
    way.moveTo(to, motion.kind, rate, !planned.rewind && !planned.in_pole_cone);
}

void ProgramPlanner::State::take(const toolpath::ArcMotion& arc) {
    beginMotion(arc.end, true, false);
    if (!cutting)
        return report.error("post.arc-start", "the path begins with an arc: where it starts is not known", here());
    beginCompensation(false);
    const toolpath::FeedRate rate = feed.value_or(toolpath::FeedRate{});
    log.motion(to.tip_mm, MotionKind::Feed, way.arcTo(arc, to, rate), rate, process.spindle.speed_rpm);
    last_tip = to.tip_mm;
}

void ProgramPlanner::State::take(const toolpath::HoleLocation& hole) {
    beginMotion(hole.location, false, true);
    const double retract_mm = cycle->retract_mm.value_or(0.0);
    const double height_mm = std::max(retract_mm, cycle->clearance_mm.value_or(0.0));
    ToolPose above = to;
    above.tip_mm += height_mm * to.axis;
    if (cutting) goAbove(above);
    logRapid(above.tip_mm);
    log.hole(to.tip_mm - cycle->depth_mm * to.axis, process.spindle.speed_rpm);
    if (!cutting) reachPart(above, MotionKind::Rapid, {});
    const auto frame = way.programmedFrame(to);
    if (!frame) return;
    const auto drilling = planHole(*cycle, {*frame * to.tip_mm, (frame->linear() * to.axis).normalized()},
                                   process.spindle, feed, options.tap_pitch_mm);
    if (!drilling) return report.error("post.cycle", drilling.error(), here());
    if (cycle_told != *drilling) emit(*drilling);
    cycle_told = *drilling;
    const Vector3 place = *frame * above.tip_mm;
    emit(HolePosition{place.x(), place.y(), planned.rotary_rad});
    way.standAt(above);
}

/// A cycle called modally goes to the place of the hole at the height where the tool is, and only there up to its planes.
/// So the tool first goes up along its axis to the retract plane, by way of home where its axis lies too flat for that; and
/// where the axis turns, it turns above the hole and not in the cycle, which would not keep the tip on its way.
void ProgramPlanner::State::goAbove(const ToolPose& above) {
    constexpr double noticeable_mm = 0.001;
    constexpr double least_slope = 0.5;
    const double rise_mm = (above.tip_mm - last_tip).dot(above.axis);
    const double across_mm = (above.tip_mm - last_tip - rise_mm * above.axis).norm();
    if (rise_mm > noticeable_mm && across_mm > noticeable_mm) {
        ToolPose up = way.at();
        const double slope = up.axis.dot(above.axis);
        if (slope < least_slope || compensation_told != CutterCompensation::Side::Off) return leavePart();
        endHoleCycle();
        up.tip_mm += rise_mm / slope * up.axis;
        up.line = line;
        way.moveTo(up, MotionKind::Rapid, {}, true);
        logRapid(up.tip_mm);
    }
    if (way.at().rotary_rad == above.rotary_rad) return;
    endHoleCycle();
    way.moveTo(above, MotionKind::Rapid, {}, !planned.rewind && !planned.in_pole_cone);
}

void ProgramPlanner::State::logRapid(const Vector3& tip_mm) {
    log.motion(tip_mm, MotionKind::Rapid, cutting ? (tip_mm - last_tip).norm() : 0.0, {}, process.spindle.speed_rpm);
    last_tip = tip_mm;
}

void ProgramPlanner::State::beginMotion(const toolpath::CutterLocation& location, bool cut, bool hole) {
    to = poseAt(location);
    ++summary.cutter_locations;
    checkMotion(cut);
    if (planned.in_pole_cone && last_rotary) tellPoleCone(*last_rotary);
    countRotary(planned.rotary_rad);
    choosePlane(to, hole);
    log.setPlace(work_offset, plane.has_value());
    if (operation_begins && cutting) beginOperationAtPart();
    operation_begins = false;
}

/// The plane a motion needs: that of the CL file where the tool stands along its Z; one across the tool axis for a hole that
/// is not along Z, and for what follows it until the axis or the operation changes; else none.
std::optional<geometry::RigidTransform> ProgramPlanner::State::planeFor(const ToolPose& pose, bool hole) {
    if (model.rotaryCount() == 0 || !machine.control.swivel.available) return std::nullopt;
    const auto stands = [&](const std::optional<geometry::RigidTransform>& candidate) {
        return candidate && geometry::angleBetween(candidate->linear().col(2), pose.axis) <= same_axis_rad;
    };
    if (stands(work_plane)) return work_plane;
    if (stands(plane) && way.inPlane()) return plane;
    if (!hole && (cutting || !hole_ahead)) return std::nullopt;
    if (way.inPlane()) return alongZ(pose.axis) ? std::nullopt : std::optional(planeAcross(pose.axis));
    const auto frame = way.programmedFrame(pose);
    if (!frame || alongZ((frame->linear() * pose.axis).normalized())) return std::nullopt;
    return planeAcross(pose.axis);
}

void ProgramPlanner::State::choosePlane(const ToolPose& pose, bool hole) {
    const auto wanted = planeFor(pose, hole);
    const bool same =
        wanted.has_value() == way.inPlane() && (!wanted || (plane && wanted->matrix() == plane->matrix()));
    plane = wanted;
    if (!same && cutting) leavePart();
}

/// G41 and G42 take effect in a straight block, in the plane across the tool.
void ProgramPlanner::State::beginCompensation(bool straight) {
    if (compensation.side == compensation_told) return;
    compensation_told = compensation.side;
    const auto frame = way.programmedFrame(to);
    const bool across = frame && alongZ((frame->linear() * to.axis).normalized());
    if (compensation.side != CutterCompensation::Side::Off && !across)
        return report.error(
            "post.radius-compensation",
            "cutter compensation (CUTCOM) while the tool is tilted against the plane of the program: an 840D "
            "offsets within G17 only",
            here());
    if (!straight)
        return report.error(
            "post.radius-compensation",
            "cutter compensation (CUTCOM) begins or ends on an arc: an 840D takes a straight move for it", here());
    emit(RadiusCompensation{compensation.side, compensation.offset_number});
}

void ProgramPlanner::State::endHoleCycle() {
    if (cycle_told) emit(HoleCycleOff{});
    cycle_told.reset();
}

// --- sequences ---

void ProgramPlanner::State::run(const std::vector<std::string>& blocks) {
    for (const std::string& block : blocks)
        if (block.front() != '{' || !runPlaceholder(std::string_view(block).substr(1, block.size() - 2)))
            emit(Literal{block});
}

bool ProgramPlanner::State::runPlaceholder(std::string_view name) {
    if (name == "modal") return emit(ModalStart{}), true;
    if (name == "home") return emit(GoHome{}), true;
    if (name == "tool") return emit(*tool), true;
    if (name == "smoothing") return emit(Smoothing{true}), true;
    if (name == "smoothing_off") return emit(Smoothing{false}), true;
    if (name == "work_offset") return emit(SelectWorkOffset{work_offset}), true;
    if (name == "spindle") return process.tellSpindle(line), true;
    if (name == "coolant") return process.tellCoolant(line), true;
    if (name == "spindle_off") return process.spindleOff(line), true;
    if (name == "coolant_off") return process.coolantOff(line), true;
    if (name == "transformation") return beginProgramming(), true;
    if (name == "rotary") {
        if (model.rotaryCount() > 0 && !plane) emit(PositionRotary{planned.rotary_rad});
        return true;
    }
    if (name == "transformation_off") {
        if (started)
            way.end(line);
        else
            emit(TipProgramming{.on = false});
        return true;
    }
    return false;
}

void ProgramPlanner::State::beginProgramming() {
    if (plane)
        return way.beginPlane(
            tiltedPlane(*plane, planned.rotary_rad, static_cast<int>(machine.control.format.rotary_decimals)), line);
    way.begin(tool ? &*tool : nullptr, work_offset, line);
}

void ProgramPlanner::State::changeTool() {
    run(machine.control.sequence.tool_change);
    tool_called_again = false;
}

void ProgramPlanner::State::reachPart(const ToolPose& pose, MotionKind kind, const toolpath::FeedRate& rate) {
    if (tool_called_again) changeTool();
    run(machine.control.sequence.approach);
    way.approach(pose, kind, rate);
    cutting = true;
}

void ProgramPlanner::State::leavePart() {
    endHoleCycle();
    if (compensation_told != CutterCompensation::Side::Off) emit(Literal{"G40"});
    compensation_told = CutterCompensation::Side::Off;
    run(machine.control.sequence.retract);
    process.forget();
    cutting = false;
}

void ProgramPlanner::State::beginOperationAtPart() {
    process.forget();
    run(machine.control.sequence.operation);
}

// --- checks ---

void ProgramPlanner::State::checkMotion(bool cut) {
    if (!tool && !std::exchange(warned_no_tool, true))
        report.warning("post.no-tool", "the tool moves before any tool is called; the program changes no tool", here());
    if (!cut) return;
    if (!feed) {
        report.error("post.no-feed", "a cutting move without a feed rate: there is no FEDRAT before it", here());
        feed = toolpath::FeedRate{};
    }
    if (process.spindle.turn != SpindleCommand::Turn::Off || std::exchange(warned_spindle_off, true)) return;
    report.add({options.strict ? base::Severity::Error : base::Severity::Warning, "post.spindle-off",
                "cuts with the spindle off: there is no SPINDL before it. Give the speed with --spindle-rpm.", here()});
}

/// The limits allow no other way: told with the numbers, so that the programmer can look at the place.
void ProgramPlanner::State::tellPoleCone(const RotaryValues& from) {
    const double swing = kinematics::linearTurnDeviation(model, from, planned.rotary_rad);
    countDeviation(swing, line);
    report.warning(
        "post.pole-cone",
        fmt::format("the rotary limits force a change of branch in a cut: {} turns {:.1f}° and the tool axis "
                    "swings {:.2f}° off its way, the tip stays on the path; without --pole-cone-deg it does not",
                    model.rotaryNames()[0], base::degFromRad(std::abs(planned.rotary_rad[0] - from[0])),
                    base::degFromRad(swing)),
        here());
}

void ProgramPlanner::State::countDeviation(double deviation_rad, std::uint32_t cl_line) {
    if (deviation_rad <= summary.largest_axis_deviation_rad) return;
    summary.largest_axis_deviation_rad = deviation_rad;
    summary.largest_axis_deviation_cl_line = cl_line;
}

void ProgramPlanner::State::countRotary(const RotaryValues& rotary_rad) {
    for (std::size_t i = 0; i < model.rotaryCount(); ++i) {
        auto& range = summary.rotary_range_rad[i];
        range = last_rotary ? std::pair{std::min(range.first, rotary_rad[i]), std::max(range.second, rotary_rad[i])}
                            : std::pair{rotary_rad[i], rotary_rad[i]};
        if (!last_rotary) continue;
        const double step = std::abs(rotary_rad[i] - (*last_rotary)[i]);
        summary.rotary_travel_rad += step;
        if (step <= summary.largest_rotary_step_rad) continue;
        summary.largest_rotary_step_rad = step;
        summary.largest_rotary_step_axis = i;
        summary.largest_rotary_step_cl_line = line;
    }
    last_rotary = rotary_rad;
}

}  // namespace cusp::post
