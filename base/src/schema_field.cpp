// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Reading and printing plain TOML values by their field's rules, with the units of their keys.
#include <cusp/base/number_text.hpp>
#include <cusp/base/schema_field.hpp>
#include <cusp/base/units.hpp>

#include "schema_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace cusp::base {
namespace {

constexpr double rad_per_deg = std::numbers::pi / 180.0;

// Longer suffixes first, so that `_mm_per_min` is not taken for `_min`.
constexpr std::array<KeyUnit, 45> units{{
    {"mm_per_min", 1.0, 60.0},
    {"mm_per_s", 1.0, 1.0},
    {"mm_per_s2", 1.0, 1.0},
    {"mm_per_s3", 1.0, 1.0},
    {"mm_per_rev", 1.0, 1.0},
    {"mm_per_tooth", 1.0, 1.0},
    {"m_per_min", 1000.0, 60.0},
    {"m_per_s", 1000.0, 1.0},
    {"m_per_s2", 1000.0, 1.0},
    {"m_per_s3", 1000.0, 1.0},
    {"mm2", 1.0, 1.0},
    {"mm3", 1.0, 1.0},
    {"mm3_per_s", 1.0, 1.0},
    {"mm3_per_min", 1.0, 60.0},
    {"per_mm", 1.0, 1.0},
    {"um_per_m", 1.0, 1e6},
    {"um_per_m_k", 1.0, 1e6},
    {"deg_per_s", rad_per_deg, 1.0},
    {"deg_per_s2", rad_per_deg, 1.0},
    {"deg_per_s3", rad_per_deg, 1.0},
    {"deg_per_min", rad_per_deg, 60.0},
    {"deg_per_mm", rad_per_deg, 1.0},
    {"n_per_mm2", 1.0, 1.0},
    {"n_per_mm", 1.0, 1.0},
    {"mm", 1.0, 1.0},
    {"um", 1.0, 1000.0},
    {"inch", mm_per_inch, 1.0},
    {"deg", rad_per_deg, 1.0},
    {"rad", 1.0, 1.0},
    {"s", 1.0, 1.0},
    {"ms", 1.0, 1000.0},
    {"us", 1.0, 1e6},
    {"minutes", 60.0, 1.0},
    {"hours", 3600.0, 1.0},
    {"rpm", 1.0, 1.0},
    {"hz", 1.0, 1.0},
    {"percent", 1.0, 100.0},
    {"kg", 1.0, 1.0},
    {"w", 1.0, 1.0},
    {"kw", 1000.0, 1.0},
    {"nm", 1.0, 1.0},
    {"baud", 1.0, 1.0},
    {"bit_per_s", 1.0, 1.0},
    {"bytes", 1.0, 1.0},
    {"celsius", 1.0, 1.0},
}};

bool isBareKey(std::string_view key) {
    const auto is_bare = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
    };
    return !key.empty() && std::all_of(key.begin(), key.end(), is_bare);
}

std::string numberText(double value, int digits) {
    std::array<char, 64> buffer{};
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, digits);
    return {buffer.data(), end.ptr};
}

bool reportRange(double written, const TomlNode& node, const FieldInfo& info, Diagnostics& report) {
    const FieldRules& rules = info.rules;
    const bool too_small = rules.min_exclusive ? written <= rules.min : written < rules.min;
    if (!too_small && written <= rules.max) return false;
    const std::string unit = displayUnit(unitOfKey(info.key));
    report.error("toml.range",
                 fmt::format("must be {}{}{}, found {}", rangeText(rules), unit.empty() ? "" : " ", unit,
                             numberText(written, 15)),
                 node.where());
    return true;
}

}  // namespace

KeyUnit unitOfKey(std::string_view key) {
    const KeyUnit* longest = nullptr;
    for (const KeyUnit& unit : units) {
        if (key.size() <= unit.name.size() + 1 || !key.ends_with(unit.name)) continue;
        if (key[key.size() - unit.name.size() - 1] != '_') continue;
        if (longest == nullptr || unit.name.size() > longest->name.size()) longest = &unit;
    }
    return longest == nullptr ? KeyUnit{} : *longest;
}

void readValue(const TomlNode& node, const FieldInfo& info, double& out, Diagnostics& report) {
    const std::optional<double> written = node.number();
    if (!written) return reportWrongType(node, info, report);
    const double inside = unitOfKey(info.key).toInside(*written);
    if (!std::isfinite(*written) || !std::isfinite(inside)) {
        report.error("toml.range", fmt::format("must be a finite number, found {}", numberText(*written, 15)),
                     node.where());
        return;
    }
    if (inside == 0.0 && *written != 0.0) {
        report.error("toml.range", fmt::format("{} is too small to tell from zero", numberText(*written, 15)),
                     node.where());
        return;
    }
    if (reportRange(*written, node, info, report)) return;
    out = inside == 0.0 ? 0.0 : inside;  // a written "-0.0" is zero
}

void readValue(const TomlNode& node, const FieldInfo& info, std::int64_t& out, Diagnostics& report) {
    const std::optional<std::int64_t> written = node.integer();
    if (!written) return reportWrongType(node, info, report);
    if (reportRange(static_cast<double>(*written), node, info, report)) return;
    out = *written;
}

void readValue(const TomlNode& node, const FieldInfo& info, bool& out, Diagnostics& report) {
    const std::optional<bool> written = node.boolean();
    if (!written) return reportWrongType(node, info, report);
    out = *written;
}

void readValue(const TomlNode& node, const FieldInfo& info, std::string& out, Diagnostics& report) {
    std::optional<std::string> written = node.text();
    if (!written) return reportWrongType(node, info, report);
    out = std::move(*written);
}

std::string printValue(double value, const FieldInfo& info) {
    const KeyUnit unit = unitOfKey(info.key);
    const double written = unit.fromInside(value);
    if (value == 0.0) return "0";
    if (!std::isfinite(value) || !std::isfinite(written)) return numberText(value, 17);
    for (const int digits : {15, 16, 17}) {
        const std::string text = numberText(written, digits);
        const auto back = parseDouble(text);
        if (back && unit.toInside(*back) == value) return text;
    }
    // The conversion may have rounded to a neighbour of the number that was written.
    for (const double towards : {-HUGE_VAL, HUGE_VAL}) {
        const double neighbour = std::nextafter(written, towards);
        if (unit.toInside(neighbour) == value) return numberText(neighbour, 17);
    }
    return numberText(written, 17);
}

std::string printValue(std::int64_t value, const FieldInfo& /*info*/) { return std::to_string(value); }
std::string printValue(bool value, const FieldInfo& /*info*/) { return value ? "true" : "false"; }
std::string printValue(const std::string& value, const FieldInfo& /*info*/) { return quoteToml(value); }

FieldInfo nestedInfo(std::string key, std::string doc, std::string type, const FieldRules& rules,
                     std::vector<FieldInfo> children) {
    return {.key = std::move(key),
            .doc = std::move(doc),
            .type = std::move(type),
            .default_text = {},
            .required = rules.required,
            .rules = rules,
            .children = std::move(children)};
}

std::string quoteToml(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\')
            out += std::string("\\") + c;
        else if (c == '\n')
            out += "\\n";
        else if (c == '\t')
            out += "\\t";
        else if (byte < 0x20U || byte == 0x7FU)
            out += fmt::format("\\u{:04X}", byte);
        else
            out += c;
    }
    return out + '"';
}

std::string quoteTomlKey(std::string_view key) { return isBareKey(key) ? std::string(key) : quoteToml(key); }

}  // namespace cusp::base
