// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// CL records in, steps of an NC program out: tool changes, approaches, modal state, rotary axes.
#pragma once

#include <cusp/base/diagnostics.hpp>
#include <cusp/kinematics/machine.hpp>
#include <cusp/post/control/control_definition.hpp>
#include <cusp/post/writer/nc_program.hpp>
#include <cusp/post/writer/post_options.hpp>
#include <cusp/toolpath/cl_record.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cusp::post {

/// A settable frame the program runs in, and the programming frame of the CL file it stands for.
struct UsedWorkOffset {
    std::string name;
    geometry::RigidTransform part_from_programming = geometry::RigidTransform::Identity();
    std::uint32_t line = 0;  ///< where the CL file first has it; 0: it has no frames
};

/// What one operation does; the setup sheet is made of these. An operation ends where the next begins or the tool changes.
struct OperationRecord {
    std::string name;
    std::uint32_t line = 0;
    std::optional<std::int64_t> tool_number;
    std::string tool_name;
    std::optional<geometry::Cutter> cutter;
    std::string work_offset;
    bool tilted_plane = false;
    double speed_rpm = 0.0;   ///< the highest
    double least_feed = 0.0;  ///< mm/min; 0: no feed moves, or per revolution with the spindle off
    double greatest_feed = 0.0;
    std::size_t locations = 0;
    std::size_t holes = 0;
    geometry::Vector3 low_mm = geometry::Vector3::Zero();  ///< of the tip, in the work offset's frame
    geometry::Vector3 high_mm = geometry::Vector3::Zero();
    double feed_length_mm = 0.0;
    double rapid_length_mm = 0.0;
    double feed_time_s = 0.0;  ///< at the programmed feeds, drilling cycles not counted
};

/// What a posting did.
struct PostSummary {
    std::size_t cutter_locations = 0;
    std::size_t operations = 0;
    std::size_t tool_changes = 0;
    std::vector<UsedWorkOffset> work_offsets;
    std::vector<OperationRecord> operation_records;
    std::size_t limit_violations = 0;
    /// Moves put between cutter locations so that tool axis and tip keep their way, and how far they still leave it: the
    /// tip by no more than a proven bound, and without TRAORI only.
    std::size_t inserted_blocks = 0;
    double largest_chord_error_mm = 0.0;
    double largest_axis_deviation_rad = 0.0;
    std::uint32_t largest_axis_deviation_cl_line = 0;
    /// How often the tool leaves the part to unwind.
    std::size_t excursions = 0;
    /// Smallest and largest value of each rotary axis, in chain order.
    std::array<std::pair<double, double>, 2> rotary_range_rad{};
    /// Total movement of the rotary axes between cutter locations, and the largest single one.
    double rotary_travel_rad = 0.0;
    double largest_rotary_step_rad = 0.0;
    std::size_t largest_rotary_step_axis = 0;
    std::uint32_t largest_rotary_step_cl_line = 0;
};

/// The machine file's decimals, or more where those would put a block end further than 0.001 mm or 0.001° from where it
/// should be: half a unit in the last place of each linear axis, of each rotary axis (in a program without TRAORI at the
/// end of a lever arm of a metre, or the longest the machine file has), of each vector component. Raising one is told.
[[nodiscard]] NumberFormat sufficientFormat(const MachineFile& file, ProgramForm form, base::Diagnostics& report);

/// A streaming stage: memory is bounded by the branch planner's window, not by the path.
class ProgramPlanner {
public:
    /// `cl_file` is for messages. All references must outlive the planner.
    ProgramPlanner(const MachineFile& file, const kinematics::Machine& machine, PostOptions options,
                   std::string cl_file, NcSink& sink, base::Diagnostics& report);
    ~ProgramPlanner();
    ProgramPlanner(const ProgramPlanner&) = delete;
    ProgramPlanner& operator=(const ProgramPlanner&) = delete;

    /// Answers false behind the last record.
    using RecordSource = std::function<bool(toolpath::ClRecord&)>;
    enum class Threads : std::uint8_t { One, Two };
    /// Everything in one call. With two threads, `source` is called and the rotary axes are planned in a thread of its own,
    /// while this one makes the program; the program is the same. `source` must not throw.
    PostSummary run(const RecordSource& source, Threads threads);

    void take(const toolpath::ClRecord& record);
    /// Ends the program. The steps are only good to run when `report` has no errors.
    PostSummary finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace cusp::post
