// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Rotary limits where the control chooses the positions, machine coordinates, and holes one by one.
#include "program_pair.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace cusp::post::verify::test {
namespace {

/// Without a CL file: only the program itself is looked at.
VerifyReport alone(const std::string& program, const MachineFile& machine) {
    std::istringstream in(program);
    auto report = verifyProgram(in, "P.MPF", machine, nullptr);
    EXPECT_TRUE(report) << base::toText(report.error());
    return *std::move(report);
}

MachineFile narrowHead() {
    MachineFile machine = shippedMachine("head-c200-a95");
    machine.machine.rotary.at("C").min_rad = base::radFromDeg(-60.0);
    machine.machine.rotary.at("C").max_rad = base::radFromDeg(60.0);
    machine.machine.rotary.at("A").min_rad = base::radFromDeg(-95.0);
    return machine;
}

TEST(Limits, OfVectors) {
    const std::string start = "G54 M3 S1000 F100\nTRAORI\nORIVECT\nG0 X0 Y0 Z0 ";
    // C ±60° with A of either sign: sideways, along X, lies at C = ±90°.
    EXPECT_EQ(errorTexts(alone(start + "A3=0 B3=-1 C3=2\nM30\n", narrowHead())), "");
    EXPECT_EQ(errorTexts(alone(start + "A3=1 B3=0 C3=0\nM30\n", narrowHead())),
              "line 4: no position of the rotary axes within their limits gives the tool axis (1.000000, 0.000000, "
              "0.000000)\n");
}

TEST(Limits, OnTheWayOfAGreatCircle) {
    // Both ends at C = ±60°, one with A > 0, the other with A < 0: the way between them crosses C = 90°.
    const std::string program =
        "G54 M3 S1000 F100\nTRAORI\nORIVECT\nG0 X0 Y0 Z0 A3=0.6 B3=-0.6 C3=0.5\nG1 A3=0.6 B3=0.6 C3=0.5\nM30\n";
    const VerifyReport report = alone(program, narrowHead());
    EXPECT_EQ(report.limit_violations, 1U);
    EXPECT_NE(errorTexts(report).find("which lies on the way"), std::string::npos) << errorTexts(report);
}

toolpath::ToolPath oneHole(const toolpath::CycleStart& cycle) {
    using namespace toolpath;
    ToolPath path = straightPath({});
    std::uint32_t line = 2;
    const auto record = [&](ClStatement statement) { path.records.push_back({std::move(statement), ++line}); };
    record(cycle);
    record(HoleLocation{{{5, 6, 0}, {0, 0, 1}}});
    record(CycleEnd{});
    return path;
}

std::string holeProblems(const toolpath::CycleStart& cycle, const std::string& blocks) {
    return errorTexts(verify("G54 S1000 M3 F600\n" + blocks + "M30\n", oneHole(cycle), shippedMachine("three-axis")));
}

TEST(Holes, DrilledByCycleOrByBlocks) {
    toolpath::CycleStart cycle;
    cycle.depth_mm = 20;
    cycle.clearance_mm = 2;
    cycle.retract_mm = 10;
    EXPECT_EQ(holeProblems(cycle, "G0 X5 Y6 Z10\nMCALL CYCLE81(10,0,2,-20)\nX5 Y6\nMCALL\n"), "");
    EXPECT_EQ(holeProblems(cycle, "G0 X5 Y6 Z10\nZ2\nG1 Z-20\nG0 Z10\n"), "");
    EXPECT_EQ(holeProblems(cycle, "G0 X5 Y6 Z2\nG1 Z-20\nG0 Z10\n"), "")
        << "the retract plane may be left out on the way in";
    EXPECT_EQ(holeProblems(cycle, "G0 X5 Y6 Z10\nZ2\nG1 Z-8\nG0 Z2\nZ-7\nG1 Z-20\nG0 Z10\n"), "") << "pecks";
    EXPECT_EQ(holeProblems(cycle, "G0 X5 Y6 Z10\nZ2\nG1 Z-8\nG0 Z2\nZ-9\nG1 Z-20\nG0 Z10\n"),
              "line 6: a rapid (G0) goes 1 mm into uncut material in the hole of CL line 4\n");
}

TEST(Holes, PecksAndDwell) {
    toolpath::CycleStart cycle;
    cycle.kind = toolpath::CycleStart::Kind::Deep;
    cycle.depth_mm = 20;
    cycle.clearance_mm = 2;
    cycle.peck_mm = 8;
    cycle.dwell_s = 0.5;
    EXPECT_EQ(holeProblems(cycle, "G0 X5 Y6 Z2\nCYCLE83(2,0,2,-20,,,8,0,0.5,0,1,1)\n"), "");
    EXPECT_EQ(holeProblems(cycle, "G0 X5 Y6 Z2\nCYCLE83(2,0,2,-20,,,9,0,0.5,0,1,1)\n"),
              "line 3: drills 9 mm at once, more than 8 mm, in the hole of CL line 4\n"
              "line 3: drills 9 mm at once, more than 8 mm, in the hole of CL line 4\n");
    EXPECT_EQ(holeProblems(cycle, "G0 X5 Y6 Z2\nCYCLE83(2,0,2,-20,,,7,0,0.5,0,1,1)\n"),
              "line 3: drilled 7 mm before this, less than 8 mm, in the hole of CL line 4\n"
              "line 3: drilled 7 mm before this, less than 8 mm, in the hole of CL line 4\n");
    EXPECT_EQ(holeProblems(cycle, "G0 X5 Y6 Z2\nCYCLE83(2,0,2,-20,,,8,0,0.5,0,1,0)\n"),
              "line 3: does not come out after a peck in the hole of CL line 4\n"
              "line 3: does not come out after a peck in the hole of CL line 4\n");
    EXPECT_EQ(holeProblems(cycle, "G0 X5 Y6 Z2\nCYCLE83(2,0,2,-20,,,8,0,0,0,1,1)\n"),
              "line 3: dwells 0 s at the bottom of the hole of CL line 4, which has 0.5 s\n");
}

TEST(MachineCoordinates, WithoutALengthTheyAreUnplaced) {
    const std::string program = "G54 S1000 M3\nG0 X0 Y0 Z0 A0 C0\nG1 X1 Y0 Z0 A10 F600\nM30\n";
    toolpath::ToolPath path = straightPath({{0, 0, 0}, {1, 0, 0}});
    const std::string texts = errorTexts(verify(program, path, shippedMachine("head-c200-a95")));
    EXPECT_NE(texts.find("line 3: a feed move without TRAORI while rotary axes are away from zero"), std::string::npos)
        << texts;
}

TEST(Plane, ToolLengthAcrossTheSpindle) {
    const std::string program = "G54 G18 S1000 M3\nG0 X0 Y0 Z0\nG1 X1 F600\nM30\n";
    const toolpath::ToolPath path = straightPath({{0, 0, 0}, {1, 0, 0}});
    EXPECT_EQ(
        errorTexts(verify(program, path, shippedMachine("three-axis"))),
        "line 3: a feed move in G18: unless the machine fixes the direction of the tool length (SD42940), it acts "
        "across the spindle (CL line 4)\n");
    VerifyOptions options;
    options.fixed_tool_length_axis = true;
    EXPECT_EQ(errorTexts(verify(program, path, shippedMachine("three-axis"), options)), "");
}

}  // namespace
}  // namespace cusp::post::verify::test
