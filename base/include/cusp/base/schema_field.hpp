// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The parts of a TOML schema that do not depend on the struct: rules, units, values, messages, printing, documentation.
#pragma once

#include <cusp/base/diagnostics.hpp>
#include <cusp/base/toml_node.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cusp::base {

/// What a field demands beyond its type. Bounds are inclusive and in the unit of the key, as a user writes them.
struct FieldRules {
    bool required = false;
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    bool min_exclusive = false;
};

[[nodiscard]] constexpr FieldRules required() { return {.required = true}; }
[[nodiscard]] constexpr FieldRules positive() { return {.min = 0.0, .min_exclusive = true}; }
[[nodiscard]] constexpr FieldRules requiredPositive() { return {.required = true, .min = 0.0, .min_exclusive = true}; }

/// The unit at the end of a key: inside = written × `numerator` / `denominator`. Two numbers, because 1/60 has no exact
/// double and a feed of 20000 mm/min must be the same double wherever it is computed (`mmPerSFromMmPerMin`).
struct KeyUnit {
    std::string_view name;
    double numerator = 1.0;
    double denominator = 1.0;

    [[nodiscard]] constexpr double toInside(double written) const { return written * numerator / denominator; }
    [[nodiscard]] constexpr double fromInside(double inside) const { return inside * denominator / numerator; }
};
/// "lead_deg" → {"deg", π/180}; {"", 1} for a key without a unit (counts, ratios, direction components).
[[nodiscard]] KeyUnit unitOfKey(std::string_view key);
/// As people write it: "mm/min" for {"mm_per_min", …}.
[[nodiscard]] std::string displayUnit(const KeyUnit& unit);

/// One line of the field table, as the documentation shows it.
struct FieldInfo {
    std::string key;
    std::string doc;
    std::string type;          ///< "number", "text", "\"a\" | \"b\"", "table", "array of tables", "named tables" …
    std::string default_text;  ///< as TOML; empty when required or absent by default
    bool required = false;
    FieldRules rules;
    std::vector<FieldInfo> children;
};

// Reading one value of each supported type. On a problem: one error in `report`, `out` untouched.
void readValue(const TomlNode& node, const FieldInfo& info, double& out, Diagnostics& report);
void readValue(const TomlNode& node, const FieldInfo& info, std::int64_t& out, Diagnostics& report);
void readValue(const TomlNode& node, const FieldInfo& info, bool& out, Diagnostics& report);
void readValue(const TomlNode& node, const FieldInfo& info, std::string& out, Diagnostics& report);

/// The shortest text that reads back to the same value inside, in the unit of the key: -120 deg stays -120.
[[nodiscard]] std::string printValue(double value, const FieldInfo& info);
[[nodiscard]] std::string printValue(std::int64_t value, const FieldInfo& info);
[[nodiscard]] std::string printValue(bool value, const FieldInfo& info);
[[nodiscard]] std::string printValue(const std::string& value, const FieldInfo& info);

void reportWrongType(const TomlNode& node, const FieldInfo& info, Diagnostics& report);
void reportMissing(const TomlNode& table, const FieldInfo& info, Diagnostics& report);
void reportNotATable(const TomlNode& node, Diagnostics& report);
/// One `toml.unknown-key` error per key of `table` that none of the field tables has, with the nearest known key.
void reportUnknownKeys(const TomlNode& table, const std::vector<std::vector<FieldInfo>>& known, Diagnostics& report);

/// A TOML basic string with its quotes and escapes.
[[nodiscard]] std::string quoteToml(std::string_view text);
/// A key as TOML wants it: bare where that is allowed, else quoted.
[[nodiscard]] std::string quoteTomlKey(std::string_view key);

/// What a type is called in messages and in the documentation.
template <class V>
struct TypeName;
template <>
struct TypeName<double> {
    static std::string text() { return "number"; }
    static std::string many() { return "numbers"; }
};
template <>
struct TypeName<std::int64_t> {
    static std::string text() { return "whole number"; }
    static std::string many() { return "whole numbers"; }
};
template <>
struct TypeName<bool> {
    static std::string text() { return "true or false"; }
    static std::string many() { return "true or false"; }
};
template <>
struct TypeName<std::string> {
    static std::string text() { return "text"; }
    static std::string many() { return "texts"; }
};
template <std::size_t n>
struct TypeName<std::array<double, n>> {
    static std::string text() { return "list of " + std::to_string(n) + " numbers"; }
    static std::string many() { return "lists of " + std::to_string(n) + " numbers"; }
};
template <class V>
struct TypeName<std::optional<V>> : TypeName<V> {};
template <class V>
struct TypeName<std::vector<V>> {
    static std::string text() { return "list of " + TypeName<V>::many(); }
    static std::string many() { return "lists of " + TypeName<V>::many(); }
};
template <class V>
struct TypeName<std::map<std::string, V>> {
    static std::string text() { return "table of " + TypeName<V>::many(); }
    static std::string many() { return "tables of " + TypeName<V>::many(); }
};

/// The same field, seen from one of its elements: messages then speak of that element's type.
template <class V>
[[nodiscard]] FieldInfo elementInfo(const FieldInfo& info) {
    FieldInfo out = info;
    out.type = TypeName<V>::text();
    return out;
}

