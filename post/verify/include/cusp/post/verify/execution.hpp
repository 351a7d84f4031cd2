// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Did the control do what the program says? What the tool really did, sample by sample, against the programmed path.
#pragma once

#include <cusp/post/reader/executed_program.hpp>
#include <cusp/post/verify/verify_program.hpp>

#include <cstddef>
#include <istream>
#include <string>
#include <vector>

namespace cusp::post::verify {

/// Where the tool was at one instant.
struct ExecutedSample {
    double time_s = 0.0;
    std::size_t line = 0;   ///< of the program, that was run
    reader::ToolPose tool;  ///< in the frame of the work offset it was run in
};

/// Reads the table `cusp controller --record` writes: a heading with the columns time_s, tip_x_mm, tip_y_mm, tip_z_mm, axis_i,
/// axis_j, axis_k and line among others, then one sample a line.
/// Errors: `record.heading`, `record.row` (with line), `record.order` (time does not grow), `record.empty`; at most 20.
[[nodiscard]] base::Result<std::vector<ExecutedSample>> readExecutionRecord(std::istream& in,
                                                                            const std::string& file_name);

struct ExecutionOptions {
    /// Distance of the tip from the programmed path that smoothing may take it: the tolerance of CYCLE832 or CTOL.
    double tip_tolerance_mm = 0.011;
    std::optional<double> tool_length_mm;
    std::optional<std::array<double, 3>> wcs_origin_mm;
    const machine::SetupDefinition* setup = nullptr;
};

/// The largest value of something in the run.
struct ExecutedExtreme {
    double value = 0.0;
    double time_s = 0.0;
    std::size_t line = 0;
};

struct ExecutionReport {
    std::size_t samples = 0;
    std::size_t compared = 0;          ///< in moves whose way the program determines
    std::size_t cutting = 0;           ///< of those, in feed moves
    std::size_t points = 0;            ///< ends of feed moves in the program
    std::size_t unreached = 0;         ///< of those, by more than the tolerance
    ExecutedExtreme max_tip_mm;        ///< in feed moves
    ExecutedExtreme max_tip_rapid_mm;  ///< in rapids
    ExecutedExtreme max_axis_rad;      ///< of the tool axis, in feed moves
    ExecutedExtreme max_unreached_mm;  ///< the end of a feed move the tool came least near to
    double rms_tip_mm = 0.0;           ///< in feed moves
    base::Diagnostics findings;        ///< `execution.tip`, `execution.unreached`
    bool pass = false;
};

/// Every sample in a feed move, and the middle of the way from the one before where they are far apart, must lie on the programmed path within the tolerance, near the line it says it runs, and every
/// end of a feed move must have been reached within it: a record that jumps or is cut short does not pass.
/// Errors: when the program cannot be read (`nc.*`), or runs lines more than once (`execution.repeats`).
[[nodiscard]] base::Result<ExecutionReport> compareExecution(std::istream& program, const std::string& program_name,
                                                             const MachineFile& machine,
                                                             const std::vector<ExecutedSample>& samples,
                                                             const ExecutionOptions& options = {});

[[nodiscard]] std::string toText(const ExecutionReport& report);

}  // namespace cusp::post::verify
