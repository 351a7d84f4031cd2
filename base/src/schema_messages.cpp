// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What a schema says about a file that does not fit it.
#include "schema_text.hpp"

#include <cusp/base/number_text.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cusp::base {
namespace {

constexpr std::size_t longest_quote = 40;
constexpr std::size_t longest_compared_key = 64;

std::string article(const std::string& noun) {
    const bool vowel = !noun.empty() && std::string_view("aeiou").find(noun.front()) != std::string_view::npos;
    return (vowel ? "an " : "a ") + noun;
}

std::string foundText(const TomlNode& node) {
    if (const auto value = node.text()) return value->size() > longest_quote ? "a long text" : quoteToml(*value);
    if (const auto value = node.integer()) return std::to_string(*value);
    if (const auto value = node.number()) {
        // "expected a whole number, found 2" would puzzle whoever wrote 2.0.
        const std::string text = std::isfinite(*value) ? formatShortest(*value) : "no finite number";
        return text.find_first_not_of("-0123456789") == std::string::npos ? text + ".0" : text;
    }
    if (const auto value = node.boolean()) return *value ? "true" : "false";
    if (node.isArray()) {
        const std::size_t count = node.elements().size();
        return fmt::format("a list of {} {}", count, count == 1 ? "value" : "values");
    }
    return node.typeName();
}

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b` (optimal string alignment),
/// letter case aside.
std::size_t editDistance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before_last(b.size() + 1);
    std::vector<std::size_t> last(b.size() + 1);
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(last.begin(), last.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool same = lower(a[i - 1]) == lower(b[j - 1]);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0U : 1U)});
            if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
                row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
        std::swap(before_last, last);
        std::swap(last, row);
    }
    return last[b.size()];
}

std::string_view withoutUnit(std::string_view key) {
    const KeyUnit unit = unitOfKey(key);
    return unit.name.empty() ? key : key.substr(0, key.size() - unit.name.size() - 1);
}

std::string unknownKeyMessage(const std::string& key, const std::vector<std::string>& candidates) {
    for (const std::string& candidate : candidates) {
        if (withoutUnit(key) != withoutUnit(candidate)) continue;
        const KeyUnit unit = unitOfKey(candidate);
        if (unit.name.empty()) return fmt::format("unknown key; this value has no unit: write `{}`", candidate);
        return fmt::format("unknown key; write the value in {}: `{}`", displayUnit(unit), candidate);
    }
    if (candidates.empty()) return "unknown key";
    const std::string* nearest = nullptr;
    std::size_t smallest = 1 + std::max(std::size_t{1}, key.size() / 3);
    for (const std::string& candidate : candidates) {
        if (key.size() > longest_compared_key) break;
        const std::size_t distance = editDistance(key, candidate);
        if (distance >= smallest) continue;
        smallest = distance;
        nearest = &candidate;
    }
    if (nearest != nullptr) return fmt::format("unknown key; did you mean `{}`?", *nearest);
    return "unknown key";
}

}  // namespace

std::string displayUnit(const KeyUnit& unit) {
    if (unit.name == "percent") return "%";
    if (unit.name == "rpm") return "rev/min";
    if (unit.name == "um") return "µm";
    if (unit.name == "nm") return "Nm";
    if (unit.name == "w") return "W";
    if (unit.name == "kw") return "kW";
    if (unit.name == "hz") return "Hz";
    if (unit.name == "celsius") return "°C";
    if (unit.name == "um_per_m_k") return "µm/(m K)";
    std::string out(unit.name);
    if (out.starts_with("per_")) out = "1/" + out.substr(4);
    if (out.starts_with("n_")) out.front() = 'N';
    if (out.starts_with("um_")) out.replace(0, 1, "µ");
    for (std::size_t i = out.find("_per_"); i != std::string::npos; i = out.find("_per_", i)) out.replace(i, 5, "/");
    for (const auto& [digit, power] : {std::pair{'2', "²"}, std::pair{'3', "³"}})
        for (std::size_t i = out.find(digit); i != std::string::npos; i = out.find(digit, i)) out.replace(i, 1, power);
    return out;
}

std::string rangeText(const FieldRules& rules) {
    const bool has_min = std::isfinite(rules.min);
    const bool has_max = std::isfinite(rules.max);
    if (!has_min && !has_max) return {};
    const std::string min = formatShortest(has_min ? rules.min : 0.0);
    const std::string max = formatShortest(has_max ? rules.max : 0.0);
    if (!has_min) return "at most " + max;
    std::string lower_bound = (rules.min_exclusive ? "greater than " : "at least ") + min;
    if (!has_max) return lower_bound;
    return rules.min_exclusive ? lower_bound + " and at most " + max : "between " + min + " and " + max;
}

std::string expectedText(const FieldInfo& info) {
    const std::string unit = displayUnit(unitOfKey(info.key));
    const std::string unit_text = unit.empty() ? "" : " in " + unit;
    if (info.type.starts_with('"') || info.type == "true or false" || info.type == "named tables") return info.type;
    return article(info.type) + unit_text;
}

void reportWrongType(const TomlNode& node, const FieldInfo& info, Diagnostics& report) {
    report.error("toml.wrong-type", fmt::format("expected {}, found {}", expectedText(info), foundText(node)),
                 node.where());
}

void reportMissing(const TomlNode& table, const FieldInfo& info, Diagnostics& report) {
    report.error("toml.missing-key", fmt::format("this key is missing: {}", expectedText(info)),
                 table.whereKey(info.key));
}

void reportNotATable(const TomlNode& node, Diagnostics& report) {
    report.error("toml.wrong-type", fmt::format("expected a table, found {}", foundText(node)), node.where());
}

void reportUnknownKeys(const TomlNode& table, const std::vector<std::vector<FieldInfo>>& known, Diagnostics& report) {
    std::vector<std::string> names;
    for (const auto& fields : known)
        for (const FieldInfo& field : fields) names.push_back(field.key);
    const std::vector<std::string> keys = table.keys();
    const auto contains = [](const std::vector<std::string>& list, const std::string& key) {
        return std::find(list.begin(), list.end(), key) != list.end();
    };
    // A key that is already there is no good advice.
    std::vector<std::string> candidates;
    for (const std::string& name : names)
        if (!contains(keys, name)) candidates.push_back(name);
    for (const std::string& key : keys)
        if (!contains(names, key))
            report.error("toml.unknown-key", unknownKeyMessage(key, candidates), table.whereKey(key));
}

}  // namespace cusp::base
