// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Viruses: where they are cut, where they are written, how they grow, and the sign of eq. 11.
#include <cusp/optimizer/evolution/operators.hpp>
#include <cusp/optimizer/evolution/virus.hpp>

#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace {

using namespace cusp::optimizer;
using cusp::base::Random;

bool isPartOf(const Virus& virus, const Bits& host) {
    for (std::size_t i = 0; i < virus.bits.size(); ++i)
        if (virus.bits[i] != host[virus.locus + i]) return false;
    return true;
}

TEST(Virus, TransductionCutsAPartOfItsHostAtEveryAllowedLengthAndPlace) {
    Random random(11);
    VirusOptions options;
    options.shortest = 2;
    options.longest = 5;
    std::vector<int> lengths(7);
    std::vector<int> loci(8);
    for (int trial = 0; trial < 4'000; ++trial) {
        const Bits host = randomBits(8, random);
        const Virus virus = transduce(host, options, random);
        ASSERT_LE(virus.locus + virus.bits.size(), host.size());
        ASSERT_TRUE(isPartOf(virus, host));
        ++lengths[virus.bits.size()];
        ++loci[virus.locus];
    }
    for (std::size_t length = 0; length < lengths.size(); ++length)
        EXPECT_EQ(lengths[length] > 0, length >= 2 && length <= 5) << length;
    for (std::size_t locus = 0; locus < loci.size(); ++locus) EXPECT_EQ(loci[locus] > 0, locus <= 6) << locus;
}

TEST(Virus, ReverseTranscriptionOverwritesItsLociAndNothingElse) {
    const Bits host{0, 0, 0, 0, 0, 0};
    const Virus virus{.locus = 2, .bits = {1, 0, 1}};
    EXPECT_EQ(reverseTranscribe(host, virus), (Bits{0, 0, 1, 0, 1, 0}));
}

TEST(Virus, AnInfectedStringIsInfectedOnce) {
    Random random(12);
    for (int trial = 0; trial < 200; ++trial) {
        const Virus virus = transduce(randomBits(46, random), {}, random);
        const Bits infected = reverseTranscribe(randomBits(46, random), virus);
        ASSERT_EQ(reverseTranscribe(infected, virus), infected);
        ASSERT_TRUE(isPartOf(virus, infected));
    }
}

TEST(Virus, PartialTransductionKeepsItsOwnBitsAndTakesTheHostsAround) {
    Random random(13);
    VirusOptions options;
    options.longest = 40;
    for (int trial = 0; trial < 2'000; ++trial) {
        const Virus before = transduce(randomBits(46, random), options, random);
        if (before.bits.size() == 40) continue;
        const Bits host = randomBits(46, random);
        Virus after = before;
        transducePartially(after, host, options, random);
        ASSERT_GT(after.bits.size(), before.bits.size());
        ASSERT_LE(after.bits.size(), 40U);
        ASSERT_LE(after.locus, before.locus);
        ASSERT_GE(after.locus + after.bits.size(), before.locus + before.bits.size());
        ASSERT_TRUE(isPartOf(after, reverseTranscribe(host, before)));
    }
}

TEST(Virus, AtItsLongestItTakesOverAPartOfItsOwnLoci) {
    Random random(14);
    VirusOptions options;
    options.longest = 6;
    const Bits host(6, 1);
    for (int trial = 0; trial < 100; ++trial) {
        Virus virus{.locus = 0, .bits = Bits(6, 0)};
        transducePartially(virus, host, options, random);
        ASSERT_EQ(virus.bits.size(), 6U);
        ASSERT_NE(virus.bits, Bits(6, 0));
    }
}

TEST(Virus, GainIsAboveZeroWhereTheObjectiveFalls) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(infectionGain(3.0, 1.0), 2.0);
    EXPECT_EQ(infectionGain(1.0, 3.0), -2.0);
    EXPECT_EQ(infectionGain(infinity, infinity), 0.0);
    EXPECT_EQ(infectionGain(infinity, 1.0), std::numeric_limits<double>::max());
    EXPECT_EQ(virusFitness(std::vector<double>{2.0, -0.5, 0.0}), 1.5);
    EXPECT_EQ(virusFitness(std::vector<double>(3, std::numeric_limits<double>::max())),
              std::numeric_limits<double>::max());
}

TEST(Virus, TheForceDecidesItsFate) {
    VirusOptions options;
    options.infectivity_force = 0.5;
    Virus virus{.locus = 0, .bits = {1}, .infection_rate = 0.7, .force = 0.0};
    EXPECT_EQ(updateInfectivity(virus, 4.0, options), VirusFate::Grow);   // 0 → 4
    EXPECT_EQ(updateInfectivity(virus, 2.0, options), VirusFate::Keep);   // 4 → 0.5 · 4 + 2
    EXPECT_EQ(updateInfectivity(virus, 1.0, options), VirusFate::Renew);  // 4 → 3
    virus.force = 0.0;
    EXPECT_EQ(updateInfectivity(virus, 0.0, options), VirusFate::Renew);
    EXPECT_EQ(updateInfectivity(virus, -1.0, options), VirusFate::Renew);
}

TEST(Virus, TheRateAdaptsWithinItsInterval) {
    VirusOptions options;
    options.rate_adaptation = 0.5;
    options.min_infection_rate = 0.5;
    Virus virus{.locus = 0, .bits = {1}, .infection_rate = 0.6, .force = 0.0};
    static_cast<void>(updateInfectivity(virus, 1.0, options));
    EXPECT_NEAR(virus.infection_rate, 0.9, 1e-15);
    static_cast<void>(updateInfectivity(virus, 1.0, options));
    EXPECT_EQ(virus.infection_rate, 1.0);
    static_cast<void>(updateInfectivity(virus, 0.0, options));
    static_cast<void>(updateInfectivity(virus, 0.0, options));
    EXPECT_EQ(virus.infection_rate, 0.5);
}

}  // namespace
