// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Reads one decimal number as APT writes it; the innermost loop of the reader.
#pragma once

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <system_error>

namespace cusp::toolpath::detail {

/// The general route: exponents (Fortran's D as well), many digits. Returns the end of the number, or null.
[[nodiscard]] const char* scanNumberSlowly(const char* first, const char* last, double& value);

[[nodiscard]] inline bool isDigit(char c) { return c >= '0' && c <= '9'; }

[[nodiscard]] inline bool isExponentMark(char c) {
    const char upper = static_cast<char>(static_cast<unsigned char>(c) & 0xDFU);
    return upper == 'E' || upper == 'D';
}

/// Reads `-0.0795`, `.9625`, `-.5`, `1.`, `+3`, `1.5E-3` from [first, last). Returns the end of the number, or null
/// when there is none or it is beyond any use (over 1e15). The result is the double nearest to the text: a mantissa below 2^53 divided by
/// an exact power of ten is rounded once (Clinger, "How to read floating point numbers accurately", PLDI 1990).
[[nodiscard]] inline const char* scanNumber(const char* first, const char* last, double& value) {
    static constexpr std::array<double, 19> power_of_ten{1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8, 1e9,
                                                         1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18};
    constexpr std::uint64_t exact_limit = std::uint64_t{1} << 53U;
    const char* p = first;
    const bool negative = p != last && *p == '-';
    if (p != last && (*p == '-' || *p == '+')) {
        ++p;
    }
    std::uint64_t mantissa = 0;
    const char* const digits = p;
    while (p != last && isDigit(*p)) {
        mantissa = mantissa * 10U + static_cast<std::uint64_t>(*p++ - '0');
    }
    std::ptrdiff_t digit_count = p - digits;
    std::ptrdiff_t fraction_count = 0;
    if (p != last && *p == '.') {
        const char* const fraction = ++p;
        while (p != last && isDigit(*p)) {
            mantissa = mantissa * 10U + static_cast<std::uint64_t>(*p++ - '0');
        }
        fraction_count = p - fraction;
        digit_count += fraction_count;
    }
    if (digit_count == 0) {
        return nullptr;
    }
    // 18 digits cannot have overflowed the mantissa.
    if (digit_count > 18 || mantissa > exact_limit || (p != last && isExponentMark(*p))) {
        return scanNumberSlowly(first, last, value);
    }
    const double magnitude = static_cast<double>(mantissa) / power_of_ten[static_cast<std::size_t>(fraction_count)];
    value = negative ? -magnitude : magnitude;
    return p;
}

}  // namespace cusp::toolpath::detail
