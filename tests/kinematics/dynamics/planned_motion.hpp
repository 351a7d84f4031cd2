// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Programs for the planner, and what its motion does at every tick.
#pragma once

#include <cusp/base/random.hpp>
#include <cusp/dynamics/motion_planner.hpp>
#include <cusp/kinematics/machine.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace cusp::dynamics::test {

/// A chain of straight tip moves, rotary axes running along linearly.
struct RandomProgram {
    std::uint64_t seed = 1;
    std::size_t blocks = 200;
    double block_mm = 0.5;
    double turn_rad = 0.02;    ///< largest change of direction between blocks
    double rotary_rad = 0.02;  ///< largest rotary step of a block
    double feed_mm_per_s = 50.0;
    double tolerance_mm = 0.01;
    double orientation_tolerance_rad = 0.00175;
};

inline constexpr double tool_length_mm = 150.0;

[[nodiscard]] ToolModel toolModel(const kinematics::Machine& machine);
/// Axes and tool at a tip with given rotary positions.
[[nodiscard]] PathPoint pointAt(const kinematics::Machine& machine, const geometry::Vector3& tip_mm,
                                const kinematics::RotaryValues& rotary_rad);
[[nodiscard]] std::vector<PathBlock> blocksOf(const RandomProgram& program, const kinematics::Machine& machine);

[[nodiscard]] std::vector<MotionPiece> planAll(MotionPlanner& planner, const std::vector<PathBlock>& blocks);
[[nodiscard]] double durationOf(const std::vector<MotionPiece>& pieces);
/// Positions at every tick from the start until some ticks after the end.
[[nodiscard]] std::vector<AxisVector> samples(const std::vector<MotionPiece>& pieces, double tick_s);

/// Largest share of each limit over all samples and axes, by differences of neighbouring samples.
struct LimitUse {
    double velocity = 0.0;
    double acceleration = 0.0;
    double jerk = 0.0;
};
[[nodiscard]] LimitUse limitUse(const std::vector<AxisVector>& samples, double tick_s, const AxisLimits& limits);

/// Limits of a machine of three linear axes alike.
[[nodiscard]] AxisLimits cube(double velocity, double acceleration, double jerk);
[[nodiscard]] ToolModel cubeTool();
[[nodiscard]] PathBlock line(const geometry::Vector3& from, const geometry::Vector3& to, double feed_mm_per_s);

}  // namespace cusp::dynamics::test
