// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The evolutionary step of Weinert & Stautner 2004, 3.2: tilt points by a (μ, λ) strategy, and what comes out of it.
#pragma once

#include <cusp/base/progress.hpp>
#include <cusp/optimizer/tilt/tilt_case.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cusp::tilt {

/// One generation, in the measure of the paper's Figs. 4, 5 and 7: 1 is free of collision, 0 out of the machine's range; in
/// between 1 − volume / (largest volume of the first generation), 0 at least.
struct TiltGeneration {
    std::size_t points = 1;  ///< tilt points
    std::size_t generation = 0;
    double best = 0.0;
    double mean = 0.0;
    double worst = 0.0;
    std::size_t evaluations = 0;  ///< so far
    std::size_t free = 0;         ///< candidates of this generation free of both kinds of collision
    TiltFitness best_so_far;
};

struct TiltOutcome {
    TiltPlan plan;
    TiltFitness fitness;
    /// The first generation, counted over all numbers of points tried, with a candidate free of collision; 0 is the random
    /// one that is begun with. Empty where none was found.
    std::optional<std::size_t> generations_to_collision_free;
    std::vector<TiltGeneration> history;
    std::size_t evaluations = 0;
    bool stopped = false;  ///< by `progress`
};

struct TiltRun {
    std::uint64_t seed = 1;
    /// Written after each generation, for each number of points one with that number added; empty: none.
    std::string checkpoint_file;
    bool resume = false;
};

/// Searches one tilt point; where that ends without a way free of collision, two, and so on, blended along the path. Candidates
/// are judged in parallel; the outcome depends on case and seed only.
/// Errors: those of the strategy (`evolution.*`).
[[nodiscard]] base::Result<TiltOutcome> searchTilt(const TiltCase& problem, const TiltRun& run,
                                                   base::Progress& progress = base::noProgress());

/// As many single tilt points drawn evenly from the cube: what the strategy is compared with.
[[nodiscard]] TiltOutcome randomTilt(const TiltCase& problem, std::uint64_t seed, std::size_t evaluations);

/// One line a generation: run, seed, points, generation, best, mean, worst, evaluations, free, and the best fitness so far.
[[nodiscard]] std::string convergenceCsv(const std::vector<std::pair<std::uint64_t, TiltOutcome>>& runs);

}  // namespace cusp::tilt
