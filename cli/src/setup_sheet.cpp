// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Tables for people who set up a machine: what to clamp, where, and what will run.
#include "setup_sheet.hpp"

#include "input.hpp"

#include <cusp/base/units.hpp>
#include <cusp/base/version.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <vector>

namespace cusp::cli {

namespace {

using geometry::Vector3;
using post::OperationRecord;

constexpr const char* by_hand = "______";

/// Bars would end a table's cell.
std::string cell(std::string text) {
    std::replace(text.begin(), text.end(), '|', '/');
    return text;
}

std::string point(const Vector3& p) {
    // Nothing is "-0.000".
    const auto rounded = [](double mm) { return std::round(mm * 1e3) / 1e3 + 0.0; };
    return fmt::format("X {:.3f}, Y {:.3f}, Z {:.3f}", rounded(p.x()), rounded(p.y()), rounded(p.z()));
}

std::string toolText(const OperationRecord& record) {
    std::string text = record.tool_number ? fmt::format("T{}", *record.tool_number) : std::string();
    if (!record.tool_name.empty()) text += (text.empty() ? "" : " ") + record.tool_name;
    return text.empty() ? "none called" : cell(text);
}

std::string cutterText(const OperationRecord& record) {
    if (!record.cutter) return "";
    return fmt::format("diameter {:g}, corner radius {:g}, cutting length {:g}", record.cutter->diameter_mm,
                       record.cutter->corner_radius_mm, record.cutter->cutting_height_mm);
}

std::string durationText(double seconds) {
    const auto whole = static_cast<long>(std::lround(seconds));
    return whole < 60 ? fmt::format("{} s", whole) : fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

std::vector<OperationRecord> worked(const PostOutcome& outcome) {
    std::vector<OperationRecord> records;
    for (const OperationRecord& record : outcome.summary.operation_records)
        if (record.locations > 0) records.push_back(record);
    return records;
}

std::string headText(const PostOutcome& outcome, const std::string& program_name) {
    std::string out = fmt::format("# Setup sheet: {}\n\n", program_name);
    out += fmt::format("* Machine: {}\n* CL file: {} ({})\n* Program: {}, {} blocks\n* Made by cusp {}\n",
                       outcome.machine.file.machine.name, fileNameOf(outcome.cl_file), outcome.dialect,
                       fileNameOf(outcome.output), outcome.blocks, base::version());
    if (outcome.cycle_time)
        out += fmt::format("* Cycle time: about {}, tool changes not counted{}\n",
                           durationText(outcome.cycle_time->total()),
                           outcome.cycle_time->from_setup ? "" : "; tool length and place of the workpiece assumed");
    if (!outcome.travel) out += "* Linear travel is NOT checked: posted without a setup file\n";
    for (const auto& diagnostic : outcome.report)
        if (diagnostic.severity == base::Severity::Warning)
            out += fmt::format("* Warning, CL line {}: {}\n", diagnostic.where.line, diagnostic.message);
    return out;
}

std::string offsetsText(const PostOutcome& outcome, const std::optional<machine::SetupDefinition>& setup) {
    std::string out =
        "\n## Work offsets\n\n| offset | zero point in the part | place in the machine |\n|---|---|---|\n";
    for (const post::UsedWorkOffset& used : outcome.summary.work_offsets) {
        const auto* placed = setup ? setup->findOffset(used.name) : nullptr;
        const Vector3 origin = used.part_from_programming.translation();
        const double turn = Eigen::AngleAxisd(used.part_from_programming.linear()).angle();
        std::string zero = used.line == 0 ? "the CL file's origin" : point(origin);
        if (turn > 1e-6) zero += fmt::format(", turned by {:.3f}°", base::degFromRad(turn));
        out += fmt::format("| {} | {} | {} |\n", used.name, zero,
                           placed != nullptr ? point(geometry::toVector(placed->origin_mm)) : by_hand);
    }
    return out;
}

std::string fixtureText(const machine::Fixture& fixture) {
    if (!fixture.stl.empty()) return "mesh " + cell(fixture.stl);
    return fmt::format("{} to {}", point(geometry::toVector(*fixture.min_mm)),
                       point(geometry::toVector(*fixture.max_mm)));
}

std::string fixturesText(const std::optional<machine::SetupDefinition>& setup) {
    if (!setup || setup->fixtures.empty()) return {};
    std::string out = "\n## Fixtures\n\nAs the setup file has them. The path is NOT checked against them.\n\n"
                      "| fixture | given in | where |\n|---|---|---|\n";
    for (const machine::Fixture& fixture : setup->fixtures)
        out += fmt::format("| {} | {} | {} |\n", cell(fixture.name),
                           fixture.work_offset.empty() ? "machine" : fixture.work_offset, fixtureText(fixture));
    return out;
}

std::string toolsText(const std::vector<OperationRecord>& records,
                      const std::optional<machine::SetupDefinition>& setup) {
    std::string out = "\n## Tools\n\nLength is from the spindle's gauge point to the tip, in mm.\n\n"
                      "| tool | cutter | length | highest speed | used by |\n|---|---|---|---|---|\n";
    std::vector<std::string> listed;
    for (const OperationRecord& record : records) {
        const std::string tool = toolText(record);
        if (std::find(listed.begin(), listed.end(), tool) != listed.end()) continue;
        listed.push_back(tool);
        double speed_rpm = 0.0;
        std::string users;
        std::size_t number = 0;
        for (const OperationRecord& user : records) {
            ++number;
            if (toolText(user) != tool) continue;
            speed_rpm = std::max(speed_rpm, user.speed_rpm);
            users += fmt::format("{}{}", users.empty() ? "" : ", ", number);
        }
        const auto length_mm = setup ? setup->toolLength(record.tool_number, record.tool_name) : std::nullopt;
        out += fmt::format("| {} | {} | {} | {:.0f} rev/min | {} |\n", tool, cutterText(record),
                           length_mm ? fmt::format("{:.3f}", *length_mm) : by_hand, speed_rpm, users);
    }
    return out;
}

std::string operationsText(const std::vector<OperationRecord>& records) {
    std::string out =
        "\n## Operations\n\nExtents are those of the tool tip in the work offset; times are at the programmed "
        "feeds, without rapids and holes.\n\n"
        "| | operation | CL line | tool | offset | lowest | highest | feed mm/min | cut | time | rapid |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|\n";
    std::size_t number = 0;
    for (const OperationRecord& record : records) {
        std::string feed = record.greatest_feed > 0.0 ? fmt::format("{:.0f}", record.greatest_feed) : "";
        if (record.greatest_feed > 0.0 && record.least_feed < record.greatest_feed)
            feed = fmt::format("{:.0f} to {:.0f}", record.least_feed, record.greatest_feed);
        const std::string holes = record.holes > 0 ? fmt::format(", {} holes", record.holes) : "";
        out += fmt::format("| {} | {} | {} | {} | {}{} | {} | {} | {} | {:.0f} mm{} | {} | {:.0f} mm |\n", ++number,
                           record.name.empty() ? "unnamed" : cell(record.name), record.line, toolText(record),
                           record.work_offset, record.tilted_plane ? ", tilted plane" : "", point(record.low_mm),
                           point(record.high_mm), feed, record.feed_length_mm, holes, durationText(record.feed_time_s),
                           record.rapid_length_mm);
    }
    return out;
}

}  // namespace

std::string setupSheet(const PostOutcome& outcome, const std::string& program_name,
                       const std::optional<machine::SetupDefinition>& setup) {
    const auto records = worked(outcome);
    return headText(outcome, program_name) + offsetsText(outcome, setup) + fixturesText(setup) +
           toolsText(records, setup) + operationsText(records);
}

}  // namespace cusp::cli
