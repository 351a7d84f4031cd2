// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The check before the TOML parser runs, and the rewording of what it says.
#include "toml_messages.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace cusp::base {
namespace {

constexpr std::size_t max_key_parts = 32;

/// Index just behind the string or comment that starts at `i`, or `i + 1` for any other character.
std::size_t skipToken(std::string_view text, std::size_t i) {
    const char first = text[i];
    if (first == '#') return std::min(text.find('\n', i), text.size());
    if (first != '"' && first != '\'') return i + 1;
    const bool multi_line = i + 2 < text.size() && text[i + 1] == first && text[i + 2] == first;
    const std::string_view quote = multi_line ? text.substr(i, 3) : text.substr(i, 1);
    i += quote.size();
    while (i < text.size()) {
        if (text.substr(i, quote.size()) == quote) {
            i += quote.size();
            // A multi-line string may end in up to five quotes, of which the first two belong to it.
            for (int extra = 0; multi_line && extra < 2 && i < text.size() && text[i] == first; ++extra) ++i;
            return i;
        }
        if (!multi_line && text[i] == '\n') return i;
        i += (first == '"' && text[i] == '\\') ? 2U : 1U;
    }
    return text.size();
}

void replaceAll(std::string& text, std::string_view from, std::string_view to) {
    for (std::size_t i = text.find(from); i != std::string::npos; i = text.find(from, i + to.size()))
        text.replace(i, from.size(), to);
}

}  // namespace

std::optional<std::size_t> lineWithTooDeepKey(std::string_view text) {
    std::size_t line = 1;
    std::size_t parts = 1;
    for (std::size_t i = 0; i < text.size();) {
        const char c = text[i];
        const std::size_t next = skipToken(text, i);
        if (c == '.' && ++parts > max_key_parts) return line;
        if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos) parts = 1;
        line += static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(i),
                                                    text.begin() + static_cast<std::ptrdiff_t>(next), '\n'));
        i = next;
    }
    return std::nullopt;
}

std::string cleanTomlMessage(std::string_view message) {
    constexpr std::string_view prefix = "Error while parsing ";
    std::string scope;
    if (message.substr(0, prefix.size()) == prefix) {
        const std::size_t colon = message.find(": ");
        if (colon != std::string_view::npos) {
            scope = message.substr(prefix.size(), colon - prefix.size());
            message.remove_prefix(colon + 2);
        }
    }
    std::string out(message);
    constexpr std::array<std::pair<std::string_view, std::string_view>, 14> rewording{{
        {", saw ", ", found "},
        {"encountered end-of-file", "the file ends here"},
        {"cannot redefine existing ", "this is in the file already: "},
        {"exceeded maximum nested value depth of 32 (TOML_MAX_NESTED_VALUES)",
         "lists and tables nested deeper than 32"},
        {"expected a comment or whitespace", "expected the end of the line"},
        {"value-terminator", "the end of the value"},
        {"could not determine value type", "this is no TOML value (a text needs quotes)"},
        {"is not representable in 64 bits", "is too large"},
        {"unescaped control characters other than TAB (U+0009) are explicitly prohibited",
         "a control character, or the end of the line before the closing quote"},
        {"explicitly prohibited", "not allowed"},
        {"prohibited", "not allowed"},
        {"decimal digit", "digit"},
        {"expected value", "expected a value"},
        {"expected key or", "expected a key or"},
    }};
    if (out.find("utf-8") != std::string::npos) return "this is not UTF-8; save the file as UTF-8 text";
    for (const auto& [from, to] : rewording) replaceAll(out, from, to);
    // Where the message says it all, the place in the grammar is noise.
    for (const std::string_view noise : {"", "root table", "value", "key-value pair", "comment"})
        if (scope == noise) return out;
    if (scope == "floating-point" || scope == "decimal integer") scope = "number";
    const bool vowel = std::string_view("aeiou").find(scope.front()) != std::string_view::npos;
    return out + " (in " + (vowel ? "an " : "a ") + scope + ")";
}

}  // namespace cusp::base
