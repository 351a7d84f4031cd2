// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The strategy on real vectors: lexicographic order, bounds, thread counts, known optima.
#include "problems.hpp"

#include <cusp/optimizer/evolution/evolution_strategy.hpp>

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace {

using namespace cusp::optimizer;
namespace base = cusp::base;

const std::vector<RealVariable> cube{{"x", -40.0, 40.0}, {"y", -40.0, 40.0}, {"z", 0.0, 80.0}};

double distance(const Values& a, const Values& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

TEST(Strategy, FindsTheCentreOfASphere) {
    const Values centre{12.0, -31.0, 55.0};
    for (const SurvivorSelection selection : {SurvivorSelection::Tournament, SurvivorSelection::Truncation})
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            StrategyOptions options;
            options.seed = seed;
            options.selection = selection;
            options.max_evaluations = 2'000;
            const auto summary =
                evolve(cube, inParallel([&](const Values& v) { return distance(v, centre); }), options).value();
            // Tournaments of two press less: ten times farther away after the same 40 generations.
            EXPECT_LT(summary.bestEvaluation().objectives.front(),
                      selection == SurvivorSelection::Tournament ? 1.0 : 0.1)
                << "seed " << seed;
        }
}

TEST(Strategy, TheFirstObjectiveRulesTheSecond) {
    // Violations first: count of axes outside a box; then distance to a point outside it. The best is the box's corner.
    const Evaluate judge = [](const Values& v) -> base::Result<Evaluation> {
        double violations = 0.0;
        for (const double x : v) violations += x > 10.0 ? 1.0 : 0.0;
        return Evaluation{{violations, distance(v, {20.0, 20.0, 20.0})}, {}};
    };
    StrategyOptions options;
    options.objectives = 2;
    options.max_evaluations = 4'000;
    options.selection = SurvivorSelection::Truncation;
    const auto summary = evolve(cube, inParallel(judge), options).value();
    EXPECT_EQ(summary.bestEvaluation().objectives[0], 0.0);
    EXPECT_LT(distance(summary.bestValues(), {10.0, 10.0, 10.0}), 0.5);
    for (std::size_t g = 1; g < summary.history.size(); ++g)
        EXPECT_FALSE(lexicographicallyLess(summary.history[g - 1].best, summary.history[g].best));
}

TEST(Strategy, TheSameAtAnyThreadCount) {
    StrategyOptions options;
    const auto judge = inParallel([](const Values& v) { return distance(v, {1.0, 2.0, 3.0}); });
    const auto many = evolve(cube, judge, options).value();
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto single = evolve(cube, judge, options).value();
    ASSERT_EQ(many.evaluations, single.evaluations);
    for (std::size_t i = 0; i < many.evaluated.size(); ++i)
        ASSERT_EQ(many.evaluated[i].values, single.evaluated[i].values);
}

TEST(Strategy, EveryCandidateIsWithinItsRange) {
    StrategyOptions options;
    options.initial_step = 1.0;
    options.starts = {{100.0, -100.0, 3.0}};
    // The optimum is a corner, so that candidates press against the limits.
    const auto summary = evolve(cube, inParallel([](const Values& v) { return -v[0] + v[1] - v[2]; }), options).value();
    EXPECT_EQ(summary.evaluated.front().values, (Values{40.0, -40.0, 3.0}));
    for (const Ledger::Entry& e : summary.evaluated)
        for (std::size_t i = 0; i < cube.size(); ++i) {
            ASSERT_GE(e.values[i], cube[i].lower);
            ASSERT_LE(e.values[i], cube[i].upper);
        }
    EXPECT_LT(summary.bestEvaluation().objectives.front(), -155.0);
}

TEST(Strategy, MutationIsNormalWithTheAskedDeviation) {
    base::Random random(21);
    double sum = 0.0;
    double squares = 0.0;
    constexpr int count = 20'000;
    for (int i = 0; i < count; ++i) {
        Values v{0.0, 0.0, 40.0};
        mutateNormally(v, 0.05, cube, random);
        sum += v[0];
        squares += v[0] * v[0];
    }
    EXPECT_NEAR(sum / count, 0.0, 5.0 * 4.0 / std::sqrt(count));
    EXPECT_NEAR(std::sqrt(squares / count), 4.0, 0.1);
}

TEST(Strategy, ChildrenHaveCoordinatesOfTheirParents) {
    base::Random random(22);
    int from_first = 0;
    for (int i = 0; i < 3'000; ++i) {
        const Values child = crossCoordinates({1.0, 2.0}, {3.0, 4.0}, random);
        ASSERT_TRUE((child[0] == 1.0 || child[0] == 3.0) && (child[1] == 2.0 || child[1] == 4.0));
        from_first += child[0] == 1.0 ? 1 : 0;
    }
    EXPECT_NEAR(from_first, 1'500, 150);
}

TEST(Strategy, EndsAtItsTarget) {
    StrategyOptions options;
    options.target_objectives = {5.0};
    options.max_evaluations = 100'000;
    const auto summary =
        evolve(cube, inParallel([](const Values& v) { return distance(v, {0, 0, 0}); }), options).value();
    EXPECT_EQ(summary.termination, Termination::Target);
    EXPECT_LE(summary.bestEvaluation().objectives.front(), 5.0);
}

TEST(Strategy, BadOptionsAreNamed) {
    StrategyOptions options;
    options.survivors = 60;
    options.initial_step = 0.0;
    const auto result = evolve({{"x", 1.0, 1.0}}, inParallel([](const Values&) { return 0.0; }), options);
    ASSERT_FALSE(result);
    EXPECT_EQ(base::toText(result.error()),
              "error: survivors: 60 of 50 candidates cannot survive [evolution.option]\n"
              "error: initial_step: 0 must be a share of the range, above 0 and up to 1 [evolution.option]\n"
              "error: smallest_step: 0.0001 must be above 0 and not above the initial step [evolution.option]\n"
              "error: x: the range 1 to 1 is empty; the lower limit must be below the upper one [evolution.option]\n");
}

}  // namespace
