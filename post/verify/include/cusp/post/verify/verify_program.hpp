// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Does a program do what its CL file says? Answered by running the program on paper and comparing.
#pragma once

#include <cusp/base/diagnostics.hpp>
#include <cusp/base/result.hpp>
#include <cusp/base/units.hpp>
#include <cusp/machine/setup_definition.hpp>
#include <cusp/post/control/control_definition.hpp>
#include <cusp/toolpath/cl_reader.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace cusp::post::verify {

struct VerifyOptions {
    double tip_tolerance_mm = 0.001;
    double axis_tolerance_rad = base::radFromDeg(0.001);
    /// Limit on the tool axis between block ends. Off by default: where the rotary axes run linearly near the pole, the
    /// axis leaves the great circle between two CL points without the tip leaving its line.
    std::optional<double> between_axis_tolerance_rad;
    /// A feed move whose rotary axes take the tool axis further off the way between its ends than that way is long is on
    /// a wrong branch or winding: an error when it swings off by more than this, a warning below, where a change of branch
    /// at the pole is hard to avoid.
    double pole_cone_rad = base::radFromDeg(3.0);
    /// Limit on the tip between block ends.
    double between_tip_tolerance_mm = 0.001;
    /// Feeds may differ by this part of themselves: what printing them costs.
    double feed_tolerance = 1e-3;
    double speed_tolerance_rpm = 0.51;
    /// D of the cutting blocks.
    int cutting_edge = 1;
    /// The machine keeps the tool length along the spindle whatever the plane (SD42940): G18 and G19 are then no finding.
    bool fixed_tool_length_axis = false;
    /// The cutting blocks of each programming frame of the CL file must run in a work offset of their own: those named
    /// here in the order the frames come in (none: the machine file's), and then the next settable frames.
    bool check_work_offset = true;
    std::vector<std::string> work_offsets;
    /// From the gauge point to the tip, of every tool: places the tip where rotary axes are away from zero without TRAORI.
    std::optional<double> tool_length_mm;
    /// Origin of the work offset in the machine frame, all axes at zero: needed as well where a rotary axis carries the
    /// workpiece.
    std::optional<std::array<double, 3>> wcs_origin_mm;
    /// Tool lengths and origins from a setup file, where the two above do not say: with it, linear travel is checked.
    const machine::SetupDefinition* setup = nullptr;
    /// Warnings of the reader (M functions of the machine builder) are errors.
    bool strict = false;
};

/// The largest value of something and where it was met.
struct Extreme {
    double value = 0.0;
    std::size_t program_line = 0;
    std::optional<std::uint64_t> block_number;
    std::size_t cl_line = 0;
};

struct VerifyReport {
    std::size_t points = 0;        ///< cutter locations of the CL file
    std::size_t matched = 0;       ///< met by a block end within tolerance
    std::size_t missed = 0;        ///< not met, or only by a block end out of tolerance
    std::size_t blocks = 0;        ///< blocks with words
    std::size_t motions = 0;       ///< blocks that move
    std::size_t intermediate = 0;  ///< block ends on the way from one CL point to the next
    std::size_t links = 0;         ///< rapids outside operations: home, tool change, approach
    std::size_t excursions =
        0;                  ///< times the tool leaves a cut along its axis, turns, and comes back to the same place
    std::size_t extra = 0;  ///< motions that lead nowhere in the CL file

    Extreme max_tip_error_mm;    ///< at block ends, those out of tolerance included
    Extreme max_axis_error_rad;  ///< the same
    /// Between block ends in cuts, sampled as the control interpolates, against a straight or circular tip and an axis on
    /// the great circle. The largest departure is at most 0.05 µm and 0.0006° larger.
    Extreme max_tip_between_mm;
    Extreme max_axis_between_rad;
    /// The same in rapids.
    Extreme max_tip_between_rapid_mm;
    Extreme max_axis_between_rapid_rad;

    std::size_t limit_violations = 0;    ///< blocks with an axis beyond its limits, at their end or on the way
    std::size_t travel_violations = 0;   ///< those of them with a linear axis
    std::size_t travel_checked = 0;      ///< motions whose linear axes were followed
    std::size_t travel_unchecked = 0;    ///< others that were placed in the work offset
    bool rotary_limits_checked = true;   ///< false on machines whose rotary positions are not solved for here
    bool linear_travel_checked = false;  ///< of every such motion; needs to know where the workpiece stands
    bool compared = false;               ///< false without a CL file: only the program itself was looked at

    /// Everything found, in the words of the shop floor; warnings of the reader included.
    base::Diagnostics findings;
    bool pass = false;  ///< no finding is an error
};

/// Reads `program` and, when `against` is given, compares it with that CL file: every CL point must be met in order by a
/// block end, every feed motion must lie on the CL path; feed, rapid or feed, spindle, tool, coolant, tool length and work
/// offset must be what the CL file and the machine file say. The points are found without any map from the writer.
///
/// Proves programmed geometry. The control may leave it by its own smoothing tolerance (CYCLE832, CTOL, G64x).
/// Errors: when the program itself cannot be read (`nc.*`); findings are values in the report.
[[nodiscard]] base::Result<VerifyReport> verifyProgram(std::istream& program, const std::string& program_name,
                                                       const MachineFile& machine, const toolpath::ToolPath* against,
                                                       const VerifyOptions& options = {});

/// The report as a page of text, without the findings.
[[nodiscard]] std::string toText(const VerifyReport& report);

}  // namespace cusp::post::verify
