// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Runs the reader into the alignment, and prints the report.
#include <cusp/post/verify/verify_program.hpp>

#include "alignment.hpp"

#include <cusp/post/reader/program_reader.hpp>
#include <fmt/format.h>

namespace cusp::post::verify {

namespace {

/// What a CL file may hold and no program can be compared with.
base::Diagnostics incomparable(const toolpath::ToolPath& path) {
    base::Diagnostics report;
    for (const toolpath::ClRecord& record : path.records)
        if (std::holds_alternative<toolpath::SplineMotion>(record.statement))
            report.error("verify.unsupported", "a NURBS curve is not compared with programs",
                         {path.file_name, record.line, 0, {}});
    return report;
}

}  // namespace

base::Result<VerifyReport> verifyProgram(std::istream& program, const std::string& program_name,
                                         const MachineFile& machine, const toolpath::ToolPath* against,
                                         const VerifyOptions& options) {
    if (against != nullptr)
        if (auto refused = incomparable(*against); refused.hasErrors()) return base::fail(std::move(refused));
    VerifyReport report;
    ExpectedPath expected;
    if (against != nullptr) expected = expectedPath(*against);
    report.compared = against != nullptr;
    report.points = expected.points.size();
    Alignment alignment(machine, against != nullptr ? &expected : nullptr, options, program_name, report);
    reader::ReaderOptions reader_options;
    reader_options.strict = options.strict;
    reader_options.setup = {options.tool_length_mm, options.wcs_origin_mm, options.setup};
    base::Diagnostics read;
    const reader::ReadSummary summary =
        reader::readProgram(program, program_name, machine, reader_options, alignment, read);
    if (read.hasErrors()) return base::fail(std::move(read));
    alignment.finish();
    report.blocks = summary.blocks;
    report.motions = summary.motions;
    report.linear_travel_checked = report.travel_checked > 0 && report.travel_unchecked == 0;
    report.findings.append(read);
    report.pass = !report.findings.hasErrors();
    return report;
}

namespace {

std::string placeText(const Extreme& extreme) {
    if (extreme.program_line == 0) return {};
    const std::string block = extreme.block_number
                                  ? fmt::format("block N{} (line {})", *extreme.block_number, extreme.program_line)
                                  : fmt::format("line {}", extreme.program_line);
    return fmt::format("  at {}, CL line {}", block, extreme.cl_line);
}

std::string errorLine(std::string_view name, const Extreme& tip_mm, const Extreme& axis_rad) {
    const Extreme axis_deg{base::degFromRad(axis_rad.value), axis_rad.program_line, axis_rad.block_number,
                           axis_rad.cl_line};
    return fmt::format("{:<22}tip {:.3g} mm{}\n{:<22}axis {:.3g}°{}\n", name, tip_mm.value, placeText(tip_mm), "",
                       axis_deg.value, placeText(axis_deg));
}

}  // namespace

std::string toText(const VerifyReport& report) {
    std::string text = fmt::format("{:<22}{} with words, {} of them move\n", "blocks", report.blocks, report.motions);
    if (report.compared) {
        text += fmt::format("{:<22}{} in the CL file: {} met, {} not\n", "points", report.points, report.matched,
                            report.missed);
        text += fmt::format("{:<22}{} on the way between points, {} links, {} leading nowhere\n", "other motions",
                            report.intermediate, report.links, report.extra);
        if (report.excursions > 0)
            text += fmt::format("{:<22}{}, off the part and back to the same place\n", "excursions", report.excursions);
        text += errorLine("at block ends", report.max_tip_error_mm, report.max_axis_error_rad);
        text += errorLine("between, in cuts", report.max_tip_between_mm, report.max_axis_between_rad);
        text += errorLine("between, in rapids", report.max_tip_between_rapid_mm, report.max_axis_between_rapid_rad);
    }
    text += fmt::format("{:<22}{}\n", "rotary limits",
                        report.limit_violations > report.travel_violations
                            ? fmt::format("{} violations", report.limit_violations - report.travel_violations)
                        : report.rotary_limits_checked
                            ? std::string("kept")
                            : std::string("kept where rotary values are programmed, else not checked"));
    text += fmt::format(
        "{:<22}{}\n", "linear travel",
        report.travel_checked == 0 ? std::string("not checked (no setup)")
        : report.travel_violations > 0
            ? fmt::format("{} violations", report.travel_violations)
            : fmt::format("kept{}", report.linear_travel_checked
                                        ? std::string()
                                        : fmt::format(", but {} motions not checked", report.travel_unchecked)));
    return text + fmt::format("{:<22}{}\n", "result", report.pass ? "pass" : "FAIL");
}

}  // namespace cusp::post::verify