template <class V>
void readValue(const TomlNode& node, const FieldInfo& info, std::optional<V>& out, Diagnostics& report) {
    const std::size_t errors_before = report.errorCount();
    V value{};
    readValue(node, info, value, report);
    if (report.errorCount() == errors_before) out = std::move(value);
}

template <std::size_t n>
void readValue(const TomlNode& node, const FieldInfo& info, std::array<double, n>& out, Diagnostics& report) {
    const std::vector<TomlNode> elements = node.elements();
    if (elements.size() != n) return reportWrongType(node, info, report);
    const std::size_t errors_before = report.errorCount();
    const FieldInfo element_info = elementInfo<double>(info);
    std::array<double, n> values{};
    for (std::size_t i = 0; i < n; ++i) readValue(elements[i], element_info, values[i], report);
    if (report.errorCount() == errors_before) out = values;
}

template <class V>
void readValue(const TomlNode& node, const FieldInfo& info, std::vector<V>& out, Diagnostics& report) {
    if (!node.isArray()) return reportWrongType(node, info, report);
    const std::size_t errors_before = report.errorCount();
    const FieldInfo element_info = elementInfo<V>(info);
    std::vector<V> values;
    for (const TomlNode& element : node.elements()) {
        V value{};
        readValue(element, element_info, value, report);
        values.push_back(std::move(value));
    }
    if (report.errorCount() == errors_before) out = std::move(values);
}

/// Values under names the user chooses: `rotary_deg = {A = 10, C = -90}`. The unit of the key holds for each.
template <class V>
void readValue(const TomlNode& node, const FieldInfo& info, std::map<std::string, V>& out, Diagnostics& report) {
    if (!node.isTable()) return reportWrongType(node, info, report);
    const std::size_t errors_before = report.errorCount();
    const FieldInfo element_info = elementInfo<V>(info);
    std::map<std::string, V> values;
    for (const std::string& name : node.keys())
        if (const auto element = node.at(name)) readValue(*element, element_info, values[name], report);
    if (report.errorCount() == errors_before) out = std::move(values);
}

template <class V>
[[nodiscard]] std::string printValue(const std::optional<V>& value, const FieldInfo& info) {
    return value ? printValue(*value, info) : std::string();
}

template <class Range>
[[nodiscard]] std::string printList(const Range& values, const FieldInfo& info) {
    std::string out = "[";
    for (const typename Range::value_type& value : values) {
        if (out.size() > 1) out += ", ";
        out += printValue(value, info);
    }
    return out + "]";
}

template <std::size_t n>
[[nodiscard]] std::string printValue(const std::array<double, n>& values, const FieldInfo& info) {
    return printList(values, info);
}

template <class V>
[[nodiscard]] std::string printValue(const std::vector<V>& values, const FieldInfo& info) {
    return printList(values, info);
}

template <class V>
[[nodiscard]] std::string printValue(const std::map<std::string, V>& values, const FieldInfo& info) {
    std::string out = "{";
    for (const auto& [name, value] : values) {
        if (out.size() > 1) out += ", ";
        out += quoteTomlKey(name) + " = " + printValue(value, info);
    }
    return out + "}";
}

template <class V>
[[nodiscard]] FieldInfo describeField(const std::string& key, const std::string& doc, const FieldRules& rules) {
    return {.key = key,
            .doc = doc,
            .type = TypeName<V>::text(),
            .default_text = {},
            .required = rules.required,
            .rules = rules,
            .children = {}};
}

[[nodiscard]] FieldInfo nestedInfo(std::string key, std::string doc, std::string type, const FieldRules& rules,
                                   std::vector<FieldInfo> children);

template <class E>
[[nodiscard]] std::string wordList(const std::vector<std::pair<std::string, E>>& words) {
    std::string out;
    for (const auto& [word, meaning] : words) out += (out.empty() ? "" : " | ") + quoteToml(word);
    return out;
}

/// Whether printed TOML carries each field's documentation as a comment above it.
enum class PrintDocs { No, Yes };

/// Collects `--print-config` text: plain keys of a table first, then its tables, as TOML demands.
class ConfigPrinter {
public:
    explicit ConfigPrinter(PrintDocs docs = PrintDocs::No) : docs_(docs) {}

    /// Writes `key = text`. An empty text (an absent optional) writes nothing, or with docs the key as a comment.
    void value(const FieldInfo& info, const std::string& text);
    /// Starts a table below the open one: `before` is "[" or "[[", `key` a dotted path in TOML's own form.
    void open(std::string_view before, const std::string& key, std::string_view after, std::string_view doc = {});
    void close();
    [[nodiscard]] std::string text() const;

private:
    struct Table {
        std::string header;
        std::string body;
    };
    std::vector<Table> tables_{Table{}};
    std::vector<std::size_t> open_{0};
    std::vector<std::string> path_;
    PrintDocs docs_;
};

/// The documentation page of a file: a Markdown table per section, in field order.
[[nodiscard]] std::string schemaMarkdown(const std::string& title, const std::string& intro,
                                         const std::vector<FieldInfo>& fields);

}  // namespace cusp::base
