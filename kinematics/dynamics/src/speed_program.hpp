// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The fastest speed along a given path within the limits of every axis, as an optimisation.
#pragma once

#include <cusp/dynamics/motion_piece.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

namespace cusp::dynamics {

/// Squared path speed b = s'² as Bernstein coefficients over a span.
using SpanSpeed = std::array<double, 3>;

/// A path of spans from rest, or from motion, to rest. A span that begins or ends at rest is no unknown: it runs with constant
/// jerk (b ~ x^(4/3), which no polynomial follows), and is left out of `spans`.
struct SpeedProblem {
    std::vector<AxisCurve> spans;
    std::vector<double> largest;  ///< of b, one for each span, from the feed
    AxisLimits limits;
    std::optional<AxisCurve> start_rest;  ///< absent where the path starts in motion
    AxisCurve end_rest;
    double start_largest = 0.0;  ///< of b over the rest spans, from the feed
    double end_largest = 0.0;
    double start_squared_speed = 0.0;  ///< where the path starts in motion: b and db/ds
    double start_slope = 0.0;
    std::vector<double> guess;  ///< of b in the middle of the first spans, from the plan before
};

struct SpeedSolution {
    std::vector<SpanSpeed> speed;
    /// Largest share of a limit that is used anywhere on the path: at most 1 when the limits hold everywhere.
    double use = 0.0;
    int iterations = 0;
};

[[nodiscard]] SpeedSolution solveSpeed(const SpeedProblem& problem);

/// Largest b at the inner border of a span that runs from rest with constant jerk within all limits.
[[nodiscard]] double largestAfterRest(const AxisCurve& curve, const AxisLimits& limits, double largest);

}  // namespace cusp::dynamics
