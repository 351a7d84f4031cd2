// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What a search knows between two generations, and the steps that lead from one to the next.
#pragma once

#include <cusp/base/random.hpp>
#include <cusp/optimizer/evolution/search.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace cusp::optimizer {

struct RunState {
    std::vector<Individual> population;
    std::vector<Virus> viruses;
    std::vector<GenerationRecord> history;  ///< its last record is the present generation
    std::size_t viral_evaluations = 0;
};

/// What a step works with. `random` is the generation's own, so that a resumed run needs no more than its number.
struct StepContext {
    const Encoding& encoding;
    const SearchOptions& options;
    Ledger& ledger;
    base::Random random;
    std::size_t infections = 0;
    std::size_t improvements = 0;
    bool restarted = false;

    /// The strings judged; nothing where the budget ended or a stop was asked for before all were.
    [[nodiscard]] base::Result<std::optional<std::vector<Individual>>> judge(std::vector<Bits> strings);
    [[nodiscard]] std::vector<double> objectives(std::span<const Individual> individuals) const;
};

/// Whether a step was carried through. One that was not leaves a state that must not be used.
enum class StepEnd { Complete, Cut };

[[nodiscard]] base::Result<StepEnd> firstPopulation(RunState& state, StepContext& context);
/// One generation of the chosen algorithm, infections included.
[[nodiscard]] base::Result<StepEnd> nextGeneration(RunState& state, StepContext& context);
/// Every virus attacks, is judged and renewed (Fountas 2017, "Viral infection").
[[nodiscard]] base::Result<StepEnd> infect(RunState& state, StepContext& context);

}  // namespace cusp::optimizer
