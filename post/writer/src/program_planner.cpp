// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Turns CL records into NC steps. The start and end order follows facts known from Siemens' own Sinumerik post.
#include <cusp/post/writer/program_planner.hpp>

#include "spindle_speed.hpp"

#include <cusp/base/units.hpp>
#include <cusp/kinematics/axis_planner.hpp>
#include <cusp/kinematics/machine.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <utility>

namespace cusp::post {

using toolpath::ClRecord;
using toolpath::CoolantCommand;
using toolpath::MotionKind;
using toolpath::SpindleCommand;

namespace {

/// The start is left free: the rotary axes are positioned at home height, where travel costs nothing at the part.
kinematics::PlannerOptions axisOptions(const std::string& cl_file) {
    kinematics::PlannerOptions options;
    options.file_name = cl_file;
    return options;
}

}  // namespace

struct ProgramPlanner::State {
    State(const MachineFile& machine_file, const kinematics::Machine& model, PostOptions post_options, std::string file,
          NcSink& steps, base::Diagnostics& diagnostics)
        : machine(machine_file), options(std::move(post_options)), cl_file(std::move(file)), sink(steps),
          report(diagnostics), axes(model, axisOptions(cl_file)), rotary_count(model.rotaryCount()) {
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
    kinematics::AxisPlanner axes;
    std::size_t rotary_count;

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
    bool warned_no_tool = false;
    bool warned_spindle_off = false;

    PostSummary summary;
    std::optional<RotaryValues> last_rotary;

    template <class Item>
    void emit(Item item) {
        sink.step({std::move(item), line});
    }
    [[nodiscard]] base::Location here() const { return {cl_file, line, 0, {}}; }

    void drain() {
        while (!waiting.empty()) {
            if (const auto* motion = std::get_if<toolpath::LinearMotion>(&waiting.front().statement)) {
                kinematics::PlannedAxes planned;
                if (!axes.pop(planned)) return;
                line = waiting.front().line;
                take(*motion, planned.rotary_rad);
            } else {
                line = waiting.front().line;
                std::visit([this](const auto& statement) { take(statement); }, waiting.front().statement);
            }
            waiting.pop_front();
        }
    }

    // --- statements ---
    void take(const toolpath::LinearMotion&) {}  // motions come with their rotary values, below
    void take(const toolpath::FeedRate& rate) { feed = rate; }
    void take(const toolpath::ProgramEnd&) {}
    void take(const toolpath::ProgramStop& stop) { emit(Stop{stop.optional}); }
    void take(const toolpath::Dwell& dwell) { emit(Pause{dwell.seconds}); }
    void take(const toolpath::Remark& remark) { emit(Comment{remark.text}); }

    void take(const toolpath::StartPosition&) {}
    void take(const toolpath::WorkPlane&) {}
    void take(const toolpath::ArcMotion&) { refuse("arcs are"); }
    void take(const toolpath::HomeReturn&) { refuse("GOHOME is"); }
    void take(const toolpath::CycleStart&) { refuse("drilling cycles are"); }
    void take(const toolpath::HoleLocation&) {}
    void take(const toolpath::CycleEnd&) {}
    void take(const toolpath::CutterCompensation& command) {
        if (command.side != toolpath::CutterCompensation::Side::Off) refuse("cutter radius compensation is");
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
            emit(Comment{fmt::format("work offset: the programming frame, origin X{:.4f} Y{:.4f} Z{:.4f} mm in the part",
                                     origin.x(), origin.y(), origin.z())});
        } else if (!frame->part_from_programming.isApprox(next.part_from_programming, 1e-9)) {
            report.error("post.second-frame",
                         "the programming frame (MSYS) changes inside the file; one program can hold one work offset so "
                         "far. Export the operations of each frame as a CL file of their own.",
                         here());
        }
        frame = next;
    }

    void take(const toolpath::LinearMotion& motion, const RotaryValues& rotary_rad) {
        ++summary.cutter_locations;
        checkMotion(motion);
        countRotary(rotary_rad);
        const toolpath::FeedRate rate = feed.value_or(toolpath::FeedRate{});
        if (!cutting) return reachPart(motion, rotary_rad, rate);
        emit(Move{motion.location.tip_mm, rotary_rad, motion.kind, rate});
    }

    // --- sequences ---
    void reachPart(const toolpath::LinearMotion& motion, const RotaryValues& rotary_rad, const toolpath::FeedRate& rate) {
        emit(Smoothing{true});
        emit(SelectWorkOffset{});
        tellSpindle();
        tellCoolant();
        if (rotary_count > 0) emit(PositionRotary{rotary_rad});
        emit(TipProgramming{true});
        emit(Approach{motion.location.tip_mm, rotary_rad, motion.kind, rate});
        cutting = true;
    }

    void leavePart() {
        emit(TipProgramming{false});
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
    void checkMotion(const toolpath::LinearMotion& motion) {
        if (!tool && !std::exchange(warned_no_tool, true))
            report.warning("post.no-tool", "the tool moves before any tool is called; the program changes no tool",
                           here());
        if (motion.kind == MotionKind::Rapid) return;
        if (!feed) {
            report.error("post.no-feed", "a cutting move without a feed rate: there is no FEDRAT before it", here());
            feed = toolpath::FeedRate{};
        }
        if (spindle.turn != SpindleCommand::Turn::Off || std::exchange(warned_spindle_off, true)) return;
        report.add({options.strict ? base::Severity::Error : base::Severity::Warning, "post.spindle-off",
                    "cuts with the spindle off: there is no SPINDL before it. Give the speed with --spindle-rpm.", here()});
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
    if (const auto* motion = std::get_if<toolpath::LinearMotion>(&record.statement))
        state_->axes.push({motion->location.axis, record.line, motion->kind == MotionKind::Feed});
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
    state.summary.limit_violations += state.axes.summary().limit_violations + state.axes.summary().unreached;
    return state.summary;
}

}  // namespace cusp::post
