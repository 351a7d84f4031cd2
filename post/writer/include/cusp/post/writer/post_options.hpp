// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What a user may choose for one posting; the `[post]` table of a job file.
#pragma once

#include <cusp/base/toml_schema.hpp>
#include <cusp/base/units.hpp>
#include <cusp/post/control/control_definition.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cusp::post {

struct PostOptions {
    /// Auto: inverse time (G93) where the rotary axes turn without TRAORI, else as the CL file says it.
    enum class FeedMode : std::uint8_t { Auto, PerMinute, InverseTime };

    /// Program name, at most 24 letters, digits and underscores (840D); empty: from the output file's name.
    std::string program_name;
    /// Spindle speed for CL files that give none before the first cut.
    std::optional<double> spindle_rpm;
    /// Overrides the machine file's work offset ("G54", "G505").
    std::string work_offset;
    /// Offsets of the programming frames in the order they come in; behind the last of these, and when empty behind
    /// `work_offset`, the next settable frames.
    std::vector<std::string> work_offsets;
    /// Setup file: where the workpiece lies and how long the tools are. Empty: linear travel is not checked.
    std::string setup;
    /// Overrides the machine file's.
    std::optional<ProgramForm> form;
    /// Lengths of tools from the gauge point to the tip, by number or name, and of all others: programs without TRAORI hold
    /// them.
    std::map<std::string, double> tool_lengths_mm;
    std::optional<double> tool_length_mm;
    /// The work offset's origin in the machine frame, all axes at zero: programs without TRAORI for machines with a rotary
    /// table hold it.
    std::optional<std::array<double, 3>> wcs_origin_mm;
    /// The same by the name of the offset; no key of the job file, the setup file has them.
    std::map<std::string, std::array<double, 3>> offset_origins_mm;
    FeedMode feed_mode = FeedMode::Auto;
    /// Pitch of tapped threads where the CL file gives neither pitch nor feed; a left-hand thread comes from the spindle.
    std::optional<double> tap_pitch_mm;
    /// How far the tool axis may leave the great circle between two points of the CL file while cutting.
    double orientation_tolerance_rad = base::radFromDeg(0.05);
    /// Where rotary limits force a change of branch in a cut, it may be made this close to the pole, and is told; the tool
    /// axis leaves its way by up to as much. 0: the tool axis never leaves its way.
    double pole_cone_rad = 0.0;
    /// What a cut does where rotary limits would force it off its way.
    enum class AtLimit : std::uint8_t {
        Retract,  ///< the tool leaves the part along its axis, the rotary axes unwind, and it comes back; told
        Refuse    ///< no program
    };
    AtLimit at_limit = AtLimit::Retract;
    double retract_mm = 50.0;
    double retract_feed_mm_per_s = base::mmPerSFromMmPerMin(5000.0);
    /// Absent: the feed of the cut.
    std::optional<double> engage_feed_mm_per_s;
    /// How far the tip may be from its way between block ends: on the chords of arcs the control cannot drive as such, and
    /// without TRAORI where all axes run linearly.
    double chord_tolerance_mm = 0.005;
    /// A cut with the spindle off is an error instead of a warning.
    bool strict = false;
};

[[nodiscard]] const base::Section<PostOptions>& postSection();

/// The rules of the table for options that came another way (flags). Errors: `post.program-name`, `post.work-offset`,
/// `post.spindle-speed`, each with the key.
void checkOptions(const PostOptions& options, base::Diagnostics& report);

/// A name an 840D takes, made from a file name: "nx part-7.cls" → "NX_PART_7".
[[nodiscard]] std::string programNameFromFile(const std::string& path);

}  // namespace cusp::post
