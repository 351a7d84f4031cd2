// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Mean and spread of the best fitness over the generations of several runs, as a table and as a picture.
#pragma once

#include <cusp/optimizer/tilt/tilt_search.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace cusp::bench {

/// Of one generation, over all runs; the fitness is the paper's, 0 (beyond the machine's range) to 1 (free of collision).
struct GenerationSpread {
    std::size_t runs = 0;
    std::size_t free_runs = 0;  ///< that have met a candidate free of collision by then
    double best_mean = 0.0;
    double best_deviation = 0.0;  ///< standard deviation over the runs
    double best_least = 1.0;
    double best_most = 0.0;
    double mean_mean = 0.0;   ///< of the mean candidate
    double worst_mean = 0.0;  ///< of the worst
};

/// With one tilt point; by generation, 0 being the random one.
[[nodiscard]] std::vector<GenerationSpread> spreadOf(const std::vector<tilt::TiltOutcome>& runs);
[[nodiscard]] std::string csvOf(const std::vector<GenerationSpread>& spread);
/// Fitness 0 … 1 upwards, generations to the right; the mean of the best as a line in its band of one standard deviation,
/// the best and worst of all runs thin beside it; mean and worst candidates in grey.
[[nodiscard]] std::string pngOf(const std::vector<GenerationSpread>& spread);

}  // namespace cusp::bench
