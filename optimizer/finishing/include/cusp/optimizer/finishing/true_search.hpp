// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The fastest path that keeps a tolerance, judged by the exact envelope of the tool.
#pragma once

#include <cusp/base/progress.hpp>
#include <cusp/optimizer/evolution/encoding.hpp>
#include <cusp/optimizer/evolution/search.hpp>
#include <cusp/optimizer/finishing/level_passes.hpp>
#include <cusp/optimizer/finishing/machine_time.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace cusp::finishing {

struct TrueProblem {
    std::vector<toolpath::Tool> tools;
    MachineSetting setting;  ///< tool length is each tool's gauge length unless `tool_length_fixed`
    bool tool_length_fixed = false;
    PlanOptions options;  ///< everything that is not searched for; the family must be along a parameter or planes
    double tolerance_mm = 0.01;                     ///< overcut and undercut, each
    std::array<double, 2> depth_share{-0.9, -0.5};  ///< depth offset, as a share of the tolerance
    std::array<double, 2> curvature_safety{1.0, 1.2};
    std::array<double, 2> width_share{0.8, 1.4};  ///< of the number of passes that the ridge alone asks for
    double search_grid_mm = 1.4;                  ///< cheap looks while searching
    double level_grid_mm = 0.6;                   ///< looks while passes are levelled
    double proof_grid_mm = 0.1;                   ///< the last word
    int search_rounds = 3;
    int level_rounds = 14;
    std::size_t finalists = 2;  ///< tools whose best candidate is levelled to the least number of passes
    /// The best is levelled with so many passes fewer and more too, for the front of time against deviation.
    std::int64_t front_passes = 2;
};

/// A path that was levelled: one place of the front of time against deviation.
struct FrontPoint {
    std::size_t tool = 0;
    std::size_t passes = 0;
    double machining_time_s = 0.0;
    double deviation_mm = 0.0;  ///< the larger of overcut and undercut, on the level grid
    bool adaptive = true;
    double lead_rad = 0.0;  ///< of a constant lead
};

struct ProvedPath {
    std::size_t tool = 0;
    LevelledPath levelled;
    MachineTime time;
    simulation::EnvelopeSummary proof;  ///< on the proof grid
    bool proved = false;                ///< all of the part is reached, and within the tolerance
};

struct TrueResult {
    ProvedPath best;
    std::vector<FrontPoint> levelled;  ///< everything that was levelled, and the time it takes
    optimizer::SearchSummary search;
    std::vector<optimizer::Gene> genes;  ///< what was searched for
};

/// Searches tool, number of passes, depth and curvature safety by cheap looks; levels the best of the first tools to fewer and
/// fewer passes; proves the fastest on the proof grid, with one pass more until the proof holds.
/// Errors: those of planning; `finishing.no-path` when nothing keeps the tolerance, with the nearest that was found.
[[nodiscard]] base::Result<TrueResult> searchTrue(const Workpiece& part, const TrueProblem& problem,
                                                  const optimizer::SearchOptions& options,
                                                  base::Progress& progress = base::noProgress(),
                                                  const optimizer::OnGeneration& on_generation = {});

/// Constant leads to compare with; passes are spaced by the ridge and levelled in the same way.
struct ConstantGrid {
    std::vector<double> leads_rad;
    std::vector<double> tilts_rad{0.0};
    std::vector<double> depth_shares{0.0, -0.85};
};
/// The fastest constant-lead path of the grid that keeps the tolerance: for each tool, lead, tilt and depth the least number of
/// passes (bisection, looks on the search grid, which forgives more than the proof grid), then the best levelled further.
/// Empty when none does with 48 passes or fewer.
[[nodiscard]] base::Result<std::optional<ProvedPath>> bestConstantLead(const Workpiece& part,
                                                                       const TrueProblem& problem,
                                                                       const ConstantGrid& grid,
                                                                       base::Progress& progress = base::noProgress());

}  // namespace cusp::finishing
