// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Eq. 9 and 10 by hand, and their edges.
#include <cusp/optimizer/evolution/objective.hpp>

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace {

using namespace cusp::optimizer;

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(WeightedObjective, NormalisesThenWeighs) {
    const auto objective =
        WeightedObjective::create({{.name = "error_mm", .weight = 3.0, .best = 0.002, .worst = 0.010},
                                   {.name = "points", .weight = 1.0, .best = 200, .worst = 400}})
            .value();
    const std::vector<double> values{0.004, 300.0};
    EXPECT_NEAR(objective.value(values), 0.75 * 0.25 + 0.25 * 0.5, 1e-15);
    EXPECT_EQ(objective.value(std::vector<double>{0.002, 200.0}), 0.0);
    EXPECT_EQ(objective.value(std::vector<double>{0.010, 400.0}), 1.0);
    EXPECT_EQ(objective.value(std::vector<double>{infinity, 400.0}), infinity);
}

TEST(WeightedObjective, ACriterionWithoutWeightDoesNotCountEvenWhereItIsInfinite) {
    const auto objective =
        WeightedObjective::create({{.name = "a", .weight = 0.0}, {.name = "b", .weight = 2.0}}).value();
    EXPECT_EQ(objective.value(std::vector<double>{infinity, 0.5}), 0.5);
}

TEST(WeightedObjective, SaysWhatIsWrong) {
    EXPECT_EQ(cusp::base::toText(WeightedObjective::create({{.name = "a", .weight = -1.0, .best = 2.0}}).error()),
              "error: a: weight -1; a weight is a number from 0 upwards [evolution.weights]\n"
              "error: a: best 2 must be below worst 1 [evolution.criterion-range]\n");
    EXPECT_EQ(WeightedObjective::create({{.name = "a", .weight = 0.0}}).error().front().code, "evolution.weights");
}

TEST(WeightedObjective, RangesComeFromFiniteSamples) {
    const std::vector<std::vector<double>> samples{{3.0, 5.0}, {1.0, 5.0}, {infinity, 9.0}};
    const auto criteria = withRangesOf({{.name = "a"}, {.name = "b"}}, samples);
    EXPECT_EQ(criteria[0].best, 1.0);
    EXPECT_EQ(criteria[0].worst, 3.0);
    EXPECT_EQ(criteria[1].best, 5.0);
    EXPECT_EQ(criteria[1].worst, 6.0);
}

TEST(ExponentialFitness, IsEq10) {
    const std::vector<double> z{0.5, 1.0, 0.0};
    const auto fitness = exponentialFitness(z, FitnessScale::Raw);
    EXPECT_NEAR(fitness[0], 1.5 * std::exp(-0.25), 1e-15);
    EXPECT_NEAR(fitness[1], 1.5 * std::exp(-1.0), 1e-15);
    EXPECT_EQ(fitness[2], 1.5);
}

TEST(ExponentialFitness, RawHasNoPressureAmongSmallObjectivesAndThePopulationScaleHas) {
    const std::vector<double> z{1e-9, 1e-10, 5e-10};
    const auto raw = exponentialFitness(z, FitnessScale::Raw);
    EXPECT_EQ(raw[0], raw[1]);  // exp(-1e-18) is 1 in a double
    const auto scaled = exponentialFitness(z, FitnessScale::Population);
    EXPECT_NEAR(scaled[0] / scaled[1], std::exp(-1.0), 1e-12);
}

TEST(ExponentialFitness, Edges) {
    EXPECT_EQ(exponentialFitness(std::vector<double>{infinity, 1.0}, FitnessScale::Raw)[0], 0.0);
    EXPECT_EQ(exponentialFitness(std::vector<double>{0.0, 0.0}, FitnessScale::Raw), (std::vector<double>{1.0, 1.0}));
    EXPECT_EQ(exponentialFitness(std::vector<double>{2.0, 2.0}, FitnessScale::Population),
              (std::vector<double>{1.0, 1.0}));
    const auto negative = exponentialFitness(std::vector<double>{-3.0, -1.0}, FitnessScale::Population);
    EXPECT_GT(negative[0], negative[1]);
}

TEST(Lexicographic, TheFirstDifferenceDecides) {
    EXPECT_TRUE(lexicographicallyLess(std::vector<double>{0.0, 9.0}, std::vector<double>{1.0, 0.0}));
    EXPECT_TRUE(lexicographicallyLess(std::vector<double>{1.0, 1.0}, std::vector<double>{1.0, 2.0}));
    EXPECT_FALSE(lexicographicallyLess(std::vector<double>{1.0, 2.0}, std::vector<double>{1.0, 2.0}));
    EXPECT_FALSE(lexicographicallyLess(std::vector<double>{infinity, 0.0}, std::vector<double>{1.0, 2.0}));
}

}  // namespace
