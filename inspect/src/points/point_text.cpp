// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Splits lines and reads numbers with either decimal mark.
#include "points/point_text.hpp"

#include <cusp/base/number_text.hpp>
#include <cusp/base/units.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace cusp::inspect {
namespace {

constexpr std::string_view blanks = " \t\r\v\f";

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

std::string_view unquoted(std::string_view field) {
    field = trimmed(field);
    if (field.size() >= 2 && field.front() == '"' && field.back() == '"')
        return trimmed(field.substr(1, field.size() - 2));
    return field;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

std::string lowered(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(), lower);
    return out;
}

bool startsWithWord(std::string_view text, std::string_view word) {
    return text.size() >= word.size() &&
           std::equal(word.begin(), word.end(), text.begin(), [](char a, char b) { return lower(a) == lower(b); });
}

void splitFields(std::string_view line, char separator, std::vector<std::string_view>& fields) {
    fields.clear();
    if (separator == ' ') {
        for (std::size_t at = line.find_first_not_of(blanks); at != std::string_view::npos;) {
            const std::size_t end = line.find_first_of(blanks, at);
            fields.push_back(unquoted(line.substr(at, end - at)));
            at = end == std::string_view::npos ? end : line.find_first_not_of(blanks, end);
        }
        return;
    }
    std::size_t begin = 0;
    bool in_quotes = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"') in_quotes = !in_quotes;
        if (line[i] != separator || in_quotes) continue;
        fields.push_back(unquoted(line.substr(begin, i - begin)));
        begin = i + 1;
    }
    const std::string_view last = unquoted(line.substr(begin));
    if (!last.empty() || fields.empty()) fields.push_back(last);
}

std::optional<double> parseNumber(std::string_view text, char decimal) {
    if (decimal == '.') return base::parseDouble(text);
    std::array<char, 64> buffer{};
    if (text.size() > buffer.size() || text.find('.') != std::string_view::npos) return std::nullopt;
    std::replace_copy(text.begin(), text.end(), buffer.begin(), ',', '.');
    return base::parseDouble(std::string_view(buffer.data(), text.size()));
}

bool isNotANumber(std::string_view text) {
    const std::string word = lowered(text);
    constexpr std::array<std::string_view, 10> words{"nan",  "-nan", "+nan", "inf",  "-inf",
                                                     "+inf", "n/a",  "na",   "null", "-nan(ind)"};
    return std::find(words.begin(), words.end(), word) != words.end();
}

std::optional<double> unitLength(std::string_view word) {
    constexpr std::array<std::pair<std::string_view, double>, 15> units{{{"mm", 1.0},
                                                                         {"millimetre", 1.0},
                                                                         {"millimeter", 1.0},
                                                                         {"millimeters", 1.0},
                                                                         {"cm", 10.0},
                                                                         {"m", 1000.0},
                                                                         {"metre", 1000.0},
                                                                         {"meter", 1000.0},
                                                                         {"um", 1e-3},
                                                                         {"µm", 1e-3},
                                                                         {"in", base::mm_per_inch},
                                                                         {"inch", base::mm_per_inch},
                                                                         {"inches", base::mm_per_inch},
                                                                         {"ft", 12.0 * base::mm_per_inch},
                                                                         {"feet", 12.0 * base::mm_per_inch}}};
    const std::string name = lowered(trimmed(word));
    for (const auto& [unit, length_mm] : units)
        if (name == unit) return length_mm;
    return std::nullopt;
}

std::string inQuotes(std::string_view text) {
    constexpr std::size_t longest = 40;
    std::string out = "'";
    for (const char c : text.substr(0, longest)) out += static_cast<unsigned char>(c) < 0x20U || c == 0x7f ? '?' : c;
    return out + (text.size() > longest ? "…'" : "'");
}

}  // namespace cusp::inspect
