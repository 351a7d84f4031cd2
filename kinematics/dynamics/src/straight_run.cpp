// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A straight line in axis space from rest to rest.
#include "window_plan.hpp"

#include <cusp/dynamics/s_curve.hpp>

#include <algorithm>
#include <cmath>

namespace cusp::dynamics {

namespace {

/// Relative to the length of the path: rounding of five printed decimals stays a straight line only on long ones, and may.
constexpr double straight = 1e-9;

bool isStraight(const Polyline& path) {
    const PathVertex& first = path.vertices().front();
    const PathVertex& last = path.vertices().back();
    const double length = last.s - first.s;
    for (const PathVertex& vertex : path.vertices()) {
        const double u = (vertex.s - first.s) / length;
        for (std::size_t i = 0; i < max_axes; ++i) {
            const double on_line = (1.0 - u) * first.point.axes[i] + u * last.point.axes[i];
            if (std::abs(vertex.point.axes[i] - on_line) > straight * length) return false;
        }
    }
    return std::all_of(path.edges().begin(), path.edges().end(),
                       [&](const PathEdge& edge) { return edge.squared_speed == path.edges().front().squared_speed; });
}

}  // namespace

std::vector<MotionPiece> planStraight(const Polyline& path, const AxisLimits& limits) {
    if (!isStraight(path)) return {};
    const PathVertex& first = path.vertices().front();
    const double length = path.end() - first.s;
    ScalarLimits along{std::sqrt(path.edges().front().squared_speed), 1e300, 1e300};
    for (std::size_t i = 0; i < limits.count; ++i) {
        const double slope = std::abs(path.vertices().back().point.axes[i] - first.point.axes[i]) / length;
        if (slope < straight) continue;
        along.velocity = std::min(along.velocity, limits.velocity[i] / slope);
        along.acceleration = std::min(along.acceleration, limits.acceleration[i] / slope);
        along.jerk = std::min(along.jerk, limits.jerk[i] / slope);
    }
    std::vector<MotionPiece> out;
    double done = 0.0;
    const std::vector<StraightPhase> phases = straightPhases(length, along);
    for (std::size_t k = 0; k < phases.size(); ++k) {
        MotionPiece piece;
        piece.law = phases[k].law;
        piece.curve.length = k + 1 == phases.size() ? length - done : phases[k].length;
        for (std::size_t p = 0; p < 4; ++p)
            piece.curve.points[p] = path.at(first.s + done + piece.curve.length * static_cast<double>(p) / 3.0).axes;
        piece.path_mm = first.s + done;
        piece.block = path.edges()[path.edgeAt(piece.path_mm)].block;
        done += piece.curve.length;
        out.push_back(piece);
    }
    return out;
}

double timeWithStops(const Polyline& path, std::size_t horizon, const AxisLimits& limits) {
    double time = 0.0;
    for (std::size_t edge = 0; edge < horizon; ++edge)
        for (const MotionPiece& piece : planStraight(path.edgeAlone(edge), limits)) time += piece.law.duration_s;
    return time;
}

}  // namespace cusp::dynamics
