// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// CUTTER, TLDATA, TOOL PATH, TOOLNO, TPRINT, LOADTL, LOAD/TOOL: which tool, and its shape.
#include "statement_table.hpp"
#include "tool_shape.hpp"

#include <cusp/base/units.hpp>

#include <fmt/format.h>

namespace cusp::toolpath::detail {
namespace {

void refuseTurning(ReaderContext& context, std::string_view statement) {
    context.stop("cl.turning", fmt::format("this is a turning program ({}); cusp mills", statement));
}

void takeCutter(ReaderContext& context, std::string_view word, std::string_view body, const geometry::Cutter& cutter) {
    if (!isPossible(cutter)) {
        context.error("cl.cutter", fmt::format("{}/{} is not a possible cutter", word, inQuotes(body)));
        return;
    }
    context.tool.cutter = cutter;
    context.tool.fresh = true;
}

/// MILL: diameter, lower corner radius, height, taper angle, tip angle; with 7 values also where the corner circle lies,
/// with 10 an upper one, which APT's shape has no place for.
std::optional<geometry::Cutter> nxMillShape(ReaderContext& context, std::string_view word, const Fields& fields) {
    constexpr std::size_t most = 10;
    std::array<double, most> v{};
    if (!takeNumbers(context, word, fields, 1, fields.size() - 1, v.data())) {
        return std::nullopt;
    }
    const double unit = context.mm_per_unit;
    geometry::Cutter cutter =
        millShape(v[0] * unit, v[1] * unit, v[2] * unit, base::radFromDeg(v[3]), base::radFromDeg(v[4]));
    if (v[7] != 0.0) {
        return std::nullopt;
    }
    if (fields.size() > 6 && (v[5] != 0.0 || v[6] != 0.0)) {
        cutter.corner_e_mm = v[5] * unit;
        cutter.corner_f_mm = v[6] * unit;
    }
    return cutter;
}

/// DRILL, the kind of operation, diameter, corner radius, length, point angle (between the edges), flute length.
std::optional<geometry::Cutter> drillShape(ReaderContext& context, std::string_view word, const Fields& fields) {
    constexpr std::size_t count = 5;
    std::array<double, count> v{};
    if (fields.size() != 2 + count || fields[1].is_number || !takeNumbers(context, word, fields, 2, count, v.data())) {
        return std::nullopt;
    }
    const double unit = context.mm_per_unit;
    constexpr double flat_deg = 180.0;
    return millShape(v[0] * unit, v[1] * unit, v[4] * unit, 0.0, base::radFromDeg((flat_deg - v[3]) / 2.0));
}

/// "17.0" and "17" are tool 17; anything else is not a number of a tool.
std::optional<std::int64_t> toolNumber(const Field& field) {
    constexpr double largest = 1e9;
    if (!field.is_number || field.number < 0.0 || field.number > largest || field.number != std::floor(field.number)) {
        return std::nullopt;
    }
    return static_cast<std::int64_t>(field.number);
}

}  // namespace

void handleCutter(ReaderContext& context, std::string_view word, std::string_view body) {
    const Fields fields(body);
    constexpr std::size_t most = 7;
    if (fields.empty() || fields.size() > most) {
        context.error("cl.syntax", fmt::format("{} takes 1 to 7 values, not {}", word, fields.size()));
        return;
    }
    std::array<double, most> values{};
    if (!takeNumbers(context, word, fields, 0, fields.size(), values.data())) {
        return;
    }
    geometry::Cutter cutter;
    cutter.diameter_mm = values[0] * context.mm_per_unit;
    cutter.corner_radius_mm = values[1] * context.mm_per_unit;
    cutter.corner_e_mm =
        fields.size() > 2 ? values[2] * context.mm_per_unit : cutter.diameter_mm / 2.0 - cutter.corner_radius_mm;
    cutter.corner_f_mm = fields.size() > 3 ? values[3] * context.mm_per_unit : cutter.corner_radius_mm;
    cutter.point_angle_rad = base::radFromDeg(values[4]);
    cutter.taper_angle_rad = base::radFromDeg(values[5]);
    cutter.cutting_height_mm = values[6] * context.mm_per_unit;
    takeCutter(context, word, body, cutter);
}

void handleTldata(ReaderContext& context, std::string_view word, std::string_view body) {
    const Fields fields(body);
    if (fields.contains("TURN")) {
        refuseTurning(context, "TLDATA/TURN");
        return;
    }
    const std::size_t values = fields.size() - (fields.empty() ? 0 : 1);
    const std::size_t errors_before = context.report.errorCount();
    std::optional<geometry::Cutter> cutter;
    if (fields.empty() || fields.truncated() || !(fields[0].is("MILL") || fields[0].is("DRILL"))) {
    } else if (fields[0].is("DRILL")) {
        cutter = drillShape(context, word, fields);
    } else if (values == 5 || values == 7 || values == 10) {
        cutter = nxMillShape(context, word, fields);
    }
    if (context.report.errorCount() > errors_before) {
        return;
    }
    if (!cutter) {
        context.warning("cl.tool-shape", fmt::format("{}/{}: only MILL with 5 or 7 values and DRILL with 5 are "
                                                     "understood; the tool is called without its shape",
                                                     word, inQuotes(body)));
        context.tool.cutter.reset();
        return;
    }
    takeCutter(context, word, body, *cutter);
    context.tool.fresh = false;  // TOOL PATH owes the call, not TLDATA
}

void handleToolPath(ReaderContext& context, std::string_view word, std::string_view body) {
    constexpr std::string_view separator = ",TOOL,";
    body = trimmed(body);
    const std::size_t at = body.rfind(separator);
    if (at == std::string_view::npos) {
        context.error("cl.syntax", fmt::format("{}/operation,TOOL,name is expected", word));
        return;
    }
    context.path_ended = false;
    context.emit(OperationStart{std::string(trimmed(body.substr(0, at)))});
    const std::string_view name = trimmed(body.substr(at + separator.size()));
    if (name != context.tool.name) {
        context.tool = ToolDescription{};
        context.tool.name = name;
        context.tool.call_owed = true;
    }
}

void handleToolno(ReaderContext& context, std::string_view word, std::string_view body) {
    const Fields fields(body);
    if (fields.contains("TURN")) {
        refuseTurning(context, fmt::format("TOOLNO/{},TURN", inQuotes(fields[0].text)));
        return;
    }
    const std::optional<std::int64_t> number = fields.empty() ? std::nullopt : toolNumber(fields[0]);
    if (!number) {
        context.error("cl.tool", fmt::format("{}/{}: the tool's number is expected first", word, inQuotes(body)));
        return;
    }
    context.tool.number = number;
    context.tool.fresh = true;
}

void handleTprint(ReaderContext& context, std::string_view /*word*/, std::string_view body) {
    // Name, comment, assembly: the first is the tool.
    context.tool.name = trimmed(body.substr(0, body.find(',')));
    context.tool.fresh = true;
}

void handleLoad(ReaderContext& context, std::string_view word, std::string_view body) {
    const Fields fields(body);
    const bool load_tool = word == "LOAD";
    const std::size_t at = load_tool ? 1 : 0;
    if (load_tool && (fields.empty() || !fields[0].is("TOOL"))) {
        context.error("cl.tool", fmt::format("{}/{} is not understood; LOAD/TOOL,number is", word, inQuotes(body)));
        return;
    }
    std::optional<std::int64_t> number = fields.size() > at ? toolNumber(fields[at]) : std::nullopt;
    if (!number) {
        context.error("cl.tool", fmt::format("{}/{}: the tool's number is expected", word, inQuotes(body)));
        return;
    }
    if (context.dialect->tool_name_rule == ToolNameRule::OperationHeader) {
        if (*number == 0) {
            number.reset();  // NX writes 0 for a tool that was given no number; the name identifies it
        }
    } else if (!context.tool.fresh && number == context.loaded_number) {
        return;  // CATIA repeats LOADTL at every operation of the tool in the spindle
    } else if (context.tool.number && context.tool.number != number) {
        // What TOOLNO, TPRINT and CUTTER told was about another tool.
        context.warning("cl.tool",
                        fmt::format("{} calls tool {}, but TOOLNO described tool {}: the tool is called without "
                                    "name and shape",
                                    word, *number, *context.tool.number));
        context.tool = ToolDescription{};
    }
    context.tool.number = number;
    context.tool.call_owed = true;
    context.callOwedTool();
}

void handleTurret(ReaderContext& context, std::string_view word, std::string_view body) {
    refuseTurning(context, fmt::format("{}/{}", word, Fields(body).empty() ? "" : Fields(body)[0].text));
}

}  // namespace cusp::toolpath::detail
