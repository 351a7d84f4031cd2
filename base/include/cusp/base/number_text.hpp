// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Numbers from text and to text, the same under every locale.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cusp::base {

/// The whole text as one decimal number: optional sign, digits with at most one point, optional exponent. "+1", ".5" and
/// "1." count; blanks, "inf", "nan", hexadecimal and values beyond a double's range (above 1.8e308 or so small that
/// they vanish) do not.
[[nodiscard]] std::optional<double> parseDouble(std::string_view text);

/// The whole text as one decimal integer with optional sign.
[[nodiscard]] std::optional<std::int64_t> parseInteger(std::string_view text);

enum class TrailingZeros {
    Keep,     ///< 1.500, 2.000
    Strip,    ///< 1.5, 2
    KeepOne,  ///< 1.5, 2.0
};

/// Appends `value` (finite) with at most `decimals` places, rounded from the exact binary value; never "-0". Negative
/// `decimals` count as 0.
void appendFixed(std::string& out, double value, int decimals, TrailingZeros zeros = TrailingZeros::Keep);
[[nodiscard]] std::string formatFixed(double value, int decimals, TrailingZeros zeros = TrailingZeros::Keep);

/// The shortest decimal text that reads back to exactly `value` (finite); never "-0".
[[nodiscard]] std::string formatShortest(double value);

}  // namespace cusp::base
