// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Linear travel along a path against dense sampling, and worked by hand.
#include "shipped_machines.hpp"

#include <cusp/base/random.hpp>
#include <cusp/base/units.hpp>
#include <cusp/kinematics/linear_travel.hpp>

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace cusp::kinematics::test {
namespace {

using base::radFromDeg;

constexpr std::uint64_t seed = 20261124;

/// The shipped machines with rotary axes, one with a single axis, and two whose rotary axes stand between linear ones.
std::vector<std::pair<std::string, machine::MachineDefinition>> machinesToTry() {
    std::vector<std::pair<std::string, machine::MachineDefinition>> machines;
    for (const std::string& name : shippedMachineNames()) machines.emplace_back(name, shippedMachine(name));
    machine::MachineDefinition indexing = plainMachine({"workpiece", "A", "base", "X", "Y", "Z", "tool"});
    indexing.rotary["A"] = endlessAxis(Vector3::UnitX());
    indexing.rotary["A"].point_mm = {0.0, 40.0, -90.0};
    machines.emplace_back("one table axis", indexing);
    machine::MachineDefinition mixed = plainMachine({"workpiece", "X", "C", "base", "Y", "Z", "B", "tool"});
    mixed.rotary["C"] = limitedAxis({0.0, 0.0, -1.0}, -60.0, 60.0);
    mixed.rotary["C"].point_mm = {30.0, -50.0, 0.0};
    mixed.rotary["B"] = limitedAxis(Vector3::UnitY(), -100.0, 100.0);
    mixed.rotary["B"].point_mm = {10.0, 0.0, 200.0};
    machines.emplace_back("C between X and Y", mixed);
    machine::MachineDefinition skew = plainMachine({"workpiece", "Y", "B", "X", "base", "Z", "A", "tool"});
    skew.rotary["B"] = limitedAxis({0.2, 1.0, 0.1}, -40.0, 40.0);
    skew.rotary["A"] = limitedAxis({1.0, 0.1, 0.3}, -90.0, 90.0);
    skew.linear["X"].direction = {{std::sqrt(0.5), std::sqrt(0.5), 0.0}};
    machines.emplace_back("skew linear axes", skew);
    return machines;
}

Vector3 anyPoint(base::Random& random, double reach) {
    return {random.uniform(-reach, reach), random.uniform(-reach, reach), random.uniform(-reach, reach)};
}

RotaryValues anyRotary(base::Random& random, const Machine& machine) {
    RotaryValues values{};
    for (std::size_t i = 0; i < machine.rotaryCount(); ++i) {
        const AxisRange& range = machine.rotaryRange(i);
        values[i] = range.endless ? random.uniform(-4.0, 4.0) : random.uniform(range.min, range.max);
    }
    return values;
}

/// A place near `values`, no further than `reach_rad` and within the limits.
RotaryValues nearRotary(base::Random& random, const Machine& machine, const RotaryValues& values, double reach_rad) {
    RotaryValues near = values;
    for (std::size_t i = 0; i < machine.rotaryCount(); ++i) {
        near[i] += random.uniform(-reach_rad, reach_rad);
        const AxisRange& range = machine.rotaryRange(i);
        if (!range.endless) near[i] = std::clamp(near[i], range.min, range.max);
    }
    return near;
}

struct End {
    Vector3 tip_mm;
    RotaryValues rotary_rad{};
};

/// Linear positions at `fraction` of a move, by the inverse solve alone.
Vector3 linearAt(const Machine& machine, const End& from, const End& to, const Vector3& origin, double length,
                 double fraction) {
    const RotaryValues rotary{std::lerp(from.rotary_rad[0], to.rotary_rad[0], fraction),
                              std::lerp(from.rotary_rad[1], to.rotary_rad[1], fraction)};
    const auto linear =
        machine.solveLinear(from.tip_mm + fraction * (to.tip_mm - from.tip_mm) + origin, rotary, length);
    return linear.value_or(Vector3::Zero());
}

TEST(LinearTravel, TheBulgeBoundsTheWayBetweenTwoEnds) {
    base::Random random(seed);
    for (const auto& [name, definition] : machinesToTry()) {
        const Machine machine(definition);
        LinearTravel travel(machine, {});
        double closest = 0.0;
        for (int trial = 0; trial < 400; ++trial) {
            const Vector3 origin = anyPoint(random, 300.0);
            const double length = random.uniform(20.0, 300.0);
            travel.setOrigin(origin);
            travel.setToolLength(length);
            const End from{anyPoint(random, 150.0), anyRotary(random, machine)};
            const End to{from.tip_mm + anyPoint(random, std::pow(10.0, random.uniform(-3.0, 2.0))),
                         nearRotary(random, machine, from.rotary_rad, std::pow(10.0, random.uniform(-3.0, 0.3)))};
            const Vector3 first = linearAt(machine, from, to, origin, length, 0.0);
            const Vector3 last = linearAt(machine, from, to, origin, length, 1.0);
            const double bound =
                travel.bulge({first, from.rotary_rad}, {last, to.rotary_rad}, (to.tip_mm - from.tip_mm).norm());
            if (!std::isfinite(bound)) continue;
            double most = 0.0;
            for (int i = 1; i < 200; ++i) {
                const double fraction = i / 200.0;
                const Vector3 chord = first + fraction * (last - first);
                most = std::max(most, (linearAt(machine, from, to, origin, length, fraction) - chord).norm());
            }
            ASSERT_LE(most, bound * (1.0 + 1e-9) + 1e-9) << name << ", seed " << seed << ", trial " << trial;
            if (bound > 1e-6) closest = std::max(closest, most / bound);
        }
        // A bound a thousand times too wide would hold as well, and halve for nothing.
        if (machine.rotaryCount() > 0) {
            EXPECT_GT(closest, 0.05) << name;
        }
    }
}

/// Limits drawn through the middle of where the path goes, so that it leaves them at many places and by little.
void tightenLimits(machine::MachineDefinition& definition, const Machine& machine, const std::vector<Vector3>& seen) {
    for (std::size_t i = 0; i < 3; ++i) {
        const auto axis = static_cast<Eigen::Index>(i);
        double low = seen.front()[axis];
        double high = low;
        for (const Vector3& position : seen) {
            low = std::min(low, position[axis]);
            high = std::max(high, position[axis]);
        }
        machine::LinearAxis& limits = definition.linear.at(machine.linearNames()[i]);
        limits.min_mm = low + 0.25 * (high - low);
        limits.max_mm = high - 0.25 * (high - low);
    }
}

struct Found {
    std::size_t reported = 0;
    std::size_t between = 0;  ///< moves with both ends within the limits and something in between beyond
};

/// Checks a random path on `definition` with limits drawn through it.
Found compareWithSampling(base::Random& random, const std::string& name, machine::MachineDefinition definition) {
    const Vector3 origin{15.0, -20.0, 35.0};
    constexpr double length = 120.0;
    constexpr std::size_t samples = 400;
    const Machine loose(definition);
    std::vector<End> path{{anyPoint(random, 60.0), anyRotary(random, loose)}};
    while (path.size() < 30)
        path.push_back({path.back().tip_mm + anyPoint(random, 8.0),
                        nearRotary(random, loose, path.back().rotary_rad, random.chance(0.3) ? 0.02 : 0.8)});
    std::vector<Vector3> seen;
    for (std::size_t i = 1; i < path.size(); ++i)
        for (std::size_t sample = 0; sample <= samples; ++sample)
            seen.push_back(linearAt(loose, path[i - 1], path[i], origin, length,
                                    static_cast<double>(sample) / static_cast<double>(samples)));
    tightenLimits(definition, loose, seen);
    const Machine machine(definition);

    LinearTravel travel(machine, {});
    travel.setOrigin(origin);
    travel.setToolLength(length);
    for (std::size_t i = 0; i < path.size(); ++i)
        travel.moveTo(path[i].tip_mm, path[i].rotary_rad, static_cast<std::uint32_t>(i));
    travel.finish();
    std::set<std::pair<std::size_t, std::size_t>> reported;
    for (const base::Diagnostic& problem : travel.report())
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (problem.message.starts_with(machine.linearNames()[axis])) reported.insert({problem.where.line, axis});
    EXPECT_EQ(travel.report().suppressed(), 0U);
    EXPECT_EQ(travel.summary().violations, reported.size());

    Found found{.reported = reported.size()};
    for (std::size_t i = 1; i < path.size(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto component = static_cast<Eigen::Index>(axis);
            const AxisRange& range = machine.linearRange(axis);
            const auto& [low, high] = travel.summary().range_mm[axis];
            const std::size_t first = (i - 1) * (samples + 1);
            double way = 0.0;
            for (std::size_t sample = first; sample < first + samples; ++sample) {
                const double position = seen[sample][component];
                way = std::max(way, range.excess(position));
                // Beyond a limit a thousandth is enough.
                const double slack = 0.01 + 0.001 * range.excess(position);
                EXPECT_GE(position, low - slack) << name;
                EXPECT_LE(position, high + slack) << name;
            }
            const double start = range.excess(seen[first][component]);
            const double end = range.excess(seen[first + samples][component]);
            // The way back from a place already reported is no news; a bulge within the bound may stay unseen, and a
            // thousandth of what lies beyond a limit.
            constexpr double seen_mm = 0.0105;
            const double news = std::max(end, way > 1.001 * start + seen_mm ? way : 0.0);
            if (news > seen_mm) {
                EXPECT_TRUE(reported.contains({i, axis})) << name << ", move " << i << ", beyond by " << news;
            }
            // Sampling misses a little of each bulge.
            if (reported.contains({i, axis})) {
                EXPECT_GT(std::max(end, way), 0.0) << name << ", move " << i;
            }
            found.between += way > seen_mm && start == 0.0 && end == 0.0 ? 1 : 0;
        }
    return found;
}

TEST(LinearTravel, FindsWhatDenseSamplingFinds) {
    base::Random random(seed);
    std::size_t between = 0;
    for (const auto& [name, definition] : machinesToTry()) {
        std::size_t reported = 0;
        for (int trial = 0; trial < 12; ++trial) {
            const Found found = compareWithSampling(random, name, definition);
            reported += found.reported;
            between += found.between;
        }
        EXPECT_GT(reported, 0U) << name;
    }
    // The test is about what no block end shows.
    EXPECT_GT(between, 10U);
}

/// The same path far out of reach, the tables turning all the time.
TEST(LinearTravel, NeedsFewLooksFarOutside) {
    for (const double far_mm : {1e4, 1e6, 1e9})
        for (const char* name : {"haas-umc-bc", "trunnion-ac", "fooke-endura-ca"}) {
            const Machine machine(shippedMachine(name));
            LinearTravel travel(machine, {});
            travel.setOrigin({far_mm, -far_mm, far_mm});
            travel.setToolLength(150.0);
            for (int i = 0; i < 1000; ++i)
                travel.moveTo({0.1 * i, 0.0, 0.0}, {0.3 * std::sin(0.01 * i), 0.02 * i}, static_cast<std::uint32_t>(i));
            travel.finish();
            EXPECT_TRUE(travel.report().hasErrors());
            EXPECT_LT(travel.summary().looks, 40U * 1000U) << name << ", " << far_mm;
        }
}

TEST(LinearTravel, NeedsNoLooksWhereNothingIsNear) {
    const Machine machine(shippedMachine("fooke-endura-ca"));
    LinearTravel travel(machine, {});
    travel.setOrigin({3000.0, 0.0, -800.0});
    travel.setToolLength(150.0);
    for (int i = 0; i < 1000; ++i) travel.moveTo({0.1 * i, 0.0, 0.0}, {0.001 * i, 0.5 + 0.3 * std::sin(0.01 * i)}, 1);
    travel.finish();
    EXPECT_TRUE(travel.report().empty()) << base::toText(travel.report());
    EXPECT_LT(travel.summary().looks, 1100U);
}

/// The pivot of this head is 250 mm above the gauge point: with a tool of 150 mm it stands 400 mm from the tip.
TEST(LinearTravel, ALevelHeadStandsBesideTheTip) {
    const Machine machine(shippedMachine("fooke-endura-ca"));
    LinearTravel travel(machine, {.bound_mm = 0.01, .file_name = "P.apt"});
    travel.setOrigin({3000.0, -1120.0, -800.0});
    travel.setToolLength(150.0);
    travel.standAt({.linear_mm = {3000.0, -1120.0, 0.0}, .rotary_rad = {0.0, 0.0}});
    ASSERT_TRUE(travel.tip().has_value());
    EXPECT_NEAR((*travel.tip() - Vector3(0.0, 0.0, 400.0)).norm(), 0.0, 1e-9);
    travel.moveTo({0.0, 0.0, 10.0}, {0.0, 0.0}, 5);
    // A at 90°, C at 0: the axis is −Y, so Y stands at −1120 − 400 and Z at the tip's height.
    travel.moveTo({0.0, 0.0, 10.0}, {0.0, radFromDeg(90.0)}, 7);
    // C goes on to 180°, back to the other side: no further than where it already stood too far.
    travel.moveTo({0.0, 0.0, 10.0}, {radFromDeg(180.0), radFromDeg(90.0)}, 8);
    // And up beyond the top: 0 is the limit, 790 + 400 − 800 = 390 the position.
    travel.moveTo({0.0, 0.0, 790.0}, {radFromDeg(180.0), 0.0}, 9);
    travel.finish();
    EXPECT_EQ(base::toText(travel.report()),
              "P.apt:7: error: Y axis would need -1520 mm at CL line 7; limit -1500 mm [kinematics.linear-limit]\n"
              "P.apt:9: error: Z axis would need 390 mm at CL line 9; limit 0 mm [kinematics.linear-limit]\n");
    EXPECT_EQ(travel.summary().violations, 2U);
    EXPECT_NEAR(travel.summary().range_mm[1].first, -1520.0, 1e-9);
    EXPECT_NEAR(travel.summary().range_mm[1].second, -720.0, 1e-9);
    EXPECT_NEAR(travel.summary().range_mm[0].second, 3400.0, 0.01);
}

/// The furthest of a swing lies between its ends: A from −30° to 30° with C at 0 lifts nothing at the ends alone.
TEST(LinearTravel, SaysWhatLiesBetweenTheEnds) {
    machine::MachineDefinition definition = shippedMachine("fooke-endura-ca");
    const Machine machine(definition);
    LinearTravel travel(machine, {.bound_mm = 0.001, .file_name = "P.apt"});
    // The head is highest at A 0: Z = −390 + 400 = 10, at the ends −390 + 400 cos 30° = −43.59.
    travel.setOrigin({3000.0, 0.0, -390.0});
    travel.setToolLength(150.0);
    travel.moveTo(Vector3::Zero(), {0.0, radFromDeg(-30.0)}, 3);
    travel.moveTo(Vector3::Zero(), {0.0, radFromDeg(30.0)}, 4);
    travel.finish();
    ASSERT_EQ(travel.report().size(), 1U) << base::toText(travel.report());
    EXPECT_EQ(travel.report().front().message, "Z axis would need 10 mm on the way to CL line 4; limit 0 mm");
}

TEST(LinearTravel, SaysWhereLinearAxesLieInOnePlane) {
    machine::MachineDefinition definition = plainMachine({"workpiece", "X", "B", "base", "Y", "Z", "tool"});
    definition.rotary["B"] = limitedAxis(Vector3::UnitY(), -120.0, 120.0);
    const Machine machine(definition);
    LinearTravel travel(machine, {.bound_mm = 0.01, .file_name = "P.apt"});
    travel.setOrigin(Vector3::Zero());
    travel.setToolLength(100.0);
    travel.moveTo(Vector3::Zero(), {0.0, 0.0}, 1);
    travel.moveTo(Vector3::Zero(), {radFromDeg(90.0), 0.0}, 2);
    travel.moveTo({1.0, 0.0, 0.0}, {radFromDeg(90.0), 0.0}, 2);
    travel.finish();
    EXPECT_EQ(base::toText(travel.report()),
              "P.apt:2: error: at CL line 2 a rotary axis has turned the linear axes into one plane "
              "[kinematics.linear-singular]\n");
}

TEST(LinearTravel, ChecksItsOptions) {
    EXPECT_TRUE(TravelOptions().check().empty());
    EXPECT_EQ(base::toText(TravelOptions{.bound_mm = 2.0, .file_name = {}}.check()),
              "error: bound_mm is 2; it must lie in 0.0001 to 1 [kinematics.option]\n");
}

}  // namespace
}  // namespace cusp::kinematics::test
