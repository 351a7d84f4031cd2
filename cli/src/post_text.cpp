// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The words and keys of a posting's outcome.
#include "post_text.hpp"

#include "input.hpp"

#include <cusp/base/units.hpp>

#include <fmt/format.h>

#include <cmath>

namespace cusp::cli {

namespace {

std::string plural(std::size_t count, const char* noun) {
    return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string rotaryText(const PostOutcome& outcome) {
    const auto& names = outcome.machine.model.rotaryNames();
    const auto& summary = outcome.summary;
    std::string out;
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto& range = outcome.machine.model.rotaryRange(i);
        const auto& [low, high] = summary.rotary_range_rad[i];
        out += fmt::format("  {} moves between {:.3f}° and {:.3f}°, ", names[i], base::degFromRad(low),
                           base::degFromRad(high));
        out += range.endless ? "endless\n"
                             : fmt::format("limits {:.6g}° and {:.6g}°\n", base::degFromRad(range.min),
                                           base::degFromRad(range.max));
    }
    if (summary.largest_rotary_step_rad > 0.0)
        out +=
            fmt::format("  largest rotary step: {} by {:.3f}° at CL line {}\n", names[summary.largest_rotary_step_axis],
                        base::degFromRad(summary.largest_rotary_step_rad), summary.largest_rotary_step_cl_line);
    if (summary.inserted_blocks > 0)
        out += "  " + plural(summary.inserted_blocks, "block") + " inserted so that tool axis and tip keep their way\n";
    if (summary.largest_chord_error_mm > 0.0)
        out += fmt::format("  between block ends the tip is within {:.4f} mm of its way (proven bound)\n",
                           summary.largest_chord_error_mm);
    if (summary.excursions > 0)
        out += "  " + plural(summary.excursions, "time") + " off the part to unwind rotary axes\n";
    if (summary.largest_axis_deviation_rad > 0.0)
        out +=
            fmt::format("  while cutting, the tool axis leaves its way by at most {:.3f}°, at CL line {}\n",
                        base::degFromRad(summary.largest_axis_deviation_rad), summary.largest_axis_deviation_cl_line);
    return out;
}

std::string travelText(const PostOutcome& outcome) {
    if (!outcome.travel)
        return "  linear travel not checked: nothing says where the workpiece lies in the machine (--setup)\n";
    if (outcome.travel->moves == 0) return "  linear travel: nothing moves\n";
    std::string out;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& range = outcome.machine.model.linearRange(i);
        // Rounded first, so that nothing is "-0.000".
        const auto rounded = [](double mm) { return std::round(mm * 1e3) / 1e3 + 0.0; };
        const auto& [low, high] = outcome.travel->range_mm[i];
        out += fmt::format("  {} moves between {:.3f} mm and {:.3f} mm, limits {:.6g} mm and {:.6g} mm\n",
                           outcome.machine.model.linearNames()[i], rounded(low), rounded(high), range.min, range.max);
    }
    return out;
}

/// "1 h 02 min 07 s"
std::string durationText(double seconds) {
    if (seconds < 60.0) return fmt::format("{:.1f} s", seconds);
    const auto whole = static_cast<long long>(std::llround(seconds));
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min {:02} s", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string cycleTimeText(const PostOutcome& outcome) {
    if (outcome.too_long_to_estimate) return "  cycle time not estimated: a long program; --cycle-time does it\n";
    if (!outcome.cycle_time) return {};
    return fmt::format("  cycle time about {}, tool changes not counted{}\n", durationText(outcome.cycle_time->total()),
                       outcome.cycle_time->from_setup ? "" : "; tool length and place of the workpiece assumed");
}

bool isLimit(const base::Diagnostic& diagnostic) {
    return diagnostic.code == "kinematics.axis-limit" || diagnostic.code == "kinematics.axis-unreachable" ||
           diagnostic.code == "kinematics.between-axis" || diagnostic.code == "kinematics.rewind" ||
           diagnostic.code == "kinematics.linear-limit" || diagnostic.code == "kinematics.linear-singular" ||
           diagnostic.code == "post.spindle-limit";
}

}  // namespace

