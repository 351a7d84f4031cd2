// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// How long motion takes: closed forms, and the bound that ignores jerk.
#include "../shipped_machines.hpp"
#include "planned_motion.hpp"
#include "time_bound.hpp"

#include <cusp/dynamics/s_curve.hpp>

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace cusp::dynamics::test {
namespace {

constexpr double tick_s = 0.001;

TEST(PlannerTime, SingleAxisMovesAreTheClosedFormWithinATick) {
    base::Random random(31);
    const AxisLimits limits = cube(800.0, 4000.0, 50000.0);
    for (int i = 0; i < 500; ++i) {
        const double way = std::pow(10.0, random.uniform(-3.0, 3.0));
        const double feed = random.uniform(1.0, 1500.0);
        MotionPlanner planner(limits, {}, cubeTool());
        const double seconds = durationOf(planAll(planner, {line({0, 0, 0}, {0, way, 0}, feed)}));
        EXPECT_NEAR(seconds, straightTime(way, {std::min(feed, 800.0), 4000.0, 50000.0}), tick_s) << way << " mm";
    }
}

/// A speed step on a straight line by Δv takes 2 √(Δv/j), or Δv/a + a/j, at the mean of both speeds.
double stepTime(double dv, double a, double j) { return dv * j < a * a ? 2.0 * std::sqrt(dv / j) : dv / a + a / j; }

TEST(PlannerTime, FeedStepsOnAStraightLineAreNearTheClosedForm) {
    const double a = 3000.0;
    const double j = 30000.0;
    MotionPlanner planner(cube(1000.0, a, j), {}, cubeTool());
    const double seconds =
        durationOf(planAll(planner, {line({0, 0, 0}, {50, 0, 0}, 100.0), line({50, 0, 0}, {100, 0, 0}, 20.0),
                                     line({100, 0, 0}, {150, 0, 0}, 100.0)}));
    const double start = stepTime(100.0, a, j);
    const double down = stepTime(80.0, a, j);
    const double fast = 50.0 - 50.0 * start - 60.0 * down;
    const double best = 2.0 * (start + fast / 100.0 + down) + 50.0 / 20.0;
    EXPECT_GE(seconds, best * (1.0 - 1e-9));
    EXPECT_LE(seconds, 1.02 * best);
}

TEST(PlannerTime, CirclesRunAtTheSpeedTheirCurvatureAllows) {
    const double radius = 5.0;
    const double a = 1000.0;
    const double j = 200000.0;
    PathBlock circle;
    circle.tolerance_mm = 0.005;
    for (int k = 0; k <= 4000; ++k) {
        const double angle = 10.0 * std::numbers::pi * k / 4000.0;
        const geometry::Vector3 tip(radius * std::cos(angle), radius * std::sin(angle), 0.0);
        circle.points.push_back({{tip.x(), tip.y(), 0.0}, {tip, geometry::Vector3::UnitZ()}});
    }
    MotionPlanner planner(cube(1000.0, a, j), {}, cubeTool());
    const double seconds = durationOf(planAll(planner, {circle}));
    // An axis swings with v²/r at constant speed; with two axes alike the best speed is a little above that, never by √2.
    const double constant = 10.0 * std::numbers::pi * radius / std::sqrt(a * radius);
    EXPECT_GE(seconds, constant / std::sqrt(std::numbers::sqrt2));
    EXPECT_LE(seconds, 1.05 * constant);
}

TEST(PlannerTime, WithinATenthOfTheBoundWhereJerkIsPlentiful) {
    for (const char* name : {"fooke-endura-ca", "trunnion-ac", "nutating-45"}) {
        const kinematics::Machine machine(kinematics::test::shippedMachine(name));
        AxisLimits limits = limitsOf(machine);
        for (double& jerk : limits.jerk) jerk *= 100.0;
        for (const RandomProgram& program :
             {RandomProgram{1, 300, 0.5, 0.02, 0.004, 100.0}, RandomProgram{2, 150, 2.0, 0.2, 0.02, 100.0},
              RandomProgram{3, 60, 8.0, 0.5, 0.05, 200.0}}) {
            SCOPED_TRACE(std::string(name) + ", seed " + std::to_string(program.seed));
            MotionPlanner planner(limits, {}, toolModel(machine));
            const auto pieces = planAll(planner, blocksOf(program, machine));
            const double bound = leastTime(pieces, limits, 1e9, 12);
            const double seconds = durationOf(pieces);
            RecordProperty("ratio", std::to_string(seconds / bound));
            EXPECT_GE(seconds, bound * 0.999);
            EXPECT_LE(seconds, 1.10 * bound) << "bound " << bound << " s";
        }
    }
}

/// A flat path as roughing has it: long moves, and corners full of the shortest.
std::vector<PathBlock> raggedPath(std::uint64_t seed, std::size_t count) {
    base::Random random(seed);
    std::vector<PathBlock> blocks;
    geometry::Vector3 at(0.0, 0.0, 0.0);
    double heading = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const double length_mm = std::pow(10.0, random.uniform(-4.0, 1.3));
        heading += random.uniform() < 0.3 ? random.uniform(-3.14, 3.14) : random.uniform(-0.3, 0.3);
        const geometry::Vector3 next = at + length_mm * geometry::Vector3(std::cos(heading), std::sin(heading), 0.0);
        blocks.push_back(line(at, next, 30.0));
        blocks.back().tolerance_mm = 0.01;
        at = next;
    }
    return blocks;
}

TEST(PlannerTime, ARaggedPathTakesNoLongerThanStoppingAtEveryBlock) {
    const AxisLimits limits = cube(500.0, 3000.0, 30000.0);
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        SCOPED_TRACE(seed);
        const auto blocks = raggedPath(seed, 200);
        double stopping_s = 0.0;
        for (const PathBlock& block : blocks) {
            MotionPlanner alone(limits, {}, cubeTool());
            stopping_s += durationOf(planAll(alone, {block}));
        }
        MotionPlanner planner(limits, {}, cubeTool());
        const auto pieces = planAll(planner, blocks);
        EXPECT_LE(durationOf(pieces), stopping_s);
        const LimitUse use = limitUse(samples(pieces, 0.001), 0.001, limits);
        EXPECT_LE(std::max({use.velocity, use.acceleration, use.jerk}), 1.0 + 1e-6);
        EXPECT_NEAR((pieces.back().at(pieces.back().law.duration_s)[0]), blocks.back().points.back().axes[0], 1e-9);
    }
}

}  // namespace
}  // namespace cusp::dynamics::test
