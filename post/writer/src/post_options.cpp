// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The `[post]` table of a job file and the name an 840D program may bear.
#include <cusp/post/writer/post_options.hpp>

#include <cusp/post/control/control_definition.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace cusp::post {

namespace {

constexpr std::size_t name_limit = 24;  // PM12 p42

bool isNameCharacter(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
}

bool fitsAnyProgram(const std::string& name) {
    return name.size() <= name_limit && std::all_of(name.begin(), name.end(), isNameCharacter);
}

/// `where` names the place of a key, in a job file or on the command line.
template <class Where>
void check(const PostOptions& options, const Where& where, base::Diagnostics& report) {
    if (!fitsAnyProgram(options.program_name))
        report.error("post.program-name",
                     "an 840D program name has at most 24 letters, digits and underscores; \"" + options.program_name +
                         "\" does not fit",
                     where("program_name"));
    if (!options.work_offset.empty() && !isSettableFrame(options.work_offset))
        report.error("post.work-offset",
                     "\"" + options.work_offset +
                         "\" is no settable frame of an 840D: G54 to G57, G505 to G599, or G500",
                     where("work_offset"));
    for (const std::string& name : options.work_offsets)
        if (!isSettableFrame(name))
            report.error("post.work-offset",
                         "\"" + name + "\" is no settable frame of an 840D: G54 to G57, G505 to G599, or G500",
                         where("work_offsets"));
    if (options.tap_pitch_mm && !(*options.tap_pitch_mm > 0.0 && *options.tap_pitch_mm <= 100.0))
        report.error("post.tap-pitch", "the pitch of a thread must lie in 0 to 100 mm", where("tap_pitch_mm"));
    if (options.spindle_rpm && !(*options.spindle_rpm > 0.0 && std::isfinite(*options.spindle_rpm)))
        report.error("post.spindle-speed", "the spindle speed must be above 0 rev/min", where("spindle_rpm"));
    const auto length = [](double mm) { return mm >= 0.0 && mm <= 5000.0; };
    if (options.tool_length_mm && !length(*options.tool_length_mm))
        report.error("post.tool-length", "the length of a tool must lie in 0 to 5000 mm", where("tool_length_mm"));
    for (const auto& [tool, mm] : options.tool_lengths_mm)
        if (!length(mm))
            report.error("post.tool-length", "the length of tool \"" + tool + "\" must lie in 0 to 5000 mm",
                         where("tool_lengths_mm"));
    const double tolerance_deg = base::degFromRad(options.orientation_tolerance_rad);
    constexpr double rounding = 1e-9;
    if (!(tolerance_deg >= 0.001 - rounding && tolerance_deg <= 10.0 + rounding))
        report.error("post.orientation-tolerance", "the orientation tolerance must lie in 0.001° to 10°",
                     where("orientation_tolerance_deg"));
    const double cone_deg = base::degFromRad(options.pole_cone_rad);
    if (!(cone_deg >= 0.0 && cone_deg <= 10.0 + rounding))
        report.error("post.pole-cone", "the pole cone must lie in 0° to 10°", where("pole_cone_deg"));
    if (!(options.retract_mm >= 1.0 && options.retract_mm <= 1000.0))
        report.error("post.retract", "the way off the part must lie in 1 to 1000 mm", where("retract_mm"));
    if (!(options.chord_tolerance_mm >= 0.0001 && options.chord_tolerance_mm <= 1.0))
        report.error("post.chord-tolerance", "the chord tolerance must lie in 0.0001 to 1 mm",
                     where("chord_tolerance_mm"));
}

}  // namespace

