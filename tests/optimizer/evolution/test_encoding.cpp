// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Chromosomes: eq. 8 at its ends, every pattern of small genes, Gray neighbours, and back again.
#include <cusp/optimizer/evolution/encoding.hpp>

#include <bit>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace {

using namespace cusp::optimizer;

Bits bitsOfNumber(std::uint64_t number, int count) {
    Bits out;
    for (int b = count - 1; b >= 0; --b)
        out.push_back(static_cast<std::uint8_t>((number >> static_cast<unsigned>(b)) & 1U));
    return out;
}

TEST(Encoding, TheEndsOfTheRangeAreExactAndTheStepIsEq8) {
    const auto encoding = Encoding::create({{.name = "x", .bits = 23, .lower = -1.0, .upper = 1.0}}).value();
    EXPECT_EQ(encoding.decode(bitsOfNumber(0, 23)), Values{-1.0});
    EXPECT_EQ(encoding.decode(bitsOfNumber((1U << 23U) - 1, 23)), Values{1.0});
    EXPECT_EQ(encoding.decode(bitsOfNumber(4194303, 23)), Values{-1.0 + 4194303 * (2.0 / 8388607.0)});
}

TEST(Encoding, PlainBinaryWeighsTheFirstBitMost) {
    const auto encoding = Encoding::create({{.name = "x", .bits = 3, .lower = 0.0, .upper = 7.0}}).value();
    EXPECT_EQ(encoding.decode({1, 0, 0}), Values{4.0});
    EXPECT_EQ(encoding.decode({0, 0, 1}), Values{1.0});
}

TEST(Encoding, GrayNeighboursDifferByOneBit) {
    const auto encoding =
        Encoding::create({{.name = "x", .bits = 10, .lower = 0.0, .upper = 1023.0}}, Coding::Gray).value();
    Bits before = encoding.encode({0.0});
    for (int value = 1; value < 1024; ++value) {
        const Bits bits = encoding.encode({static_cast<double>(value)});
        int different = 0;
        for (std::size_t b = 0; b < bits.size(); ++b) different += bits[b] != before[b] ? 1 : 0;
        ASSERT_EQ(different, 1) << value;
        before = bits;
    }
}

TEST(Encoding, EveryPatternDecodesToAGridValueAndBack) {
    for (const Coding coding : {Coding::Binary, Coding::Gray}) {
        const auto encoding = Encoding::create({{.name = "a", .bits = 5, .lower = -3.0, .upper = 4.0},
                                                {.name = "b", .bits = 4, .lower = 0.0, .upper = 8.0, .choices = 9}},
                                               coding)
                                  .value();
        std::set<Values> seen;
        for (std::uint64_t pattern = 0; pattern < 512; ++pattern) {
            const Values values = encoding.decode(bitsOfNumber(pattern, 9));
            seen.insert(values);
            ASSERT_EQ(encoding.decode(encoding.encode(values)), values) << pattern;
        }
        EXPECT_EQ(seen.size(), 32U * 9U);
        EXPECT_EQ(encoding.candidateCount(), 32.0 * 9.0);
    }
}

TEST(Encoding, PatternsBeyondTheChoicesAreSharedEvenly) {
    const auto encoding =
        Encoding::create({{.name = "tool", .bits = 10, .lower = 0.0, .upper = 8.0, .choices = 9}}).value();
    std::map<double, int> count;
    for (std::uint64_t pattern = 0; pattern < 1024; ++pattern)
        ++count[encoding.decode(bitsOfNumber(pattern, 10)).front()];
    ASSERT_EQ(count.size(), 9U);
    for (const auto& [value, times] : count) {
        EXPECT_EQ(value, std::round(value));
        EXPECT_GE(times, 113);
        EXPECT_LE(times, 114);
    }
}

TEST(Encoding, EncodesTheNearestGridValue) {
    const auto encoding = Encoding::create({{.name = "x", .bits = 2, .lower = 0.0, .upper = 3.0}}).value();
    EXPECT_EQ(encoding.decode(encoding.encode({1.4})), Values{1.0});
    EXPECT_EQ(encoding.decode(encoding.encode({1.6})), Values{2.0});
    EXPECT_EQ(encoding.decode(encoding.encode({-7.0})), Values{0.0});
    EXPECT_EQ(encoding.decode(encoding.encode({99.0})), Values{3.0});
}

TEST(Encoding, SaysWhatIsWrongWithAGene) {
    const auto encoding = Encoding::create({{.name = "wide", .bits = 53},
                                            {.name = "empty", .bits = 4, .lower = 2.0, .upper = 2.0},
                                            {.name = "many", .bits = 2, .choices = 5},
                                            {.name = "many", .bits = 2}});
    ASSERT_FALSE(encoding);
    EXPECT_EQ(cusp::base::toText(encoding.error()),
              "error: wide: 53 bits; a gene has 1 to 52 [evolution.bits]\n"
              "error: empty: the range 2 to 2 is empty; the lower limit must be below the upper one "
              "[evolution.empty-range]\n"
              "error: many: 5 choices do not fit in 2 bits, which tell 4 apart [evolution.choices]\n"
              "error: many: two genes have this name [evolution.duplicate-gene]\n");
    EXPECT_EQ(Encoding::create({}).error().front().code, "evolution.no-genes");
}

}  // namespace
