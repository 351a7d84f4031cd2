// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// An evolution strategy on real vectors whose objectives are compared lexicographically (Weinert, Stautner 2004).
#pragma once

#include <cusp/base/progress.hpp>
#include <cusp/base/random.hpp>
#include <cusp/base/result.hpp>
#include <cusp/optimizer/evolution/evaluation.hpp>
#include <cusp/optimizer/evolution/search.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace cusp::optimizer {

/// A real number that is searched for, in its own unit.
struct RealVariable {
    std::string name;
    double lower = 0.0;
    double upper = 1.0;
};

enum class SurvivorSelection {
    Tournament,  ///< winners of tournaments among the offspring (the paper's)
    Truncation,  ///< the best
};

struct StrategyOptions {
    std::uint64_t seed = 1;
    std::size_t objectives = 1;  ///< how many the problem gives; the first that differs decides
    std::size_t offspring = 50;  ///< candidates per generation (the paper's 50)
    std::size_t survivors = 25;  ///< that become parents (the paper's 25)
    SurvivorSelection selection = SurvivorSelection::Tournament;
    std::size_t tournament_size = 2;
    /// Best individuals that stay among the candidates; 0 is the comma strategy, where the best may be lost (the summary keeps
    /// it all the same).
    std::size_t elite = 0;
    double crossover_probability = 1.0;  ///< a child takes each coordinate from one of two parents
    /// Standard deviation of mutation as a share of each variable's range: at first, and at least. It is inherited and varied
    /// with the individual (log-normally, τ = 1 / √(2 n)), so that it adapts itself.
    double initial_step = 0.15;
    double smallest_step = 1e-4;

    std::size_t max_evaluations = 1000;
    std::size_t max_generations = 0;    ///< 0: no limit
    std::size_t stall_generations = 0;  ///< without a better candidate; 0: never ends for that
    /// Ends once the best is lexicographically not above this; empty: never.
    std::vector<double> target_objectives;
    /// Candidates of the first generation; the others are drawn uniformly from the ranges.
    std::vector<Values> starts;

    std::string checkpoint_file;  ///< as in SearchOptions
    std::size_t checkpoint_interval = 1;
    bool resume = false;
    std::string problem_id;

    /// Errors `evolution.option`, with the option as key, and `evolution.empty-range`, with the variable as key.
    [[nodiscard]] base::Result<void> check(const std::vector<RealVariable>& variables) const;
};

struct StrategyIndividual {
    Values values;
    double step = 0.0;      ///< standard deviation as a share of the range
    std::size_t entry = 0;  ///< its place in `StrategySummary::evaluated`
};

struct StrategyRecord {
    std::size_t generation = 0;
    std::size_t evaluations = 0;
    std::size_t repeats = 0;
    std::vector<double> best;             ///< objectives of the best candidate so far
    std::vector<double> population_best;  ///< … and of the best of this generation
    double mean_step = 0.0;               ///< of the survivors
};

struct StrategySummary {
    Termination termination = Termination::Evaluations;
    std::size_t best = 0;  ///< index in `evaluated`
    std::vector<Ledger::Entry> evaluated;
    std::vector<StrategyRecord> history;
    std::vector<StrategyIndividual> survivors;
    std::size_t evaluations = 0;
    std::size_t repeats = 0;

    [[nodiscard]] const Values& bestValues() const { return evaluated[best].values; }
    [[nodiscard]] const Evaluation& bestEvaluation() const { return evaluated[best].evaluation; }
};

/// A child of two parents: each coordinate from either with probability ½.
[[nodiscard]] Values crossCoordinates(const Values& a, const Values& b, base::Random& random);
/// Adds normal deviates of `step` times each range, reflected at its ends.
void mutateNormally(Values& values, double step, const std::vector<RealVariable>& variables, base::Random& random);

/// Minimises lexicographically. Like `search`: seeded, the same at any thread count and after any interruption, no vector
/// judged twice, ends gracefully on a stop.
[[nodiscard]] base::Result<StrategySummary>
evolve(const std::vector<RealVariable>& variables, const EvaluateBatch& evaluate, const StrategyOptions& options,
       base::Progress& progress = base::noProgress(),
       const std::function<void(const StrategyRecord&)>& on_generation = {});

}  // namespace cusp::optimizer
