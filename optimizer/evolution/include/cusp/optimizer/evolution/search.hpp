// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Searching binary chromosomes: the virus-evolutionary algorithm and what it is compared with, in one frame.
#pragma once

#include <cusp/base/progress.hpp>
#include <cusp/base/result.hpp>
#include <cusp/optimizer/evolution/encoding.hpp>
#include <cusp/optimizer/evolution/evaluation.hpp>
#include <cusp/optimizer/evolution/objective.hpp>
#include <cusp/optimizer/evolution/virus.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace cusp::optimizer {

enum class Algorithm {
    VirusEvolutionary,  ///< `Genetic`, and viruses after each generation (Fountas 2017)
    Genetic,            ///< generations with elitism: the same algorithm without viral operators
    SteadyState,        ///< two children at a time take the places of the worst
    RandomSearch,       ///< every candidate drawn anew
};

enum class Selection { Roulette, Tournament };
enum class Crossover { SinglePoint, TwoPoint, Uniform };
enum class Mutation { SinglePoint, PerBit };
enum class InfectionAcceptance {
    Improvement,  ///< the infected string takes the host's place where it is better
    Always,       ///< in any case, as a mutation would
};

/// The defaults are those that did best on a shifted eq. 13 and on a mixed problem of five genes (bench/optimizer): few
/// viruses, from the elite, on few hosts. Take them with `Coding::Gray`.
struct SearchOptions {
    Algorithm algorithm = Algorithm::VirusEvolutionary;
    std::uint64_t seed = 1;

    std::size_t population = 20;
    std::size_t elite = 2;  ///< individuals that pass to the next generation unchanged
    Selection selection = Selection::Tournament;
    std::size_t tournament_size = 3;
    FitnessScale fitness_scale = FitnessScale::Population;  ///< of roulette
    Crossover crossover = Crossover::Uniform;
    double crossover_probability = 0.9;
    Mutation mutation = Mutation::PerBit;
    /// Per child for `SinglePoint`; per bit for `PerBit`, where 0 stands for 1 / length.
    double mutation_probability = 0.0;
    VirusOptions virus;
    InfectionAcceptance acceptance = InfectionAcceptance::Improvement;

    /// When the population's diversity (`GenerationRecord::diversity`) falls below this, all but its best individual are drawn
    /// anew; viruses live on, and carry what was found into the new population. 0: never, as in the paper.
    double restart_diversity = 0.1;
    /// Candidates of the first population, the nearest on the grid; the others are random.
    std::vector<Values> starts;

    /// Distinct decoded candidates, those of viruses included. The search ends when one more would be needed.
    std::size_t max_evaluations = 1000;
    /// 0: no limit.
    std::size_t max_generations = 0;
    /// Ends after so many generations without a better candidate; 0: never.
    std::size_t stall_generations = 0;
    /// Ends when the best objective is at most this.
    double target_objective = -std::numeric_limits<double>::infinity();

    /// Written (atomically) after every `checkpoint_interval` generations and at the end; empty: none.
    std::string checkpoint_file;
    std::size_t checkpoint_interval = 1;
    /// Takes up the run of `checkpoint_file` where that file exists. Its outcome is that of a run never interrupted.
    bool resume = false;
    /// What the objective is, in the caller's words (a digest of the job, say): a checkpoint of another problem is refused.
    std::string problem_id;

    /// Errors `evolution.option`, one per option that makes no sense, with its name as key.
    [[nodiscard]] base::Result<void> check(const Encoding& encoding) const;
};

/// The parameters of Fountas 2017: roulette on eq. 10 as printed, single-point crossover and mutation, and the best viral
/// settings of its Table 1. What it leaves open (probabilities, elite) is set here.
[[nodiscard]] SearchOptions paperOptions();

/// The state after a generation; generation 0 is the initial population.
struct GenerationRecord {
    std::size_t generation = 0;
    std::size_t evaluations = 0;        ///< distinct candidates so far
    std::size_t viral_evaluations = 0;  ///< of these, first met by an infection
    std::size_t repeats = 0;            ///< requests answered from memory so far
    double best = 0.0;                  ///< objective of the best candidate so far
    double population_best = 0.0;
    double population_mean = 0.0;  ///< over finite objectives
    double population_worst = 0.0;
    double diversity = 0.0;        ///< mean over the bits of 4 p (1 − p), p the share of ones: 1 random, 0 all alike
    std::size_t infections = 0;    ///< in this generation
    std::size_t improvements = 0;  ///< infections that gained
    bool restarted = false;        ///< the population was drawn anew in this generation
};

struct Individual {
    Bits bits;
    std::size_t entry = 0;  ///< its place in `SearchSummary::evaluated`
};

enum class Termination {
    Evaluations,  ///< `max_evaluations`
    Generations,  ///< `max_generations`
    Stalled,      ///< `stall_generations`
    Target,       ///< `target_objective`
    Exhausted,    ///< every candidate there is was judged, or 1000 generations in a row met no new one
    Stopped,      ///< by `progress`
};
/// "evaluation limit reached" …
[[nodiscard]] std::string toText(Termination termination);

struct SearchSummary {
    Termination termination = Termination::Evaluations;
    std::size_t best = 0;                  ///< index in `evaluated`
    std::vector<Ledger::Entry> evaluated;  ///< every candidate judged, in order
    std::vector<GenerationRecord> history;
    std::vector<Individual> population;  ///< after the last complete generation
    std::vector<Virus> viruses;
    std::size_t evaluations = 0;
    std::size_t viral_evaluations = 0;
    std::size_t repeats = 0;

    [[nodiscard]] const Values& bestValues() const { return evaluated[best].values; }
    [[nodiscard]] const Evaluation& bestEvaluation() const { return evaluated[best].evaluation; }
    [[nodiscard]] double bestObjective() const { return bestEvaluation().objectives.front(); }
};

/// Called after every generation, from the calling thread.
using OnGeneration = std::function<void(const GenerationRecord&)>;

/// Minimises. The outcome depends on problem, options and seed alone, not on threads or on interruptions. `progress` counts
/// evaluations and is asked before each whether to stop; a stopped search is a result (`Termination::Stopped`), with what it
/// had, and leaves its checkpoint to be resumed.
/// Errors: those of the options, the evaluator, and the checkpoint file (`evolution.checkpoint*`, `io.*`);
/// `evolution.negative-objective` where roulette on raw eq. 10 meets one; `evolution.stopped` where not one candidate was
/// judged before the stop.
[[nodiscard]] base::Result<SearchSummary> search(const Encoding& encoding, const EvaluateBatch& evaluate,
                                                 const SearchOptions& options,
                                                 base::Progress& progress = base::noProgress(),
                                                 const OnGeneration& on_generation = {});

/// Mean over the bits of 4 p (1 − p), p the share of ones: 1 for many random strings, 0 where all are alike.
[[nodiscard]] double diversityOf(const std::vector<Individual>& population);

/// The history as CSV, one line per generation, keys as in GenerationRecord.
[[nodiscard]] std::string convergenceCsv(const std::vector<GenerationRecord>& history);

}  // namespace cusp::optimizer
