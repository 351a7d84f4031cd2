// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Turns CL records into NC steps. The start and end order follows facts known from Siemens' own Sinumerik post.
#include <cusp/post/writer/program_planner.hpp>

#include "hole_plan.hpp"
#include "spindle_speed.hpp"
#include "tool_motion.hpp"

#include <cusp/base/units.hpp>
#include <cusp/kinematics/axis_planner.hpp>
#include <cusp/kinematics/machine.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <utility>

namespace cusp::post {

using geometry::Vector3;
using toolpath::ClRecord;
using toolpath::CoolantCommand;
using toolpath::MotionKind;
using toolpath::SpindleCommand;

namespace {

/// Vectors leave the rotary positions to the control: nothing can be unwound with them.
bool unwinds(const PostOptions& options, ProgramForm form) {
    return options.at_limit == PostOptions::AtLimit::Retract && form != ProgramForm::TraoriVectors;
}

/// The start is left free: the rotary axes are positioned at home height, where travel costs nothing at the part.
kinematics::PlannerOptions axisOptions(const std::string& cl_file, const PostOptions& chosen, ProgramForm form) {
    kinematics::PlannerOptions options;
    options.file_name = cl_file;
    options.orientation_tolerance_rad = chosen.orientation_tolerance_rad;
    options.pole_cone_rad = chosen.pole_cone_rad;
    options.rewinds_are_handled = unwinds(chosen, form);
    return options;
}

/// Where a statement sends the tool; none for a statement that does not move it.
const toolpath::CutterLocation* locationOf(const toolpath::ClStatement& statement) {
    if (const auto* motion = std::get_if<toolpath::LinearMotion>(&statement)) return &motion->location;
    if (const auto* arc = std::get_if<toolpath::ArcMotion>(&statement)) return &arc->end;
    if (const auto* hole = std::get_if<toolpath::HoleLocation>(&statement)) return &hole->location;
    return nullptr;
}

bool isCut(const toolpath::ClStatement& statement) {
    const auto* motion = std::get_if<toolpath::LinearMotion>(&statement);
    return motion != nullptr ? motion->kind == MotionKind::Feed
                             : std::holds_alternative<toolpath::ArcMotion>(statement);
}

}  // namespace

struct ProgramPlanner::State {
    State(const MachineFile& machine_file, const kinematics::Machine& machine_model, PostOptions post_options,
          std::string file, NcSink& steps, base::Diagnostics& diagnostics)
        : machine(machine_file),
          options(std::move(post_options)),
          cl_file(std::move(file)),
          sink(steps),
          report(diagnostics),
          model(machine_model),
          axes(model, axisOptions(cl_file, options, options.form.value_or(machine.control.form))),
          way(machine_file, model, options, cl_file, sink, report),
          rotary_count(model.rotaryCount()),
          work_offset(options.work_offset.empty() ? machine.control.work_offset : options.work_offset) {
        if (options.spindle_rpm) {
            spindle.turn = SpindleCommand::Turn::Clockwise;
            spindle.speed_rpm = *options.spindle_rpm;
        }
        emit(ModalStart{});
        emit(GoHome{});
    }

    const MachineFile& machine;
    PostOptions options;
    std::string cl_file;
    NcSink& sink;
    base::Diagnostics& report;
    const kinematics::Machine& model;
    kinematics::AxisPlanner axes;
    ToolMotion way;
    std::size_t rotary_count;
    std::string work_offset;

    /// Records waiting for the rotary axes of the first motion among them.
    std::deque<ClRecord> waiting;
    std::uint32_t line = 0;

    // What the CL file has said so far, and what the program has been told.
    std::optional<toolpath::FeedRate> feed;
    Spindle spindle;
    Spindle spindle_told;
    CoolantCommand::Kind coolant = CoolantCommand::Kind::Off;
    CoolantCommand::Kind coolant_told = CoolantCommand::Kind::Off;
    std::optional<geometry::Cutter> cutter;
    std::optional<toolpath::ProgrammingFrame> frame;
    std::optional<ChangeTool> tool;
    bool cutting = false;  ///< tip programming is on and the tool is at the part
    bool at_home = true;   ///< of the records taken: the next location is reached from home, not cut to
    bool warned_no_tool = false;
    bool warned_spindle_off = false;

    std::optional<toolpath::CycleStart> cycle;
    std::optional<HoleCycle> cycle_told;

    kinematics::PlannedAxes planned;
    PostSummary summary;
    std::optional<RotaryValues> last_rotary;

    template <class Item>
    void emit(Item item) {
        sink.step({std::move(item), line});
    }
    [[nodiscard]] base::Location here() const { return {cl_file, line, 0, {}}; }

    void drain() {
        while (!waiting.empty()) {
            const ClRecord& record = waiting.front();
            if (locationOf(record.statement) != nullptr && !axes.pop(planned)) return;
            line = record.line;
            std::visit([this](const auto& statement) { take(statement); }, record.statement);
            waiting.pop_front();
        }
    }

