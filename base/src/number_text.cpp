// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// std::from_chars and std::to_chars with the habits of shop-floor files on top.
#include <cusp/base/number_text.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>

namespace cusp::base {
namespace {

/// Drops one leading '+', which std::from_chars does not know.
std::string_view withoutPlus(std::string_view text) {
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    return text;
}

void trimZeros(std::string& out, std::size_t start, TrailingZeros zeros) {
    const std::size_t point = out.find('.', start);
    if (point == std::string::npos) {
        if (zeros == TrailingZeros::KeepOne) out += ".0";
        return;
    }
    std::size_t end = out.find_last_not_of('0') + 1;
    if (end == point + 1) end = zeros == TrailingZeros::KeepOne ? point + 2 : point;
    out.resize(end);
}

}  // namespace

std::optional<double> parseDouble(std::string_view text) {
    text = withoutPlus(text);
    const std::string_view unsigned_text = text.starts_with('-') ? text.substr(1) : text;
    // std::from_chars also reads "inf" and "nan".
    if (unsigned_text.empty() || std::string_view("0123456789.").find(unsigned_text.front()) == std::string_view::npos)
        return std::nullopt;
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end) return std::nullopt;
    return value;
}

std::optional<std::int64_t> parseInteger(std::string_view text) {
    text = withoutPlus(text);
    std::int64_t value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc{} || stop != end) return std::nullopt;
    return value;
}

void appendFixed(std::string& out, double value, int decimals, TrailingZeros zeros) {
    // The largest double has 309 digits before the point; more than 60 behind it nobody asks for.
    std::array<char, 384> buffer{};
    const int places = std::clamp(decimals, 0, 60);
    const auto [end, error] =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, places);
    std::string_view text(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
    if (text.starts_with('-') && text.find_first_not_of("-0.") == std::string_view::npos) text.remove_prefix(1);
    const std::size_t start = out.size();
    out += text;
    if (zeros != TrailingZeros::Keep) trimZeros(out, start, zeros);
}

std::string formatFixed(double value, int decimals, TrailingZeros zeros) {
    std::string out;
    appendFixed(out, value, decimals, zeros);
    return out;
}

std::string formatShortest(double value) {
    if (value == 0.0) return "0";
    std::array<char, 32> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
    return {buffer.data(), end.ptr};
}

}  // namespace cusp::base
