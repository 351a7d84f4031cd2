// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// How NC steps are spelled: exact 840D text, modal words, strings.
#include <cusp/base/units.hpp>
#include <cusp/post/writer/sinumerik_writer.hpp>

#include <gtest/gtest.h>

namespace cusp::post {
namespace {

using toolpath::FeedRate;
using toolpath::MotionKind;

/// A C-then-A head with round numbers.
MachineFile headMachine() {
    MachineFile file;
    file.machine.chain = {"workpiece", "base", "X", "Y", "Z", "C", "A", "tool"};
    for (const char* name : {"X", "Y", "Z"}) file.machine.linear[name].home_mm = 0.0;
    file.machine.linear["Z"].home_mm = 800.0;
    file.machine.rotary["C"].direction = {0, 0, 1};
    file.machine.rotary["A"].direction = {1, 0, 0};
    return file;
}

class Writer : public ::testing::Test {
protected:
    template <class... Items>
    std::string write(const Items&... items) {
        std::string out;
        SinumerikWriter writer([&out](std::string_view text) { out += text; }, file, {"P", "", {}});
        (writer.step({items, 0}), ...);
        blocks = writer.finish();
        return out;
    }
    static Move feedMove(double x, double y, double z, double c_deg, double a_deg, double feed_mm_per_min) {
        return {{x, y, z},
                {base::radFromDeg(c_deg), base::radFromDeg(a_deg)},
                MotionKind::Feed,
                {base::mmPerSFromMmPerMin(feed_mm_per_min), FeedRate::Unit::MmPerS}};
    }

