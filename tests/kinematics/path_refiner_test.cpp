// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Following a great circle and refining a path, against walking the circle in tiny steps.
#include "shipped_machines.hpp"

#include <cusp/base/random.hpp>
#include <cusp/base/units.hpp>
#include <cusp/kinematics/angles.hpp>
#include <cusp/kinematics/axis_planner.hpp>
#include <cusp/kinematics/path_refiner.hpp>

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <set>

namespace cusp::kinematics::test {
namespace {

using base::degFromRad;
using base::radFromDeg;
using geometry::angleBetween;
using std::numbers::pi;

constexpr std::uint64_t seed = 20240611;
const std::vector<std::string> five_axis_machines = {"fooke-endura-ca", "head-c200-a95", "nutating-45", "trunnion-ac",
                                                     "haas-umc-bc"};

/// A unit axis leaning by `tilt_deg` from +Z towards `azimuth_deg`.
Vector3 leaning(double tilt_deg, double azimuth_deg) {
    const double tilt = radFromDeg(tilt_deg);
    const double azimuth = radFromDeg(azimuth_deg);
    return {std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt)};
}

TEST(Following, TurnsAsFarAsTinyStepsAddUpTo) {
    base::Random random(seed);
    for (const std::string& name : five_axis_machines) {
        const Machine machine(shippedMachine(name));
        for (int trial = 0; trial < 200; ++trial) {
            const Vector3 from = leaning(random.uniform(2.0, 80.0), random.uniform(0.0, 360.0));
            const Vector3 to = leaning(random.uniform(2.0, 80.0), random.uniform(0.0, 360.0));
            // Nearer to the pole, steps would have to be tinier still.
            if (nearestMeeting(machine, from, to).gap_rad < radFromDeg(0.5)) continue;
            constexpr int steps = 4000;
            for (std::size_t branch = 0; branch < 2; ++branch) {
                RotaryValues sum{};
                RotaryValues before = machine.solveAxis(from).branch[branch];
                for (int i = 1; i <= steps; ++i) {
                    const RotaryValues at =
                        machine.solveAxis(onGreatCircle(from, to, static_cast<double>(i) / steps)).branch[branch];
                    for (std::size_t axis = 0; axis < 2; ++axis) {
                        const double step = wrapAngle(at[axis] - before[axis]);
                        ASSERT_LT(std::abs(step), 0.3) << name << ", seed " << seed << ", trial " << trial;
                        sum[axis] += step;
                    }
                    before = at;
                }
                const RotaryValues closed = followStep(machine.solveAxis(from), machine.solveAxis(to), branch);
                EXPECT_NEAR(closed[0], sum[0], 1e-9) << name << ", seed " << seed << ", trial " << trial;
                EXPECT_NEAR(closed[1], sum[1], 1e-9) << name << ", seed " << seed << ", trial " << trial;
            }
        }
    }
}

TEST(Following, FindsWhereBranchesMeetAsASweepDoes) {
    base::Random random(seed);
    for (const std::string& name : five_axis_machines) {
        const Machine machine(shippedMachine(name));
        for (int trial = 0; trial < 300; ++trial) {
            const Vector3 from = leaning(random.uniform(0.0, 89.0), random.uniform(0.0, 360.0));
            const Vector3 to = leaning(random.uniform(0.0, 89.0), random.uniform(0.0, 360.0));
            double least = pi;
            for (int i = 0; i <= 2000; ++i)
                least = std::min(least, machine.branchGap(onGreatCircle(from, to, i / 2000.0)));
            const BranchMeeting found = nearestMeeting(machine, from, to);
            EXPECT_LE(found.gap_rad, least + 1e-12) << name << ", trial " << trial;
            EXPECT_GE(found.gap_rad, least - angleBetween(from, to) / 2000.0) << name << ", trial " << trial;
            EXPECT_NEAR(machine.branchGap(onGreatCircle(from, to, found.fraction)), found.gap_rad, 1e-12);
        }
    }
}

/// A path of short and long steps that keeps coming near the pole, past it on either side and through it.
std::vector<AxisPoint> pathAroundThePole(base::Random& random, std::size_t count) {
    std::vector<AxisPoint> path;
    Vector3 axis = leaning(20.0, random.uniform(0.0, 360.0));
    while (path.size() < count) {
        path.push_back({.axis = axis, .line = static_cast<std::uint32_t>(path.size() + 1), .cutting = true});
        const double reach = std::pow(10.0, random.uniform(-4.0, -0.3));
        // One after the other: compilers differ in the order of arguments, and each would walk a path of its own.
        const double y = random.uniform(-1.0, 1.0);
        const double x = random.uniform(-1.0, 1.0);
        const double inward = 0.3 * random.uniform(0.0, 1.0);
        const Vector3 aim = reach * Vector3(x, y, 0.0) - inward * Vector3(axis[0], axis[1], 0.0);
        axis = random.chance(0.02) ? Vector3::UnitZ() : Vector3((axis + aim).normalized());
    }
    return path;
}

struct Refined {
    std::vector<PathPoint> planned;
    std::vector<PathPoint> points;
    RefinerSummary summary;
    base::Diagnostics report;
    base::Diagnostics planning;
};

std::vector<PathPoint> refineOnce(const Machine& machine, const std::vector<PathPoint>& path,
                                  const RefinerOptions& options, Refined& out) {
    PathRefiner refiner(machine, options);
    std::vector<PathPoint> points;
    for (const PathPoint& point : path)
        for (const PathPoint& next : refiner.advance(point)) points.push_back(next);
    out.summary = refiner.summary();
    out.report = refiner.report();
    return points;
}

Refined planAndRefine(const Machine& machine, const std::vector<AxisPoint>& path, double tolerance_deg) {
    PlannerOptions planner_options;
    planner_options.orientation_tolerance_rad = radFromDeg(tolerance_deg);
    AxisPlanner planner(machine, planner_options);
    for (const AxisPoint& point : path) planner.push(point);
    planner.finish();
    Refined out;
    PlannedAxes axes;
    while (planner.pop(axes)) {
        const double x = static_cast<double>(out.planned.size());
        out.planned.push_back({.tip_mm = Vector3(x, 0.1 * x * x, 3.0),
                               .rotary_rad = axes.rotary_rad,
                               .line = axes.line,
                               .cutting = path[out.planned.size()].cutting,
                               .rewind = axes.rewind});
    }
    RefinerOptions options;
    options.orientation_tolerance_rad = radFromDeg(tolerance_deg);
    out.points = refineOnce(machine, out.planned, options, out);
    out.planning = planner.report();
    return out;
}

/// Its own sampling, on its own great circle (by normalised interpolation of the angle).
double sampledDeviation(const Machine& machine, const PathPoint& from, const PathPoint& to) {
    const Vector3 first = machine.toolAxis(from.rotary_rad);
    const Vector3 last = machine.toolAxis(to.rotary_rad);
    const double whole = angleBetween(first, last);
    double worst = 0.0;
    for (int i = 1; i < 300; ++i) {
        const double f = i / 300.0;
        const RotaryValues at{std::lerp(from.rotary_rad[0], to.rotary_rad[0], f),
                              std::lerp(from.rotary_rad[1], to.rotary_rad[1], f)};
        const Vector3 wanted =
            whole < 1e-9 ? first
                         : Vector3((std::sin((1 - f) * whole) * first + std::sin(f * whole) * last).normalized());
        worst = std::max(worst, angleBetween(machine.toolAxis(at), wanted));
    }
    return worst;
}

/// Through the pole a head may have to turn faster than points can be inserted; then the step is reported, by its line.
TEST(PathRefiner, HoldsTheToolAxisOnItsWayNearThePoleOrSaysWhereNot) {
    std::size_t steps = 0;
    std::size_t reported = 0;
    for (const std::string& name : five_axis_machines) {
        const Machine machine(shippedMachine(name));
        for (std::uint64_t trial = 0; trial < 6; ++trial) {
            base::Random random(seed + trial);
            const double tolerance_deg = trial % 2 == 0 ? 0.05 : 0.5;
            const Refined refined = planAndRefine(machine, pathAroundThePole(random, 400), tolerance_deg);
            SCOPED_TRACE(name + ", seed " + std::to_string(seed + trial));
            std::set<std::size_t> said;
            for (const base::Diagnostic& one : refined.report) said.insert(one.where.line);
            steps += refined.planned.size();
            reported += said.size();
            EXPECT_GT(refined.summary.inserted, 0U);
            ASSERT_EQ(refined.points.size(), refined.planned.size() + refined.summary.inserted);
            for (std::size_t i = 1; i < refined.points.size(); ++i) {
                if (refined.points[i].rewind || said.contains(refined.points[i].line)) continue;
                ASSERT_LE(degFromRad(sampledDeviation(machine, refined.points[i - 1], refined.points[i])),
                          tolerance_deg)
                    << "CL line " << refined.points[i].line;
            }
        }
    }
    EXPECT_LE(reported * 2000, steps) << "of these steps straight past the pole";
}

TEST(PathRefiner, PassesEveryPointAndStaysOnTheLineBetween) {
    const Machine machine(shippedMachine("fooke-endura-ca"));
    base::Random random(seed);
    const Refined refined = planAndRefine(machine, pathAroundThePole(random, 500), 0.05);
    std::size_t at = 0;
    for (std::size_t i = 0; i < refined.planned.size(); ++i) {
        const Vector3 before = refined.planned[i == 0 ? 0 : i - 1].tip_mm;
        const Vector3 along = refined.planned[i].tip_mm - before;
        const Vector3 axis_before = machine.toolAxis(refined.planned[i == 0 ? 0 : i - 1].rotary_rad);
        const Vector3 axis_here = machine.toolAxis(refined.planned[i].rotary_rad);
        double last = 0.0;
        for (; refined.points[at].tip_mm != refined.planned[i].tip_mm; ++at) {
            const Vector3 away = refined.points[at].tip_mm - before;
            const double fraction = away.dot(along) / along.squaredNorm();
            EXPECT_LT((away - fraction * along).norm(), 1e-9);
            EXPECT_GT(fraction, last);
            EXPECT_LT(angleBetween(machine.toolAxis(refined.points[at].rotary_rad),
                                   onGreatCircle(axis_before, axis_here, fraction)),
                      1e-9);
            last = fraction;
        }
        EXPECT_EQ(refined.points[at].rotary_rad, refined.planned[i].rotary_rad);
        EXPECT_EQ(refined.points[at].line, refined.planned[i].line);
        ++at;
    }
    EXPECT_EQ(at, refined.points.size());
}

TEST(PathRefiner, LeavesARefinedPathAsItIs) {
    for (const std::string& name : five_axis_machines) {
        const Machine machine(shippedMachine(name));
        base::Random random(seed);
        const Refined once = planAndRefine(machine, pathAroundThePole(random, 500), 0.05);
        Refined twice;
        EXPECT_EQ(refineOnce(machine, once.points, {}, twice).size(), once.points.size()) << name;
        EXPECT_EQ(twice.summary.inserted, 0U) << name;
    }
}

TEST(PathRefiner, HalvesOnlyWhatNeedsIt) {
    // Every pair of neighbours that came from one halving would be too long as one move.
    const Machine machine(shippedMachine("fooke-endura-ca"));
    const Refined refined = planAndRefine(machine,
                                          {{.axis = leaning(5.0, 0.0), .line = 1, .cutting = true},
                                           {.axis = leaning(5.0, 150.0), .line = 2, .cutting = true}},
                                          0.05);
    ASSERT_GT(refined.points.size(), 8U);
    EXPECT_LT(refined.points.size(), 40U);
    for (std::size_t i = 2; i < refined.points.size(); ++i) {
        const double uneven =
            refined.points[i].tip_mm[0] + refined.points[i - 2].tip_mm[0] - 2.0 * refined.points[i - 1].tip_mm[0];
        if (std::abs(uneven) > 1e-9) continue;
        EXPECT_GT(degFromRad(sampledDeviation(machine, refined.points[i - 2], refined.points[i])), 0.0125);
    }
}

TEST(PathRefiner, GoesStraightThroughThePole) {
    for (const std::string name : {"fooke-endura-ca", "head-c200-a95", "trunnion-ac", "haas-umc-bc"}) {
        const Machine machine(shippedMachine(name));
        const Refined refined = planAndRefine(machine,
                                              {{.axis = leaning(10.0, 40.0), .line = 1, .cutting = true},
                                               {.axis = leaning(12.0, 220.0), .line = 2, .cutting = true}},
                                              0.05);
        ASSERT_TRUE(refined.planning.empty() && refined.report.empty()) << name;
        EXPECT_EQ(refined.summary.inserted, 0U) << name;
        EXPECT_NEAR(refined.points[0].rotary_rad[0], refined.points[1].rotary_rad[0], 1e-9) << name;
        EXPECT_NEAR(degFromRad(std::abs(refined.points[1].rotary_rad[1] - refined.points[0].rotary_rad[1])), 22.0, 1e-9)
            << name;
    }
}

TEST(PathRefiner, TurnsTheFirstAxisAtAPointOnThePole) {
    const Machine machine(shippedMachine("fooke-endura-ca"));
    const Refined refined = planAndRefine(machine,
                                          {{.axis = leaning(10.0, 40.0), .line = 1, .cutting = true},
                                           {.axis = leaning(0.0, 0.0), .line = 2, .cutting = true},
                                           {.axis = leaning(10.0, 120.0), .line = 3, .cutting = true}},
                                          0.05);
    ASSERT_TRUE(refined.planning.empty() && refined.report.empty());
    // All of C's 80 degrees lie in the part next to the pole, where they do not swing the tool axis.
    double turned = 0.0;
    for (std::size_t i = 1; i < refined.points.size(); ++i) {
        const double step = std::abs(refined.points[i].rotary_rad[0] - refined.points[i - 1].rotary_rad[0]);
        if (step > 1e-9) {
            EXPECT_LT(degFromRad(std::abs(refined.points[i].rotary_rad[1])), 0.2);
        }
        turned += step;
    }
    EXPECT_NEAR(degFromRad(turned), 80.0, 1e-6);
}

TEST(PathRefiner, SaysWhatNoInsertionMends) {
    const Machine machine(shippedMachine("fooke-endura-ca"));
    RefinerOptions options;
    options.file_name = "P.apt";
    PathRefiner refiner(machine, options);
    // C turns by a whole turn at 30°: the same tool axis at both ends.
    static_cast<void>(refiner.advance({.rotary_rad = {radFromDeg(-180.0), radFromDeg(30.0)}, .line = 1}));
    EXPECT_EQ(
        refiner.advance({.tip_mm = Vector3::UnitX(), .rotary_rad = {radFromDeg(180.0), radFromDeg(30.0)}, .line = 2})
            .size(),
        1U);
    EXPECT_EQ(refiner.summary().not_within, 1U);
    EXPECT_EQ(
        base::toText(refiner.report()),
        "P.apt:2: error: on the way to CL line 2 the tool axis swings 60° off, tolerance 0.05°: C and A from -180, 30 "
        "to 180, 30; more points in the CL file or a larger tolerance help [kinematics.between-axis]\n");
}

TEST(PathRefiner, NamesALimitMetOnTheWay) {
    // Below the horizon the great circle dips further than its ends: tan(dip) = tan 19° / cos 20°.
    const Machine machine(shippedMachine("fooke-endura-ca"));
    PathRefiner refiner(machine, {});
    static_cast<void>(refiner.advance({.rotary_rad = {radFromDeg(-20.0), radFromDeg(109.0)}, .line = 1}));
    static_cast<void>(
        refiner.advance({.tip_mm = Vector3::UnitX(), .rotary_rad = {radFromDeg(20.0), radFromDeg(109.0)}, .line = 2}));
    ASSERT_EQ(refiner.report().errorCount(), 1U);
    EXPECT_EQ(base::toText(refiner.report().front()),
              "2: error: A axis would need 110.124° on the way to CL line 2; limit 110° [kinematics.axis-limit]");
}

TEST(PathRefiner, InsertsNothingInRapidMoves) {
    const Machine machine(shippedMachine("fooke-endura-ca"));
    PathRefiner refiner(machine, {});
    static_cast<void>(refiner.advance({.rotary_rad = {0.0, radFromDeg(10.0)}, .line = 1}));
    EXPECT_EQ(
        refiner.advance({.rotary_rad = {radFromDeg(150.0), radFromDeg(10.0)}, .line = 2, .cutting = false}).size(), 1U);
}

TEST(RefinerOptions, NameWhatIsWrong) {
    RefinerOptions options;
    EXPECT_TRUE(options.check().empty());
    options.orientation_tolerance_rad = radFromDeg(11.0);
    EXPECT_EQ(base::toText(options.check()),
              "error: orientation tolerance is 11°; it must lie in 0.001° to 10° [kinematics.option]\n");
}

}  // namespace
}  // namespace cusp::kinematics::test
