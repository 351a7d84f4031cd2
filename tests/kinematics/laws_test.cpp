// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The law suite over every shipped machine and over machines built to be awkward; and that it catches a wrong machine.
#include "shipped_machines.hpp"

#include <cusp/base/random.hpp>
#include <cusp/base/units.hpp>
#include <cusp/kinematics/laws.hpp>

#include <gtest/gtest.h>
#include <iostream>

namespace cusp::kinematics::test {
namespace {

constexpr std::uint64_t seed = 20240607;
constexpr std::uint64_t poses = 10000;

void expectLawful(const Machine& machine, const std::string& name) {
    const LawReport report = runLaws(machine, seed, poses);
    std::cout << name << ", seed " << seed << ", " << poses << " poses\n";
    for (const Law& law : report.laws) {
        std::cout << "  " << law.name << ": worst " << law.worst << " " << law.unit << " of " << law.bound << " ("
                  << law.checked << " checked)\n";
        if (law.checked == 0) continue;
        EXPECT_TRUE(law.passes()) << name << ": " << law.name << ", worst " << law.worst << " of " << law.bound
                                  << " at rotary " << law.worst_pose.rotary_rad[0] << ", "
                                  << law.worst_pose.rotary_rad[1];
    }
    EXPECT_TRUE(report.passes());
}

class ShippedMachines : public testing::TestWithParam<std::string> {};

TEST_P(ShippedMachines, ObeyTheLaws) { expectLawful(Machine(shippedMachine(GetParam())), GetParam()); }

TEST_P(ShippedMachines, AgreeWithTheirAnchors) {
    for (const AnchorReport& anchor : checkAnchors(Machine(shippedMachine(GetParam()))))
        EXPECT_TRUE(anchor.passes()) << anchor.source << ": off by " << base::degFromRad(anchor.error_rad)
                                     << " degrees";
}

INSTANTIATE_TEST_SUITE_P(Machines, ShippedMachines, testing::ValuesIn(shippedMachineNames()), [](const auto& machine) {
    std::string name = machine.param;
    for (char& c : name)
        if (c == '-') c = '_';
    return name;
});

TEST(ShippedMachineSet, HasTheMachinesPromised) {
    EXPECT_EQ(shippedMachineNames(), (std::vector<std::string>{"fooke-endura-ca", "haas-umc-bc", "head-c200-a95",
                                                               "nutating-45", "three-axis", "trunnion-ac"}));
}

TEST(Anchors, AreThereWhereAPoseIsKnown) {
    for (const auto& [name, count] :
         {std::pair{"head-c200-a95", 1U}, std::pair{"nutating-45", 1U}, std::pair{"haas-umc-bc", 3U},
          std::pair{"fooke-endura-ca", 0U}, std::pair{"trunnion-ac", 0U}, std::pair{"three-axis", 0U}})
        EXPECT_EQ(checkAnchors(Machine(shippedMachine(name))).size(), count) << name;
}

TEST(Anchors, CatchAWrongSign) {
    for (const std::string name : {"head-c200-a95", "nutating-45", "haas-umc-bc"}) {
        const machine::MachineDefinition right = shippedMachine(name);
        for (const auto& [axis_name, axis] : right.rotary) {
            machine::MachineDefinition wrong = right;
            for (double& component : wrong.rotary.at(axis_name).direction) component = -component;
            bool caught = false;
            for (const AnchorReport& anchor : checkAnchors(Machine(wrong))) caught |= !anchor.passes();
            EXPECT_TRUE(caught) << name << ", axis " << axis_name;
        }
    }
}

TEST(Laws, HoldForSkewAxesWithOffsets) {
    // Nothing at right angles, nothing through the origin, linear axes between the rotary ones, on either side of base.
    const std::vector<std::vector<std::string>> chains{{"workpiece", "base", "X", "Y", "Z", "P", "Q", "tool"},
                                                       {"workpiece", "P", "base", "X", "Y", "Z", "Q", "tool"},
                                                       {"workpiece", "P", "Q", "base", "X", "Y", "Z", "tool"},
                                                       {"workpiece", "X", "P", "base", "Y", "Q", "Z", "tool"}};
    base::Random random(seed);
    const auto direction = [&] { return Vector3(random.normal(), random.normal(), random.normal()).normalized(); };
    for (int number = 0; number < 12; ++number) {
        machine::MachineDefinition machine = plainMachine(chains[static_cast<std::size_t>(number) % chains.size()]);
        machine.rotary["P"] = number % 2 == 0 ? endlessAxis(direction()) : limitedAxis(direction(), -400.0, 170.0);
        machine.rotary["Q"] = limitedAxis(direction(), -200.0, 200.0);
        machine.rotary["P"].point_mm = {120.0, -35.0, 60.0};
        machine.rotary["Q"].point_mm = {-15.0, 80.0, 220.0};
        const Vector3 spindle = direction();
        machine.spindle.axis = {{spindle[0], spindle[1], spindle[2]}};
        machine.spindle.gauge_point_mm = {5.0, 7.0, -180.0};
        // A linear axis between rotary ones can be turned into the plane of the others; keep those from being sampled.
        if (number % 4 == 3) continue;
        expectLawful(Machine(machine), "skew machine " + std::to_string(number));
    }
}

TEST(Laws, HoldForOneRotaryAxis) {
    machine::MachineDefinition tilting = plainMachine({"workpiece", "A", "base", "X", "Y", "Z", "tool"});
    tilting.rotary["A"] = limitedAxis(Vector3::UnitX(), -200.0, 190.0);
    expectLawful(Machine(tilting), "four-axis machine, tilting");
    machine::MachineDefinition indexing = plainMachine({"workpiece", "C", "base", "X", "Y", "Z", "tool"});
    indexing.rotary["C"] = endlessAxis(Vector3::UnitZ());
    const AxisSolutions solved = Machine(indexing).solveAxis(Vector3::UnitZ());
    EXPECT_TRUE(solved.pole);
    EXPECT_EQ(solved.miss_rad, 0.0);
}

TEST(Laws, GiveTheSameReportForTheSameSeed) {
    const Machine machine(shippedMachine("nutating-45"));
    const LawReport a = runLaws(machine, 7, 300);
    const LawReport b = runLaws(machine, 7, 300);
    ASSERT_EQ(a.laws.size(), b.laws.size());
    for (std::size_t i = 0; i < a.laws.size(); ++i) EXPECT_EQ(a.laws[i].worst, b.laws[i].worst);
    EXPECT_NE(a.laws[0].worst, runLaws(machine, 8, 300).laws[0].worst);
}

TEST(Laws, AreBrokenByNoPosesAtAll) { EXPECT_FALSE(runLaws(Machine(shippedMachine("three-axis")), seed, 0).passes()); }

}  // namespace
}  // namespace cusp::kinematics::test
