// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Straight-line code around from_chars and to_chars.
#include "limit_program.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <numbers>
#include <string_view>
#include <vector>

namespace cusp::bench {

namespace {

constexpr std::size_t block_bytes = 1U << 18U;
constexpr double deg_per_rad = 180.0 / std::numbers::pi;

char* printPoint(const std::array<double, 6>& v, char* at) {
    const double c = std::atan2(v[3], -v[4]) * deg_per_rad;
    const double a = std::atan2(std::sqrt(v[3] * v[3] + v[4] * v[4]), v[5]) * deg_per_rad;
    const std::array<double, 5> words{v[0], v[1], v[2], c, a};
    static constexpr std::string_view letters = "XYZCA";
    for (std::size_t i = 0; i < words.size(); ++i) {
        *at++ = letters[i];
        at = std::to_chars(at, at + 32, words[i], std::chars_format::fixed, 5).ptr;
        *at++ = ' ';
    }
    *at++ = '\n';
    return at;
}

bool parsePoint(std::string_view line, std::array<double, 6>& values) {
    if (!line.starts_with("GOTO/")) return false;
    const char* at = line.data() + 5;
    const char* const end = line.data() + line.size();
    for (double& value : values) {
        const auto [next, problem] = std::from_chars(at, end, value);
        if (problem != std::errc()) return false;
        at = next == end ? next : next + 1;
    }
    return true;
}

}  // namespace

std::uint64_t runLimitProgram(std::FILE* in, std::FILE* out) {
    std::vector<char> input(block_bytes);
    std::vector<char> output(4 * block_bytes);
    std::array<double, 6> values{};
    std::uint64_t points = 0;
    std::size_t held = 0;
    while (const std::size_t got = std::fread(input.data() + held, 1, block_bytes - held, in)) {
        const std::size_t size = held + got;
        char* at = output.data();
        std::size_t begin = 0;
        while (const void* stop = std::memchr(input.data() + begin, '\n', size - begin)) {
            const auto end = static_cast<std::size_t>(static_cast<const char*>(stop) - input.data());
            if (parsePoint({input.data() + begin, end - begin}, values)) {
                at = printPoint(values, at);
                ++points;
            }
            begin = end + 1;
        }
        held = size - begin;
        std::memmove(input.data(), input.data() + begin, held);
        std::fwrite(output.data(), 1, static_cast<std::size_t>(at - output.data()), out);
    }
    return points;
}

}  // namespace cusp::bench
