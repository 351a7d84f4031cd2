// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Numbers in shop-floor spelling, against std::strtod and std::snprintf as witnesses.
#include <cusp/base/number_text.hpp>
#include <cusp/base/random.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>
#include <limits>
#include <string>

namespace {

using namespace cusp::base;

TEST(NumberText, ReadsShopFloorSpellings) {
    EXPECT_EQ(parseDouble("12.5"), 12.5);
    EXPECT_EQ(parseDouble("+12.5"), 12.5);
    EXPECT_EQ(parseDouble("-.5"), -0.5);
    EXPECT_EQ(parseDouble(".5"), 0.5);
    EXPECT_EQ(parseDouble("1."), 1.0);
    EXPECT_EQ(parseDouble("1e-3"), 0.001);
    EXPECT_EQ(parseDouble("1.E+2"), 100.0);
    EXPECT_EQ(parseDouble("0001"), 1.0);
    EXPECT_TRUE(std::signbit(parseDouble("-0").value()));
    EXPECT_EQ(parseInteger("+42"), 42);
    EXPECT_EQ(parseInteger("-9223372036854775808"), std::numeric_limits<std::int64_t>::min());
}

TEST(NumberText, RefusesEverythingElse) {
    for (const char* text : {"",   " 1",  "1 ",  "+",    "-",   ".",    "+-1",   "-+1",    "--1", "1,5", "1.2.3",
                             "1e", "1e+", "inf", "-inf", "nan", "0x10", "1e999", "1e-999", "1d3", "one", "1_000"})
        EXPECT_FALSE(parseDouble(text).has_value()) << '"' << text << '"';
    for (const char* text : {"", "+", "-", "+-1", "1.", "1.0", "9223372036854775808", " 1", "0x1", "1e3"})
        EXPECT_FALSE(parseInteger(text).has_value()) << '"' << text << '"';
    using namespace std::string_view_literals;
    EXPECT_FALSE(parseDouble("1\0"sv).has_value());
}

TEST(NumberText, WritesFixedPlaces) {
    EXPECT_EQ(formatFixed(1.5, 3), "1.500");
    EXPECT_EQ(formatFixed(1.5, 3, TrailingZeros::Strip), "1.5");
    EXPECT_EQ(formatFixed(2.0, 3, TrailingZeros::Strip), "2");
    EXPECT_EQ(formatFixed(2.0, 3, TrailingZeros::KeepOne), "2.0");
    EXPECT_EQ(formatFixed(1.5, 3, TrailingZeros::KeepOne), "1.5");
    EXPECT_EQ(formatFixed(100.0, 0), "100");
    EXPECT_EQ(formatFixed(100.0, 0, TrailingZeros::Strip), "100");
    EXPECT_EQ(formatFixed(100.0, 0, TrailingZeros::KeepOne), "100.0");
    EXPECT_EQ(formatFixed(7.0, -3), "7");
    std::string out = "X1.20";
    appendFixed(out, 3.0, 2, TrailingZeros::Strip);
    EXPECT_EQ(out, "X1.203");
}

TEST(NumberText, NeverWritesMinusZero) {
    EXPECT_EQ(formatFixed(-0.0, 3), "0.000");
    EXPECT_EQ(formatFixed(-0.0004, 3), "0.000");
    EXPECT_EQ(formatFixed(-0.0004, 3, TrailingZeros::Strip), "0");
    EXPECT_EQ(formatFixed(-0.0006, 3), "-0.001");
    EXPECT_EQ(formatFixed(-0.4, 0), "0");
    EXPECT_EQ(formatShortest(-0.0), "0");
}

TEST(NumberText, AgreesWithThePrintfFamily) {
    constexpr std::uint64_t seed = 20240611;
    RecordProperty("seed", std::to_string(seed));
    Random random(seed);
    for (int i = 0; i < 20000; ++i) {
        const double value = random.uniform(-1.0, 1.0) * std::pow(10.0, static_cast<double>(random.integer(-8, 8)));
        const int decimals = static_cast<int>(random.integer(0, 9));
        std::array<char, 400> expected{};
        static_cast<void>(std::snprintf(expected.data(), expected.size(), "%.*f", decimals, value));
        std::string text = expected.data();
        if (text.front() == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
        ASSERT_EQ(formatFixed(value, decimals), text);
        const std::string stripped = formatFixed(value, decimals, TrailingZeros::Strip);
        ASSERT_EQ(std::strtod(stripped.c_str(), nullptr), std::strtod(text.c_str(), nullptr));
        ASSERT_EQ(parseDouble(text).value(), std::strtod(text.c_str(), nullptr));
    }
    EXPECT_EQ(formatFixed(std::numeric_limits<double>::max(), 60).size(), 309U + 1U + 60U);
}

TEST(NumberText, ShortestReadsBackExactly) {
    constexpr std::uint64_t seed = 7;
    RecordProperty("seed", std::to_string(seed));
    Random random(seed);
    for (int i = 0; i < 20000; ++i) {
        const double value = std::bit_cast<double>(random.next());
        if (!std::isfinite(value)) continue;
        ASSERT_EQ(std::strtod(formatShortest(value).c_str(), nullptr), value);
    }
    EXPECT_EQ(formatShortest(0.1), "0.1");
    EXPECT_EQ(formatShortest(-120.0), "-120");
}

}  // namespace