    MachineFile file = headMachine();
    std::size_t blocks = 0;
};

TEST_F(Writer, StartsWithDefaultsAndHome) {
    EXPECT_EQ(write(ModalStart{}, TipProgramming{.on = false}, GoHome{}), "; P\n"
                                                                          "N10 G40 G17 G710 G94 G90 G60 G601 FNORM\n"
                                                                          "N20 TRAFOOF\n"
                                                                          "N30 SUPA G0 Z800 D0\n"
                                                                          "N40 SUPA G0 X0 Y0 C0 A0 D0\n");
    EXPECT_EQ(blocks, 4U);
}

TEST_F(Writer, OnlyChangedWordsArePrinted) {
    EXPECT_EQ(
        write(feedMove(1, 2, 3, 10, 20, 3000), feedMove(1, 2.5, 3, 10, 20, 3000), feedMove(1, 2.5, 3, 11, 20, 500)),
        "; P\n"
        "N10 G94 G1 X1 Y2 Z3 C10 A20 F3000\n"
        "N20 Y2.5\n"
        "N30 C11 F500\n");
}

TEST_F(Writer, APointThatPrintsTheSameIsNoBlock) {
    EXPECT_EQ(
        write(feedMove(1, 2, 3, 0, 0, 100), feedMove(1.000001, 2, 3, 0, 0, 100), feedMove(1.00002, 2, 3, 0, 0, 100)),
        "; P\n"
        "N10 G94 G1 X1 Y2 Z3 C0 A0 F100\n"
        "N20 X1.00002\n");
    EXPECT_EQ(blocks, 2U);
}

TEST_F(Writer, TransformationForgetsPositionsAndCallsTheOffsetAgain) {
    EXPECT_EQ(write(feedMove(1, 2, 3, 0, 0, 100), TipProgramming{true}, feedMove(1, 2, 3, 0, 0, 100)),
              "; P\n"
              "N10 G94 G1 X1 Y2 Z3 C0 A0 F100\n"
              "N20 TRAORI\n"
              "N30 G54\n"
              "N40 ORIAXES\n"
              "N50 G1 X1 Y2 Z3 C0 A0\n");
}

TEST_F(Writer, OrientationCommandFollowsMD21104) {
    file.control.md21104_ori_ipo_with_g_code = false;
    EXPECT_EQ(write(TipProgramming{true}), "; P\nN10 TRAORI\nN20 G54\nN30 ORIMKS\n");
}

TEST_F(Writer, VectorsAreToldWholeAndOnlyWhenTheyChange) {
    Move first = feedMove(1, 2, 3, 90, 30, 600);
    first.axis = {0.5, 0.0, 0.8660254037844387};
    Move second = first;
    second.point_mm.x() = 2;
    Move third = second;
    third.axis = {0.0, 0.0, 1.0};
    EXPECT_EQ(write(TipProgramming{true, true}, first, second, third),
              "; P\n"
              "N10 TRAORI\n"
              "N20 G54\n"
              "N30 ORIWKS ORIVECT\n"
              "N40 G94 G1 X1 Y2 Z3 A3=0.5 B3=0 C3=0.866025 F600\n"
              "N50 X2\n"
              "N60 A3=0 B3=0 C3=1\n");
    file.control.md21104_ori_ipo_with_g_code = false;
    EXPECT_EQ(write(TipProgramming{true, true}), "; P\nN10 TRAORI\nN20 G54\nN30 ORIWKS\n");
}

TEST_F(Writer, InverseTimeHasAFeedInEveryBlock) {
    Move timed = feedMove(1, 0, 0, 0, 1, 600);
    timed.moves_per_min = 1234.5678;
    Move slow = feedMove(2, 0, 0, 0, 2, 600);
    slow.moves_per_min = 0.0123456789;
    EXPECT_EQ(write(feedMove(0, 0, 0, 0, 0, 600), timed, slow, slow, feedMove(3, 0, 0, 0, 2, 600)),
              "; P\n"
              "N10 G94 G1 X0 Y0 Z0 C0 A0 F600\n"
              "N20 G93 X1 A1 F1234.57\n"
              "N30 X2 A2 F0.0123457\n"
              "N40 G94 X3 F600\n");
}

TEST_F(Writer, ApproachGoesInThePlaneFirst) {
    const Approach rapid{{10, 20, 30}, {0, 0}, MotionKind::Rapid, {}};
    EXPECT_EQ(write(PositionRotary{{0, 0}}, rapid), "; P\nN10 G0 C0 A0\nN20 X10 Y20\nN30 Z30\n");
    const Approach feed{{10, 20, 30}, {0, 0}, MotionKind::Feed, {10.0, FeedRate::Unit::MmPerS}};
    EXPECT_EQ(write(feed), "; P\nN10 G0 X10 Y20 C0 A0\nN20 G94 G1 Z30 F600\n");
}

TEST_F(Writer, ArcsPrintEndAndCentre) {
    const ArcMove arc{{0, 10, 3}, {-10, 0, 0}, false, {0, 0}, {10.0, FeedRate::Unit::MmPerS}};
    const ArcMove circle{{0, 10, 3}, {0, -10, 0}, true, {0, 0}, {10.0, FeedRate::Unit::MmPerS}};
    EXPECT_EQ(
        write(feedMove(10, 0, 3, 0, 0, 600), arc, circle, feedMove(0, 10, 3, 0, 0, 600), feedMove(1, 10, 3, 0, 0, 600)),
        "; P\n"
        "N10 G94 G1 X10 Y0 Z3 C0 A0 F600\n"
        "N20 G3 X0 Y10 I-10 J0\n"
        "N30 G2 X0 Y10 I0 J-10\n"
        "N40 G1\n"
        "N50 X1\n");
}

TEST_F(Writer, FeedPerRevolution) {
    const Move per_rev{{1, 0, 0}, {0, 0}, MotionKind::Feed, {0.125, FeedRate::Unit::MmPerRev}};
    EXPECT_EQ(write(feedMove(0, 0, 0, 0, 0, 100), per_rev), "; P\nN10 G94 G1 X0 Y0 Z0 C0 A0 F100\nN20 G95 X1 F0.125\n");
}

TEST_F(Writer, ToolsByNameOrNumber) {
    EXPECT_EQ(write(ChangeTool{5, "BALL \"6\""}), "; P\nN10 T=\"BALL _6_\"\n");
    EXPECT_EQ(write(ChangeTool{5, ""}), "; P\nN10 T5\n");
}

TEST_F(Writer, SmoothingPerSoftware) {
    file.control.cycle832_orientation_tolerance_rad = base::radFromDeg(0.05);
    EXPECT_EQ(write(Smoothing{true}, Smoothing{false}), "; P\nN10 CYCLE832(0.01,_ORI_FINISH,0.05)\nN20 CYCLE832()\n");
    file.control.cycle832 = ControlDefinition::Cycle832::UpTo44;
    EXPECT_EQ(write(Smoothing{true}), "; P\nN10 CYCLE832(0.01,1,1)\n");
    file.control.cycle832 = ControlDefinition::Cycle832::None;
    EXPECT_EQ(write(Smoothing{true}), "; P\n");
}

TEST_F(Writer, NamesOfSeveralLettersTakeAnEqualsSign) {
    file.machine.chain = {"workpiece", "base", "X", "Y", "Z", "C1", "A", "tool"};
    file.machine.rotary["C1"] = file.machine.rotary["C"];
    EXPECT_EQ(write(PositionRotary{{base::radFromDeg(-90), 0}}), "; P\nN10 G0 C1=-90 A0\n");
}

TEST_F(Writer, ATiltedPlaneIsCycle800) {
    TiltedPlane plane;
    plane.angles_rad = {base::radFromDeg(45.0), base::radFromDeg(35.2644), base::radFromDeg(150.0)};
    plane.origin_mm = {1.0, 2.0, 3.0};
    EXPECT_EQ(write(plane, feedMove(1, 2, 3, 10, 20, 600), PlaneOff{}),
              "; P\n"
              "N10 CYCLE800(0,\"\",0,57,1,2,3,45,35.2644,150,0,0,0,-1,0,0)\n"
              "N20 G94 G1 X1 Y2 Z3 F600\n"
              "N30 CYCLE800()\n");
    file.control.swivel = {.data_set = "TABLE", .retract = 4, .status = 200000, .direction = 1, .display = 1};
    EXPECT_EQ(write(plane), "; P\nN10 CYCLE800(4,\"TABLE\",200000,57,1,2,3,45,35.2644,150,0,0,0,1,0,1)\n");
}

TEST_F(Writer, RadiusCompensationStandsInTheNextStraightBlock) {
    using Side = toolpath::CutterCompensation::Side;
    EXPECT_EQ(write(feedMove(0, 0, 0, 0, 0, 600), RadiusCompensation{Side::Left, {}}, feedMove(1, 0, 0, 0, 0, 600),
                    RadiusCompensation{Side::Off, {}}, feedMove(2, 0, 0, 0, 0, 600), RadiusCompensation{Side::Right, 2},
                    feedMove(3, 0, 0, 0, 0, 600)),
              "; P\n"
              "N10 G94 G1 X0 Y0 Z0 C0 A0 F600\n"
              "N20 G41 X1\n"
              "N30 G40 X2\n"
              "N40 G42 D2 X3 Y0 Z0\n");
}

TEST_F(Writer, SmallFeedsAndSpeedsAreNotRoundedAway) {
    EXPECT_EQ(write(Spindle{toolpath::SpindleCommand::Turn::Clockwise, 0.398}, feedMove(0, 0, 0, 0, 0, 0.0125)),
              "; P\nN10 S0.398 M3\nN20 G94 G1 X0 Y0 Z0 C0 A0 F0.0125\n");
}

TEST_F(Writer, FgrefAndNumbersThatBeginAgain) {
    file.control.fgref_mm = 80.0;
    file.control.block_number_max = 1000;
    file.control.block_number_step = 400;
    EXPECT_EQ(write(TipProgramming{true}), "; P\nN400 TRAORI\nN800 G54\nN400 ORIAXES\nN800 FGREF[C]=80 FGREF[A]=80\n");
}

TEST_F(Writer, HomeIsSpelledByTheMachineFile) {
    file.control.sequence.home = {"G53 G0 {Z}", "G53 G0 {other_axes}", "G53 {C}"};
    EXPECT_EQ(write(GoHome{}), "; P\nN10 G53 G0 Z800\nN20 G53 G0 X0 Y0 C0 A0\nN30 G53 C0\n");
}

TEST_F(Writer, EveryBlockIsListedWithItsClLine) {
    std::string listed;
    SinumerikWriter writer([](std::string_view) {}, file, {"P", "", {"a", "b"}},
                           [&](const WrittenBlock& block) {
                               listed += std::to_string(block.number) + "," + std::to_string(block.program_line) + "," +
                                         std::to_string(block.cl_line) + ";";
                           });
    writer.step({Comment{"c"}, 6});
    writer.step({Approach{{1, 2, 3}, {}, MotionKind::Rapid, {}}, 7});
    writer.step({feedMove(1, 2, 4, 0, 0, 100), 9});
    EXPECT_EQ(listed, "10,4,7;20,5,7;30,6,9;");
}

TEST_F(Writer, TextIsPrintableAndShort) {
    const std::string out = write(ScreenMessage{std::string(600, 'x') + "\n"}, Comment{"a\nM30"});
    EXPECT_EQ(out, "; P\nN10 MSG(\"" + std::string(120, 'x') + "\")\n; a_M30\n");
}

}  // namespace
}  // namespace cusp::post
