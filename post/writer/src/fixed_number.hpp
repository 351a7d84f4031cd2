// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Numbers as they stand on paper: an integer count of the last decimal, so that "unchanged" means unchanged in print.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>

namespace cusp::post {

inline constexpr std::array<double, 10> powers_of_ten{1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9};

/// Largest count of last decimals that is exact in a double; far beyond any machine.
inline constexpr double fixed_limit = 9.0e15;

/// `value` in units of its last decimal, rounded half away from zero. Values beyond the limit are a programmer's error:
/// readers and limits refuse them long before.
[[nodiscard]] inline std::int64_t toFixed(double value, int decimals) {
    const double scaled = value * powers_of_ten[static_cast<std::size_t>(decimals)];
    if (!(std::abs(scaled) < fixed_limit)) return 0;
    // As std::llround, which is a call: what is cut off is exact.
    const auto whole = static_cast<std::int64_t>(scaled);
    const double rest = scaled - static_cast<double>(whole);
    constexpr double half = 0.5;
    return whole + static_cast<std::int64_t>(rest >= half) - static_cast<std::int64_t>(rest <= -half);
}

/// "00" to "99".
inline constexpr std::array<char, 200> two_digits = [] {
    std::array<char, 200> out{};
    for (std::size_t i = 0; i < 100; ++i) {
        out[2 * i] = static_cast<char>('0' + i / 10);
        out[2 * i + 1] = static_cast<char>('0' + i % 10);
    }
    return out;
}();

/// Appends e.g. -12500, 3 decimals → "-12.5"; no trailing zeros, no point when whole (an 840D reads X10 as 10 mm).
inline void appendFixed(std::string& out, std::int64_t fixed, int decimals) {
    // Written from the last digit to the first, which needs no search for the length.
    std::array<char, 32> text;
    char* const end = text.data() + text.size();
    char* at = end;
    std::uint64_t magnitude = fixed < 0 ? static_cast<std::uint64_t>(-fixed) : static_cast<std::uint64_t>(fixed);
    const char* last = end;
    if (decimals > 0) {
        for (int left = decimals; left > 0; --left) {
            *--at = static_cast<char>('0' + magnitude % 10);
            magnitude /= 10;
        }
        while (last != at && last[-1] == '0') --last;
        if (last == at)
            last = at = end;
        else
            *--at = '.';
    }
    for (; magnitude >= 100; magnitude /= 100) {
        const std::size_t pair = 2 * static_cast<std::size_t>(magnitude % 100);
        *--at = two_digits[pair + 1];
        *--at = two_digits[pair];
    }
    if (magnitude >= 10) {
        const std::size_t pair = 2 * static_cast<std::size_t>(magnitude);
        *--at = two_digits[pair + 1];
        *--at = two_digits[pair];
    } else {
        *--at = static_cast<char>('0' + magnitude);
    }
    if (fixed < 0) *--at = '-';
    out.append(at, static_cast<std::size_t>(last - at));
}

}  // namespace cusp::post
