// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Passes spaced and leaned by what they are seen to leave, until every ridge is as high as the next and no pass cuts too deep.
#pragma once

#include <cusp/optimizer/finishing/finishing_path.hpp>
#include <cusp/simulation/surface_envelope.hpp>

#include <cstdint>

namespace cusp::finishing {

struct LevelOptions {
    double overcut_mm = 0.0095;   ///< at most, everywhere
    double undercut_mm = 0.0095;  ///< material left, at most
    double grid_mm = 0.5;         ///< on which what is left is looked at
    int rounds = 12;              ///< of planning and looking
};

struct LevelledPath {
    FinishingPath path;  ///< contacts.options holds places and factors: they plan the same path again
    simulation::EnvelopeSummary left;
    /// The larger of overcut and undercut, each as a share of what is allowed: at most 1 when the path is in order on the grid.
    double excess = 0.0;
    bool whole = false;  ///< all of the part is reached
    int rounds = 0;
};

/// Starts from `options` (placement arc or scallop, orientation adaptive or not) with `count` passes for each face and, round
/// by round, sees by the exact envelope what each leaves: a ridge higher than the others draws its passes together, a pass that
/// cuts too deep is leaned more, one that has room is leaned less. Answers the best of all rounds; ends early once one is in order
/// when `first_in_order` is set.
/// Errors: those of `planContacts` and of `surfaceEnvelope`.
[[nodiscard]] base::Result<LevelledPath> levelPasses(const Workpiece& part, const geometry::Cutter& cutter,
                                                     const PlanOptions& options, std::int64_t count,
                                                     const LevelOptions& level, bool first_in_order = true);

/// Plans, joins and looks once.
[[nodiscard]] base::Result<LevelledPath> lookAtPath(const Workpiece& part, const geometry::Cutter& cutter,
                                                    const PlanOptions& options, const LevelOptions& level);

}  // namespace cusp::finishing
