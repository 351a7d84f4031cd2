// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What the planner knows at one record of the CL file.
#pragma once

#include "axis_stage.hpp"
#include "operation_log.hpp"
#include "process_words.hpp"
#include "tool_motion.hpp"
#include "work_offsets.hpp"

#include <cusp/post/writer/program_planner.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cusp::post {

struct ProgramPlanner::State {
    State(const MachineFile& machine_file, const kinematics::Machine& machine_model, PostOptions post_options,
          std::string file, NcSink& steps, base::Diagnostics& diagnostics);

    /// What the statement asks for; its rotary positions are decided.
    void run(const PlannedRecord& record);
    void finish();

    const MachineFile& machine;
    PostOptions options;
    std::string cl_file;
    NcSink& sink;
    base::Diagnostics& report;
    const kinematics::Machine& model;
    AxisStage axes;  ///< nothing below knows it before `finish`: it may run in a thread of its own
    ToolMotion way;
    WorkOffsets offsets;
    ProcessWords process;
    OperationLog log;

    template <class Item>
    void emit(Item item) {
        sink.step({std::move(item), line});
    }
    [[nodiscard]] base::Location here() const { return {cl_file, line, 0, {}}; }

    // Statements, in program_planner.cpp.
    void take(const toolpath::FeedRate& rate) { feed = rate; }
    void take(const toolpath::ProgramEnd&) {}
    void take(const toolpath::StartPosition&) {}
    void take(const toolpath::ProgramStop& stop) { emit(Stop{stop.optional}); }
    void take(const toolpath::Dwell& dwell) { emit(Pause{dwell.seconds}); }
    void take(const toolpath::Remark& remark) { emit(Comment{remark.text}); }
    void take(const toolpath::HomeReturn&);
    void take(const toolpath::WorkPlane& next);
    void take(const toolpath::CycleStart& start);
    void take(const toolpath::CycleEnd&);
    void take(const toolpath::CutterCompensation& command);
    void take(const toolpath::PathTolerance& tolerance);
    void take(const toolpath::SplineMotion&);
    void take(const toolpath::OperationStart& operation);
    void take(const toolpath::ToolCall& call);
    void take(const toolpath::SpindleCommand& command);
    void take(const toolpath::CoolantCommand& command);
    void take(const toolpath::ProgrammingFrame& frame);

    // Motions, in planner_motion.cpp; `planned` holds the rotary values of the one at hand.
    void take(const toolpath::LinearMotion& motion);
    void take(const toolpath::ArcMotion& arc);
    void take(const toolpath::HoleLocation& hole);
    void goAbove(const ToolPose& above);
    void logRapid(const geometry::Vector3& tip_mm);
    void beginMotion(const toolpath::CutterLocation& location, bool cut, bool hole);
    [[nodiscard]] ToolPose poseAt(const toolpath::CutterLocation& location) const;
    [[nodiscard]] std::optional<geometry::RigidTransform> planeFor(const ToolPose& pose, bool hole);
    void choosePlane(const ToolPose& pose, bool hole);
    void beginCompensation(bool straight);
    void endHoleCycle();
    void checkMotion(bool cut);
    void tellPoleCone(const RotaryValues& from);
    void countDeviation(double deviation_rad, std::uint32_t cl_line);
    void countRotary(const RotaryValues& rotary_rad);

    // Sequences of the machine file.
    void run(const std::vector<std::string>& blocks);
    [[nodiscard]] bool runPlaceholder(std::string_view name);
    void beginProgramming();
    void reachPart(const ToolPose& pose, toolpath::MotionKind kind, const toolpath::FeedRate& rate);
    void leavePart();
    void beginOperationAtPart();
    void changeTool();

    bool unwinds = false;  ///< the tool leaves the part where limits force it to
    std::uint32_t line = 0;
    std::optional<toolpath::FeedRate> feed;
    std::optional<geometry::Cutter> cutter;
    std::optional<toolpath::ProgrammingFrame> first_frame;
    std::string work_offset;
    std::optional<ChangeTool> tool;
    bool cutting = false;  ///< the tool is at the part
    bool operation_begins = false;
    bool tool_called_again = false;  ///< the next approach calls the tool first
    bool started = false;
    bool warned_no_tool = false;
    bool warned_spindle_off = false;
    bool warned_tolerance = false;

    std::optional<geometry::RigidTransform> work_plane;  ///< the CL file's, when it is tilted
    std::optional<geometry::RigidTransform> plane;       ///< the program's, chosen for the motion at hand

    std::optional<toolpath::CycleStart> cycle;
    std::optional<HoleCycle> cycle_told;
    toolpath::CutterCompensation compensation;
    toolpath::CutterCompensation::Side compensation_told = toolpath::CutterCompensation::Side::Off;

    ToolPose to;  ///< the pose of the motion at hand
    kinematics::PlannedAxes planned;
    bool hole_ahead = false;
    std::optional<RotaryValues> last_rotary;
    geometry::Vector3 last_tip = geometry::Vector3::Zero();
    PostSummary summary;
};

}  // namespace cusp::post
