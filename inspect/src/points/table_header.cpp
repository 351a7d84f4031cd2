// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Columns from the names in a header.
#include "points/table_header.hpp"

#include "points/point_text.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace cusp::inspect {
namespace {

enum class Role { Other, X, Y, Z, I, J, K, Section, Weight };

struct ColumnName {
    std::string word;  ///< lower case, without the unit, '_' for what joins words
    std::string unit;
};

/// "X [mm]", "x (inch)", "x_mm" fall into name and unit.
ColumnName parted(std::string_view name) {
    ColumnName out{lowered(trimmed(name)), {}};
    const std::size_t bracket = out.word.find_first_of("[(");
    if (bracket != std::string::npos) {
        const std::size_t end = out.word.find_first_of("])", bracket);
        out.unit = out.word.substr(bracket + 1, end == std::string::npos ? end : end - bracket - 1);
        out.word = std::string(trimmed(std::string_view(out.word).substr(0, bracket)));
    }
    std::replace_if(out.word.begin(), out.word.end(), [](char c) { return c == ' ' || c == '-' || c == '.'; }, '_');
    const std::size_t last = out.word.rfind('_');
    if (out.unit.empty() && last != std::string::npos && last > 0 && unitLength(out.word.substr(last + 1))) {
        out.unit = out.word.substr(last + 1);
        out.word.resize(last);
    }
    return out;
}

Role roleOf(const std::string& word) {
    struct Names {
        Role role;
        std::vector<std::string_view> words;
    };
    static const std::vector<Names> table{
        {Role::X,
         {"x", "px", "x_act", "act_x", "actual_x", "x_actual", "x_meas", "meas_x", "measured_x", "x_measured"}},
        {Role::Y,
         {"y", "py", "y_act", "act_y", "actual_y", "y_actual", "y_meas", "meas_y", "measured_y", "y_measured"}},
        {Role::Z,
         {"z", "pz", "z_act", "act_z", "actual_z", "z_actual", "z_meas", "meas_z", "measured_z", "z_measured"}},
        {Role::I, {"i", "nx", "ni", "normal_x", "normalx", "dir_x", "vx"}},
        {Role::J, {"j", "ny", "nj", "normal_y", "normaly", "dir_y", "vy"}},
        {Role::K, {"k", "nz", "nk", "normal_z", "normalz", "dir_z", "vz"}},
        {Role::Section, {"section", "section_x", "section_y", "section_z", "cut", "profile", "line"}},
        {Role::Weight, {"weight", "weights"}}};
    for (const Names& names : table)
        if (std::find(names.words.begin(), names.words.end(), word) != names.words.end()) return names.role;
    return Role::Other;
}

/// The one column of a role; an error when there are two.
std::optional<std::size_t> only(const std::vector<Role>& roles, Role role, const std::vector<std::string_view>& names,
                                std::uint64_t line, PointCollector& out) {
    const auto first = std::find(roles.begin(), roles.end(), role);
    if (first == roles.end()) return std::nullopt;
    const auto second = std::find(first + 1, roles.end(), role);
    const auto at = static_cast<std::size_t>(first - roles.begin());
    if (second != roles.end())
        out.error("points.header",
                  fmt::format("columns {} and {} mean the same; say with --columns which one counts",
                              inQuotes(names[at]), inQuotes(names[static_cast<std::size_t>(second - roles.begin())])),
                  line);
    return at;
}

/// The unit all coordinate columns agree on.
void takeUnit(const std::vector<ColumnName>& columns, const std::array<std::size_t, 3>& position, std::uint64_t line,
              TableLayout& layout, PointCollector& out) {
    for (const std::size_t column : position) {
        const std::string& unit = columns[column].unit;
        if (unit.empty()) continue;
        const auto length = unitLength(unit);
        if (!length)
            out.error("points.unit", fmt::format("the unit {} in the header is not known", inQuotes(unit)), line);
        else if (layout.mm_per_unit && *layout.mm_per_unit != *length)
            out.error("points.unit", "the coordinates in the header have different units", line);
        else
            layout.mm_per_unit = length;
    }
}

}  // namespace

bool columnsFromNames(const std::vector<std::string_view>& names, std::uint64_t line, TableLayout& layout,
                      PointCollector& out) {
    std::vector<ColumnName> columns;
    std::vector<Role> roles;
    std::string unused;
    for (const std::string_view name : names) {
        columns.push_back(parted(name));
        roles.push_back(roleOf(columns.back().word));
        if (roles.back() == Role::Other && !name.empty()) unused += (unused.empty() ? "" : ", ") + std::string(name);
    }
    const auto x = only(roles, Role::X, names, line, out);
    const auto y = only(roles, Role::Y, names, line, out);
    const auto z = only(roles, Role::Z, names, line, out);
    if (!x || !y || !z) {
        out.error("points.header",
                  fmt::format("the header has no column {}; its columns are {}; say with --columns which is which",
                              !x ? "x" : (!y ? "y" : "z"), fmt::join(names, ", ")),
                  line);
        return false;
    }
    layout.position = {*x, *y, *z};
    const auto i = only(roles, Role::I, names, line, out);
    const auto j = only(roles, Role::J, names, line, out);
    const auto k = only(roles, Role::K, names, line, out);
    if (i && j && k) layout.direction = {*i, *j, *k};
    layout.section = only(roles, Role::Section, names, line, out);
    layout.weight = only(roles, Role::Weight, names, line, out);
    if (layout.section) {
        const std::string& word = columns[*layout.section].word;
        layout.section_axis = word.ends_with("_x") ? 0 : (word.ends_with("_y") ? 1 : (word.ends_with("_z") ? 2 : -1));
    }
    takeUnit(columns, layout.position, line, layout, out);
    if (!unused.empty()) out.note("points.unused-columns", "columns not used: " + unused, line);
    return !out.hasErrors();
}

}  // namespace cusp::inspect
