// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// One optimisation: from rest or from motion, over the smoothed path, to rest at a horizon.
#pragma once

#include "path_spline.hpp"
#include "polyline.hpp"
#include "speed_program.hpp"

#include <cusp/dynamics/motion_planner.hpp>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace cusp::dynamics {

/// Where the last commitment left the machine: knots about that place, and how fast it moves.
struct MotionStart {
    std::vector<double> knots;  ///< two before the place, the place, two after
    double squared_speed = 0.0;
    double slope = 0.0;
    /// The plan from there to its rest: path length in the middle of each span and the squared speed.
    std::vector<std::pair<double, double>> plan;
};

struct WindowPlan {
    bool usable = false;                   ///< keeps every limit, and is no slower than stopping at every vertex
    std::vector<MotionPiece> pieces;       ///< two for each span of the spline, one where it is at rest
    std::vector<SpanSpeed> speed;          ///< of each piece; of those at rest zero
    std::vector<double> knots;             ///< as PathSpline takes them
    std::vector<std::size_t> first_piece;  ///< of each span
    double tip_mm = 0.0;
    double axis_rad = 0.0;

    /// The start of span `span`, for the next window.
    [[nodiscard]] MotionStart startAt(std::size_t span) const;
};

/// `horizon` is a vertex of `path`. `limits` are those to plan with.
[[nodiscard]] WindowPlan planWindow(const Polyline& path, std::size_t horizon, const std::optional<MotionStart>& start,
                                    const AxisLimits& limits, double limit_use, const ToolModel& tool);

/// The whole of a path from rest to rest that is one straight line in axis space under one feed: the closed form. Empty when
/// it is not.
[[nodiscard]] std::vector<MotionPiece> planStraight(const Polyline& path, const AxisLimits& limits);

/// Time, in s, from the first vertex to the vertex `horizon` with a stop at each between.
[[nodiscard]] double timeWithStops(const Polyline& path, std::size_t horizon, const AxisLimits& limits);

}  // namespace cusp::dynamics
