// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Limits of every axis on every sample, and tolerances everywhere on the path.
#include "../shipped_machines.hpp"
#include "planned_motion.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace cusp::dynamics::test {
namespace {

/// Rounding of the third difference of positions near 1 m at a tick of 1 ms.
constexpr double rounding = 1e-6;

double distanceToSegment(const geometry::Vector3& p, const geometry::Vector3& a, const geometry::Vector3& b) {
    const geometry::Vector3 along = b - a;
    const double u = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    return (p - a - u * along).norm();
}

/// Nearest distance of the tip to any programmed block from `low` on.
double missOf(const geometry::Vector3& tip, const std::vector<PathBlock>& blocks, std::size_t low, std::size_t high) {
    double least = 1e9;
    for (std::size_t i = low; i < std::min(high, blocks.size()); ++i)
        least = std::min(
            least, distanceToSegment(tip, blocks[i].points.front().tool.tip_mm, blocks[i].points.back().tool.tip_mm));
    return least;
}

struct Case {
    const char* name;
    RandomProgram program;
};

std::vector<Case> cases() {
    return {{"finishing", {1, 400, 0.5, 0.02, 0.004, 50.0}}, {"rough", {2, 200, 1.0, 0.4, 0.02, 100.0}},
            {"corners", {3, 60, 5.0, 2.0, 0.05, 60.0}},      {"dense", {4, 3000, 0.02, 0.3, 0.0005, 40.0}},
            {"rapid", {5, 40, 30.0, 1.0, 0.1, 1e9}},         {"tight", {6, 100, 1.0, 0.5, 0.01, 50.0, 0.001, 2e-4}}};
}

TEST(PlannerLimits, HoldOnEverySampleOfEveryShippedMachine) {
    for (const std::string& name : kinematics::test::shippedMachineNames()) {
        const kinematics::Machine machine(kinematics::test::shippedMachine(name));
        for (const Case& one : cases()) {
            SCOPED_TRACE(machine.definition().name + ", " + one.name);
            const auto blocks = blocksOf(one.program, machine);
            MotionPlanner planner(limitsOf(machine), {}, toolModel(machine));
            const auto pieces = planAll(planner, blocks);
            ASSERT_FALSE(pieces.empty());
            for (const double tick_s : {0.001, 0.0037}) {
                const LimitUse use = limitUse(samples(pieces, tick_s), tick_s, limitsOf(machine));
                EXPECT_LE(use.velocity, 1.0 + rounding);
                EXPECT_LE(use.acceleration, 1.0 + rounding);
                EXPECT_LE(use.jerk, 1.0 + rounding);
                EXPECT_GT(std::max({use.velocity, use.acceleration, use.jerk}), 0.5) << "some limit must decide";
            }
            EXPECT_EQ(planner.summary().stops, 1u);
            const AxisVector end = pieces.back().at(pieces.back().law.duration_s);
            for (std::size_t i = 0; i < max_axes; ++i) EXPECT_NEAR(end[i], blocks.back().points.back().axes[i], 1e-9);
        }
    }
}

TEST(PlannerLimits, TipStaysWithinToleranceOfTheProgrammedPath) {
    const kinematics::Machine machine(kinematics::test::shippedMachine("fooke-endura-ca"));
    for (const Case& one : cases()) {
        SCOPED_TRACE(one.name);
        const auto blocks = blocksOf(one.program, machine);
        MotionPlanner planner(limitsOf(machine), {}, toolModel(machine));
        double worst = 0.0;
        for (const MotionPiece& piece : planAll(planner, blocks)) {
            const std::size_t low = piece.block > 40 ? piece.block - 40 : 0;
            for (const double share : {0.0, 0.25, 0.5, 0.8}) {
                const AxisVector axes = piece.at(share * piece.law.duration_s);
                const geometry::Vector3 tip = machine.forward(axisValues(axes), tool_length_mm).tip_mm;
                worst = std::max(worst, missOf(tip, blocks, low, piece.block + 80));
            }
        }
        EXPECT_LE(worst, one.program.tolerance_mm);
        EXPECT_LE(planner.summary().largest_tip_mm, one.program.tolerance_mm);
        EXPECT_LE(planner.summary().largest_axis_rad, one.program.orientation_tolerance_rad);
    }
}

TEST(PlannerLimits, WithoutToleranceEveryCornerIsAStop) {
    const AxisLimits limits = cube(500.0, 3000.0, 30000.0);
    MotionPlanner planner(limits, {}, cubeTool());
    std::vector<PathBlock> blocks = {line({0, 0, 0}, {10, 0, 0}, 50.0), line({10, 0, 0}, {20, 0, 0}, 50.0),
                                     line({20, 0, 0}, {20, 10, 0}, 50.0)};
    for (PathBlock& block : blocks) block.tolerance_mm = 0.0;
    const auto pieces = planAll(planner, blocks);
    EXPECT_EQ(planner.summary().stops, 2u) << "the straight passage is none";
    const LimitUse use = limitUse(samples(pieces, 0.001), 0.001, limits);
    EXPECT_LE(use.jerk, 1.0 + rounding);
}

TEST(PlannerLimits, FeedIsTheSpeedOfTheTip) {
    const kinematics::Machine machine(kinematics::test::shippedMachine("trunnion-ac"));
    const RandomProgram program{7, 300, 0.5, 0.02, 0.002, 10.0};
    MotionPlanner planner(limitsOf(machine), {}, toolModel(machine));
    const auto positions = samples(planAll(planner, blocksOf(program, machine)), 0.002);
    double fastest = 0.0;
    geometry::Vector3 before = machine.forward(axisValues(positions.front()), tool_length_mm).tip_mm;
    for (const AxisVector& axes : positions) {
        const geometry::Vector3 tip = machine.forward(axisValues(axes), tool_length_mm).tip_mm;
        fastest = std::max(fastest, (tip - before).norm() / 0.002);
        before = tip;
    }
    // Smoothing bends the tip's way against the path length by as much as the rotary axes bend it within a span.
    EXPECT_LE(fastest, 10.0 * 1.005);
    EXPECT_GE(fastest, 9.9);
}

TEST(PlannerLimits, RotaryBlocksFeedOneMillimetreForADegree) {
    const kinematics::Machine machine(kinematics::test::shippedMachine("fooke-endura-ca"));
    const geometry::Vector3 tip(0.0, 0.0, 0.0);
    PathBlock block;
    block.feed_mm_per_s = 5.0;
    for (int k = 0; k <= 400; ++k) block.points.push_back(pointAt(machine, tip, {0.3, 0.1 + 0.4 * k / 400.0}));
    MotionPlanner planner(limitsOf(machine), {}, toolModel(machine));
    const double seconds = durationOf(planAll(planner, {block}));
    const double degrees = 0.4 * 180.0 / 3.14159265358979;
    EXPECT_GT(seconds, degrees / 5.0);
    EXPECT_LT(seconds, degrees / 5.0 + 0.2);
}

}  // namespace
}  // namespace cusp::dynamics::test
