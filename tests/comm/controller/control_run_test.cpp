// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// States, stops, alarms and block search.
#include "control_bench.hpp"

#include <gtest/gtest.h>

namespace cusp::comm::test {
namespace {

const std::string small = "G54 G90 G64\n"        // 1
                          "SUPA G1 F3000 X10\n"  // 2
                          "SUPA X20\n"           // 3
                          "M0\n"                 // 4
                          "SUPA X30\n"           // 5
                          "M1\n"                 // 6
                          "SUPA X40\n"           // 7
                          "M30\n";               // 8

TEST(ControlRun, GoesThroughItsStates) {
    Bench bench("three-axis");
    EXPECT_EQ(bench.control.status().state, ChannelState::Reset);
    EXPECT_FALSE(bench.control.start()) << "nothing chosen";
    ASSERT_TRUE(bench.control.select("SMALL.MPF", small));
    ASSERT_TRUE(bench.control.start());
    EXPECT_FALSE(bench.control.start()) << "already running";
    EXPECT_FALSE(bench.control.select("OTHER.MPF", small));
    bench.control.runToRest(60.0);
    EXPECT_EQ(bench.control.status().state, ChannelState::Interrupted);
    EXPECT_EQ(bench.control.status().waiting_for, "M0");
    EXPECT_DOUBLE_EQ(bench.control.status().axes[0], 20.0);
    EXPECT_EQ(bench.control.status().completed_line, 4u);
    ASSERT_TRUE(bench.control.start());
    bench.control.runToRest(60.0);
    EXPECT_TRUE(bench.control.status().finished) << "M1 is off";
    EXPECT_EQ(bench.control.status().state, ChannelState::Reset);
    EXPECT_DOUBLE_EQ(bench.control.status().axes[0], 40.0);
}

TEST(ControlRun, OptionalStopAndSingleBlock) {
    Bench bench("three-axis");
    bench.control.setOptionalStop(true);
    ASSERT_TRUE(bench.control.select("SMALL.MPF", small));
    ASSERT_TRUE(bench.control.start());
    bench.control.runToRest(60.0);
    ASSERT_TRUE(bench.control.start());
    bench.control.runToRest(60.0);
    EXPECT_EQ(bench.control.status().waiting_for, "M1");
    bench.control.reset();
    bench.control.advance(0.1);
    bench.control.setSingleBlock(true);
    ASSERT_TRUE(bench.control.start());
    bench.control.runToRest(60.0);
    EXPECT_EQ(bench.control.status().waiting_for, "single block");
    EXPECT_DOUBLE_EQ(bench.control.status().axes[0], 10.0);
    ASSERT_TRUE(bench.control.start());
    bench.control.runToRest(60.0);
    EXPECT_DOUBLE_EQ(bench.control.status().axes[0], 20.0);
}

TEST(ControlRun, DwellLasts) {
    Bench bench("three-axis");
    ASSERT_TRUE(bench.control.select("P.MPF", "G54 G90\nG4 F1.5\nM30\n"));
    ASSERT_TRUE(bench.control.start());
    bench.control.runToRest(60.0);
    EXPECT_TRUE(bench.control.status().finished);
    EXPECT_NEAR(bench.control.status().time_s, 1.5, 0.02);
}

TEST(ControlRun, ResetEndsTheProgramOnThePath) {
    Bench bench("three-axis");
    ASSERT_TRUE(bench.control.select("P.MPF", "G54 G90\nSUPA G1 F3000 X300\nM30\n"));
    ASSERT_TRUE(bench.control.start());
    bench.control.advance(1.0);
    bench.control.reset();
    bench.control.advance(1.0);
    EXPECT_EQ(bench.control.status().state, ChannelState::Reset);
    const double x = bench.control.status().axes[0];
    EXPECT_GT(x, 20.0);
    EXPECT_LT(x, 100.0);
    EXPECT_LE(bench.limitUse(), 1.0 + 1e-5);
    ASSERT_TRUE(bench.control.start()) << "from the beginning";
    bench.control.runToRest(60.0);
    EXPECT_DOUBLE_EQ(bench.control.status().axes[0], 300.0);
}

Alarm alarmOf(const std::string& program) {
    Bench bench("three-axis");
    EXPECT_TRUE(bench.control.select("P.MPF", program));
    EXPECT_TRUE(bench.control.start());
    bench.control.runToRest(60.0);
    EXPECT_EQ(bench.control.status().state, ChannelState::Interrupted);
    EXPECT_FALSE(bench.control.start()) << "only a reset clears an alarm";
    if (bench.control.status().alarms.size() != 1) return {};
    const Alarm alarm = bench.control.status().alarms.front();
    bench.control.reset();
    EXPECT_TRUE(bench.control.status().alarms.empty());
    return alarm;
}

TEST(ControlRun, AlarmsHaveNumberLineAndText) {
    const Alarm limit = alarmOf("G54 G90\nSUPA G1 F3000 X10\nSUPA X99999\nM30\n");
    EXPECT_EQ(limit.number, 10720);
    EXPECT_EQ(limit.line, 3u);
    EXPECT_EQ(limit.text.substr(0, 57), "axis X would go to 99999.000 mm, beyond its software limi");
    const Alarm syntax = alarmOf("G54 G90\nG1 F100 SUPA X10\nWHATEVER\nM30\n");
    EXPECT_EQ(syntax.number, 12080);
    EXPECT_EQ(syntax.line, 3u);
    EXPECT_NE(syntax.text.find("[nc.unknown-word]"), std::string::npos) << syntax.text;
    const Alarm end = alarmOf("G54 G90\nG1 F100 SUPA X10\n");
    EXPECT_EQ(end.number, 12080);
    EXPECT_NE(end.text.find("[nc.no-end]"), std::string::npos) << end.text;
    EXPECT_EQ(alarmOf("G54 G90\nSUPA G0 X0 Y0 Z0\nG1 F100 G41 X1 Y1\nX5\nG40 X0\nM30\n").text,
              "cutter radius compensation (G41, G42) is not run here");
    EXPECT_EQ(alarmOf("G54 G95 G90\nSUPA G1 F0.1 X10\nM30\n").number, 10860);
}

TEST(ControlRun, WhatStandsBeforeAnAlarmIsStillRun) {
    Bench bench("three-axis");
    ASSERT_TRUE(bench.control.select("P.MPF", "G54 G90\nSUPA G1 F3000 X10\nSUPA X99999\nM30\n"));
    ASSERT_TRUE(bench.control.start());
    bench.control.runToRest(60.0);
    EXPECT_DOUBLE_EQ(bench.control.status().axes[0], 10.0);
    EXPECT_EQ(bench.control.status().resume_line, 3u);
}

TEST(ControlRun, BlockSearchCalculatesAndComesFromAbove) {
    Bench bench("three-axis");
    const std::string program = "G54 G90 G60\nSUPA G0 Z-20\nSUPA G1 F3000 X10\nSUPA X20\nSUPA Z-30\nSUPA X40\nM30\n";
    ASSERT_TRUE(bench.control.select("P.MPF", program));
    ASSERT_TRUE(bench.control.search(6).has_value());
    ASSERT_TRUE(bench.control.start());
    bench.control.runToRest(60.0);
    ASSERT_TRUE(bench.control.status().finished);
    bool crossed_low = false;
    bool cut = false;
    for (const ControlSample& sample : bench.samples) {
        crossed_low = crossed_low || (sample.axes[0] > 0.1 && sample.axes[0] < 19.9 && sample.axes[2] < -0.1);
        cut = cut || (sample.axes[0] > 25.0 && sample.axes[2] == -30.0);
    }
    EXPECT_FALSE(crossed_low) << "first over the place, then down";
    EXPECT_TRUE(cut) << "with the Z of the line before";
    EXPECT_FALSE(bench.control.search(100).has_value());
}

}  // namespace
}  // namespace cusp::comm::test
