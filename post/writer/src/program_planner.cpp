// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Statements of the CL file that move nothing, and the stream as a whole.
#include "batch_queue.hpp"
#include "planner_state.hpp"
#include "spindle_speed.hpp"

#include <cusp/base/units.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <thread>
#include <vector>

namespace cusp::post {

using toolpath::ClRecord;
using toolpath::MotionKind;
using toolpath::SpindleCommand;

namespace {

// Z axes this close are one.
constexpr double same_axis_rad = 1e-6;

/// Vectors leave the rotary positions to the control: nothing can be unwound with them.
bool unwindsAtLimits(const PostOptions& options, ProgramForm form) {
    return options.at_limit == PostOptions::AtLimit::Retract && form != ProgramForm::TraoriVectors;
}

/// The start is left free: the rotary axes are positioned at home height, where travel costs nothing at the part.
kinematics::PlannerOptions axisOptions(const std::string& cl_file, const PostOptions& chosen, ProgramForm form) {
    kinematics::PlannerOptions options;
    options.file_name = cl_file;
    options.orientation_tolerance_rad = chosen.orientation_tolerance_rad;
    options.pole_cone_rad = chosen.pole_cone_rad;
    options.rewinds_are_handled = unwindsAtLimits(chosen, form);
    return options;
}

std::vector<std::string> offsetNames(const MachineFile& machine, const PostOptions& options) {
    if (!options.work_offsets.empty()) return options.work_offsets;
    return {options.work_offset.empty() ? machine.control.work_offset : options.work_offset};
}

}  // namespace

ProgramPlanner::State::State(const MachineFile& machine_file, const kinematics::Machine& machine_model,
                             PostOptions post_options, std::string file, NcSink& steps, base::Diagnostics& diagnostics)
    : machine(machine_file),
      options(std::move(post_options)),
      cl_file(std::move(file)),
      sink(steps),
      report(diagnostics),
      model(machine_model),
      axes(model, axisOptions(cl_file, options, options.form.value_or(machine.control.form))),
      way(machine_file, model, options, cl_file, sink, report),
      offsets(offsetNames(machine, options)),
      process(sink),
      unwinds(unwindsAtLimits(options, way.form())),
      work_offset(offsets.first()) {
    if (options.spindle_rpm) {
        process.spindle.turn = SpindleCommand::Turn::Clockwise;
        process.spindle.speed_rpm = *options.spindle_rpm;
    }
    run(machine.control.sequence.program_start);
    started = true;
}

void ProgramPlanner::State::run(const PlannedRecord& record) {
    line = record.line;
    planned = record.axes;
    hole_ahead = record.hole_ahead;
    if (record.other)
        std::visit([this](const auto& statement) { take(statement); }, record.other->statement);
    else
        take(record.motion);
}

void ProgramPlanner::State::take(const toolpath::HomeReturn&) {
    if (cutting) leavePart();
}

void ProgramPlanner::State::take(const toolpath::WorkPlane& next) {
    const auto& turn = next.programming_from_plane.linear();
    work_plane.reset();
    if (geometry::angleBetween(turn.col(2), geometry::Vector3::UnitZ()) > same_axis_rad)
        work_plane = next.programming_from_plane;
}

void ProgramPlanner::State::take(const toolpath::CycleStart& start) {
    endHoleCycle();
    cycle = start;
}

void ProgramPlanner::State::take(const toolpath::CycleEnd&) {
    endHoleCycle();
    cycle.reset();
}

void ProgramPlanner::State::take(const toolpath::CutterCompensation& command) { compensation = command; }

/// CYCLE832 lets the control leave the programmed path by its tolerance; a finer one than the path was made with makes it
/// follow the chords of the CAM system.
void ProgramPlanner::State::take(const toolpath::PathTolerance& tolerance) {
    const double smoothing_mm = machine.control.cycle832_tolerance_mm;
    if (machine.control.cycle832 == ControlDefinition::Cycle832::None || tolerance.value_mm <= smoothing_mm ||
        std::exchange(warned_tolerance, true))
        return;
    report.warning(
        "post.smoothing-tolerance",
        fmt::format("CYCLE832 has {:g} mm, the path was made with {} {:g} mm: with the finer tolerance the control "
                    "follows the chords of the path; set cycle832_tolerance_mm",
                    smoothing_mm, tolerance.outside ? "OUTTOL" : "INTOL", tolerance.value_mm),
        here());
}

void ProgramPlanner::State::take(const toolpath::SplineMotion&) {
    report.error("post.nurbs", "a NURBS curve cannot be posted: export the operation with linear or circular moves",
                 here());
}

void ProgramPlanner::State::take(const toolpath::OperationStart& operation) {
    ++summary.operations;
    log.begin(operation.name, line);
    endHoleCycle();
    plane = work_plane;
    if (cutting && (machine.control.sequence.operations_from_home || way.inPlane())) leavePart();
    tool_called_again = tool.has_value() && machine.control.sequence.operations_from_home;
    emit(Comment{"operation " + operation.name});
    if (machine.control.sequence.messages) emit(ScreenMessage{operation.name});
    operation_begins = cutting;
}

void ProgramPlanner::State::take(const toolpath::ToolCall& call) {
    if (call.cutter) cutter = call.cutter;
    const bool same = tool && tool->number == call.number && tool->name == call.name;
    if (same) return;
    if (cutting) leavePart();
    tool = ChangeTool{call.number, call.name};
    log.setTool(&*tool, cutter);
    changeTool();
    ++summary.tool_changes;
}

void ProgramPlanner::State::take(const SpindleCommand& command) {
    const auto speed = spindleSpeed(command, cutter, process.spindle.speed_rpm);
    if (!speed) return report.error("post.surface-speed", speed.error(), here());
    process.spindle = {command.turn, *speed};
    if (command.turn != SpindleCommand::Turn::Off && *speed > machine.machine.spindle.max_speed_rpm) {
        ++summary.limit_violations;
        report.error("post.spindle-limit",
                     fmt::format("S{:.0f} is above the spindle's limit of {:.0f} rev/min", *speed,
                                 machine.machine.spindle.max_speed_rpm),
                     here());
    }
    if (cutting) process.tellSpindle(line);
}

void ProgramPlanner::State::take(const toolpath::CoolantCommand& command) {
    process.coolant = command.kind;
    if (cutting) process.tellCoolant(line);
}

void ProgramPlanner::State::take(const toolpath::ProgrammingFrame& frame) {
    const std::string name = offsets.take(frame.part_from_programming, line);
    if (name.empty())
        return report.error("post.work-offsets",
                            "no work offset is left for this programming frame (MSYS): give more names in work_offsets",
                            here());
    if (cutting && name != work_offset) leavePart();
    if (name != work_offset || !first_frame) {
        const auto& origin = frame.part_from_programming.translation();
        emit(Comment{fmt::format("work offset {}: the programming frame, origin X{:.4f} Y{:.4f} Z{:.4f} mm in the part",
                                 name, origin.x(), origin.y(), origin.z())});
    }
    work_offset = name;
    if (!first_frame) first_frame = frame;
    const double turn = Eigen::AngleAxisd(first_frame->part_from_programming.linear().transpose() *
                                          frame.part_from_programming.linear())
                            .angle();
    if (turn > same_axis_rad && offsets.used().back().line == line)
        report.warning(
            "post.turned-frame",
            fmt::format("the programming frame of {} is turned by {:.4g}° against that of {}: the workpiece has to "
                        "lie so in {}, and the offset itself stays without rotation",
                        name, base::degFromRad(turn), offsets.first(), name),
            here());
}

void ProgramPlanner::State::finish() {
    line = 0;
    if (cutting) leavePart();
    run(machine.control.sequence.program_end);
    report.append(axes.axes().report());
    report.append(way.refiner().report());
    report.append(way.excursions().report());
    summary.excursions = way.excursions().planned();
    const kinematics::RefinerSummary& refined = way.refiner().summary();
    summary.inserted_blocks = refined.inserted + way.linearised();
    summary.largest_chord_error_mm = way.largestChordError();
    countDeviation(refined.max_deviation_rad, refined.max_deviation_line);
    const kinematics::PlannerSummary& turned = axes.axes().summary();
    summary.limit_violations += turned.limit_violations + turned.unreached + turned.rewinds - summary.excursions +
                                way.refiner().report().errorCount();
    summary.work_offsets = offsets.used();
    if (summary.work_offsets.empty()) summary.work_offsets.push_back({work_offset, {}, 0});
    summary.operation_records = log.take();
}

ProgramPlanner::ProgramPlanner(const MachineFile& file, const kinematics::Machine& machine, PostOptions options,
                               std::string cl_file, NcSink& sink, base::Diagnostics& report)
    : state_(std::make_unique<State>(file, machine, std::move(options), std::move(cl_file), sink, report)) {}

ProgramPlanner::~ProgramPlanner() = default;

void ProgramPlanner::take(const ClRecord& record) {
    state_->axes.take(record);
    for (PlannedRecord planned; state_->axes.next(planned);) state_->run(planned);
}

PostSummary ProgramPlanner::finish() {
    state_->axes.finish();
    for (PlannedRecord planned; state_->axes.next(planned);) state_->run(planned);
    state_->finish();
    return state_->summary;
}

PostSummary ProgramPlanner::run(const RecordSource& source, Threads threads) {
    ClRecord record;
    if (threads == Threads::One) {
        while (source(record)) take(record);
        return finish();
    }
    BatchQueue queue;
    AxisStage& axes = state_->axes;
    std::thread reading([&] {
        // Whatever happens, the queue is closed, or the other side would wait for ever.
        const auto closed = queue.closeAtEnd();
        std::vector<PlannedRecord> batch;
        const auto pass = [&] {
            for (PlannedRecord planned; axes.next(planned);) {
                batch.push_back(std::move(planned));
                if (batch.size() == BatchQueue::batch_records) queue.push(std::exchange(batch, {}));
            }
        };
        while (source(record)) {
            axes.take(record);
            pass();
        }
        axes.finish();
        pass();
        queue.push(std::move(batch));
    });
    for (std::vector<PlannedRecord> batch; queue.pop(batch);)
        for (const PlannedRecord& planned : batch) state_->run(planned);
    reading.join();
    state_->finish();
    return state_->summary;
}

}  // namespace cusp::post
