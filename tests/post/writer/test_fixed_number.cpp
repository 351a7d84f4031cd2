// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Printed numbers against the C library's own printing.
#include "fixed_number.hpp"

#include <cstdio>
#include <gtest/gtest.h>
#include <random>
#include <string>

namespace cusp::post {
namespace {

std::string text(double value, int decimals) {
    std::string out;
    appendFixed(out, toFixed(value, decimals), decimals);
    return out;
}

/// printf's text without trailing zeros, trailing point or "-0".
std::string witness(double value, int decimals) {
    std::array<char, 64> digits{};
    std::snprintf(digits.data(), digits.size(), "%.*f", decimals, value);
    std::string out = digits.data();
    if (out.find('.') != std::string::npos) {
        while (out.back() == '0') out.pop_back();
        if (out.back() == '.') out.pop_back();
    }
    return out == "-0" ? "0" : out;
}

TEST(FixedNumber, Examples) {
    EXPECT_EQ(text(10.0, 5), "10");
    EXPECT_EQ(text(-0.5, 3), "-0.5");
    EXPECT_EQ(text(0.00001, 5), "0.00001");
    EXPECT_EQ(text(-0.000001, 5), "0");
    EXPECT_EQ(text(-0.001234, 5), "-0.00123");
    EXPECT_EQ(text(123456.789, 2), "123456.79");
    EXPECT_EQ(text(9950.0, 0), "9950");
    EXPECT_EQ(text(0.1, 0), "0");
}

TEST(FixedNumber, AgreesWithPrintf) {
    constexpr unsigned seed = 20261123;
    RecordProperty("seed", static_cast<int>(seed));
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> mantissa(-1.0, 1.0);
    std::uniform_int_distribution<int> exponent(-7, 6);
    std::uniform_int_distribution<int> places(0, 6);
    for (int i = 0; i < 200000; ++i) {
        const double value = mantissa(engine) * std::pow(10.0, exponent(engine));
        const int decimals = places(engine);
        ASSERT_EQ(text(value, decimals), witness(value, decimals)) << "value " << value << ", decimals " << decimals;
    }
}

}  // namespace
}  // namespace cusp::post
