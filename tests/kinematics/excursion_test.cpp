// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Excursions: where a move is left and taken up again, against walking both ways in tiny steps.
#include "shipped_machines.hpp"

#include <cusp/base/random.hpp>
#include <cusp/base/units.hpp>
#include <cusp/kinematics/angles.hpp>
#include <cusp/kinematics/axis_following.hpp>
#include <cusp/kinematics/excursion.hpp>

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace cusp::kinematics::test {
namespace {

using base::degFromRad;
using base::radFromDeg;
using geometry::angleBetween;

constexpr std::uint64_t seed = 20261125;

bool withinLimits(const Machine& machine, const RotaryValues& rotary_rad, double slack_rad) {
    for (std::size_t i = 0; i < machine.rotaryCount(); ++i)
        if (machine.rotaryRange(i).excess(rotary_rad[i]) > slack_rad) return false;
    return true;
}

/// The position for `axis` that is nearest to `near`: continues a way by a tiny step, whatever the branch is called.
RotaryValues continued(const Machine& machine, const Vector3& axis, const RotaryValues& near) {
    const AxisSolutions solved = machine.solveAxis(axis);
    RotaryValues best = near;
    double least = 1e9;
    for (std::size_t b = 0; b < solved.count; ++b) {
        RotaryValues at{};
        double away = 0.0;
        for (std::size_t i = 0; i < 2; ++i) {
            at[i] = near[i] + wrapAngle(solved.branch[b][i] - near[i]);
            away = std::max(away, std::abs(at[i] - near[i]));
        }
        if (away >= least) continue;
        least = away;
        best = at;
    }
    return best;
}

struct Walk {
    std::vector<RotaryValues> positions;  ///< at even fractions
    std::size_t keeps = 0;                ///< how many of them from its start keep the limits
};

Walk walk(const Machine& machine, const Vector3& from, const Vector3& to, RotaryValues start, int steps) {
    Walk out;
    bool kept = true;
    for (int i = 0; i <= steps; ++i) {
        start = continued(machine, onGreatCircle(from, to, static_cast<double>(i) / steps), start);
        out.positions.push_back(start);
        kept = kept && withinLimits(machine, start, 2e-6);
        out.keeps += kept ? 1U : 0U;
    }
    return out;
}

/// Every position of `axis` in every winding within the limits.
std::vector<RotaryValues> positionsOf(const Machine& machine, const Vector3& axis) {
    std::vector<RotaryValues> positions;
    for (const AxisValues& values : machine.inverse({.tip_mm = Vector3::Zero(), .axis = axis}, 0.0).values)
        positions.push_back(values.rotary_rad);
    return positions;
}

TEST(Excursion, LeavesWhereBothWaysKeepTheLimits) {
    base::Random random(seed);
    constexpr int steps = 3600;
    std::size_t planned = 0;
    std::size_t inside = 0;
    std::size_t refused = 0;
    machine::MachineDefinition narrow = shippedMachine("head-c200-a95");
    narrow.rotary.at("C").min_rad = radFromDeg(-100.0);
    narrow.rotary.at("C").max_rad = radFromDeg(100.0);
    narrow.rotary.at("A").min_rad = radFromDeg(20.0);
    // On the narrow machine most random axes are out of reach.
    for (const auto& [definition, trials] :
         {std::pair{shippedMachine("fooke-endura-ca"), 120}, std::pair{shippedMachine("head-c200-a95"), 120},
          std::pair{narrow, 1200}}) {
        const Machine machine(definition);
        for (int trial = 0; trial < trials; ++trial) {
            const Vector3 first = machine.toolAxis({random.uniform(-4.0, 4.0), random.uniform(0.15, 1.0)});
            const Vector3 last = machine.toolAxis({random.uniform(-4.0, 4.0), random.uniform(0.15, 1.0)});
            if (nearestMeeting(machine, first, last).gap_rad < radFromDeg(2.0)) continue;
            const auto starts = positionsOf(machine, first);
            const auto ends = positionsOf(machine, last);
            if (starts.empty() || ends.empty()) continue;
            const PathPoint from{
                .tip_mm = {1.0, 2.0, 3.0}, .rotary_rad = starts[random.below(starts.size())], .line = 8};
            const PathPoint to{.tip_mm = {11.0, 2.0, -3.0}, .rotary_rad = ends[random.below(ends.size())], .line = 9};
            const Walk forth = walk(machine, first, last, from.rotary_rad, steps);
            const Walk back = walk(machine, last, first, to.rotary_rad, steps);
            constexpr std::size_t all = steps + 1;
            ExcursionPlanner planner(machine, {.retract_mm = 40.0, .file_name = "P.apt"});
            const auto excursion = planner.plan(from, to);
            const bool possible = forth.keeps + back.keeps > all;
            // Where the two just meet, tiny steps and coarse ones may disagree.
            if (std::abs(static_cast<double>(forth.keeps + back.keeps) - static_cast<double>(all)) < 20.0) continue;
            ASSERT_EQ(excursion.has_value(), possible) << "seed " << seed << ", trial " << trial;
            if (!excursion) {
                ++refused;
                EXPECT_EQ(planner.report().errorCount(), 1U);
                continue;
            }
            ++planned;
            const double earliest = static_cast<double>(all - back.keeps) / double{steps};
            EXPECT_GE(excursion->fraction, earliest - 1.0 / steps) << trial;
            EXPECT_LE(excursion->fraction, earliest + 1.0 / 720.0 + 1.0 / steps) << trial;
            inside += excursion->fraction > 0.0 && excursion->fraction < 1.0 ? 1U : 0U;
            // Both sides give the axis of the path there, and lie on the ways walked.
            const Vector3 there = onGreatCircle(first, last, excursion->fraction);
            EXPECT_LE(angleBetween(machine.toolAxis(excursion->leave_rad), there), 1e-6);
            EXPECT_LE(angleBetween(machine.toolAxis(excursion->return_rad), there), 1e-6);
            EXPECT_TRUE(withinLimits(machine, excursion->leave_rad, 0.0));
            EXPECT_TRUE(withinLimits(machine, excursion->return_rad, 0.0));
            const auto place = static_cast<std::size_t>(std::lround(excursion->fraction * steps));
            for (std::size_t i = 0; i < 2; ++i) {
                EXPECT_NEAR(excursion->leave_rad[i], forth.positions[place][i], 1e-5) << trial;
                EXPECT_NEAR(excursion->return_rad[i], back.positions[all - 1 - place][i], 1e-5) << trial;
            }
            const Vector3 tip = from.tip_mm + excursion->fraction * (to.tip_mm - from.tip_mm);
            EXPECT_NEAR((excursion->tip_mm - tip).norm(), 0.0, 1e-12);
            EXPECT_NEAR((excursion->retracted_mm - tip - 40.0 * there).norm(), 0.0, 1e-4);
        }
    }
    EXPECT_GT(planned, 100U);
    EXPECT_GT(inside, 5U);
    EXPECT_GT(refused, 5U);
}

/// C at 190° of 200°, A at 30°: the path goes on to 210°, where C must be at −150°. At the start −170° is within the limits
/// already, so the tool leaves there.
TEST(Excursion, SaysWhatTheToolDoes) {
    machine::MachineDefinition definition = shippedMachine("head-c200-a95");
    definition.rotary.at("A").min_rad = radFromDeg(5.0);
    definition.rotary.at("A").home_rad = radFromDeg(5.0);
    const Machine machine(definition);
    ExcursionPlanner planner(machine, {.retract_mm = 50.0, .file_name = "P.apt"});
    const auto excursion =
        planner.plan({.tip_mm = {0.0, 0.0, 0.0}, .rotary_rad = {radFromDeg(190.0), radFromDeg(30.0)}, .line = 6},
                     {.tip_mm = {5.0, 0.0, 0.0}, .rotary_rad = {radFromDeg(-150.0), radFromDeg(30.0)}, .line = 7});
    ASSERT_TRUE(excursion.has_value());
    EXPECT_EQ(excursion->fraction, 0.0);
    EXPECT_NEAR(degFromRad(excursion->return_rad[0]), -170.0, 1e-9);
    // A whole turn of the head at 30° swings the axis to the other side: by 60°.
    EXPECT_NEAR(degFromRad(excursion->swing_rad), 60.0, 1e-3);
    EXPECT_EQ(
        base::toText(planner.report()),
        "P.apt:7: warning: the rotary limits force the tool off the part on the way to CL line 7: it leaves along "
        "its axis by 50 mm, turns C axis from 190° to -170° (360°) with the axis swinging by up to 60°, and comes "
        "back to the same place [kinematics.excursion]\n");
}

TEST(Excursion, RefusesWhatTheLimitsLeaveNoPlaceFor) {
    machine::MachineDefinition definition = shippedMachine("head-c200-a95");
    definition.rotary.at("A").min_rad = radFromDeg(5.0);
    definition.rotary.at("A").home_rad = radFromDeg(5.0);
    definition.rotary.at("C").min_rad = radFromDeg(-100.0);
    definition.rotary.at("C").max_rad = radFromDeg(100.0);
    const Machine machine(definition);
    ExcursionPlanner planner(machine, {.retract_mm = 50.0, .file_name = "P.apt"});
    EXPECT_FALSE(planner
                     .plan({.tip_mm = {}, .rotary_rad = {radFromDeg(90.0), radFromDeg(30.0)}, .line = 6},
                           {.tip_mm = {}, .rotary_rad = {radFromDeg(-95.0), radFromDeg(30.0)}, .line = 7})
                     .has_value());
    EXPECT_EQ(
        base::toText(planner.report()),
        "P.apt:7: error: the limits force a rewind while cutting, at CL line 7, and leave no place for it: C axis "
        "from 90° to -95° (185°) [kinematics.rewind]\n");
    EXPECT_EQ(planner.planned(), 0U);
}

TEST(Excursion, LeavesThePoleWhereItStands) {
    const Machine machine(shippedMachine("head-c200-a95"));
    ExcursionPlanner planner(machine, {});
    // At the pole C may stand anywhere; the way off it wants C at −170°.
    const auto excursion =
        planner.plan({.tip_mm = Vector3::Zero(), .rotary_rad = {radFromDeg(190.0), 0.0}, .line = 6},
                     {.tip_mm = {5.0, 0.0, 0.0}, .rotary_rad = {radFromDeg(-100.0), radFromDeg(30.0)}, .line = 7});
    ASSERT_TRUE(excursion.has_value());
    EXPECT_EQ(excursion->fraction, 0.0);
    EXPECT_NEAR(degFromRad(excursion->leave_rad[0]), 190.0, 1e-12);
    EXPECT_NEAR(degFromRad(excursion->return_rad[0]), -100.0, 1e-6);
    EXPECT_NEAR(degFromRad(excursion->return_rad[1]), 0.0, 1e-4);
}

TEST(Excursion, ChecksItsOptions) {
    EXPECT_TRUE(ExcursionOptions().check().empty());
    EXPECT_EQ(base::toText(ExcursionOptions{.retract_mm = 0.0, .file_name = {}}.check()),
              "error: retract_mm is 0; it must lie in 1 to 1000 [kinematics.option]\n");
}

}  // namespace
}  // namespace cusp::kinematics::test
