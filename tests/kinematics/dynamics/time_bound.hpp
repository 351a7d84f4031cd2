// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The witness of speed: how fast a path can be run at all with limited velocity and acceleration.
#pragma once

#include <cusp/dynamics/motion_planner.hpp>

#include <vector>

namespace cusp::dynamics::test {

/// Least time along the geometry of `pieces`, from rest to rest, within limits of velocity and acceleration of every axis
/// and `feed_mm_per_s` along the path; jerk is free. Every motion within jerk limits as well takes at least as long. By
/// reachability over a fine grid (Pham and Pham 2018): it shares neither variables nor method with the planner.
[[nodiscard]] double leastTime(const std::vector<MotionPiece>& pieces, const AxisLimits& limits, double feed_mm_per_s,
                               int points_per_piece);

}  // namespace cusp::dynamics::test
