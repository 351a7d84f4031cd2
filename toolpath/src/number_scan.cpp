// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The general route of the number scanner, over the standard library's exact conversion.
#include "number_scan.hpp"

#include <algorithm>

namespace cusp::toolpath::detail {

const char* scanNumberSlowly(const char* first, const char* last, double& value) {
    // A number of more characters than this is nothing a CAM system writes.
    std::array<char, 64> copy{};
    const char* p = first;
    if (p != last && *p == '+') {
        ++p;
    }
    std::size_t length = 0;
    bool exponent_seen = false;
    const char* q = p;
    for (; q != last; ++q) {
        const bool sign = (*q == '-' || *q == '+') && (q == p || isExponentMark(q[-1]));
        const bool mark = !exponent_seen && isExponentMark(*q);
        if (!isDigit(*q) && *q != '.' && !sign && !mark) {
            break;
        }
        if (length == copy.size()) {
            return nullptr;
        }
        exponent_seen = exponent_seen || mark;
        copy[length++] = mark ? 'E' : *q;
    }
    const char* const end = copy.data() + length;
    const auto [stop, problem] = std::from_chars(copy.data(), end, value);
    // No length, feed or speed comes near this; what is computed from the value then stays finite.
    constexpr double largest = 1e15;
    if (problem != std::errc{} || stop != end || !(std::abs(value) <= largest)) {
        return nullptr;
    }
    return q;
}

}  // namespace cusp::toolpath::detail
