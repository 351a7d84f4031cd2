// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What `cusp optimize` does: reads the job and all it names, searches, judges the best.
#pragma once

#include "optimize_output.hpp"

#include <cstdint>
#include <string>

namespace cusp::cli {

struct OptimizeFlags {
    std::string job_file;
    std::string folder;
    std::string evaluator;            ///< command of an outside CAM; empty: the planner of the house
    double evaluator_seconds = 60.0;  ///< for one candidate
    std::int64_t seed = -1;           ///< below 0: the job's
    std::int64_t evaluations = -1;    ///< below 0: the job's
    bool resume = false;
    bool json = false;
};

/// Makes the folder, since the search leaves its checkpoint there; takes it away again where nothing was left in it.
/// Errors: those of the job and the files it names, of planning and of the search.
[[nodiscard]] base::Result<Optimized> runOptimization(const OptimizeFlags& flags);

}  // namespace cusp::cli