const base::Section<PostOptions>& postSection() {
    using FeedMode = PostOptions::FeedMode;
    static const auto section =
        base::Section<PostOptions>("Choices for one posting; every one is also a flag of `cusp post`.")
            .field("program_name", &PostOptions::program_name,
                   "Program name: at most 24 letters, digits, underscores. Empty: from the output file's name.")
            .field("spindle_rpm", &PostOptions::spindle_rpm,
                   "Spindle speed, clockwise, for CL files that give none before the first cut.", base::positive())
            .field("work_offset", &PostOptions::work_offset, "Work offset, e.g. G54. Empty: the machine file's.")
            .field(
                "work_offsets", &PostOptions::work_offsets,
                "Work offsets of the programming frames (MSYS) in the order they come in. Empty, and behind the last: the "
                "next settable frames.")
            .choice<FeedMode>(
                "feed_mode", &PostOptions::feed_mode,
                {{"auto", FeedMode::Auto},
                 {"per-minute", FeedMode::PerMinute},
                 {"inverse-time", FeedMode::InverseTime}},
                "auto: inverse time (G93) where rotary axes turn without TRAORI, else as the CL file says it; "
                "per-minute: always so; inverse-time: every feed per minute becomes G93.")
            .field("tap_pitch_mm", &PostOptions::tap_pitch_mm,
                   "Pitch of tapped threads where the CL file gives no feed to take it from.", base::positive())
            .field(
                "setup", &PostOptions::setup,
                "Setup file, which says where the workpiece lies and how long the tools are. Empty: linear travel is "
                "not checked.")
            .choice<std::optional<ProgramForm>>(
                "form", &PostOptions::form, programFormWords(),
                "How the program says where the tool is: traori-rotary, traori-vectors or machine. Absent: the machine "
                "file's.")
            .field(
                "tool_lengths_mm", &PostOptions::tool_lengths_mm,
                "Lengths from the gauge point to the tip, by tool number or name; a program without TRAORI holds them.")
            .field("tool_length_mm", &PostOptions::tool_length_mm, "The length of every tool not named above.",
                   {.min = 0.0, .max = 5000.0})
            .field("wcs_origin_mm", &PostOptions::wcs_origin_mm,
                   "Origin of the work offset in machine coordinates: without TRAORI, on machines with a rotary table.")
            .field("orientation_tolerance_deg", &PostOptions::orientation_tolerance_rad,
                   "While cutting, how far the tool axis may leave the great circle between two points of the CL file; "
                   "where the rotary axes would swing it further, blocks are inserted.",
                   {.min = 0.001, .max = 10.0})
            .field(
                "pole_cone_deg", &PostOptions::pole_cone_rad,
                "Where rotary limits force a change of branch in a cut, it may be made this close to the pole, and is told; "
                "the tool axis leaves its way by up to as much. 0: the tool axis never leaves its way.",
                {.min = 0.0, .max = 10.0})
            .choice(
                "at_limit", &PostOptions::at_limit,
                {{"retract", PostOptions::AtLimit::Retract}, {"refuse", PostOptions::AtLimit::Refuse}},
                "Where rotary limits would force a cut off its way: the tool leaves the part along its axis, the rotary "
                "axes unwind, and it comes back to the same place, which is told; or there is no program.")
            .field("retract_mm", &PostOptions::retract_mm, "How far the tool then leaves the part.",
                   {.min = 1.0, .max = 1000.0})
            .field("retract_feed_mm_per_min", &PostOptions::retract_feed_mm_per_s, "Feed on the way off the part.",
                   base::positive())
            .field("engage_feed_mm_per_min", &PostOptions::engage_feed_mm_per_s,
                   "Feed on the way back to it; without it, the feed of the cut.", base::positive())
            .field(
                "chord_tolerance_mm", &PostOptions::chord_tolerance_mm,
                "How far the tip may be from its way between block ends: on the chords of arcs the control cannot drive "
                "as such, and without TRAORI on every move.",
                {.min = 0.0001, .max = 1.0})
            .field("strict", &PostOptions::strict,
                   "What the reader does not know, and a cut with the spindle off, are errors instead of warnings.")
            .check([](const PostOptions& options, const base::TomlNode& table, base::Diagnostics& report) {
                check(options, [&table](const char* key) { return table.whereKey(key); }, report);
            });
    return section;
}

void checkOptions(const PostOptions& options, base::Diagnostics& report) {
    check(options, [](const char* key) { return base::Location{{}, 0, 0, key}; }, report);
}

std::string programNameFromFile(const std::string& path) {
    const std::size_t slash = path.find_last_of('/');
    std::string stem = slash == std::string::npos ? path : path.substr(slash + 1);
    if (const std::size_t dot = stem.find_last_of('.'); dot != std::string::npos && dot > 0) stem.resize(dot);
    std::string name;
    for (const char c : stem) {
        if (name.size() == name_limit) break;
        name.push_back(isNameCharacter(c) ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : '_');
    }
    return name.empty() || name == "_" ? "PROGRAM" : name;
}

}  // namespace cusp::post
