// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The rules of a machine file; each message says what is wrong and what would be right.
#include "machine_checks.hpp"

#include <cusp/base/units.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace cusp::machine {
namespace {

using base::degFromRad;
using base::Diagnostics;
using base::Location;
using base::TomlNode;

// Below this sine two directions are the same to within a mistyped digit, and a solve would lose the answer.
constexpr double independent = 1e-3;

/// Where `key` of `table` is, or would be.
Location at(const TomlNode& table, std::string_view key) {
    const auto node = table.at(key);
    return node ? node->where() : table.whereKey(key);
}

Location at(const TomlNode& root, std::string_view table, const std::string& name) {
    const auto node = root.at(table);
    return node ? at(*node, name) : root.whereKey(table);
}

/// The value of `key`, or the table itself: for places of which the field table has already made sure.
TomlNode child(const TomlNode& table, std::string_view key) { return table.at(key).value_or(table); }

TomlNode element(const TomlNode& root, std::string_view key, std::size_t i) {
    const std::vector<TomlNode> elements = child(root, key).elements();
    return i < elements.size() ? elements[i] : root;
}

std::array<double, 3> cross(const Direction& a, const Direction& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

bool isIdentifier(std::string_view name) {
    const auto letter = [](char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_'; };
    const auto digit = [](char c) { return c >= '0' && c <= '9'; };
    return !name.empty() && letter(name.front()) &&
           std::all_of(name.begin(), name.end(), [&](char c) { return letter(c) || digit(c); });
}

void checkSchema(const MachineDefinition& machine, const TomlNode& root, Diagnostics& report) {
    if (machine.schema != 1)
        report.error("machine.schema-version",
                     fmt::format("schema {} is not known; this version reads schema 1", machine.schema),
                     at(root, "schema"));
}

void checkChainEnds(const MachineDefinition& machine, const TomlNode& root, Diagnostics& report) {
    const auto& chain = machine.chain;
    const Location where = at(root, "chain");
    if (chain.empty() || chain.front() != "workpiece" || std::count(chain.begin(), chain.end(), "workpiece") != 1)
        report.error("machine.chain-start", "the chain must start with \"workpiece\" and name it once", where);
    if (chain.empty() || chain.back() != "tool" || std::count(chain.begin(), chain.end(), "tool") != 1)
        report.error("machine.chain-end", "the chain must end with \"tool\" and name it once", where);
    if (const auto count = std::count(chain.begin(), chain.end(), "base"); count != 1)
        report.error(
            "machine.chain-base",
            fmt::format("the chain must name \"base\", the standing part, exactly once; it does so {} times", count),
            where);
}

void checkChainNames(const MachineDefinition& machine, const TomlNode& root, Diagnostics& report) {
    std::map<std::string, int> seen;
    for (const std::string& name : machine.axisNames()) {
        if (++seen[name] == 2)
            report.error("machine.chain-duplicate", fmt::format("axis \"{}\" stands in the chain more than once", name),
                         at(root, "chain"));
        if (seen[name] > 1) continue;
        if (!isIdentifier(name)) {
            report.error("machine.axis-name",
                         fmt::format("\"{}\" cannot name an axis: a letter, then letters and digits", name),
                         at(root, "chain"));
            continue;
        }
        const bool is_linear = machine.linear.contains(name);
        const bool is_rotary = machine.rotary.contains(name);
        if (!is_linear && !is_rotary)
            report.error("machine.axis-undefined",
                         fmt::format("axis \"{0}\" has neither a [linear.{0}] nor a [rotary.{0}] table", name),
                         at(root, "chain"));
        if (is_linear && is_rotary)
            report.error("machine.axis-twice", fmt::format("axis \"{}\" is defined both as linear and as rotary", name),
                         at(root, "rotary", name));
    }
    const auto unused = [&](std::string_view table, const std::string& name) {
        // A chain without any axis has been reported as such.
        if (!seen.empty() && !seen.contains(name))
            report.error("machine.axis-unused", fmt::format("axis \"{}\" does not stand in the chain", name),
                         at(root, table, name));
    };
    for (const auto& [name, axis] : machine.linear) unused("linear", name);
    for (const auto& [name, axis] : machine.rotary) unused("rotary", name);
}

void checkAxisCounts(const MachineDefinition& machine, const TomlNode& root, Diagnostics& report) {
    if (machine.linear.size() != 3)
        report.error("machine.linear-count",
                     fmt::format("a machine needs exactly 3 linear axes; this one has {}", machine.linear.size()),
                     at(root, "linear"));
    if (machine.rotary.size() > 2)
        report.error("machine.rotary-count",
                     fmt::format("a machine can have at most 2 rotary axes; this one has {}", machine.rotary.size()),
                     at(root, "rotary"));
}

void checkDirections(const MachineDefinition& machine, const TomlNode& root, Diagnostics& report) {
    if (machine.linear.size() == 3) {
        auto axis = machine.linear.begin();
        const Direction& a = axis->second.direction;
        const Direction& b = (++axis)->second.direction;
        const Direction& c = (++axis)->second.direction;
        const auto ab = cross(a, b);
        if (std::abs(ab[0] * c[0] + ab[1] * c[1] + ab[2] * c[2]) < independent)
            report.error("machine.linear-dependent",
                         "the directions of the 3 linear axes lie in one plane, so the tool cannot reach every point",
                         at(root, "linear"));
    }
    if (machine.rotary.size() == 2) {
        const auto& [first_name, first] = *machine.rotary.begin();
        const auto& [second_name, second] = *std::next(machine.rotary.begin());
        const auto normal = cross(first.direction, second.direction);
        if (std::hypot(normal[0], normal[1], normal[2]) < independent)
            report.error("machine.rotary-parallel",
                         fmt::format("rotary axes \"{}\" and \"{}\" are parallel, so the tool tilts in one plane only",
                                     first_name, second_name),
                         at(root, "rotary"));
    }
}

/// With two rotary axes the one nearer the tool must tilt it; with one, a table that only indexes is a machine too.
void checkTilt(const MachineDefinition& machine, const TomlNode& root, Diagnostics& report) {
    if (machine.rotary.size() != 2) return;
    std::string nearest;
    for (const std::string& name : machine.axisNames())
        if (machine.rotary.contains(name)) nearest = name;
    if (nearest.empty()) return;
    const auto normal = cross(machine.rotary.at(nearest).direction, machine.spindle.axis);
    if (std::hypot(normal[0], normal[1], normal[2]) < independent)
        report.error("machine.rotary-spindle-parallel",
                     fmt::format("rotary axis \"{}\" is nearest to the tool and parallel to the spindle, so it cannot "
                                 "tilt the tool",
                                 nearest),
                     at(root, "rotary", nearest));
}

void checkAnchors(const MachineDefinition& machine, const TomlNode& root, Diagnostics& report) {
    for (std::size_t i = 0; i < machine.anchors.size(); ++i)
        for (const auto& [name, angle] : machine.anchors[i].rotary_rad)
            if (!machine.rotary.contains(name))
                report.error("machine.anchor-axis", fmt::format("the machine has no rotary axis \"{}\"", name),
                             at(child(element(root, "anchor", i), "rotary_deg"), name));
}

/// Keys that do not exist would make a value look documented that is not. `control` belongs to another room.
void checkSources(const MachineDefinition& machine, const TomlNode& root, Diagnostics& report) {
    for (std::size_t i = 0; i < machine.sources.size(); ++i)
        for (const std::string& key : machine.sources[i].keys) {
            TomlNode node = root;
            std::size_t start = 0;
            bool found = true;
            while (found && start <= key.size()) {
                const std::size_t dot = std::min(key.find('.', start), key.size());
                const auto value = node.at(key.substr(start, dot - start));
                found = value.has_value();
                if (found) node = *value;
                start = dot + 1;
            }
            if (!found)
                report.error("machine.source-key", fmt::format("the file has no key \"{}\"", key),
                             at(element(root, "source", i), "keys"));
        }
}

}  // namespace

void checkLinearAxis(const LinearAxis& axis, const TomlNode& table, Diagnostics& report) {
    if (!(axis.min_mm < axis.max_mm)) {
        report.error("machine.limits-order",
                     fmt::format("min_mm ({:g}) must lie below max_mm ({:g})", axis.min_mm, axis.max_mm),
                     at(table, "min_mm"));
    } else if (axis.home_mm < axis.min_mm || axis.home_mm > axis.max_mm) {
        report.error("machine.home-outside",
                     fmt::format("home_mm ({:g}) lies outside the travel {:g} to {:g} mm", axis.home_mm, axis.min_mm,
                                 axis.max_mm),
                     at(table, "home_mm"));
    }
}

void checkRotaryAxis(const RotaryAxis& axis, const TomlNode& table, Diagnostics& report) {
    if (axis.winding == RotaryAxis::Winding::Endless) {
        for (const auto& [key, limit] : {std::pair{"min_deg", axis.min_rad}, std::pair{"max_deg", axis.max_rad}})
            if (limit)
                report.error("machine.limits-endless", fmt::format("an axis with winding = \"endless\" has no {}", key),
                             at(table, key));
        return;
    }
    for (const auto& [key, limit] : {std::pair{"min_deg", axis.min_rad}, std::pair{"max_deg", axis.max_rad}})
        if (!limit)
            report.error("machine.limits-missing", fmt::format("an axis with winding = \"limited\" needs {}", key),
                         at(table, key));
    if (!axis.min_rad || !axis.max_rad) return;
    const double min_deg = degFromRad(*axis.min_rad);
    const double max_deg = degFromRad(*axis.max_rad);
    if (!(*axis.min_rad < *axis.max_rad)) {
        report.error("machine.limits-order",
                     fmt::format("min_deg ({:g}) must lie below max_deg ({:g})", min_deg, max_deg),
                     at(table, "min_deg"));
    } else if (axis.home_rad < *axis.min_rad || axis.home_rad > *axis.max_rad) {
        report.error("machine.home-outside",
                     fmt::format("home_deg ({:g}) lies outside the travel {:g} to {:g} degrees",
                                 degFromRad(axis.home_rad), min_deg, max_deg),
                     at(table, "home_deg"));
    }
}

void checkMachine(const MachineDefinition& machine, const TomlNode& root, Diagnostics& report) {
    checkSchema(machine, root, report);
    checkChainEnds(machine, root, report);
    checkChainNames(machine, root, report);
    checkAxisCounts(machine, root, report);
    checkDirections(machine, root, report);
    checkTilt(machine, root, report);
    checkAnchors(machine, root, report);
    checkSources(machine, root, report);
}

}  // namespace cusp::machine
