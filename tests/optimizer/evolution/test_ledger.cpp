// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The ledger: no candidate twice, the budget to the candidate, and evaluators that misbehave.
#include <cusp/optimizer/evolution/evaluation.hpp>

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace {

using namespace cusp::optimizer;
namespace base = cusp::base;

/// Judges 2 x and remembers what it was asked.
struct Witness {
    std::vector<double> asked;
    EvaluateBatch batch() {
        return [this](std::span<const Values> values, base::Progress&) -> base::Result<std::vector<Evaluation>> {
            std::vector<Evaluation> out;
            for (const Values& v : values) {
                asked.push_back(v.front());
                out.push_back({{2.0 * v.front()}, {}});
            }
            return out;
        };
    }
};

const std::vector<CandidateKey> keys{{1}, {2}, {1}, {3}};
const std::vector<Values> values{{1.0}, {2.0}, {1.0}, {3.0}};

TEST(Ledger, NoCandidateIsJudgedTwice) {
    Witness witness;
    Ledger ledger(witness.batch(), 100, 1, base::noProgress());
    EXPECT_EQ(ledger.evaluate(keys, values).value(), (std::vector<std::size_t>{0, 1, 0, 2}));
    EXPECT_EQ(ledger.evaluate(keys, values).value(), (std::vector<std::size_t>{0, 1, 0, 2}));
    EXPECT_EQ(witness.asked, (std::vector<double>{1.0, 2.0, 3.0}));
    EXPECT_EQ(ledger.size(), 3U);
    EXPECT_EQ(ledger.repeats(), 5U);
    EXPECT_EQ(ledger.objective(2), 6.0);
}

TEST(Ledger, TheBudgetEndsInTheMiddleOfABatch) {
    Witness witness;
    Ledger ledger(witness.batch(), 2, 1, base::noProgress());
    EXPECT_EQ(ledger.evaluate(keys, values).value(), (std::vector<std::size_t>{0, 1, 0, Ledger::not_evaluated}));
    EXPECT_TRUE(ledger.exhausted());
    EXPECT_EQ(witness.asked, (std::vector<double>{1.0, 2.0}));
}

TEST(Ledger, WhatWasJudgedBeyondTheLastGenerationIsNotJudgedAgainButCounted) {
    Witness first;
    Ledger before(first.batch(), 100, 1, base::noProgress());
    static_cast<void>(before.evaluate(keys, values).value());
    Witness second;
    Ledger after(second.batch(), 100, 1, base::noProgress());
    after.restore(before.known(), 1, 0);
    EXPECT_EQ(after.size(), 1U);
    EXPECT_EQ(after.evaluate(keys, values).value(), (std::vector<std::size_t>{0, 1, 0, 2}));
    EXPECT_TRUE(second.asked.empty());
    EXPECT_EQ(after.size(), 3U);
    EXPECT_EQ(after.objective(2), 6.0);
}

TEST(Ledger, EvaluatorsThatMisbehaveAreNamed) {
    const auto codeOf = [](const EvaluateBatch& evaluate) {
        Ledger ledger(evaluate, 100, 1, base::noProgress());
        return base::toText(ledger.evaluate(keys, values).error());
    };
    EXPECT_EQ(codeOf([](auto, auto&) -> base::Result<std::vector<Evaluation>> { return std::vector<Evaluation>{}; }),
              "error: the evaluator was given 3 candidates and answered for 0 [evolution.evaluator]\n");
    EXPECT_EQ(codeOf(inParallel(
                  Evaluate([](const Values&) -> base::Result<Evaluation> { return Evaluation{{1.0, 2.0}, {}}; }))),
              "error: the evaluator gave 2 objectives where 1 are expected [evolution.evaluator]\n");
    EXPECT_EQ(codeOf(inParallel([](const Values& v) { return v.front() > 1.5 ? std::nan("") : 0.0; })),
              "error: the objective of candidate (2) is not a number [evolution.objective-nan]\n");
    EXPECT_EQ(codeOf(inParallel(Evaluate([](const Values& v) -> base::Result<Evaluation> {
                  if (v.front() > 1.5) return base::fail("problem.broken", "no path");
                  return Evaluation{{0.0}, {}};
              }))),
              "error: no path [problem.broken]\n");
}

}  // namespace
