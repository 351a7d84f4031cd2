// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The planner against brute force over every choice, and its promises: limits, poles, rewinds, bounded delay.
#include "shipped_machines.hpp"

#include <cusp/base/random.hpp>
#include <cusp/base/units.hpp>
#include <cusp/kinematics/angles.hpp>
#include <cusp/kinematics/axis_planner.hpp>

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>

namespace cusp::kinematics::test {
namespace {

using base::degFromRad;
using base::radFromDeg;
using geometry::angleBetween;
using std::numbers::pi;

constexpr std::uint64_t seed = 20240608;

struct Plan {
    std::vector<PlannedAxes> points;
    PlannerSummary summary;
    base::Diagnostics report;
};

Plan plan(const Machine& machine, const std::vector<AxisPoint>& path, PlannerOptions options = {}) {
    AxisPlanner planner(machine, std::move(options));
    Plan out;
    PlannedAxes axes;
    for (const AxisPoint& point : path) {
        planner.push(point);
        while (planner.pop(axes)) out.points.push_back(axes);
    }
    planner.finish();
    while (planner.pop(axes)) out.points.push_back(axes);
    out.summary = planner.summary();
    out.report = planner.report();
    return out;
}

/// A path whose axes the machine reaches with the second angle given and the first one anything.
std::vector<AxisPoint> pathThrough(const Machine& machine, const std::vector<RotaryValues>& rotary_deg,
                                   bool cutting = true) {
    std::vector<AxisPoint> path;
    path.reserve(rotary_deg.size());
    for (const RotaryValues& values : rotary_deg)
        path.push_back({.axis = machine.toolAxis({radFromDeg(values[0]), radFromDeg(values[1])}),
                        .line = static_cast<std::uint32_t>(path.size() + 1),
                        .cutting = cutting});
    return path;
}

double travelTime(const Machine& machine, const RotaryValues& a, const RotaryValues& b) {
    double time_s = 0.0;
    for (std::size_t i = 0; i < machine.rotaryCount(); ++i) {
        const double way = machine.rotaryRange(i).endless ? std::abs(wrapAngle(b[i] - a[i])) : std::abs(b[i] - a[i]);
        time_s = std::max(time_s, way / machine.rotaryVelocity(i));
    }
    return time_s;
}

/// The least time over every sequence of candidates, by trying them all.
double bruteForce(const Machine& machine, const std::vector<std::vector<RotaryValues>>& candidates, std::size_t from,
                  const RotaryValues* before) {
    if (from == candidates.size()) return 0.0;
    double least = std::numeric_limits<double>::infinity();
    for (const RotaryValues& candidate : candidates[from])
        least = std::min(least, (before != nullptr ? travelTime(machine, *before, candidate) : 0.0) +
                                    bruteForce(machine, candidates, from + 1, &candidate));
    return least;
}

TEST(AxisPlanner, FindsTheShortestOfAllWays) {
    base::Random random(seed);
    for (const std::string name : {"fooke-endura-ca", "head-c200-a95", "nutating-45", "trunnion-ac", "haas-umc-bc"}) {
        const Machine machine(shippedMachine(name));
        for (int trial = 0; trial < 200; ++trial) {
            std::vector<AxisPoint> path;
            std::vector<std::vector<RotaryValues>> candidates;
            while (path.size() < 7) {
                RotaryValues values{};
                for (std::size_t i = 0; i < 2; ++i)
                    values[i] = machine.rotaryRange(i).endless
                                    ? random.uniform(-pi, pi)
                                    : random.uniform(machine.rotaryRange(i).min, machine.rotaryRange(i).max);
                const Vector3 axis = machine.toolAxis(values);
                candidates.emplace_back();
                for (const AxisValues& solution :
                     machine.inverse({.tip_mm = Vector3::Zero(), .axis = axis}, 0.0).values)
                    candidates.back().push_back(solution.rotary_rad);
                path.push_back({.axis = axis, .line = static_cast<std::uint32_t>(path.size()), .cutting = false});
            }
            const Plan planned = plan(machine, path);
            ASSERT_EQ(planned.points.size(), path.size());
            double time_s = 0.0;
            for (std::size_t i = 1; i < path.size(); ++i)
                time_s += travelTime(machine, planned.points[i - 1].rotary_rad, planned.points[i].rotary_rad);
            EXPECT_NEAR(time_s, bruteForce(machine, candidates, 0, nullptr), 1e-8)
                << name << ", seed " << seed << ", trial " << trial;
        }
    }
}

TEST(AxisPlanner, LooksAheadToAvoidARewind) {
    // C climbs through 400 degrees of its 400: only a start at -200 makes it. Point by point, a start at 0 looks better.
    const Machine machine(shippedMachine("head-c200-a95"));
    std::vector<RotaryValues> rotary_deg;
    for (int i = 0; i <= 390; ++i) rotary_deg.push_back({-195.0 + i, 30.0});
    const Plan planned = plan(machine, pathThrough(machine, rotary_deg));
    EXPECT_EQ(planned.summary.rewinds, 0U);
    EXPECT_TRUE(planned.report.empty()) << base::toText(planned.report);
    EXPECT_NEAR(degFromRad(planned.points.front().rotary_rad[0]), -195.0, 1e-9);
    EXPECT_NEAR(degFromRad(planned.summary.travel_rad[0]), 390.0, 1e-9);
}

TEST(AxisPlanner, ReportsARewindThatLimitsForce) {
    const Machine machine(shippedMachine("head-c200-a95"));
    std::vector<RotaryValues> rotary_deg;
    for (int i = 0; i <= 500; ++i) rotary_deg.push_back({-200.0 + i, 30.0});
    PlannerOptions options;
    options.file_name = "P.apt";
    const Plan planned = plan(machine, pathThrough(machine, rotary_deg), options);
    EXPECT_EQ(planned.summary.rewinds, 1U);
    EXPECT_EQ(planned.summary.limit_violations, 0U);
    ASSERT_EQ(planned.report.errorCount(), 1U);
    EXPECT_EQ(planned.report.front().code, "kinematics.rewind");
    std::size_t at = 0;
    while (!planned.points[at].rewind) ++at;
    EXPECT_EQ(planned.report.front().where.line, planned.points[at].line);
    EXPECT_EQ(planned.report.front().where.file, "P.apt");
}

TEST(AxisPlanner, SaysWhatARewindDoes) {
    // With A in 5 to 95 there is one branch, and C must unwind by a whole turn: soonest is shortest.
    machine::MachineDefinition definition = shippedMachine("head-c200-a95");
    definition.rotary.at("A").min_rad = radFromDeg(5.0);
    definition.rotary.at("A").home_rad = radFromDeg(5.0);
    const Machine machine(definition);
    PlannerOptions options;
    options.start_rad = RotaryValues{radFromDeg(150.0), radFromDeg(30.0)};
    const Plan planned =
        plan(machine, pathThrough(machine, {{150.0, 30.0}, {190.0, 30.0}, {201.0, 30.0}, {250.0, 30.0}}), options);
    ASSERT_EQ(planned.report.size(), 1U);
    EXPECT_EQ(base::toText(planned.report.front()),
              "2: error: the limits force a rewind while cutting, at CL line 2: C axis from 150° to -170° (320°) "
              "[kinematics.rewind]");
    options.rewinds_are_handled = true;
    const Plan handled = plan(machine, pathThrough(machine, {{150.0, 30.0}, {190.0, 30.0}, {201.0, 30.0}}), options);
    EXPECT_TRUE(handled.report.empty()) << base::toText(handled.report);
    EXPECT_EQ(handled.summary.rewinds, 1U);
}

TEST(AxisPlanner, PutsAnUnavoidableRewindIntoARapidMove) {
    machine::MachineDefinition definition = shippedMachine("head-c200-a95");
    definition.rotary.at("A").min_rad = radFromDeg(5.0);
    definition.rotary.at("A").home_rad = radFromDeg(5.0);
    const Machine machine(definition);
    std::vector<AxisPoint> path = pathThrough(
        machine, {{150.0, 30.0}, {170.0, 30.0}, {175.0, 30.0}, {180.0, 30.0}, {190.0, 30.0}, {210.0, 30.0}});
    path[2].cutting = false;
    PlannerOptions options;
    options.start_rad = RotaryValues{radFromDeg(150.0), radFromDeg(30.0)};
    const Plan planned = plan(machine, path, options);
    EXPECT_EQ(planned.summary.rewinds, 0U);
    EXPECT_NEAR(degFromRad(planned.points[1].rotary_rad[0]), 170.0, 1e-9);
    EXPECT_NEAR(degFromRad(planned.points[2].rotary_rad[0]), -185.0, 1e-9);
}

TEST(AxisPlanner, NamesAxisValueLineAndLimit) {
    const Machine machine(shippedMachine("fooke-endura-ca"));
    std::vector<AxisPoint> path = pathThrough(machine, {{10.0, 100.0}, {10.0, 118.3}, {10.0, 120.0}, {10.0, 109.0}});
    for (AxisPoint& point : path) point.line += 4810;
    const Plan planned = plan(machine, path);
    EXPECT_EQ(planned.summary.limit_violations, 2U);
    ASSERT_EQ(planned.report.errorCount(), 2U);
    EXPECT_EQ(base::toText(planned.report.front()),
              "4812: error: A axis would need 118.3° at CL line 4812; limit 110° [kinematics.axis-limit]");
    EXPECT_TRUE(planned.points[0].within_limits);
    EXPECT_FALSE(planned.points[1].within_limits);
    EXPECT_NEAR(degFromRad(planned.points[1].rotary_rad[1]), 118.3, 1e-9);
    EXPECT_TRUE(planned.points[3].within_limits);
}

TEST(AxisPlanner, CountsEveryViolationAndListsTheFirst) {
    const Machine machine(shippedMachine("fooke-endura-ca"));
    const std::vector<RotaryValues> rotary_deg(500, RotaryValues{10.0, 118.3});
    const Plan planned = plan(machine, pathThrough(machine, rotary_deg));
    EXPECT_EQ(planned.summary.limit_violations, 500U);
    EXPECT_EQ(planned.report.errorCount(), 500U);
    EXPECT_EQ(planned.report.size(), base::Diagnostics::default_cap);
    EXPECT_EQ(planned.report.front().where.line, 1U);
}

TEST(AxisPlanner, NamesAnAxisOutOfReach) {
    const Plan nutating = plan(Machine(shippedMachine("nutating-45")),
                               {{.axis = Vector3(std::cos(0.1), 0.0, -std::sin(0.1)), .line = 7, .cutting = true}});
    EXPECT_EQ(nutating.summary.unreached, 1U);
    EXPECT_FALSE(nutating.points.at(0).reached);
    EXPECT_EQ(base::toText(nutating.report.front()),
              "7: error: the tool axis at CL line 7 is 5.73° beyond what the rotary axes can reach "
              "[kinematics.axis-unreachable]");
    const Plan three_axis = plan(Machine(shippedMachine("three-axis")),
                                 {{.axis = Vector3::UnitZ(), .line = 1, .cutting = true},
                                  {.axis = Vector3(std::sin(0.1), 0.0, std::cos(0.1)), .line = 2, .cutting = true}});
    EXPECT_EQ(base::toText(three_axis.report.front()),
              "2: error: the tool axis at CL line 2 leans 5.73° from the spindle, and the machine has no rotary axis "
              "[kinematics.axis-unreachable]");
    EXPECT_EQ(three_axis.summary.unreached, 1U);
}

TEST(AxisPlanner, TakesPrintedAxesAsTheyAreMeant) {
    // Level as six decimals print it, a hair below what a 45° nutating head reaches.
    const Plan planned = plan(Machine(shippedMachine("nutating-45")),
                              {{.axis = Vector3(1.0, 0.0, -5e-7).normalized(), .line = 1, .cutting = true}});
    EXPECT_TRUE(planned.report.empty());
    EXPECT_TRUE(planned.points.at(0).reached);
}

TEST(AxisPlanner, TakesAHairBeyondALimitAsTheLimit) {
    machine::MachineDefinition definition = shippedMachine("head-c200-a95");
    definition.rotary.at("A").min_rad = radFromDeg(-90.0);
    definition.rotary.at("A").max_rad = radFromDeg(90.0);
    const Machine machine(definition);
    const Plan hair = plan(machine, {{.axis = Vector3(1.0, 0.0, -5e-7).normalized(), .line = 1, .cutting = true}});
    EXPECT_TRUE(hair.report.empty());
    EXPECT_EQ(std::abs(hair.points.at(0).rotary_rad[1]), radFromDeg(90.0));
    const Plan beyond = plan(machine, {{.axis = Vector3(1.0, 0.0, -5e-6).normalized(), .line = 1, .cutting = true}});
    EXPECT_EQ(beyond.summary.limit_violations, 1U);
}

TEST(AxisPlanner, KeepsTheFirstAxisStillAtThePole) {
    const Machine machine(shippedMachine("head-c200-a95"));
    const Plan planned =
        plan(machine, pathThrough(machine, {{40.0, 10.0}, {40.0, 0.0}, {99.0, 0.0}, {-70.0, 0.0}, {45.0, 12.0}}));
    EXPECT_EQ(planned.summary.pole_points, 3U);
    for (std::size_t i = 1; i <= 3; ++i) {
        EXPECT_TRUE(planned.points[i].pole);
        EXPECT_EQ(planned.points[i].rotary_rad[0], planned.points[0].rotary_rad[0]);
    }
    EXPECT_NEAR(degFromRad(planned.summary.travel_rad[0]), 5.0, 1e-9);
}

TEST(AxisPlanner, StartsAtThePoleWithTheFirstAngleThatIsBound) {
    const Machine machine(shippedMachine("head-c200-a95"));
    const Plan planned = plan(machine, pathThrough(machine, {{0.0, 0.0}, {0.0, 0.0}, {-73.0, 25.0}, {-80.0, 20.0}}));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(degFromRad(planned.points[i].rotary_rad[0]), -73.0, 1e-9);
    EXPECT_NEAR(degFromRad(planned.summary.travel_rad[0]), 7.0, 1e-9);
    // From a start that is known, the pole keeps the start's angle.
    PlannerOptions options;
    options.start_rad = RotaryValues{radFromDeg(30.0), 0.0};
    const Plan started = plan(machine, pathThrough(machine, {{0.0, 0.0}, {-73.0, 25.0}}), options);
    EXPECT_NEAR(degFromRad(started.points[0].rotary_rad[0]), 30.0, 1e-9);
}

TEST(AxisPlanner, StartsNearZeroWhenNothingElseDecides) {
    const Machine machine(shippedMachine("head-c200-a95"));
    const Plan planned = plan(machine, pathThrough(machine, {{180.0, 20.0}, {180.0, 20.0}}));
    EXPECT_NEAR(degFromRad(planned.points[0].rotary_rad[0]), 0.0, 1e-9);
    EXPECT_NEAR(degFromRad(planned.points[0].rotary_rad[1]), -20.0, 1e-9);
}

TEST(AxisPlanner, EndsAPathOfPolesOnly) {
    const Machine machine(shippedMachine("head-c200-a95"));
    PlannerOptions options;
    options.window_points = 8;
    std::vector<RotaryValues> rotary_deg(50, RotaryValues{0.0, 0.0});
    rotary_deg.push_back({60.0, 10.0});
    const Plan planned = plan(machine, pathThrough(machine, rotary_deg), options);
    ASSERT_EQ(planned.points.size(), 51U);
    for (std::size_t i = 0; i < 40; ++i) EXPECT_EQ(planned.points[i].rotary_rad, (RotaryValues{0.0, 0.0})) << i;
    EXPECT_FALSE(std::isnan(planned.points[50].rotary_rad[0]));
}

TEST(AxisPlanner, UnwrapsEndlessAxes) {
    const Machine machine(shippedMachine("trunnion-ac"));
    std::vector<RotaryValues> rotary_deg;
    for (int i = 0; i <= 100; ++i) rotary_deg.push_back({10.0 * i, 40.0});
    const Plan planned = plan(machine, pathThrough(machine, rotary_deg));
    EXPECT_TRUE(planned.report.empty());
    const double first = planned.points.front().rotary_rad[0];
    EXPECT_NEAR(degFromRad(planned.points.back().rotary_rad[0] - first), 1000.0, 1e-8);
    EXPECT_NEAR(degFromRad(planned.summary.travel_rad[0]), 1000.0, 1e-8);
}

/// A path that wanders over the sphere, through the pole now and then, with rapid moves in it.
std::vector<AxisPoint> wander(std::uint64_t path_seed, std::size_t count) {
    base::Random random(path_seed);
    std::vector<AxisPoint> path;
    Vector3 axis = Vector3::UnitZ();
    while (path.size() < count) {
        const Vector3 moved =
            axis + 0.15 * Vector3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
        axis = moved[2] > 0.1 ? Vector3(moved.normalized()) : Vector3::UnitZ();
        path.push_back(
            {.axis = axis, .line = static_cast<std::uint32_t>(path.size() + 1), .cutting = random.chance(0.95)});
    }
    return path;
}

TEST(AxisPlanner, NeverLeavesTheLimitsWhateverTheWindow) {
    for (const std::string name : {"fooke-endura-ca", "head-c200-a95", "nutating-45", "trunnion-ac", "haas-umc-bc"}) {
        const Machine machine(shippedMachine(name));
        for (const std::size_t window : {2U, 3U, 16U, 257U, 5000U}) {
            PlannerOptions options;
            options.window_points = window;
            const std::vector<AxisPoint> path = wander(seed + window, 3000);
            const Plan planned = plan(machine, path, options);
            ASSERT_EQ(planned.points.size(), path.size());
            for (std::size_t p = 0; p < path.size(); ++p) {
                ASSERT_EQ(planned.points[p].line, path[p].line);
                ASSERT_LE(angleBetween(machine.toolAxis(planned.points[p].rotary_rad), path[p].axis), 1.1e-6) << name;
                if (!planned.points[p].within_limits) continue;
                for (std::size_t i = 0; i < 2; ++i)
                    ASSERT_EQ(machine.rotaryRange(i).excess(planned.points[p].rotary_rad[i]), 0.0)
                        << name << ", window " << window << ", seed " << seed + window << ", point " << p;
            }
        }
    }
}

TEST(AxisPlanner, IsNeverWorseForAWindowThatCoversThePath) {
    const Machine machine(shippedMachine("head-c200-a95"));
    const std::vector<AxisPoint> path = wander(seed, 2000);
    const auto cost = [&](std::size_t window) {
        PlannerOptions options;
        options.window_points = window;
        const Plan planned = plan(machine, path, options);
        double time_s = options.rewind_penalty_s * static_cast<double>(planned.summary.rewinds);
        for (std::size_t i = 1; i < path.size(); ++i)
            time_s += travelTime(machine, planned.points[i - 1].rotary_rad, planned.points[i].rotary_rad);
        return time_s;
    };
    const double whole = cost(4000);
    for (const std::size_t window : {2U, 10U, 100U, 1000U})
        EXPECT_LE(whole, cost(window) + 1e-5) << "window " << window;
    EXPECT_LT(whole, cost(2) - 1.0) << "the window makes no difference on this path, so it tests nothing";
}

TEST(AxisPlanner, AnswersWithinItsWindow) {
    const Machine machine(shippedMachine("head-c200-a95"));
    PlannerOptions options;
    options.window_points = 64;
    AxisPlanner planner(machine, options);
    std::size_t pushed = 0;
    std::size_t popped = 0;
    PlannedAxes axes;
    for (const AxisPoint& point : wander(seed, 5000)) {
        planner.push(point);
        ++pushed;
        while (planner.pop(axes)) ++popped;
        ASSERT_LT(pushed - popped, 64U);
    }
}

TEST(PlannerOptions, NameWhatIsWrong) {
    PlannerOptions options;
    EXPECT_TRUE(options.check().empty());
    options.window_points = 1;
    options.rewind_penalty_s = -1.0;
    const base::Diagnostics report = options.check();
    ASSERT_EQ(report.errorCount(), 2U);
    EXPECT_EQ(base::toText(report), "error: window_points is 1; it must be at least 2 [kinematics.option]\n"
                                    "error: rewind_penalty_s is -1; it must lie in 0 to 3600 [kinematics.option]\n");
}

}  // namespace
}  // namespace cusp::kinematics::test