    // --- statements ---
    void take(const toolpath::FeedRate& rate) { feed = rate; }
    void take(const toolpath::ProgramEnd&) {}
    void take(const toolpath::ProgramStop& stop) { emit(Stop{stop.optional}); }
    void take(const toolpath::Dwell& dwell) { emit(Pause{dwell.seconds}); }
    void take(const toolpath::Remark& remark) { emit(Comment{remark.text}); }

    void take(const toolpath::StartPosition&) {}
    void take(const toolpath::WorkPlane&) {}
    void take(const toolpath::HomeReturn&) {
        if (cutting) leavePart();
    }
    void take(const toolpath::CycleStart& start) {
        endHoleCycle();
        cycle = start;
    }
    void take(const toolpath::CycleEnd&) {
        endHoleCycle();
        cycle.reset();
    }
    void take(const toolpath::CutterCompensation& command) {
        if (command.side != toolpath::CutterCompensation::Side::Off) refuse("cutter radius compensation is");
    }
    void take(const toolpath::PathTolerance&) {}
    void take(const toolpath::SplineMotion&) {
        report.error("post.nurbs", "a NURBS curve cannot be posted: export the operation with linear or circular moves",
                     here());
    }
    void refuse(std::string_view what) {
        report.error("post.unsupported", fmt::format("{} not yet posted", what), here());
    }

    void take(const toolpath::OperationStart& operation) {
        ++summary.operations;
        emit(Comment{"operation " + operation.name});
        emit(ScreenMessage{operation.name});
    }

    void take(const toolpath::ToolCall& call) {
        if (call.cutter) cutter = call.cutter;
        if (tool && tool->number == call.number && tool->name == call.name) return;
        if (cutting) leavePart();
        tool = ChangeTool{call.number, call.name};
        emit(*tool);
        ++summary.tool_changes;
    }

    void take(const SpindleCommand& command) {
        const auto speed = spindleSpeed(command, cutter, spindle.speed_rpm);
        if (!speed) return report.error("post.surface-speed", speed.error(), here());
        spindle = {command.turn, *speed};
        if (spindle.turn != SpindleCommand::Turn::Off && *speed > machine.machine.spindle.max_speed_rpm) {
            ++summary.limit_violations;
            report.error("post.spindle-limit",
                         fmt::format("S{:.0f} is above the spindle's limit of {:.0f} rev/min", *speed,
                                     machine.machine.spindle.max_speed_rpm),
                         here());
        }
        if (cutting) tellSpindle();
    }

    void take(const CoolantCommand& command) {
        coolant = command.kind;
        if (cutting) tellCoolant();
    }

    void take(const toolpath::ProgrammingFrame& next) {
        if (!frame) {
            const auto& origin = next.part_from_programming.translation();
            emit(
                Comment{fmt::format("work offset: the programming frame, origin X{:.4f} Y{:.4f} Z{:.4f} mm in the part",
                                    origin.x(), origin.y(), origin.z())});
        } else if (!frame->part_from_programming.isApprox(next.part_from_programming, 1e-9)) {
            report.error(
                "post.second-frame",
                "the programming frame (MSYS) changes inside the file; one program can hold one work offset so "
                "far. Export the operations of each frame as a CL file of their own.",
                here());
        }
        frame = next;
    }

    // --- motions: `planned` holds the rotary values of the one at hand ---
    void take(const toolpath::LinearMotion& motion) {
        beginMotion(motion.kind == MotionKind::Feed);
        const toolpath::FeedRate rate = feed.value_or(toolpath::FeedRate{});
        const ToolPose to = poseAt(motion.location);
        if (!cutting) return reachPart(to, motion.kind, rate);
        if (planned.rewind && unwinds(options, way.form())) return way.unwindTo(to, rate);
        way.moveTo(to, motion.kind, rate, !planned.rewind && !planned.in_pole_cone);
    }

    void take(const toolpath::ArcMotion& arc) {
        beginMotion(true);
        if (!cutting)
            return report.error("post.arc-start", "the path begins with an arc: where it starts is not known", here());
        way.arcTo(arc, poseAt(arc.end), feed.value_or(toolpath::FeedRate{}));
    }

    void take(const toolpath::HoleLocation& hole) {
        beginMotion(false);
        const auto drilling = planHole(*cycle, hole.location, spindle, feed);
        if (!drilling) return report.error("post.cycle", drilling.error(), here());
        ToolPose above = poseAt(hole.location);
        above.tip_mm.z() = drilling->retract_z_mm;
        if (!cutting) reachPart(above, MotionKind::Rapid, {});
        if (cycle_told != *drilling) emit(*drilling);
        cycle_told = *drilling;
        emit(HolePosition{above.tip_mm.x(), above.tip_mm.y(), planned.rotary_rad});
        way.standAt(above);
    }

