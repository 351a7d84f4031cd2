// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The field table of a tool library and what must hold between its values.
#include "tool_shape.hpp"

#include <cusp/base/units.hpp>
#include <cusp/toolpath/tool_library.hpp>

#include <algorithm>
#include <fmt/format.h>
#include <set>

namespace cusp::toolpath {
namespace {

using base::Diagnostics;
using base::Location;
using base::Section;
using base::TomlNode;

Location at(const TomlNode& table, std::string_view key) {
    const std::optional<TomlNode> node = table.at(key);
    return node ? node->where() : table.whereKey(key);
}

void checkCorner(const Tool& tool, const TomlNode& table, Diagnostics& report) {
    const bool has_corner = tool.corner_radius_mm.has_value();
    const bool needs_corner = tool.shape == Tool::Shape::Toroidal;
    const bool may_have_corner = needs_corner || tool.shape == Tool::Shape::Tapered;
    if (has_corner && !may_have_corner) {
        report.error("tool.corner-radius", "a flat or a ball mill has no corner radius of its own",
                     at(table, "corner_radius_mm"));
    } else if (needs_corner &&
               (!has_corner || !(*tool.corner_radius_mm > 0.0) || !(*tool.corner_radius_mm < tool.diameter_mm / 2.0))) {
        report.error("tool.corner-radius",
                     fmt::format("a toroidal mill needs a corner radius above 0 and below half its diameter, {:g} mm",
                                 tool.diameter_mm / 2.0),
                     at(table, "corner_radius_mm"));
    }
}

void checkTaper(const Tool& tool, const TomlNode& table, Diagnostics& report) {
    const bool tapered = tool.shape == Tool::Shape::Tapered;
    if (tapered != tool.taper_rad.has_value()) {
        report.error("tool.taper", tapered ? "a tapered mill needs taper_deg" : "only a tapered mill has a taper angle",
                     at(table, "taper_deg"));
    } else if (tapered && !(tool.cutter().corner_e_mm >= 0.0)) {
        report.error("tool.corner-radius", "the corner radius is too large for the diameter and the taper",
                     at(table, "corner_radius_mm"));
    }
}

void checkStack(const Tool& tool, const TomlNode& table, Diagnostics& report) {
    double height_mm = tool.cutting_height_mm;
    for (const auto& [key, rings] : {std::pair{"shank_mm", &tool.shank_mm}, std::pair{"holder_mm", &tool.holder_mm}}) {
        for (std::size_t i = 0; i < rings->size(); ++i) {
            const ToolRing& ring = (*rings)[i];
            if (ring.size() != 2 && ring.size() != 3) {
                report.error("tool.ring",
                             fmt::format("ring {}: it must be [height, diameter], or [height, lower diameter, upper "
                                         "diameter], not {} numbers",
                                         i + 1, ring.size()),
                             at(table, key));
                continue;
            }
            height_mm += ring[0];
            if (std::any_of(ring.begin(), ring.end(), [](double length) { return !(length > 0.0); })) {
                report.error("tool.ring",
                             fmt::format("ring {}: height and diameters must be above 0; they are {:g} mm", i + 1,
                                         fmt::join(ring, ", ")),
                             at(table, key));
            }
        }
    }
    constexpr double rounding_mm = 1e-9;
    if (height_mm > tool.gauge_length_mm + rounding_mm) {
        report.error(
            "tool.gauge-length",
            fmt::format("cutting height, shank and holder are {:g} mm high, more than the gauge length of {:g} mm",
                        height_mm, tool.gauge_length_mm),
            at(table, "gauge_length_mm"));
    }
}

void checkTool(const Tool& tool, const TomlNode& table, Diagnostics& report) {
    if (tool.number && *tool.number < 1) {
        report.error("tool.number", fmt::format("a tool's number is 1 or more, not {}", *tool.number),
                     at(table, "number"));
    }
    if (tool.name.empty()) {
        report.error("tool.name", "a tool needs a name", at(table, "name"));
    }
    checkCorner(tool, table, report);
    checkTaper(tool, table, report);
    checkStack(tool, table, report);
}

void checkLibrary(const ToolLibrary& library, const TomlNode& root, Diagnostics& report) {
    if (library.schema != 1) {
        report.error("tool.schema-version",
                     fmt::format("schema {} is not known; this version reads schema 1", library.schema),
                     at(root, "schema"));
    }
    const std::optional<TomlNode> tables = root.at("tool");
    const std::vector<TomlNode> elements = tables ? tables->elements() : std::vector<TomlNode>();
    std::set<std::string> names;
    std::set<std::int64_t> numbers;
    for (std::size_t i = 0; i < std::min(library.tools.size(), elements.size()); ++i) {
        const Tool& tool = library.tools[i];
        if (!names.insert(tool.name).second) {
            report.error("tool.duplicate", fmt::format("another tool is named \"{}\" too", tool.name),
                         at(elements[i], "name"));
        }
        if (tool.number && !numbers.insert(*tool.number).second) {
            report.error("tool.duplicate", fmt::format("another tool has number {} too", *tool.number),
                         at(elements[i], "number"));
        }
    }
}

Section<Tool> toolSection() {
    constexpr base::FieldRules taper{.min = 0.0, .max = 60.0, .min_exclusive = true};
    constexpr base::FieldRules not_negative{.min = 0.0};
    Section<Tool> section("A tool.");
    section.field("number", &Tool::number, "Number by which a program calls it.")
        .field("name", &Tool::name, "Name by which a program calls it.", base::required())
        .choice("shape", &Tool::shape,
                {{"flat", Tool::Shape::Flat},
                 {"ball", Tool::Shape::Ball},
                 {"toroidal", Tool::Shape::Toroidal},
                 {"tapered", Tool::Shape::Tapered}},
                "Shape of the cutting part.", base::required())
        .field("diameter_mm", &Tool::diameter_mm,
               "Diameter; of a tapered mill where bottom and flank would meet without the corner.",
               base::requiredPositive())
        .field("corner_radius_mm", &Tool::corner_radius_mm,
               "Corner radius: of a toroidal mill, and of a tapered one unless its edge is sharp.", not_negative)
        .field("taper_deg", &Tool::taper_rad, "Of a tapered mill: the flank against the tool axis.", taper)
        .field("cutting_height_mm", &Tool::cutting_height_mm, "Height of the cutting part above the tip.",
               base::requiredPositive())
        .field("gauge_length_mm", &Tool::gauge_length_mm, "From the tip to the spindle's gauge plane.",
               base::requiredPositive())
        .field(
            "shank_mm", &Tool::shank_mm,
            "Rings from the cutting height upwards: [height, diameter], or [height, lower diameter, upper diameter].")
        .field("holder_mm", &Tool::holder_mm, "Rings from the shank upwards, likewise.")
        .check(checkTool);
    return section;
}

Section<ToolLibrary> librarySection() {
    Section<ToolLibrary> section("A library of tools.");
    section.field("schema", &ToolLibrary::schema, "Version of this file format; 1.", base::required())
        .field("name", &ToolLibrary::name, "Name of the library.", base::required())
        .field("description", &ToolLibrary::description, "What it holds.")
        .tables("tool", &ToolLibrary::tools, toolSection(), base::required())
        .check(checkLibrary);
    return section;
}

base::Result<ToolLibrary> readLibrary(base::Result<base::TomlDocument> document) {
    if (!document) {
        return base::fail(std::move(document).error());
    }
    Diagnostics report;
    ToolLibrary library = toolLibrarySection().read(document->root(), report);
    if (report.hasErrors()) {
        return base::fail(std::move(report));
    }
    return library;
}

}  // namespace

geometry::Cutter Tool::cutter() const {
    const double radius_mm = shape == Shape::Ball ? diameter_mm / 2.0 : corner_radius_mm.value_or(0.0);
    return detail::millShape(diameter_mm, radius_mm, cutting_height_mm, taper_rad.value_or(0.0), 0.0);
}

const Tool* ToolLibrary::findNumber(std::int64_t wanted) const {
    const auto tool = std::find_if(tools.begin(), tools.end(), [&](const Tool& t) { return t.number == wanted; });
    return tool == tools.end() ? nullptr : &*tool;
}

const Tool* ToolLibrary::findName(std::string_view wanted) const {
    const auto tool = std::find_if(tools.begin(), tools.end(), [&](const Tool& t) { return t.name == wanted; });
    return tool == tools.end() ? nullptr : &*tool;
}

const base::Section<ToolLibrary>& toolLibrarySection() {
    static const Section<ToolLibrary> section = librarySection();
    return section;
}

base::Result<ToolLibrary> readToolLibraryFile(const std::string& path) {
    return readLibrary(base::TomlDocument::readFile(path));
}

base::Result<ToolLibrary> readToolLibrary(std::string_view text, const std::string& file_name) {
    return readLibrary(base::TomlDocument::parse(text, file_name));
}

}  // namespace cusp::toolpath
