// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What lasts from block to block, and what each word does to it.
#include "nc_recorder.hpp"

#include <gtest/gtest.h>

namespace cusp::post::reader::test {
namespace {

constexpr const char* ready = "SUPA G0 A0 C0\nG54\nG0 X0 Y0 Z0\n";

const RecordedMotion& last(const Recording& out) { return out.motions.back(); }

TEST(ModalState, MotionCodeAndCoordinatesLast) {
    const Recording out = runLines(std::string(ready) + "G1 X10 F500\nY5\nN40 Z-1.5");
    ASSERT_EQ(out.problems, "");
    const ExecutedMotion& motion = last(out).motion;
    EXPECT_EQ(motion.code, MotionCode::Linear);
    EXPECT_EQ(norm(motion.end_pose->tip_mm - Vector3{10, 5, -1.5}), 0.0);
    EXPECT_EQ(norm(motion.start_pose->tip_mm - Vector3{10, 5, 0}), 0.0);
    EXPECT_EQ(motion.place.line, 6U);
    EXPECT_EQ(motion.place.block_number, 40U);
    EXPECT_EQ(last(out).state.feed.value, 500.0);
}

TEST(ModalState, IncrementalAndAbsoluteMayMix) {
    const Recording out = runLines(std::string(ready) + "G91 X10 Y10\nX5 Y=AC(3)\nG90 X=IC(-1) Y7");
    ASSERT_EQ(out.problems, "");
    EXPECT_EQ(norm(out.motions[3].motion.end_pose->tip_mm - Vector3{15, 3, 0}), 0.0);
    EXPECT_EQ(norm(out.motions[4].motion.end_pose->tip_mm - Vector3{14, 7, 0}), 0.0);
}

TEST(ModalState, InchesWithAndWithoutTheFeed) {
    const Recording out = runLines(std::string(ready) + "G700 G1 X1 F10\nG70 X2 F10\nG710 X3 F10\nG71 X4");
    ASSERT_EQ(out.problems, "");
    EXPECT_DOUBLE_EQ(out.motions[2].motion.end_pose->tip_mm.x, 25.4);
    EXPECT_DOUBLE_EQ(*out.motions[2].state.feed.value, 254.0);
    EXPECT_DOUBLE_EQ(out.motions[3].motion.end_pose->tip_mm.x, 50.8);
    EXPECT_DOUBLE_EQ(*out.motions[3].state.feed.value, 10.0);
    EXPECT_DOUBLE_EQ(out.motions[4].motion.end_pose->tip_mm.x, 3.0);
    EXPECT_DOUBLE_EQ(out.motions[5].motion.end_pose->tip_mm.x, 4.0);
}

TEST(ModalState, AnotherFeedTypeNeedsANewFeed) {
    const Recording out = runLines(std::string(ready) + "G1 X1 F100\nG95 X2\nX3 F0.1");
    EXPECT_EQ(out.problems,
              "5: error: a feed motion without feed: no F has been programmed for the active feed type [nc.no-feed]\n");
    EXPECT_EQ(last(out).state.feed.mode, Feed::Mode::PerRevolution);
    EXPECT_EQ(last(out).state.feed.value, 0.1);
}

TEST(ModalState, InverseTimeFeedHoldsForOneBlock) {
    const Recording out = runLines(std::string(ready) + "G93 G1 X1 F10\nX2");
    EXPECT_EQ(out.problems,
              "5: error: a feed motion without feed: no F has been programmed for the active feed type [nc.no-feed]\n");
}

TEST(ModalState, ToolSpindleAndCoolant) {
    const Recording out =
        runLines(std::string(ready) + "T=\"BALL_10\"\nX1\nM6\nG54 G0 X0 Y0 Z0 S8000 M3 M8\nX1\nM7\nX2 M9 M5\nX3");
    ASSERT_EQ(out.problems, "");
    EXPECT_EQ(out.motions[2].state.tool, "") << "T alone only selects";
    EXPECT_EQ(out.motions[4].state.tool, "BALL_10");
    EXPECT_EQ(out.motions[4].state.cutting_edge, 1);
    EXPECT_EQ(out.motions[4].state.spindle, SpindleTurn::Clockwise);
    EXPECT_EQ(out.motions[4].state.spindle_rpm, 8000.0);
    EXPECT_TRUE(out.motions[4].state.flood && !out.motions[4].state.mist);
    EXPECT_TRUE(out.motions[5].state.flood && out.motions[5].state.mist);
    EXPECT_EQ(out.motions[5].state.spindle, SpindleTurn::Clockwise) << "M5 acts at the end of its block";
    EXPECT_EQ(out.motions[6].state.spindle, SpindleTurn::Off);
    EXPECT_FALSE(out.motions[6].state.flood || out.motions[6].state.mist);
}

TEST(ModalState, AToolChangeStopsSpindleAndCoolant) {
    const Recording out = runLines(std::string(ready) + "S100 M3 M8\nX1\nT2 M6\nG0 X2");
    ASSERT_EQ(out.problems, "");
    EXPECT_EQ(out.motions[2].state.spindle, SpindleTurn::Clockwise);
    EXPECT_EQ(out.motions[3].state.spindle, SpindleTurn::Off);
    EXPECT_FALSE(out.motions[3].state.flood);
}

TEST(ModalState, EventsComeInOrder) {
    const Recording out = runLines(
        "MSG(\"OP 1; it begins\")\nT5 M6\nS100 M4\nG4 F1.5\nTRAORI\nTRAFOOF\nM1\nCYCLE832(0.01,_ORI_FINISH,0.1)");
    ASSERT_EQ(out.problems, "");
    ASSERT_EQ(out.events.size(), 9U);
    EXPECT_EQ(std::get<OperatorMessage>(out.events[0].second).text, "OP 1; it begins");
    EXPECT_EQ(std::get<ToolChange>(out.events[1].second).tool, "5");
    EXPECT_EQ(std::get<SpindleStart>(out.events[2].second).turn, SpindleTurn::CounterClockwise);
    EXPECT_EQ(std::get<DwellTime>(out.events[3].second).seconds, 1.5);
    EXPECT_TRUE(std::get<TransformationSwitch>(out.events[4].second).on);
    EXPECT_FALSE(std::get<TransformationSwitch>(out.events[5].second).on);
    EXPECT_TRUE(std::get<MachineStop>(out.events[6].second).optional);
    EXPECT_EQ(std::get<HighSpeedSetting>(out.events[7].second).arguments,
              (std::vector<std::string>{"0.01", "_ORI_FINISH", "0.1"}));
    EXPECT_EQ(std::get<ProgramEnd>(out.events[8].second).m_function, 30);
}

TEST(ModalState, DwellTimeIsNoFeed) {
    const Recording out = runLines(std::string(ready) + "G1 X1 F100\nG4 F2\nX2");
    ASSERT_EQ(out.problems, "");
    EXPECT_EQ(last(out).state.feed.value, 100.0);
}

TEST(ModalState, WhatTheProgramCannotKnowIsForgotten) {
    // After a machine position, another offset or another tool, X, Y, Z in the workpiece frame are the control's knowledge.
    for (const char* change : {"SUPA Z100", "G55", "M6", "D0", "G153 X0"}) {
        const Recording out = runLines(std::string(ready) + "D1 X1 Y1 Z1\nX1 Y1 Z1\n" + change + "\nG0 Y2");
        ASSERT_EQ(out.problems, "") << change;
        EXPECT_FALSE(last(out).motion.end_pose) << change;
    }
}

TEST(ModalState, MachineFunctionsAreNamedOnceOrRefused) {
    const std::string program = "M27\nM27\nM30\n";
    const MachineFile machine = shippedMachine("three-axis");
    EXPECT_EQ(
        run(program, machine).problems,
        "1:1: warning: M27 belongs to the machine builder; what it does is not known here [nc.machine-function]\n");
    ReaderOptions strict;
    strict.strict = true;
    EXPECT_EQ(run(program, machine, strict).problems,
              "1:1: error: M27 belongs to the machine builder; what it does is not known here [nc.machine-function]\n");
}

TEST(ModalState, BlockSkipIsReadAsNotSkipped) {
    const Recording out = runLines(std::string(ready) + "/N10 G0 X5\n/2 X6");
    EXPECT_EQ(out.problems,
              "4: warning: blocks that begin with '/' may be skipped at the control; they are read as not skipped "
              "[nc.block-skip]\n");
    EXPECT_EQ(last(out).motion.end_pose->tip_mm.x, 6.0);
}

TEST(ModalState, WordsNeedNoSpacesAndNoCapitals) {
    const Recording out = runLines(std::string(ready) + "n10g1x-1.5y+.5z2.f1EX3 ; text with ( and \" in it");
    ASSERT_EQ(out.problems, "");
    EXPECT_EQ(norm(last(out).motion.end_pose->tip_mm - Vector3{-1.5, 0.5, 2.0}), 0.0);
    EXPECT_EQ(last(out).state.feed.value, 1000.0);
}

TEST(ModalState, ThreeAxisMachineNeedsNoTransformation) {
    const Recording out =
        run("%_N_PART_MPF\n;$PATH=/_N_WKS_DIR/_N_PART_WPD\nG54 G0 X1 Y2 Z3\nM17\n", shippedMachine("three-axis"));
    ASSERT_EQ(out.problems, "");
    EXPECT_EQ(norm(out.motions[0].motion.end_pose->tip_mm - Vector3{1, 2, 3}), 0.0);
}

TEST(ModalState, WhatOnlyTheOperatorSeesHasNoEffect) {
    const Recording out =
        runLines("WORKPIECE(,\"\",,\"BOX\",112,0,-20,-80,0,0,100,100)\nGROUP_BEGIN(0,\"ROUGH\",0,0)\nG0 A0 C0\n"
                 "G54 G0 X1 Y2 Z3\nGROUP_END(0,0)");
    EXPECT_EQ(out.problems, "");
    EXPECT_EQ(out.motions.size(), 2U);
}

TEST(ModalState, CutterCompensationKeepsTheContour) {
    const Recording out = runLines("G0 A0 C0\nG54 G0 X0 Y0 Z0 F100\nG41 G1 X10\nG42 Y10\nG40 X0");
    ASSERT_EQ(out.problems, "");
    EXPECT_EQ(out.motions[2].state.compensation, RadiusCompensation::Left);
    EXPECT_EQ(out.motions[3].state.compensation, RadiusCompensation::Right);
    EXPECT_NEAR(norm(out.motions[3].motion.end_pose->tip_mm - Vector3{10, 10, 0}), 0.0, 1e-12);
    EXPECT_EQ(out.motions[4].state.compensation, RadiusCompensation::Off);
}

}  // namespace
}  // namespace cusp::post::reader::test
