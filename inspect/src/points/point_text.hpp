// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Words and numbers in the lines of measured points.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::inspect {

[[nodiscard]] std::string_view trimmed(std::string_view text);
[[nodiscard]] std::string lowered(std::string_view text);
/// Whether `text` starts with `word`, whatever the case.
[[nodiscard]] bool startsWithWord(std::string_view text, std::string_view word);

/// Fields between separators, trimmed and without the quotes around them; ' ' means any run of blanks and tabs. A field
/// in quotes may hold the separator. A separator at the end of the line opens no further field.
void splitFields(std::string_view line, char separator, std::vector<std::string_view>& fields);

/// One number, with ',' or '.' as its decimal mark.
[[nodiscard]] std::optional<double> parseNumber(std::string_view text, char decimal);
/// "nan", "inf" and the like: numbers that say there is none.
[[nodiscard]] bool isNotANumber(std::string_view text);

/// Length in mm of a unit called "mm", "cm", "m", "in", "inch", "um" …; nothing for any other word.
[[nodiscard]] std::optional<double> unitLength(std::string_view word);

/// For messages: at most 40 characters, control characters replaced.
[[nodiscard]] std::string inQuotes(std::string_view text);

}  // namespace cusp::inspect
