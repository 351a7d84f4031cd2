// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The generators against published output, the jump against linear algebra, the distributions against their moments.
#include <cusp/base/random.hpp>

#include <algorithm>
#include <array>
#include <bitset>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <set>
#include <vector>

namespace {

using namespace cusp::base;
using State = std::array<std::uint64_t, 4>;

// Rosetta Code, "Pseudo-random numbers/Splitmix64", seed 1234567.
TEST(Random, SplitMix64KnowsThePublishedOutput) {
    std::uint64_t state = 1234567;
    for (const std::uint64_t expected : {6457827717110365317U, 3203168211198807973U, 9817491932198370423U,
                                         4593380528125082431U, 16408922859458223821U})
        EXPECT_EQ(splitMix64(state), expected);
}

// The authors' C program (prng.di.unimi.it/xoshiro256starstar.c) from state 1, 2, 3, 4, as quoted in the tests of the Rust
// crate rand_xoshiro.
TEST(Random, XoshiroKnowsThePublishedOutput) {
    Random random = Random::fromState({1, 2, 3, 4});
    for (const std::uint64_t expected :
         {std::uint64_t{11520}, std::uint64_t{0}, std::uint64_t{1509978240}, std::uint64_t{1215971899390074240U},
          std::uint64_t{1216172134540287360U}, std::uint64_t{607988272756665600U}, std::uint64_t{16172922978634559625U},
          std::uint64_t{8476171486693032832U}, std::uint64_t{10595114339597558777U},
          std::uint64_t{2904607092377533576U}})
        EXPECT_EQ(random.next(), expected);
}

using Vector = std::bitset<256>;
using Matrix = std::vector<Vector>;  // column by column

Vector times(const Matrix& matrix, const Vector& vector) {
    Vector out;
    for (std::size_t i = 0; i < 256; ++i)
        if (vector[i]) out ^= matrix[i];
    return out;
}

Vector bitsOf(const State& state) {
    Vector out;
    for (std::size_t i = 0; i < 256; ++i) out[i] = ((state[i / 64] >> (i % 64)) & 1U) != 0;
    return out;
}

/// The state's step is linear over GF(2): its matrix, squared 128 times, is 2^128 steps. This uses nothing of the
/// authors' jump polynomial.
TEST(Random, JumpIsTwoToThe128Steps) {
    Matrix power(256);
    for (std::size_t i = 0; i < 256; ++i) {
        State unit{};
        unit[i / 64] = std::uint64_t{1} << (i % 64);
        Random step = Random::fromState(unit);
        static_cast<void>(step.next());
        power[i] = bitsOf(step.state());
    }
    for (int k = 0; k < 128; ++k) {
        Matrix square(256);
        for (std::size_t i = 0; i < 256; ++i) square[i] = times(power, power[i]);
        power = std::move(square);
    }
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        Random random(seed);
        const Vector expected = times(power, bitsOf(random.state()));
        random.jump();
        EXPECT_EQ(bitsOf(random.state()), expected);
    }
}

TEST(Random, SameSeedSameDraws) {
    Random a(42);
    Random b(42);
    Random c(43);
    bool differs = false;
    for (int i = 0; i < 100; ++i) {
        const double value = a.normal();
        EXPECT_EQ(value, b.normal());
        differs = differs || value != c.normal();
    }
    EXPECT_TRUE(differs);
}

/// Pinned: whoever changes how a number is drawn changes every seeded result of the house. The values are those of a
/// separate implementation in Python, whose logarithm is the C library's: the normal deviates agree to the last bits.
TEST(Random, DrawsArePinned) {
    Random random(1);
    EXPECT_EQ(random.next(), 12966619160104079557U);
    EXPECT_EQ(random.below(1000), 520U);
    EXPECT_EQ(random.integer(-5, 5), 1);
    EXPECT_EQ(random.uniform(), 0x1.90b871ef099a8p-2);
    EXPECT_DOUBLE_EQ(random.normal(), 0x1.c0d732ae4b3ddp-2);
    EXPECT_DOUBLE_EQ(random.normal(), -0x1.95abea9281847p-1);
    std::vector<int> items{0, 1, 2, 3, 4, 5, 6, 7};
    random.shuffle(items);
    EXPECT_EQ(items, (std::vector<int>{7, 1, 4, 3, 6, 5, 2, 0}));
}

TEST(Random, UniformFillsItsInterval) {
    Random random(5);
    constexpr int count = 200000;
    double sum = 0.0;
    double squares = 0.0;
    for (int i = 0; i < count; ++i) {
        const double x = random.uniform();
        ASSERT_GE(x, 0.0);
        ASSERT_LT(x, 1.0);
        sum += x;
        squares += x * x;
    }
    // Five standard errors: 5 √(1/12/n) and 5 √(4/45/n).
    EXPECT_NEAR(sum / count, 0.5, 5.0 * std::sqrt(1.0 / 12.0 / count));
    EXPECT_NEAR(squares / count, 1.0 / 3.0, 5.0 * std::sqrt(4.0 / 45.0 / count));
    const double tiny = std::nextafter(1.0, 2.0);
    for (int i = 0; i < 1000; ++i) ASSERT_EQ(random.uniform(1.0, tiny), 1.0);  // never the open end
    EXPECT_EQ(random.uniform(3.0, 3.0), 3.0);
}

