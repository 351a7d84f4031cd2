// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The best that a constant lead can do, with all else as in the search.
#include "true_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cusp::finishing {

namespace {

struct Combination {
    std::size_t tool = 0;
    double lead_rad = 0.0;
    PlanOptions options;
    std::int64_t passes = 0;  ///< the least found by looks
};

/// The least number of passes that keeps the tolerance, to a bound; empty where none below `most` does.
base::Result<std::optional<std::int64_t>> fewestPasses(const Workpiece& part, const TrueProblem& problem,
                                                       const Combination& choice, std::int64_t most) {
    const LevelOptions level = levelOptions(problem, problem.search_grid_mm);
    const auto holds = [&](std::int64_t count) -> base::Result<bool> {
        PlanOptions options = choice.options;
        options.passes.count = count;
        const auto seen = lookAtPath(part, problem.tools[choice.tool].cutter(), options, level);
        if (!seen) return base::fail(seen.error());
        return seen->excess <= 1.0 / (1.0 - 0.05);  // the whole tolerance: levelling finds the rest
    };
    auto good = holds(most);
    if (!good) return base::fail(good.error());
    if (!*good) return std::optional<std::int64_t>();
    std::int64_t low = 1;
    std::int64_t high = most;
    while (high - low > 1) {
        const std::int64_t middle = (low + high) / 2;
        good = holds(middle);
        if (!good) return base::fail(good.error());
        (*good ? high : low) = middle;
    }
    return std::optional(high);
}

}  // namespace

base::Result<std::optional<ProvedPath>> bestConstantLead(const Workpiece& part, const TrueProblem& problem,
                                                         const ConstantGrid& grid, base::Progress& progress) {
    std::optional<Combination> best;
    constexpr std::int64_t most_passes = 48;
    progress.begin(problem.tools.size() * grid.leads_rad.size() * grid.tilts_rad.size() * grid.depth_shares.size(),
                   "constant leads");
    for (std::size_t tool = 0; tool < problem.tools.size(); ++tool)
        for (const double lead : grid.leads_rad)
            for (const double tilt : grid.tilts_rad)
                for (const double depth : grid.depth_shares) {
                    progress.advance();
                    if (progress.stopRequested()) break;
                    Combination choice{tool, lead, constantOptions(problem, depth * problem.tolerance_mm, lead, tilt),
                                       0};
                    // One pass more than the best is of no use.
                    const auto fewest = fewestPasses(part, problem, choice, best ? best->passes : most_passes);
                    if (!fewest) return base::fail(fewest.error());
                    if (!*fewest || (best && **fewest >= best->passes)) continue;
                    choice.passes = **fewest;
                    best = choice;
                }
    progress.end();
    if (!best) return std::optional<ProvedPath>();
    std::optional<ProvedPath> fastest;
    for (std::int64_t count = best->passes; count >= 2 && !progress.stopRequested(); --count) {
        auto path = leveled(part, problem, best->tool, best->options, count);
        if (!path) return base::fail(path.error());
        if (path->levelled.excess > 1.0 && fastest) break;
        const bool in_order = path->levelled.excess <= 1.0;
        if (in_order || !fastest) fastest = *std::move(path);
        if (!in_order) break;
    }
    auto proved = prove(part, problem, *std::move(fastest), false);
    if (!proved) return base::fail(proved.error());
    return std::optional(*std::move(proved));
}

}  // namespace cusp::finishing