    [[nodiscard]] ToolPose poseAt(const toolpath::CutterLocation& location) const {
        return {location.tip_mm, location.axis, planned.rotary_rad, line};
    }
    void beginMotion(bool cut) {
        ++summary.cutter_locations;
        checkMotion(cut);
        if (planned.in_pole_cone && last_rotary) tellPoleCone(*last_rotary);
        countRotary(planned.rotary_rad);
    }
    void endHoleCycle() {
        if (cycle_told) emit(HoleCycleOff{});
        cycle_told.reset();
    }

    // --- sequences ---
    void reachPart(const ToolPose& pose, MotionKind kind, const toolpath::FeedRate& rate) {
        emit(Smoothing{true});
        emit(SelectWorkOffset{work_offset});
        tellSpindle();
        tellCoolant();
        if (rotary_count > 0) emit(PositionRotary{planned.rotary_rad});
        way.begin(tool ? &*tool : nullptr, work_offset, line);
        way.approach(pose, kind, rate);
        cutting = true;
    }

    void leavePart() {
        endHoleCycle();
        way.end(line);
        if (spindle_told.turn != SpindleCommand::Turn::Off) emit(Spindle{});
        if (coolant_told != CoolantCommand::Kind::Off) emit(Coolant{});
        spindle_told = {};
        coolant_told = CoolantCommand::Kind::Off;
        emit(GoHome{});
        cutting = false;
    }

    void tellSpindle() {
        if (spindle.turn == spindle_told.turn && spindle.speed_rpm == spindle_told.speed_rpm) return;
        if (spindle.turn != SpindleCommand::Turn::Off || spindle_told.turn != SpindleCommand::Turn::Off) emit(spindle);
        spindle_told = spindle;
    }
    void tellCoolant() {
        if (coolant == coolant_told) return;
        emit(Coolant{coolant});
        coolant_told = coolant;
    }

    // --- checks ---
    void checkMotion(bool cut) {
        if (!tool && !std::exchange(warned_no_tool, true))
            report.warning("post.no-tool", "the tool moves before any tool is called; the program changes no tool",
                           here());
        if (!cut) return;
        if (!feed) {
            report.error("post.no-feed", "a cutting move without a feed rate: there is no FEDRAT before it", here());
            feed = toolpath::FeedRate{};
        }
        if (spindle.turn != SpindleCommand::Turn::Off || std::exchange(warned_spindle_off, true)) return;
        report.add({options.strict ? base::Severity::Error : base::Severity::Warning, "post.spindle-off",
                    "cuts with the spindle off: there is no SPINDL before it. Give the speed with --spindle-rpm.",
                    here()});
    }

    /// The limits allow no other way: told with the numbers, so that the programmer can look at the place.
    void tellPoleCone(const RotaryValues& from) {
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

    void countDeviation(double deviation_rad, std::uint32_t cl_line) {
        if (deviation_rad <= summary.largest_axis_deviation_rad) return;
        summary.largest_axis_deviation_rad = deviation_rad;
        summary.largest_axis_deviation_cl_line = cl_line;
    }

    void countRotary(const RotaryValues& rotary_rad) {
        for (std::size_t i = 0; i < rotary_count; ++i) {
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
};

ProgramPlanner::ProgramPlanner(const MachineFile& file, const kinematics::Machine& machine, PostOptions options,
                               std::string cl_file, NcSink& sink, base::Diagnostics& report)
    : state_(std::make_unique<State>(file, machine, std::move(options), std::move(cl_file), sink, report)) {}

ProgramPlanner::~ProgramPlanner() = default;

void ProgramPlanner::take(const ClRecord& record) {
    if (std::holds_alternative<toolpath::ToolCall>(record.statement) ||
        std::holds_alternative<toolpath::HomeReturn>(record.statement))
        state_->at_home = true;
    if (const auto* location = locationOf(record.statement)) {
        const bool from_home = std::exchange(state_->at_home, false);
        state_->axes.push({location->axis, record.line, isCut(record.statement) && !from_home});
    }
    state_->waiting.push_back(record);
    state_->drain();
}

PostSummary ProgramPlanner::finish() {
    State& state = *state_;
    state.axes.finish();
    state.drain();
    state.line = 0;
    if (state.cutting) state.leavePart();
    state.emit(Smoothing{false});
    state.emit(End{});
    state.report.append(state.axes.report());
    state.report.append(state.way.refiner().report());
    state.report.append(state.way.excursions().report());
    state.summary.excursions = state.way.excursions().planned();
    const kinematics::RefinerSummary& refined = state.way.refiner().summary();
    state.summary.inserted_blocks = refined.inserted + state.way.linearised();
    state.summary.largest_chord_error_mm = state.way.largestChordError();
    state.countDeviation(refined.max_deviation_rad, refined.max_deviation_line);
    state.summary.limit_violations += state.axes.summary().limit_violations + state.axes.summary().unreached +
                                      state.axes.summary().rewinds - state.summary.excursions +
                                      state.way.refiner().report().errorCount();
    return state.summary;
}

}  // namespace cusp::post
