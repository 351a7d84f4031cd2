// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Operators, each alone: what they keep, and how often they do what.
#include <cusp/optimizer/evolution/operators.hpp>

#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>

namespace {

using namespace cusp::optimizer;
using cusp::base::Random;

int ones(const Bits& bits) { return std::accumulate(bits.begin(), bits.end(), 0); }

TEST(Operators, RandomBitsAreFair) {
    Random random(1);
    const int count = ones(randomBits(100'000, random));
    EXPECT_NEAR(count, 50'000, 800);  // five standard deviations
}

TEST(Operators, RouletteFollowsFitness) {
    Random random(2);
    const std::vector<double> fitness{1.0, 0.0, 3.0};
    std::vector<int> count(3);
    for (int i = 0; i < 40'000; ++i) ++count[selectByRoulette(fitness, random)];
    EXPECT_EQ(count[1], 0);
    EXPECT_NEAR(count[0], 10'000, 450);
    EXPECT_NEAR(count[2], 30'000, 450);
}

TEST(Operators, RouletteWithoutFitnessIsUniform) {
    Random random(3);
    std::vector<int> count(4);
    for (int i = 0; i < 40'000; ++i) ++count[selectByRoulette(std::vector<double>(4, 0.0), random)];
    for (const int c : count) EXPECT_NEAR(c, 10'000, 450);
}

TEST(Operators, TournamentOfTwoPicksTheBestWithTheChanceOfOneInTwoDraws) {
    Random random(4);
    const std::vector<double> objectives{3.0, 1.0, 2.0, 4.0};
    std::vector<int> count(4);
    for (int i = 0; i < 40'000; ++i) ++count[selectByTournament(objectives, 2, random)];
    // 1 − (3/4)², (3/4)² − (2/4)², …
    EXPECT_NEAR(count[1], 17'500, 500);
    EXPECT_NEAR(count[2], 12'500, 500);
    EXPECT_NEAR(count[0], 7'500, 500);
    EXPECT_NEAR(count[3], 2'500, 500);
}

TEST(Operators, EliteIsSortedAndStable) {
    const std::vector<double> objectives{2.0, 1.0, 2.0, 0.5};
    EXPECT_EQ(eliteOf(objectives, 3), (std::vector<std::size_t>{3, 1, 0}));
    EXPECT_EQ(eliteOf(objectives, 9).size(), 4U);
}

TEST(Operators, CrossingKeepsEveryLocusPair) {
    Random random(5);
    for (int trial = 0; trial < 300; ++trial) {
        const Bits a0 = randomBits(46, random);
        const Bits b0 = randomBits(46, random);
        for (const auto cross : {crossSinglePoint, crossTwoPoint, crossUniform}) {
            Bits a = a0;
            Bits b = b0;
            cross(a, b, random);
            for (std::size_t i = 0; i < a.size(); ++i)
                ASSERT_TRUE((a[i] == a0[i] && b[i] == b0[i]) || (a[i] == b0[i] && b[i] == a0[i]));
        }
    }
}

TEST(Operators, SinglePointHasOneSeam) {
    Random random(6);
    std::vector<int> cuts(8);
    for (int trial = 0; trial < 7'000; ++trial) {
        Bits a(8, 0);
        Bits b(8, 1);
        crossSinglePoint(a, b, random);
        ASSERT_EQ(a.front(), 0);
        ASSERT_TRUE(std::is_sorted(a.begin(), a.end()));
        ++cuts[static_cast<std::size_t>(8 - ones(a))];
    }
    EXPECT_EQ(cuts[0], 0);
    for (std::size_t cut = 1; cut < 8; ++cut) EXPECT_NEAR(cuts[cut], 1'000, 150);
    Bits single{1};
    Bits other{0};
    crossSinglePoint(single, other, random);
    EXPECT_EQ(single, Bits{1});
}

TEST(Operators, MutationTurnsAsManyBitsAsAsked) {
    Random random(7);
    Bits bits(46, 0);
    mutateSinglePoint(bits, random);
    EXPECT_EQ(ones(bits), 1);
    int turned = 0;
    for (int i = 0; i < 10'000; ++i) {
        Bits zero(46, 0);
        mutatePerBit(zero, 1.0 / 46.0, random);
        turned += ones(zero);
    }
    EXPECT_NEAR(turned, 10'000, 500);
    Bits zero(46, 0);
    mutatePerBit(zero, 0.0, random);
    EXPECT_EQ(ones(zero), 0);
}

}  // namespace
