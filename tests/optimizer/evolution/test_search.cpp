// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Searches: the same at any thread count, honest counts, the ends they come to, and the optimum where it is known.
#include "problems.hpp"

#include <cusp/optimizer/evolution/search.hpp>

#include <atomic>
#include <gtest/gtest.h>
#include <limits>
#include <mutex>
#include <set>
#include <tbb/global_control.h>

namespace {

using namespace cusp::optimizer;
using test_problems::bohachevsky;
using test_problems::bohachevskyGenes;
namespace base = cusp::base;

constexpr Algorithm algorithms[] = {Algorithm::VirusEvolutionary, Algorithm::Genetic, Algorithm::SteadyState,
                                    Algorithm::RandomSearch};

std::vector<std::pair<CandidateKey, double>> trace(const SearchSummary& summary) {
    std::vector<std::pair<CandidateKey, double>> out;
    for (const Ledger::Entry& e : summary.evaluated) out.emplace_back(e.key, e.evaluation.objectives.front());
    return out;
}

TEST(Search, TheSameAtAnyThreadCountAndAnotherWithAnotherSeed) {
    const Encoding genes = bohachevskyGenes(23, Coding::Gray);
    for (const Algorithm algorithm : algorithms) {
        SearchOptions options;
        options.algorithm = algorithm;
        options.max_evaluations = 700;
        const auto many = search(genes, inParallel(bohachevsky), options).value();
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        const auto single = search(genes, inParallel(bohachevsky), options).value();
        EXPECT_EQ(trace(many), trace(single));
        EXPECT_EQ(convergenceCsv(many.history), convergenceCsv(single.history));
        options.seed = 2;
        EXPECT_NE(trace(search(genes, inParallel(bohachevsky), options).value()), trace(many));
    }
}

TEST(Search, EvaluationsAreDistinctCandidatesAndTheLimitHoldsToTheCandidate) {
    const Encoding genes = bohachevskyGenes(6, Coding::Binary);
    for (const Algorithm algorithm : algorithms) {
        std::mutex mutex;
        std::multiset<Values> asked;
        const auto witness = [&](const Values& values) {
            const std::lock_guard lock(mutex);
            asked.insert(values);
            return bohachevsky(values);
        };
        SearchOptions options;
        options.algorithm = algorithm;
        options.max_evaluations = 333;
        const auto summary = search(genes, inParallel(witness), options).value();
        EXPECT_EQ(asked.size(), summary.evaluations);
        EXPECT_EQ(std::set<Values>(asked.begin(), asked.end()).size(), asked.size());
        EXPECT_LE(summary.evaluations, 333U);
        EXPECT_EQ(summary.evaluated.size(), summary.evaluations);
        EXPECT_EQ(summary.history.back().evaluations, summary.evaluations);
        EXPECT_EQ(summary.history.back().best, summary.bestObjective());
        double best = std::numeric_limits<double>::infinity();
        for (const Values& values : asked) best = std::min(best, bohachevsky(values));
        EXPECT_EQ(summary.bestObjective(), best);
    }
}

TEST(Search, ASmallSpaceIsExhaustedAndItsOptimumFound) {
    const Encoding genes = bohachevskyGenes(4, Coding::Binary);
    double best = std::numeric_limits<double>::infinity();
    for (int x = 0; x < 16; ++x)
        for (int y = 0; y < 16; ++y)
            best = std::min(best, bohachevsky({-1.0 + x * (2.0 / 15.0), -1.0 + y * (2.0 / 15.0)}));
    for (const Algorithm algorithm : algorithms) {
        SearchOptions options;
        options.algorithm = algorithm;
        options.max_evaluations = 100'000;
        const auto summary = search(genes, inParallel(bohachevsky), options).value();
        EXPECT_EQ(summary.termination, Termination::Exhausted);
        EXPECT_LE(summary.evaluations, 256U);
        EXPECT_EQ(summary.bestObjective(), best);
    }
}

TEST(Search, EndsByGenerationsTargetAndStall) {
    const Encoding genes = bohachevskyGenes(23, Coding::Gray);
    SearchOptions options;
    options.max_evaluations = 100'000;
    options.max_generations = 7;
    const auto generations = search(genes, inParallel(bohachevsky), options).value();
    EXPECT_EQ(generations.termination, Termination::Generations);
    EXPECT_EQ(generations.history.size(), 8U);
    options.max_generations = 0;
    options.target_objective = 0.01;
    const auto target = search(genes, inParallel(bohachevsky), options).value();
    EXPECT_EQ(target.termination, Termination::Target);
    EXPECT_LE(target.bestObjective(), 0.01);
    options.target_objective = -1.0;
    options.stall_generations = 5;
    const auto stalled = search(genes, inParallel([](const Values&) { return 1.0; }), options).value();
    EXPECT_EQ(stalled.termination, Termination::Stalled);
    EXPECT_EQ(stalled.history.size(), 6U);
}

TEST(Search, ViralEvaluationsAreCounted) {
    const Encoding genes = bohachevskyGenes(23, Coding::Binary);
    SearchOptions options = paperOptions();
    options.max_generations = 20;
    const auto viral = search(genes, inParallel(bohachevsky), options).value();
    // Seven viruses at 70 % of 20 hosts.
    for (std::size_t g = 1; g < viral.history.size(); ++g) EXPECT_EQ(viral.history[g].infections, 98U);
    EXPECT_GT(viral.viral_evaluations, viral.evaluations / 2);
    EXPECT_LT(viral.viral_evaluations, viral.evaluations);
    options.algorithm = Algorithm::Genetic;
    const auto plain = search(genes, inParallel(bohachevsky), options).value();
    EXPECT_EQ(plain.viral_evaluations, 0U);
    EXPECT_LE(plain.evaluations, 20U + 20U * 18U);
}

TEST(Search, TheBestNeverGetsWorseAndElitesStay) {
    const Encoding genes = bohachevskyGenes(23, Coding::Gray);
    SearchOptions options;
    options.max_evaluations = 2'000;
    const auto summary = search(genes, inParallel(bohachevsky), options).value();
    for (std::size_t g = 1; g < summary.history.size(); ++g) {
        EXPECT_LE(summary.history[g].best, summary.history[g - 1].best);
        EXPECT_GE(summary.history[g].population_best, summary.history[g].best);
        // The last record may be of a generation that the limit cut short.
        if (g + 1 < summary.history.size()) {
            EXPECT_EQ(summary.history[g].population_best, summary.history[g].best);
        }
    }
}

TEST(Search, APopulationThatBecameAlikeIsDrawnAnewAndKeepsItsBest) {
    const Encoding genes = bohachevskyGenes(23, Coding::Gray);
    for (const Algorithm algorithm : {Algorithm::VirusEvolutionary, Algorithm::Genetic, Algorithm::SteadyState}) {
        SearchOptions options;
        options.algorithm = algorithm;
        options.max_evaluations = 4'000;
        options.restart_diversity = 0.15;
        const auto summary = search(genes, inParallel(bohachevsky), options).value();
        std::size_t restarts = 0;
        for (std::size_t g = 1; g + 1 < summary.history.size(); ++g) {
            const bool alike = summary.history[g - 1].diversity < 0.15;
            ASSERT_EQ(summary.history[g].restarted, alike) << g;
            restarts += alike ? 1 : 0;
            if (alike) {
                EXPECT_GT(summary.history[g].diversity, 0.5);
            }
            ASSERT_EQ(summary.history[g].population_best, summary.history[g].best);
        }
        EXPECT_GE(restarts, 2U);
    }
}

TEST(Search, StartsAreJudgedFirst) {
    const Encoding genes = bohachevskyGenes(23, Coding::Gray);
    SearchOptions options;
    options.starts = {{0.0, 0.0}};
    const auto summary = search(genes, inParallel(bohachevsky), options).value();
    EXPECT_NEAR(summary.evaluated.front().evaluation.objectives.front(), 6.67e-13, 0.01e-13);
    EXPECT_EQ(summary.best, 0U);
}

TEST(Search, InfeasibleCandidatesAreAvoidedAndCarriedThrough) {
    const Encoding genes = bohachevskyGenes(12, Coding::Gray);
    const auto half = [](const Values& v) {
        return v[0] < 0.3 ? std::numeric_limits<double>::infinity() : bohachevsky(v);
    };
    for (const Algorithm algorithm : algorithms) {
        SearchOptions options = paperOptions();
        options.algorithm = algorithm;
        options.max_evaluations = 1'500;
        const auto summary = search(genes, inParallel(half), options).value();
        EXPECT_GE(summary.bestValues()[0], 0.3);
        EXPECT_LT(summary.bestObjective(), 1.0);
    }
}

TEST(Search, BadOptionsAreNamed) {
    const Encoding genes = bohachevskyGenes(12, Coding::Gray);
    SearchOptions options;
    options.population = 20;
    options.elite = 20;
    options.crossover_probability = 1.5;
    options.virus.infection_rate = 0.2;
    options.virus.min_infection_rate = 0.5;
    options.max_evaluations = 10;
    EXPECT_EQ(base::toText(search(genes, inParallel(bohachevsky), options).error()),
              "error: elite: 20 of 20 individuals; at least one must be new [evolution.option]\n"
              "error: crossover_probability: 1.5 is no share; it must be from 0 to 1 [evolution.option]\n"
              "error: max_evaluations: 10 do not suffice for a first population of 20 [evolution.option]\n"
              "error: virus.infection_rate: 0.2 is outside its interval 0.5 to 1 [evolution.option]\n");
}

TEST(Search, RawRouletteRefusesNegativeObjectives) {
    SearchOptions options = paperOptions();
    const auto summary =
        search(bohachevskyGenes(12, Coding::Gray), inParallel([](const Values& v) { return v[0]; }), options);
    ASSERT_FALSE(summary);
    EXPECT_EQ(summary.error().front().code, "evolution.negative-objective");
}

}  // namespace
