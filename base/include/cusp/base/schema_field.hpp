// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The parts of a TOML schema that do not depend on the struct: rules, units, values, messages, printing, documentation.
#pragma once

#include <cusp/base/diagnostics.hpp>
#include <cusp/base/toml_node.hpp>

#include <array>
#include <cstdint>
#include <limits>
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

/// The unit at the end of a key. `inside_per_unit` converts what the user writes to the unit used inside.
struct KeyUnit {
    std::string_view name;
    double inside_per_unit = 1.0;
};
/// "lead_deg" → {"deg", π/180}; {"", 1} for a key without a unit (counts, ratios, direction components).
[[nodiscard]] KeyUnit unitOfKey(std::string_view key);

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
void readValue(const TomlNode& node, const FieldInfo& info, std::array<double, 3>& out, Diagnostics& report);

[[nodiscard]] std::string printValue(double value, const FieldInfo& info);
[[nodiscard]] std::string printValue(std::int64_t value, const FieldInfo& info);
[[nodiscard]] std::string printValue(bool value, const FieldInfo& info);
[[nodiscard]] std::string printValue(const std::string& value, const FieldInfo& info);
[[nodiscard]] std::string printValue(const std::array<double, 3>& value, const FieldInfo& info);

void reportWrongType(const TomlNode& node, const FieldInfo& info, Diagnostics& report);
void reportMissing(const TomlNode& table, const FieldInfo& info, Diagnostics& report);
void reportNotATable(const TomlNode& node, Diagnostics& report);
/// One `toml.unknown-key` error per key of `table` that none of the field tables has, with the nearest known key.
void reportUnknownKeys(const TomlNode& table, const std::vector<std::vector<FieldInfo>>& known, Diagnostics& report);

template <class V>
void readValue(const TomlNode& node, const FieldInfo& info, std::optional<V>& out, Diagnostics& report) {
    const std::size_t errors_before = report.errorCount();
    V value{};
    readValue(node, info, value, report);
    if (report.errorCount() == errors_before) out = std::move(value);
}

template <class V>
void readValue(const TomlNode& node, const FieldInfo& info, std::vector<V>& out, Diagnostics& report) {
    if (!node.isArray()) return reportWrongType(node, info, report);
    std::vector<V> values;
    for (const TomlNode& element : node.elements()) {
        V value{};
        readValue(element, info, value, report);
        values.push_back(std::move(value));
    }
    out = std::move(values);
}

template <class V>
[[nodiscard]] std::string printValue(const std::optional<V>& value, const FieldInfo& info) {
    return value ? printValue(*value, info) : std::string();
}

template <class V>
[[nodiscard]] std::string printValue(const std::vector<V>& values, const FieldInfo& info) {
    std::string out = "[";
    for (const V& value : values) {
        if (out.size() > 1) out += ", ";
        out += printValue(value, info);
    }
    return out + "]";
}

template <class V>
struct TypeName;
template <>
struct TypeName<double> {
    static std::string text() { return "number"; }
};
template <>
struct TypeName<std::int64_t> {
    static std::string text() { return "integer"; }
};
template <>
struct TypeName<bool> {
    static std::string text() { return "true or false"; }
};
template <>
struct TypeName<std::string> {
    static std::string text() { return "text"; }
};
template <>
struct TypeName<std::array<double, 3>> {
    static std::string text() { return "three numbers"; }
};
template <class V>
struct TypeName<std::optional<V>> {
    static std::string text() { return TypeName<V>::text(); }
};
template <class V>
struct TypeName<std::vector<V>> {
    static std::string text() { return "list of " + TypeName<V>::text(); }
};

template <class V>
[[nodiscard]] FieldInfo describeField(std::string key, std::string doc, const FieldRules& rules) {
    return {.key = std::move(key),
            .doc = std::move(doc),
            .type = TypeName<V>::text(),
            .default_text = {},
            .required = rules.required,
            .rules = rules,
            .children = {}};
}

[[nodiscard]] FieldInfo nestedInfo(std::string key, std::string doc, std::string type, const FieldRules& rules,
                                   std::vector<FieldInfo> children);

/// A TOML basic string with its quotes and escapes.
[[nodiscard]] std::string quoteToml(std::string_view text);

template <class E>
[[nodiscard]] std::string wordList(const std::vector<std::pair<std::string, E>>& words) {
    std::string out;
    for (const auto& [word, meaning] : words) out += (out.empty() ? "" : " | ") + quoteToml(word);
    return out;
}

/// Collects `--print-config` text: plain keys of a table first, then its tables, as TOML demands.
class ConfigPrinter {
public:
    /// Writes `key = text`; nothing for an empty text (an absent optional).
    void value(const FieldInfo& info, const std::string& text);
    void open(std::string_view before, const std::string& key, std::string_view after);
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
};

/// The documentation page of a file: a Markdown table per section, in field order.
[[nodiscard]] std::string schemaMarkdown(const std::string& title, const std::string& intro,
                                         const std::vector<FieldInfo>& fields);

}  // namespace cusp::base