bool PostOutcome::onlyLimits() const {
    for (const auto& diagnostic : report)
        if (diagnostic.severity == base::Severity::Error && !isLimit(diagnostic)) return false;
    return report.hasErrors();
}

std::string toText(const PostOutcome& outcome) {
    const auto& summary = outcome.summary;
    std::string out =
        fmt::format("{}: {} CL file in {}, {}, {}, {}\n", fileNameOf(outcome.cl_file), outcome.dialect,
                    outcome.mm_per_unit == 1.0 ? "mm" : "inches", plural(summary.operations, "operation"),
                    plural(summary.tool_changes, "tool change"), plural(summary.cutter_locations, "cutter location"));
    out += fmt::format("  for {}\n", outcome.machine.file.machine.name);
    if (outcome.machine.unanchored()) out += unanchored_text;
    if (outcome.report.hasErrors()) {
        const std::string limits =
            summary.limit_violations > 0 ? ", " + plural(summary.limit_violations, "limit violation") : "";
        return out + fmt::format("  NO PROGRAM WRITTEN: {}{}\n", plural(outcome.report.errorCount(), "error"), limits);
    }
    out += rotaryText(outcome);
    out += travelText(outcome);
    out += cycleTimeText(outcome);
    if (outcome.report.warningCount() > 0)
        out += "  " + plural(outcome.report.warningCount(), "warning") + ", see above\n";
    return out + fmt::format("  {} → {}\n", plural(outcome.blocks, "block"), outcome.output);
}

base::Json toJson(const PostOutcome& outcome) {
    const auto& summary = outcome.summary;
    base::Json out = base::jsonReport("post", 1);
    out["cl_file"] = outcome.cl_file;
    out["dialect"] = outcome.dialect;
    out["mm_per_unit"] = outcome.mm_per_unit;
    out["machine"] = outcome.machine.file.machine.name;
    out["machine_anchored"] = !outcome.machine.unanchored();
    out["program"] = outcome.report.hasErrors() ? base::Json() : base::Json(outcome.output);
    out["cutter_locations"] = summary.cutter_locations;
    out["operations"] = summary.operations;
    out["tool_changes"] = summary.tool_changes;
    out["blocks"] = outcome.blocks;
    out["inserted_blocks"] = summary.inserted_blocks;
    out["excursions"] = summary.excursions;
    out["max_tip_between_bound_mm"] = summary.largest_chord_error_mm;
    out["max_axis_between_deg"] = base::degFromRad(summary.largest_axis_deviation_rad);
    out["warnings"] = outcome.report.warningCount();
    out["errors"] = outcome.report.errorCount();
    out["limit_violations"] = summary.limit_violations;
    out["rotary_travel_deg"] = base::degFromRad(summary.rotary_travel_rad);
    out["largest_rotary_step_deg"] = base::degFromRad(summary.largest_rotary_step_rad);
    out["largest_rotary_step_cl_line"] = summary.largest_rotary_step_cl_line;
    out["rotary_range_deg"] = base::Json::object();
    for (std::size_t i = 0; i < outcome.machine.model.rotaryCount(); ++i)
        out["rotary_range_deg"][outcome.machine.model.rotaryNames()[i]] = {
            base::degFromRad(summary.rotary_range_rad[i].first), base::degFromRad(summary.rotary_range_rad[i].second)};
    const auto& time = outcome.cycle_time;
    out["cycle_time_s"] = time ? base::Json(time->total()) : base::Json();
    out["cycle_time_dwell_s"] = time ? base::Json(time->dwell_s) : base::Json();
    out["cycle_time_basis"] = time ? base::Json(time->from_setup ? "setup" : "assumed") : base::Json();
    out["linear_travel"] = outcome.travel ? "checked" : "not checked";
    out["linear_range_mm"] = base::Json::object();
    for (std::size_t i = 0; outcome.travel && outcome.travel->moves > 0 && i < 3; ++i)
        out["linear_range_mm"][outcome.machine.model.linearNames()[i]] = {outcome.travel->range_mm[i].first,
                                                                          outcome.travel->range_mm[i].second};
    out["diagnostics"] = base::diagnosticsToJson(outcome.report);
    return out;
}

}  // namespace cusp::cli
