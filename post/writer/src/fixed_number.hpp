// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Numbers as they stand on paper: an integer count of the last decimal, so that "unchanged" means unchanged in print.
#pragma once

#include <array>
#include <charconv>
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
    return std::abs(scaled) < fixed_limit ? std::llround(scaled) : 0;
}

/// Appends e.g. -12500, 3 decimals → "-12.5"; no trailing zeros, no point when whole (an 840D reads X10 as 10 mm).
inline void appendFixed(std::string& out, std::int64_t fixed, int decimals) {
    std::array<char, 24> digits{};
    std::uint64_t magnitude = fixed < 0 ? static_cast<std::uint64_t>(-fixed) : static_cast<std::uint64_t>(fixed);
    while (decimals > 0 && magnitude % 10 == 0) {
        magnitude /= 10;
        --decimals;
    }
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), magnitude).ptr;
    const int count = static_cast<int>(end - digits.data());
    if (fixed < 0) out.push_back('-');
    if (decimals == 0) {
        out.append(digits.data(), static_cast<std::size_t>(count));
        return;
    }
    const int whole = count - decimals;
    if (whole <= 0) {
        out.append("0.");
        out.append(static_cast<std::size_t>(-whole), '0');
        out.append(digits.data(), static_cast<std::size_t>(count));
        return;
    }
    out.append(digits.data(), static_cast<std::size_t>(whole));
    out.push_back('.');
    out.append(digits.data() + whole, static_cast<std::size_t>(decimals));
}

}  // namespace cusp::post
