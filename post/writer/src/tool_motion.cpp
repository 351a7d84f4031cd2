// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// One way to each pose, spelled as the form wants it.
#include "tool_motion.hpp"

#include "arc_steps.hpp"

#include <cusp/base/units.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace cusp::post {

using geometry::Vector3;
using toolpath::FeedRate;
using toolpath::MotionKind;

namespace {

/// FGREF as delivered: a degree of a rotary axis counts like a millimetre (PM12 p112).
constexpr double mm_per_rad = 180.0 / std::numbers::pi;

kinematics::RefinerOptions refinerOptions(const std::string& cl_file, const PostOptions& chosen) {
    kinematics::RefinerOptions options;
    options.file_name = cl_file;
    options.orientation_tolerance_rad = chosen.orientation_tolerance_rad;
    return options;
}

ProgramForm formOf(const MachineFile& file, const kinematics::Machine& machine, const PostOptions& options) {
    // Without rotary axes there is nothing to transform, and the forms are one.
    return machine.rotaryCount() == 0 ? ProgramForm::TraoriRotary : options.form.value_or(file.control.form);
}

}  // namespace

ToolMotion::ToolMotion(const MachineFile& file, const kinematics::Machine& machine, const PostOptions& options,
                       const std::string& cl_file, NcSink& sink, base::Diagnostics& report)
    : options_(options),
      cl_file_(cl_file),
      sink_(sink),
      report_(report),
      machine_(machine),
      form_(formOf(file, machine, options)),
      refiner_(machine, refinerOptions(cl_file, options)),
      excursions_(machine, {.retract_mm = options.retract_mm, .file_name = cl_file}),
      machine_axes_(machine, file.control.format),
      lineariser_(machine, machine_axes_,
                  {.tolerance_mm = options.chord_tolerance_mm,
                   .orientation_tolerance_rad = options.orientation_tolerance_rad}) {}

void ToolMotion::begin(const ChangeTool* tool, const std::string& work_offset, std::uint32_t line) {
    if (form_ == ProgramForm::Machine) return setUpAxes(tool, work_offset, line);
    sink_.step({TipProgramming{true, form_ == ProgramForm::TraoriVectors, work_offset}, line});
}

void ToolMotion::beginPlane(const TiltedPlane& plane, std::uint32_t line) {
    plane_from_workpiece_ = Eigen::Affine3d(plane.workpieceFromPlane().inverse());
    sink_.step({plane, line});
}

void ToolMotion::end(std::uint32_t line) {
    if (inPlane())
        sink_.step({PlaneOff{}, line});
    else if (form_ != ProgramForm::Machine)
        sink_.step({TipProgramming{.on = false}, line});
    plane_from_workpiece_.reset();
}

void ToolMotion::setUpAxes(const ChangeTool* tool, const std::string& work_offset, std::uint32_t line) {
    const std::string number = tool != nullptr && tool->number ? std::to_string(*tool->number) : std::string();
    const std::string name = tool != nullptr ? tool->name : std::string();
    std::optional<double> length_mm = options_.tool_length_mm;
    for (const std::string& key : {number, name})
        if (const auto known = options_.tool_lengths_mm.find(key); known != options_.tool_lengths_mm.end())
            length_mm = known->second;
    if (!length_mm && machine_axes_.needsToolLength())
        report_.error("post.tool-length",
                      fmt::format("without TRAORI the program holds the length of the tool: give that of \"{}\" with "
                                  "--setup or --tool-length-mm",
                                  name.empty() ? number : name),
                      {cl_file_, line, 0, {}});
    std::optional<std::array<double, 3>> origin = options_.wcs_origin_mm;
    if (const auto known = options_.offset_origins_mm.find(work_offset); known != options_.offset_origins_mm.end())
        origin = known->second;
    if (!origin && machine_axes_.needsOrigin())
        report_.error(
            "post.wcs-origin",
            fmt::format("without TRAORI, a program for a machine with a rotary table needs to know where {} lies in "
                        "the machine: --setup or --wcs-origin-mm",
                        work_offset),
            {cl_file_, line, 0, {}});
    const Vector3 origin_mm = geometry::toVector(origin.value_or(std::array<double, 3>{}));
    machine_axes_.setUp(length_mm.value_or(0.0), origin_mm);
    sink_.step({AxisProgramming{length_mm.value_or(0.0), origin_mm}, line});
}

