// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What the search for the fastest path and the comparison with constant leads have in common.
#pragma once

#include <cusp/optimizer/finishing/true_search.hpp>

namespace cusp::finishing {

/// A share of the tolerance is kept back for what lies between the points of the grid.
[[nodiscard]] LevelOptions levelOptions(const TrueProblem& problem, double grid_mm);
[[nodiscard]] PlanOptions adaptiveOptions(const TrueProblem& problem, double depth_mm, double safety);
[[nodiscard]] PlanOptions constantOptions(const TrueProblem& problem, double depth_mm, double lead_rad,
                                          double tilt_rad);
/// Passes that the ridge alone asks for, with an adaptive lead.
[[nodiscard]] base::Result<std::int64_t> ridgeCount(const Workpiece& part, const TrueProblem& problem,
                                                    const geometry::Cutter& cutter);
/// Feed moves at their feeds; rapid moves left out.
[[nodiscard]] double estimatedTime(const FinishingPath& path);
[[nodiscard]] base::Result<MachineTime> timeOf(const FinishingPath& path, const TrueProblem& problem,
                                               const toolpath::Tool& tool);
/// Levelled with the whole number of rounds, and timed.
[[nodiscard]] base::Result<ProvedPath> leveled(const Workpiece& part, const TrueProblem& problem, std::size_t tool,
                                               const PlanOptions& options, std::int64_t count);
[[nodiscard]] FrontPoint frontPointOf(const ProvedPath& path, const TrueProblem& problem, bool adaptive,
                                      double lead_rad);
/// On the proof grid; where that finds more than the level grid did, levelled again with less allowed, then with more passes.
[[nodiscard]] base::Result<ProvedPath> prove(const Workpiece& part, const TrueProblem& problem, ProvedPath path,
                                             bool insist);

}  // namespace cusp::finishing