TEST(Random, BelowIsUnbiased) {
    Random random(6);
    // For n = 3·2^62 a mere modulus or an unchecked product would be off by a third.
    constexpr std::uint64_t n = std::uint64_t{3} << 62U;
    constexpr int count = 90000;
    std::array<int, 3> hits{};
    for (int i = 0; i < count; ++i) {
        const std::uint64_t x = random.below(n);
        ASSERT_LT(x, n);
        ++hits[static_cast<std::size_t>(x >> 62U)];
    }
    for (const int h : hits) EXPECT_NEAR(h, count / 3.0, 5.0 * std::sqrt(count * 2.0 / 9.0));
    EXPECT_EQ(random.below(0), 0U);
    EXPECT_EQ(random.below(1), 0U);
}

TEST(Random, IntegerReachesBothEnds) {
    Random random(7);
    std::set<std::int64_t> seen;
    for (int i = 0; i < 1000; ++i) seen.insert(random.integer(-2, 3));
    EXPECT_EQ(seen, (std::set<std::int64_t>{-2, -1, 0, 1, 2, 3}));
    constexpr auto low = std::numeric_limits<std::int64_t>::min();
    constexpr auto high = std::numeric_limits<std::int64_t>::max();
    bool negative = false;
    bool positive = false;
    for (int i = 0; i < 64; ++i) (random.integer(low, high) < 0 ? negative : positive) = true;
    EXPECT_TRUE(negative && positive);
    EXPECT_EQ(random.integer(high, high), high);
}

TEST(Random, NormalHasItsMomentsAndTails) {
    Random random(8);
    constexpr int count = 400000;
    std::array<double, 4> moments{};
    int beyond_three = 0;
    for (int i = 0; i < count; ++i) {
        const double x = random.normal();
        ASSERT_TRUE(std::isfinite(x));
        double power = 1.0;
        for (double& m : moments) m += (power *= x) / count;
        if (std::abs(x) > 3.0) ++beyond_three;
    }
    // Five standard errors each; the variances of x, x², x³, x⁴ are 1, 2, 15, 96.
    const double root = std::sqrt(static_cast<double>(count));
    EXPECT_NEAR(moments[0], 0.0, 5.0 * 1.0 / root);
    EXPECT_NEAR(moments[1], 1.0, 5.0 * std::sqrt(2.0) / root);
    EXPECT_NEAR(moments[2], 0.0, 5.0 * std::sqrt(15.0) / root);
    EXPECT_NEAR(moments[3], 3.0, 5.0 * std::sqrt(96.0) / root);
    const double p = std::erfc(3.0 / std::sqrt(2.0));
    EXPECT_NEAR(beyond_three, count * p, 5.0 * std::sqrt(count * p));
}

/// The polar method again, with the library's logarithm: our own is right to the last few bits.
TEST(Random, NormalMatchesTheLibraryLogarithm) {
    Random random(9);
    Random witness(9);
    for (int i = 0; i < 100000; ++i) {
        double u = 0.0;
        double v = 0.0;
        double s = 0.0;
        do {
            u = 2.0 * witness.uniform() - 1.0;
            v = 2.0 * witness.uniform() - 1.0;
            s = u * u + v * v;
        } while (s >= 1.0 || s == 0.0);
        const double scale = std::sqrt(-2.0 * std::log(s) / s);
        // Near s = 1 the logarithm is small and its relative error what matters; 1e-15 is nine units in the last place.
        ASSERT_NEAR(random.normal(), u * scale, 1e-15 * std::abs(u * scale));
        ASSERT_NEAR(random.normal(), v * scale, 1e-15 * std::abs(v * scale));
    }
}

TEST(Random, ShuffleReachesEveryOrderEqually) {
    Random random(10);
    constexpr int count = 60000;
    std::array<int, 6> hits{};
    for (int i = 0; i < count; ++i) {
        std::array<int, 3> items{0, 1, 2};
        random.shuffle(items);
        ++hits[static_cast<std::size_t>(items[0] * 2 + (items[1] > items[2] ? 1 : 0))];
    }
    for (const int h : hits) EXPECT_NEAR(h, count / 6.0, 5.0 * std::sqrt(count * 5.0 / 36.0));
}

TEST(Random, SplitsAreReproducibleAndDoNotMeet) {
    const Random parent(11);
    std::set<std::uint64_t> seen;
    for (std::uint64_t i = 0; i < 100; ++i) {
        Random child = parent.split(i);
        Random again = parent.split(i);
        for (int k = 0; k < 100; ++k) {
            const std::uint64_t x = child.next();
            EXPECT_EQ(x, again.next());
            seen.insert(x);
        }
    }
    EXPECT_EQ(seen.size(), 10000U);
    EXPECT_EQ(parent.state(), Random(11).state());
    Random moved(11);
    static_cast<void>(moved.next());
    EXPECT_NE(moved.split(0).state(), parent.split(0).state());
}

}  // namespace
