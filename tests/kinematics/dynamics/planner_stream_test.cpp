// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A path that goes on and on, stops in between, and starves.
#include "planned_motion.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace cusp::dynamics::test {
namespace {

std::vector<PathBlock> wave(std::size_t blocks) {
    std::vector<PathBlock> out;
    geometry::Vector3 tip(0.0, 0.0, 0.0);
    for (std::size_t i = 1; i <= blocks; ++i) {
        const double x = 0.4 * static_cast<double>(i);
        const geometry::Vector3 next(x, 5.0 * std::sin(0.1 * x), 0.0);
        out.push_back(line(tip, next, 80.0));
        out.back().id = i;
        tip = next;
    }
    return out;
}

TEST(PlannerStream, TheWindowCostsLittleAgainstAllAtOnce) {
    const AxisLimits limits = cube(500.0, 2000.0, 40000.0);
    MotionPlanner windowed(limits, {.window_blocks = 100}, cubeTool());
    MotionPlanner whole(limits, {.window_blocks = 599}, cubeTool());
    const auto blocks = wave(590);
    const double seconds = durationOf(planAll(windowed, blocks));
    const double best = durationOf(planAll(whole, blocks));
    EXPECT_EQ(whole.summary().windows, 1u);
    EXPECT_GT(windowed.summary().windows, 5u);
    EXPECT_NEAR(seconds / best, 1.0, 0.01);
}

TEST(PlannerStream, EveryPlanCanBeRunToItsRest) {
    const AxisLimits limits = cube(500.0, 2000.0, 40000.0);
    const auto blocks = wave(300);
    MotionPlanner planner(limits, {}, cubeTool());
    std::vector<MotionPiece> run;
    std::size_t rests = 0;
    for (const PathBlock& block : blocks) {
        planner.add(block);
        if (!planner.ready()) continue;
        Plan plan = planner.plan();
        run.insert(run.end(), plan.committed.begin(), plan.committed.end());
        std::vector<MotionPiece> stopped = run;
        stopped.insert(stopped.end(), plan.to_rest.begin(), plan.to_rest.end());
        const LimitUse use = limitUse(samples(stopped, 0.001), 0.001, limits);
        EXPECT_LE(std::max({use.velocity, use.acceleration, use.jerk}), 1.0 + 1e-6);
        if (++rests != 2) continue;
        planner.takeRest();
        run = std::move(stopped);
    }
    planner.stop();
    while (planner.ready()) {
        const Plan plan = planner.plan();
        run.insert(run.end(), plan.committed.begin(), plan.committed.end());
    }
    EXPECT_EQ(planner.summary().stops, 2u);
    const AxisVector end = run.back().at(run.back().law.duration_s);
    EXPECT_NEAR(end[0], blocks.back().points.back().axes[0], 1e-9);
    const LimitUse use = limitUse(samples(run, 0.001), 0.001, limits);
    EXPECT_LE(std::max({use.velocity, use.acceleration, use.jerk}), 1.0 + 1e-6);
}

TEST(PlannerStream, BlocksFarShorterThanTheWindowsAreLookedAtInLargerNumbers) {
    const AxisLimits limits = cube(500.0, 2000.0, 40000.0);
    std::vector<PathBlock> blocks;
    for (int i = 0; i < 5000; ++i) blocks.push_back(line({0.001 * i, 0, 0}, {0.001 * (i + 1), 0, 0}, 20.0));
    blocks.push_back(line({5, 0, 0}, {5, 5, 0}, 20.0));
    MotionPlanner planner(limits, {}, cubeTool());
    const auto pieces = planAll(planner, blocks);
    EXPECT_EQ(planner.summary().stops, 1u);
    EXPECT_EQ(planner.summary().blocks, 5001u);
}

TEST(PlannerStream, APathThatStartsElsewhereStartsAtRest) {
    MotionPlanner planner(cube(500.0, 2000.0, 40000.0), {}, cubeTool());
    const auto pieces = planAll(planner, {line({0, 0, 0}, {10, 0, 0}, 20.0), line({50, 0, 0}, {60, 0, 0}, 20.0)});
    EXPECT_EQ(planner.summary().stops, 2u);
    EXPECT_DOUBLE_EQ(pieces.back().at(pieces.back().law.duration_s)[0], 60.0);
}

TEST(PlannerStream, NothingComesOfNothing) {
    MotionPlanner planner(cube(500.0, 2000.0, 40000.0), {}, cubeTool());
    EXPECT_FALSE(planner.ready());
    EXPECT_TRUE(planAll(planner, {line({1, 2, 3}, {1, 2, 3}, 20.0), PathBlock{}}).empty());
    EXPECT_EQ(planner.summary().blocks, 0u);
}

}  // namespace
}  // namespace cusp::dynamics::test
