// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Forward and inverse kinematics against formulas written out by hand.
#include "shipped_machines.hpp"

#include <cusp/base/units.hpp>
#include <cusp/kinematics/angles.hpp>

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace cusp::kinematics::test {
namespace {

using base::degFromRad;
using base::radFromDeg;
using geometry::angleBetween;
using std::numbers::pi;

TEST(Forward, OfAHeadFollowsThePivotFormula) {
    // The pivot stands at (X, Y, Z), the tip pivot length and tool length away from it against u.
    const Machine machine(shippedMachine("head-c200-a95"));
    const double a = radFromDeg(35.0);
    const double c = radFromDeg(-120.0);
    const Vector3 u(std::sin(c) * std::sin(a), -std::cos(c) * std::sin(a), std::cos(a));
    const Vector3 pivot(100.0, -200.0, -300.0);
    const auto location = machine.forward({.linear_mm = pivot, .rotary_rad = {c, a}}, 150.0);
    EXPECT_LT((location.tip_mm - (pivot - (220.0 + 150.0) * u)).norm(), 1e-12);
    EXPECT_LT((location.axis - u).norm(), 1e-15);
}

TEST(Forward, OfAHeadWithOffsetsFollowsItsFormula) {
    // P = M + Rz(C)[o1 + Rx(A)(o2 − Lt·ez)] with C through the origin, A through o1, the gauge point at o1 + o2.
    machine::MachineDefinition definition = shippedMachine("head-c200-a95");
    const Vector3 o1(12.0, -7.0, 30.0);
    const Vector3 o2(3.0, 5.0, -140.0);
    definition.rotary.at("A").point_mm = {o1[0], o1[1], o1[2]};
    definition.spindle.gauge_point_mm = {o1[0] + o2[0], o1[1] + o2[1], o1[2] + o2[2]};
    const double a = radFromDeg(-71.0);
    const double c = radFromDeg(33.0);
    const Vector3 m(10.0, 20.0, -30.0);
    const Matrix3 turn_c = Eigen::AngleAxisd(c, Vector3::UnitZ()).toRotationMatrix();
    const Matrix3 turn_a = Eigen::AngleAxisd(a, Vector3::UnitX()).toRotationMatrix();
    const Vector3 expected = m + turn_c * (o1 + turn_a * (o2 - 90.0 * Vector3::UnitZ()));
    const auto location = Machine(definition).forward({.linear_mm = m, .rotary_rad = {c, a}}, 90.0);
    EXPECT_LT((location.tip_mm - expected).norm(), 1e-12);
}

TEST(Forward, OfADualTableFollowsItsFormula) {
    const Machine machine(shippedMachine("haas-umc-bc"));
    const double b = radFromDeg(-22.201);
    const double c = radFromDeg(1.05);
    EXPECT_EQ(machine.rotaryNames(), (std::vector<std::string>{"C", "B"}));
    const Vector3 expected(std::cos(c) * std::sin(b), std::sin(c) * std::sin(b), std::cos(b));
    EXPECT_LT((machine.toolAxis({c, b}) - expected).norm(), 1e-15);
}

TEST(Forward, OfANutatingHeadFollowsItsFormula) {
    const Machine machine(shippedMachine("nutating-45"));
    const double b = radFromDeg(81.101);
    const double c = radFromDeg(103.826);
    const Vector3 at_head((1.0 - std::cos(b)) / 2.0, std::sin(b) / std::numbers::sqrt2, (1.0 + std::cos(b)) / 2.0);
    const Vector3 expected = Eigen::AngleAxisd(-c, Vector3::UnitZ()) * at_head;
    EXPECT_LT((machine.toolAxis({c, b}) - expected).norm(), 1e-15);
}

TEST(Inverse, OfAHeadIsTheTextbookOne) {
    // A = ±atan2(√(i² + j²), k); A > 0: C = atan2(i, −j); A < 0: C = atan2(−i, j).
    const Machine machine(shippedMachine("fooke-endura-ca"));
    for (const Vector3& u : {Vector3(0.3, -0.5, 0.8), Vector3(-0.1, 0.9, 0.2), Vector3(1e-6, -2e-6, 1.0)}) {
        const Vector3 n = u.normalized();
        const AxisSolutions solved = machine.solveAxis(n);
        ASSERT_EQ(solved.count, 2);
        const double a = std::atan2(std::hypot(n[0], n[1]), n[2]);
        EXPECT_NEAR(solved.branch[0][1], a, 1e-15);
        EXPECT_NEAR(solved.branch[0][0], std::atan2(n[0], -n[1]), 1e-15);
        EXPECT_NEAR(solved.branch[1][1], -a, 1e-15);
        EXPECT_NEAR(solved.branch[1][0], std::atan2(-n[0], n[1]), 1e-15);
    }
}

TEST(Inverse, KeepsItsDigitsBesideThePole) {
    // acos would lose half of them: at 1e-9 rad it answers 0.
    for (const std::string name : {"fooke-endura-ca", "nutating-45", "trunnion-ac"}) {
        const Machine machine(shippedMachine(name));
        for (const double tilt : {1e-4, 1e-7, 1e-9, 1e-12}) {
            const Vector3 target(std::sin(tilt) * 0.6, std::sin(tilt) * 0.8, std::cos(tilt));
            const AxisSolutions solved = machine.solveAxis(target);
            ASSERT_EQ(solved.count, 2) << name << " at " << tilt;
            for (const RotaryValues& branch : solved.branch)
                EXPECT_LT(angleBetween(machine.toolAxis(branch), target), 1e-15) << name << " at " << tilt;
        }
    }
}

TEST(Inverse, KnowsThePole) {
    for (const std::string name : {"fooke-endura-ca", "nutating-45", "trunnion-ac", "haas-umc-bc"}) {
        const Machine machine(shippedMachine(name));
        const AxisSolutions solved = machine.solveAxis(Vector3::UnitZ());
        EXPECT_TRUE(solved.pole) << name;
        EXPECT_EQ(solved.count, 1) << name;
        EXPECT_NEAR(solved.branch[0][1], 0.0, 1e-15) << name;
        EXPECT_EQ(solved.miss_rad, 0.0) << name;
        EXPECT_FALSE(machine.solveAxis(Vector3(1e-7, 0.0, 1.0).normalized()).pole) << name;
        EXPECT_TRUE(machine.solveAxis(Vector3(1e-7, 0.0, 1.0).normalized(), 2e-7).pole) << name;
    }
}

TEST(Inverse, SaysByHowMuchAnAxisIsOutOfReach) {
    const Machine nutating(shippedMachine("nutating-45"));
    const double below = radFromDeg(12.0);
    const Vector3 target(std::cos(below), 0.0, -std::sin(below));
    const AxisSolutions solved = nutating.solveAxis(target);
    EXPECT_NEAR(solved.miss_rad, below, 1e-14);
    EXPECT_NEAR(angleBetween(nutating.toolAxis(solved.branch[0]), target), below, 1e-14);
    EXPECT_TRUE(nutating.inverse({.tip_mm = Vector3::Zero(), .axis = target}, 0.0).values.empty());

    const Machine three_axis(shippedMachine("three-axis"));
    EXPECT_NEAR(three_axis.solveAxis(Vector3(std::sin(0.1), 0.0, std::cos(0.1))).miss_rad, 0.1, 1e-15);
    EXPECT_EQ(three_axis.solveAxis(Vector3::UnitZ()).miss_rad, 0.0);
}

TEST(Inverse, GivesEveryWindingWithinTheLimits) {
    const Machine machine(shippedMachine("head-c200-a95"));
    // C 170 is also −190; A > 0 and A < 0 both fit: C −10 has one winding.
    const Vector3 target = machine.toolAxis({radFromDeg(170.0), radFromDeg(40.0)});
    const PoseSolutions solved = machine.inverse({.tip_mm = Vector3(1.0, 2.0, 3.0), .axis = target}, 100.0);
    ASSERT_EQ(solved.values.size(), 3U);
    std::vector<double> c_deg;
    c_deg.reserve(solved.values.size());
    for (const AxisValues& values : solved.values) c_deg.push_back(degFromRad(values.rotary_rad[0]));
    std::sort(c_deg.begin(), c_deg.end());
    EXPECT_NEAR(c_deg[0], -190.0, 1e-11);
    EXPECT_NEAR(c_deg[1], -10.0, 1e-11);
    EXPECT_NEAR(c_deg[2], 170.0, 1e-11);
}

TEST(Inverse, TakesAPositionOnTheLimit) {
    const Machine machine(shippedMachine("head-c200-a95"));
    EXPECT_EQ(machine.windings(1, radFromDeg(95.0)), std::vector<double>{radFromDeg(95.0)});
    EXPECT_EQ(machine.windings(1, radFromDeg(95.0) + 1e-12), std::vector<double>{radFromDeg(95.0)});
    EXPECT_TRUE(machine.windings(1, radFromDeg(95.001)).empty());
    EXPECT_EQ(machine.windings(0, pi).size(), 2U);
    EXPECT_EQ(machine.windings(0, radFromDeg(0.0)).size(), 1U);
}

TEST(Inverse, NamesLinearAxesTurnedIntoOnePlane) {
    // Z between B and the tool: at B = 90° it points along X.
    machine::MachineDefinition definition = plainMachine({"workpiece", "base", "X", "Y", "B", "Z", "tool"});
    definition.rotary["B"] = limitedAxis(Vector3::UnitY(), -100.0, 100.0);
    const Machine machine(definition);
    EXPECT_TRUE(machine.solveLinear(Vector3(1.0, 2.0, 3.0), {radFromDeg(45.0), 0.0}, 0.0).has_value());
    EXPECT_FALSE(machine.solveLinear(Vector3(1.0, 2.0, 3.0), {radFromDeg(90.0), 0.0}, 0.0).has_value());
}

TEST(Angles, WrapIntoOneTurn) {
    EXPECT_EQ(wrapAngle(pi), pi);
    EXPECT_EQ(wrapAngle(-pi), pi);
    EXPECT_NEAR(wrapAngle(7.0 * pi), pi, 1e-14);
    EXPECT_NEAR(wrapAngle(5.0), 5.0 - turn_rad, 1e-15);
    EXPECT_EQ(wrapAngle(-0.25), -0.25);
}

}  // namespace
}  // namespace cusp::kinematics::test
