// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The field table of a tilting job and what must hold between its values.
#include <cusp/optimizer/tilt/tilt_job.hpp>

#include <cusp/toolpath/tool_library.hpp>

#include <algorithm>
#include <fmt/format.h>

namespace cusp::tilt {

namespace {

using base::Diagnostics;
using base::FieldRules;
using base::Section;
using base::TomlNode;

constexpr FieldRules above_zero = base::positive();
constexpr FieldRules not_negative{.min = 0.0};

base::Location at(const TomlNode& table, std::string_view key) {
    const auto node = table.at(key);
    return node ? node->where() : table.whereKey(key);
}

void checkTool(const TiltTool& tool, const TomlNode& node, Diagnostics& report) {
    if (tool.cutting_height_mm < tool.diameter_mm / 2.0)
        report.error(
            "tilt.tool",
            fmt::format("the ball of {:g} mm diameter is not whole: its cutting height must be at least {:g} mm",
                        tool.diameter_mm, tool.diameter_mm / 2.0),
            at(node, "cutting_height_mm"));
    for (const auto& [key, rings] : {std::pair{"shank_mm", &tool.shank_mm}, std::pair{"holder_mm", &tool.holder_mm}})
        for (std::size_t i = 0; i < rings->size(); ++i)
            if ((*rings)[i][0] <= 0.0 || (*rings)[i][1] <= 0.0 || (*rings)[i][2] <= 0.0)
                report.error("tilt.tool", fmt::format("ring {}: height and diameters must be above 0", i + 1),
                             at(node, key));
    if (tool.shank_mm.empty() && tool.holder_mm.empty())
        report.error("tilt.tool",
                     "without shank and holder nothing of the tool can collide; give shank_mm or holder_mm",
                     node.where());
}

void checkSearch(const TiltSearch& search, const TomlNode& node, Diagnostics& report) {
    if (search.survivors > search.offspring)
        report.error(
            "tilt.search",
            fmt::format("survivors is {}; at most offspring, {}, can survive", search.survivors, search.offspring),
            at(node, "survivors"));
}

void checkJob(const TiltJob& job, const TomlNode& root, Diagnostics& report) {
    if (job.schema != 1)
        report.error("tilt.schema-version",
                     fmt::format("schema {} is not known; this version reads schema 1", job.schema),
                     at(root, "schema"));
    if (job.cl_file.has_value() == job.path.has_value())
        report.error("tilt.path", "give either cl_file, a three-axis path, or [path], how to make one", root.where());
}

Section<TiltTool> toolSection() {
    using Tool = TiltTool;
    Section<Tool> section("The ball end mill, and what of it must not touch.");
    section.field("number", &Tool::number, "Number by which the program calls it.", {.min = 1.0})
        .field("name", &Tool::name, "Name by which the program calls it.")
        .field("diameter_mm", &Tool::diameter_mm, "Of the ball.", base::requiredPositive())
        .field("cutting_height_mm", &Tool::cutting_height_mm, "Up to here the tool cuts and may touch.",
               base::requiredPositive())
        .field("shank_mm", &Tool::shank_mm,
               "Rings from the cutting height upwards: height, lower diameter, upper diameter.")
        .field("holder_mm", &Tool::holder_mm, "Rings on the shank: height, lower diameter, upper diameter.")
        .field("clearance_mm", &Tool::clearance_mm, "Kept around shank and holder.", not_negative)
        .check(checkTool);
    return section;
}

Section<TiltSearch> searchSection() {
    using Search = TiltSearch;
    constexpr FieldRules at_least_one{.min = 1.0};
    Section<Search> section("How the tilt point is searched for (Weinert & Stautner 2004, 3.2).");
    section.field("center_mm", &Search::center_mm, "Middle of the cube in which tilt points are searched for.")
        .field("cube_mm", &Search::cube_mm, "Edge of the cube.", above_zero)
        .field("seed", &Search::seed, "The same seed gives the same result.", not_negative)
        .field("offspring", &Search::offspring, "Candidates per generation.", {.min = 2.0})
        .field("survivors", &Search::survivors, "That become parents.", at_least_one)
        .field("generations", &Search::generations, "At most, for each number of tilt points.", at_least_one)
        .field("most_points", &Search::most_points,
               "Tilt points; more than one only where fewer find no way free of collision.", {.min = 1.0, .max = 20.0})
        .field(
            "coarse_mm", &Search::coarse_mm,
            "Cell of the field of distances that candidates are looked up in; 2 and 8 times this apart are the places of "
            "the first looks.",
            above_zero)
        .field("proof_mm", &Search::proof_mm, "Resolution of the simulation that proves the winner.", above_zero)
        .check(checkSearch);
    return section;
}

}  // namespace

geometry::Cutter TiltTool::cutter() const {
    toolpath::Tool tool;
    tool.shape = toolpath::Tool::Shape::Ball;
    tool.diameter_mm = diameter_mm;
    tool.cutting_height_mm = cutting_height_mm;
    return tool.cutter();
}

double TiltTool::stickOutMm() const {
    double height = cutting_height_mm;
    for (const auto& ring : shank_mm) height += ring[0];
    return height;
}

double TiltTool::lengthMm() const {
    double height = stickOutMm();
    for (const auto& ring : holder_mm) height += ring[0];
    return height;
}

base::Result<simulation::ToolAssembly> TiltTool::assembly(double stick_out_mm) const {
    using simulation::ToolPart;
    auto out = simulation::assemblyOf(cutter());
    if (!out) return out;
    double height = cutting_height_mm;
    const auto stack = [&](ToolPart part, const std::array<double, 3>& ring, double below_mm) {
        const double from = height;
        height += ring[0];
        return out->addFrustum(part, from - below_mm, ring[1] + 2.0 * clearance_mm, height + clearance_mm,
                               ring[2] + 2.0 * clearance_mm);
    };
    // The clearance below the shank would reach into the cutter, which may touch.
    for (const auto& ring : shank_mm)
        if (auto ok = stack(ToolPart::Shank, ring, 0.0); !ok) return base::fail(ok.error());
    height = stick_out_mm;
    for (const auto& ring : holder_mm)
        if (auto ok = stack(ToolPart::Holder, ring, clearance_mm); !ok) return base::fail(ok.error());
    return out;
}

const Section<TiltJob>& tiltJobSection() {
    using Job = TiltJob;
    static const auto section =
        Section<Job>("A tilting job.")
            .field("schema", &Job::schema, "Version of this form: 1.", base::required())
            .field("name", &Job::name, "For people, and for the CL file.", base::required())
            .field("description", &Job::description, "For people.")
            .field("machine", &Job::machine, "Machine file, or the name of one that ships with cusp.", base::required())
            .field("origin_mm", &Job::origin_mm,
                   "Origin of the part's frame in the machine frame, all axes at zero (the work offset).")
            .table("part", &Job::part, partSection(), base::required())
            .table("tool", &Job::tool, toolSection(), base::required())
            .field("cl_file", &Job::cl_file, "A three-axis path, from any CAM; relative to the job file.")
            .table("path", &Job::path, threeAxisSection())
            .field("longest_cut_mm", &Job::longest_cut_mm,
                   "Cuts longer than this are divided, since the tool axis turns along them.", above_zero)
            .table("area", &Job::area, tiltAreaSection())
            .field("tilt_points_mm", &Job::tilt_points_mm,
                   "Tilt points given by hand; the path is tilted and judged, nothing is searched for.")
            .table("search", &Job::search, searchSection())
            .check(checkJob);
    return section;
}

namespace {

base::Result<TiltJob> jobOf(const base::Result<base::TomlDocument>& document) {
    if (!document) return base::fail(document.error());
    Diagnostics report;
    TiltJob job = tiltJobSection().read(document->root(), report);
    if (report.hasErrors()) return base::fail(std::move(report));
    return job;
}

}  // namespace

base::Result<TiltJob> readTiltJobFile(const std::string& path) { return jobOf(base::TomlDocument::readFile(path)); }
base::Result<TiltJob> readTiltJob(std::string_view text, const std::string& file_name) {
    return jobOf(base::TomlDocument::parse(text, file_name));
}

}  // namespace cusp::tilt