void ToolMotion::reportSingular(std::uint32_t line) {
    if (std::exchange(singular_reported_, true)) return;
    report_.error("post.linear-axes", "with the rotary axes here, two linear axes move the tool the same way",
                  {cl_file_, line, 0, {}});
}

std::optional<Eigen::Affine3d> ToolMotion::programmedFrame(const ToolPose& at) {
    if (plane_from_workpiece_) return plane_from_workpiece_;
    if (form_ != ProgramForm::Machine) return Eigen::Affine3d::Identity();
    auto frame = machine_axes_.programmedFromWorkpiece(machine_axes_.printed(at.rotary_rad));
    if (!frame) reportSingular(at.line);
    return frame;
}

void ToolMotion::approach(const ToolPose& to, MotionKind kind, const FeedRate& feed) {
    standAt(to);
    if (const auto frame = programmedFrame(to))
        sink_.step({Approach{*frame * to.tip_mm, to.rotary_rad, kind, feed, to.axis}, to.line});
}

void ToolMotion::standAt(const ToolPose& pose) {
    at_ = pose;
    refiner_.interrupt();
    static_cast<void>(refiner_.advance({.tip_mm = pose.tip_mm, .rotary_rad = pose.rotary_rad, .line = pose.line}));
    told_ = {{pose.tip_mm, pose.rotary_rad}, pose.tip_mm, pose.axis};
    if (!inMachineAxes()) return;
    if (!lineariser_.startAt({pose.tip_mm, pose.rotary_rad})) reportSingular(pose.line);
    told_ = lineariser_.last();
}

void ToolMotion::moveTo(const ToolPose& to, MotionKind kind, const FeedRate& feed, bool mendable) {
    kind_ = kind;
    feed_ = feed;
    line_ = to.line;
    at_ = to;
    // A straight way of the tip, the tool axis at rest or on its great circle: nothing to divide.
    if (inPlane()) return emitMove({{*plane_from_workpiece_ * to.tip_mm, to.rotary_rad}, to.tip_mm, to.axis});
    if (form_ == ProgramForm::TraoriVectors) return emitMove({{to.tip_mm, to.rotary_rad}, to.tip_mm, to.axis});
    const kinematics::PathPoint point{.tip_mm = to.tip_mm,
                                      .rotary_rad = to.rotary_rad,
                                      .line = to.line,
                                      .cutting = kind == MotionKind::Feed,
                                      .rewind = !mendable};
    for (const kinematics::PathPoint& next : refiner_.advance(point)) {
        if (form_ == ProgramForm::Machine)
            machineMove(next, kind == MotionKind::Feed && mendable);
        else
            emitMove({{next.tip_mm, next.rotary_rad}, next.tip_mm, to.axis});
    }
}

void ToolMotion::unwindTo(const ToolPose& to, const FeedRate& feed) {
    const auto excursion = excursions_.plan({.tip_mm = at_.tip_mm, .rotary_rad = at_.rotary_rad, .line = to.line},
                                            {.tip_mm = to.tip_mm, .rotary_rad = to.rotary_rad, .line = to.line});
    if (!excursion) return moveTo(to, MotionKind::Feed, feed, false);
    const auto pose = [&](const Vector3& tip_mm, const RotaryValues& rotary_rad) {
        return ToolPose{tip_mm, machine_.toolAxis(rotary_rad), rotary_rad, to.line};
    };
    const auto mmPerS = [](double value) { return FeedRate{.value = value, .unit = FeedRate::Unit::MmPerS}; };
    const FeedRate back = options_.engage_feed_mm_per_s ? mmPerS(*options_.engage_feed_mm_per_s) : feed;
    if (excursion->fraction > 0.0) moveTo(pose(excursion->tip_mm, excursion->leave_rad), MotionKind::Feed, feed, true);
    sink_.step({Comment{"off the part: the rotary axes unwind"}, to.line});
    moveTo(pose(excursion->retracted_mm, excursion->leave_rad), MotionKind::Feed,
           mmPerS(options_.retract_feed_mm_per_s), true);
    moveTo(pose(excursion->retracted_mm, excursion->return_rad), MotionKind::Rapid, {}, true);
    moveTo(pose(excursion->tip_mm, excursion->return_rad), MotionKind::Feed, back, true);
    sink_.step({Comment{"back on the path"}, to.line});
    if (excursion->fraction < 1.0) moveTo(to, MotionKind::Feed, feed, true);
}

