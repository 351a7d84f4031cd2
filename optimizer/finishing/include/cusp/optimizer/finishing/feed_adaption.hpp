// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The feed of each move, as the control, the axes and the curve of the path allow.
#pragma once

#include <cusp/optimizer/finishing/machine_time.hpp>

namespace cusp::finishing {

struct FeedLimits {
    double acceleration_mm_per_s2 = 1000.0;  ///< of the tip across its path
    double finest_mm_per_s = 10.0 / 60.0;    ///< feeds are rounded down to multiples of this, so that few are written
};

struct FeedChange {
    std::size_t lowered = 0;  ///< moves
    std::size_t by_block_time = 0;
    std::size_t by_axes = 0;
    std::size_t by_curvature = 0;
    double lowest_mm_per_s = 0.0;  ///< of all feed moves
};

/// Lowers the feed of moves that are too short for the block cycle time (spacing ≥ F · T_block), that turn an axis faster than
/// it can, or whose curve would need more acceleration across than allowed: a tip at speed F on a radius ρ needs F² / ρ.
/// No feed is raised. Errors: those of `machineTime`.
[[nodiscard]] base::Result<FeedChange> adaptFeeds(FinishingPath& path, const MachineSetting& setting,
                                                  const FeedLimits& limits);

}  // namespace cusp::finishing
