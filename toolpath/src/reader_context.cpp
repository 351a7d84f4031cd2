// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Shared steps of the statement handlers.
#include "reader_context.hpp"

#include <fmt/format.h>

namespace cusp::toolpath::detail {

void ReaderContext::requireUnit() {
    if (unit_source != UnitSource::Unknown || unit_reported) {
        return;
    }
    unit_reported = true;
    error(
        "cl.unit-unknown",
        "the file does not say whether it is in mm or inch: no UNITS statement, and no feed in MMPM, MMPR, IPM or IPR; "
        "say which with --units mm or --units inch");
}

void ReaderContext::callOwedTool() {
    if (!tool.call_owed) {
        return;
    }
    loaded_number = tool.number;
    emit(ToolCall{tool.number, tool.name, tool.cutter});
    const std::string name = tool.name;
    tool = ToolDescription{};  // what was told is told of this call only
    if (dialect->tool_name_rule == ToolNameRule::OperationHeader) {
        tool.name = name;  // which the next header's is compared with
    }
}

void ReaderContext::settleTool() {
    callOwedTool();
    if (!tool.isSettled()) {
        tool.noted = true;
        warning("cl.tool-not-called", "a tool is described, but no LOADTL or LOAD/TOOL calls it before this motion");
    }
}

std::string inQuotes(std::string_view text) {
    constexpr std::size_t most = 60;
    text = trimmed(text);
    if (text.size() <= most) {
        return std::string(text);
    }
    std::size_t end = most;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) {
        --end;  // not inside a UTF-8 character
    }
    return std::string(text.substr(0, end)) + "…";
}

bool takeNumbers(ReaderContext& context, std::string_view word, const Fields& fields, std::size_t first,
                 std::size_t count, double* out) {
    for (std::size_t i = first; i < first + count; ++i) {
        if (i >= fields.size()) {
            context.error("cl.syntax", fmt::format("{}: a number is missing", word));
            return false;
        }
        if (!fields[i].is_number) {
            context.error("cl.number", fmt::format("{}: '{}' is not a number", word, inQuotes(fields[i].text)));
            return false;
        }
        out[i - first] = fields[i].number;
    }
    return true;
}

std::optional<geometry::Vector3> unitAxis(ReaderContext& context, std::string_view word, const double* ijk) {
    // CL files print axes with 5 to 7 decimals: anything further off is not a unit vector but a mistake.
    constexpr double length_tolerance = 1e-3;
    const geometry::Vector3 axis(ijk[0], ijk[1], ijk[2]);
    const double length = axis.norm();
    if (!(std::abs(length - 1.0) <= length_tolerance)) {
        context.error("cl.axis", fmt::format("{}: the axis {},{},{} has length {:.6g}; it must be 1", word, ijk[0],
                                             ijk[1], ijk[2], length));
        return std::nullopt;
    }
    return normalisedOnce(axis, length);
}

}  // namespace cusp::toolpath::detail