void ToolMotion::machineMove(const kinematics::PathPoint& to, bool refined) {
    const auto& stops = lineariser_.advance({to.tip_mm, to.rotary_rad}, refined);
    if (stops.empty()) return reportSingular(line_);
    if (lineariser_.errorBound() > options_.chord_tolerance_mm)
        report_.error(
            "post.linearise",
            fmt::format("on the way to CL line {} the tip strays by up to {:.3g} mm, tolerance {:g} mm, however "
                        "many blocks are put in",
                        line_, lineariser_.errorBound(), options_.chord_tolerance_mm),
            {cl_file_, line_, 0, {}});
    largest_chord_error_mm_ = std::max(largest_chord_error_mm_, lineariser_.errorBound());
    for (const MachineStop& stop : stops) emitMove(stop);
}

/// Blocks a minute: without TRAORI the control would hold the feed along the way of the axes, not along the tip's.
double ToolMotion::inverseTime(const MachineStop& stop) const {
    using FeedMode = PostOptions::FeedMode;
    if (options_.feed_mode == FeedMode::PerMinute || kind_ != MotionKind::Feed || feed_.unit != FeedRate::Unit::MmPerS)
        return 0.0;
    const RotaryValues& from = told_.at.rotary_rad;
    const RotaryValues& to = stop.at.rotary_rad;
    if (options_.feed_mode == FeedMode::Auto && (!inMachineAxes() || from == to)) return 0.0;
    const double turn_rad = std::max(std::abs(to[0] - from[0]), std::abs(to[1] - from[1]));
    const double way_mm = (stop.tip_mm - told_.tip_mm).norm();
    // A tip that hardly moves says nothing about the time.
    constexpr double hardly_mm = 0.1;
    const double counted_mm = way_mm < hardly_mm ? std::max(way_mm, turn_rad * mm_per_rad) : way_mm;
    return counted_mm > 0.0 ? base::mmPerMinFromMmPerS(feed_.value) / counted_mm : 0.0;
}

void ToolMotion::emitMove(const MachineStop& stop) {
    sink_.step({Move{stop.at.point_mm, stop.at.rotary_rad, kind_, feed_, stop.axis, inverseTime(stop)}, line_});
    told_ = stop;
}

double ToolMotion::arcTo(const toolpath::ArcMotion& arc, const ToolPose& to, const FeedRate& feed) {
    const Vector3 start_mm = at_.tip_mm;
    const double length_mm = arcLength(arc, start_mm);
    const bool timed = options_.feed_mode == PostOptions::FeedMode::InverseTime && feed.unit == FeedRate::Unit::MmPerS;
    kind_ = MotionKind::Feed;
    feed_ = feed;
    line_ = to.line;
    if (const auto frame = programmedFrame(to))
        for (NcItem& item : arcSteps(arc, start_mm, *frame, to.rotary_rad, feed, options_.chord_tolerance_mm)) {
            if (auto* move = std::get_if<Move>(&item)) {
                emitMove({{move->point_mm, move->rotary_rad}, frame->inverse() * move->point_mm, move->axis});
                continue;
            }
            auto& circle = std::get<ArcMove>(item);
            if (timed) circle.moves_per_min = base::mmPerMinFromMmPerS(feed.value) / length_mm;
            sink_.step({std::move(item), line_});
        }
    standAt(to);
    return length_mm;
}

}  // namespace cusp::post
