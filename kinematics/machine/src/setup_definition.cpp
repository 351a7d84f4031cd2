// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The field table of a setup file, its rules, and its two questions.
#include <cusp/machine/setup_definition.hpp>

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <utility>

namespace cusp::machine {
namespace {

using base::Diagnostics;
using base::Location;
using base::Section;
using base::TomlNode;

Location at(const TomlNode& table, std::string_view key) {
    const auto node = table.at(key);
    return node ? node->where() : table.whereKey(key);
}

std::vector<TomlNode> elementsOf(const TomlNode& root, std::string_view key) {
    const auto node = root.at(key);
    return node ? node->elements() : std::vector<TomlNode>();
}

void checkTool(const SetupTool& tool, const TomlNode& table, Diagnostics& report) {
    if (!tool.number && tool.name.empty())
        report.error("setup.tool-unnamed", "a tool needs the number or the name the program calls it by",
                     table.where());
}

void checkFixture(const Fixture& fixture, const TomlNode& table, Diagnostics& report) {
    const bool box = fixture.min_mm || fixture.max_mm;
    if (box == !fixture.stl.empty() || (box && !(fixture.min_mm && fixture.max_mm))) {
        report.error("setup.fixture-shape", "a fixture is either a box (min_mm and max_mm) or a mesh (stl)",
                     table.where());
        return;
    }
    for (std::size_t i = 0; box && i < 3; ++i)
        if (!((*fixture.min_mm)[i] < (*fixture.max_mm)[i])) {
            report.error("setup.fixture-order",
                         fmt::format("min_mm[{0}] ({1:g}) must lie below max_mm[{0}] ({2:g})", i, (*fixture.min_mm)[i],
                                     (*fixture.max_mm)[i]),
                         at(table, "min_mm"));
        }
}

void checkTools(const SetupDefinition& setup, const TomlNode& root, Diagnostics& report) {
    std::set<std::string> names;
    std::set<std::int64_t> numbers;
    const std::vector<TomlNode> tables = elementsOf(root, "tool");
    for (std::size_t i = 0; i < std::min(tables.size(), setup.tools.size()); ++i) {
        const SetupTool& tool = setup.tools[i];
        if (!tool.name.empty() && !names.insert(tool.name).second)
            report.error("setup.tool-duplicate", fmt::format("another tool is named \"{}\" too", tool.name),
                         at(tables[i], "name"));
        if (tool.number && !numbers.insert(*tool.number).second)
            report.error("setup.tool-duplicate", fmt::format("another tool has number {} too", *tool.number),
                         at(tables[i], "number"));
    }
}

void checkFrames(const SetupDefinition& setup, const TomlNode& root, Diagnostics& report) {
    const std::vector<TomlNode> tables = elementsOf(root, "fixture");
    for (std::size_t i = 0; i < std::min(tables.size(), setup.fixtures.size()); ++i) {
        const std::string& frame = setup.fixtures[i].work_offset;
        if (!frame.empty() && setup.findOffset(frame) == nullptr)
            report.error("setup.fixture-frame", fmt::format("the setup has no work offset \"{}\"", frame),
                         at(tables[i], "work_offset"));
    }
}

void checkSetup(const SetupDefinition& setup, const TomlNode& root, Diagnostics& report) {
    if (setup.schema != 1)
        report.error("setup.schema-version",
                     fmt::format("schema {} is not known; this version reads schema 1", setup.schema),
                     at(root, "schema"));
    if (setup.work_offsets.empty())
        report.error("setup.no-offset", "a setup needs at least one work offset, such as [work_offset.G54]",
                     at(root, "work_offset"));
    checkTools(setup, root, report);
    checkFrames(setup, root, report);
}

Section<WorkOffset> offsetSection() {
    Section<WorkOffset> section("Where the workpiece frame of a work offset lies.");
    section.field("origin_mm", &WorkOffset::origin_mm,
                  "Its origin in the machine frame, all axes at zero: what the control shows for the offset, plus the "
                  "machine file's gauge point. Its axes are the machine's.",
                  base::required());
    return section;
}

Section<SetupTool> toolSection() {
    Section<SetupTool> section("A tool in this machine.");
    section
        .field("number", &SetupTool::number, "Number by which the program calls it, where the program gives no name.")
        .field("name", &SetupTool::name, "Name by which the program calls it.")
        .field("length_mm", &SetupTool::length_mm, "From the spindle's gauge point to the tip.",
               base::requiredPositive())
        .check(checkTool);
    return section;
}

Section<Fixture> fixtureSection() {
    Section<Fixture> section("Something that stands in the machine, a box or a mesh. No check uses it yet.");
    section.field("name", &Fixture::name, "What it is.", base::required())
        .field("work_offset", &Fixture::work_offset,
               "Work offset in whose frame it is given; empty: the machine frame with all axes at zero.")
        .field("min_mm", &Fixture::min_mm, "Of a box: its lowest corner.")
        .field("max_mm", &Fixture::max_mm, "Of a box: its highest corner.")
        .field("stl", &Fixture::stl, "Of a mesh: its STL file.")
        .check(checkFixture);
    return section;
}

Section<SetupDefinition> buildSetupSection() {
    Section<SetupDefinition> section("A setup: where the workpiece lies in the machine, and how long the tools are.");
    section.field("schema", &SetupDefinition::schema, "Version of this file format; 1.", base::required())
        .field("name", &SetupDefinition::name, "Name of the setup.", base::required())
        .field("description", &SetupDefinition::description, "What it is for.")
        .field("tool_library", &SetupDefinition::tool_library,
               "Tool library, beside this file or by its full path; its gauge lengths hold for tools not listed here.")
        .named("work_offset", &SetupDefinition::work_offsets, offsetSection(), base::required())
        .tables("tool", &SetupDefinition::tools, toolSection())
        .tables("fixture", &SetupDefinition::fixtures, fixtureSection())
        .check(checkSetup);
    return section;
}

base::Result<SetupDefinition> readDocument(base::Result<base::TomlDocument> document) {
    if (!document) return base::fail(std::move(document).error());
    Diagnostics report;
    SetupDefinition setup = setupSection().read(document->root(), report);
    if (report.hasErrors()) return base::fail(std::move(report));
    return setup;
}

}  // namespace

const WorkOffset* SetupDefinition::findOffset(const std::string& offset) const {
    const auto found = work_offsets.find(offset);
    return found == work_offsets.end() ? nullptr : &found->second;
}

std::optional<double> SetupDefinition::toolLength(std::optional<std::int64_t> number, std::string_view tool) const {
    for (const SetupTool& known : tools)
        if (tool.empty() ? number && known.number == number : known.name == tool) return known.length_mm;
    return std::nullopt;
}

const base::Section<SetupDefinition>& setupSection() {
    static const Section<SetupDefinition> section = buildSetupSection();
    return section;
}

base::Result<SetupDefinition> readSetupFile(const std::string& path) {
    return readDocument(base::TomlDocument::readFile(path));
}

base::Result<SetupDefinition> readSetup(std::string_view text, const std::string& file_name) {
    return readDocument(base::TomlDocument::parse(text, file_name));
}

}  // namespace cusp::machine
