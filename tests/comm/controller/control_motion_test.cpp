// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What the axes do: limits, tolerances, times, stops and overrides.
#include "control_bench.hpp"

#include <cusp/dynamics/s_curve.hpp>

#include <cmath>
#include <gtest/gtest.h>

namespace cusp::comm::test {
namespace {

constexpr double rounding = 1e-5;

TEST(ControlMotion, FiveAxisProgramKeepsLimitsAndTolerance) {
    Bench bench("fooke-endura-ca");
    const FiveAxisProgram program = fiveAxisProgram(800, 0.5);
    ASSERT_TRUE(bench.control.select("P.MPF", program.text));
    ASSERT_TRUE(bench.control.start());
    bench.control.runToRest(600.0);
    ASSERT_TRUE(bench.control.status().finished)
        << (bench.control.status().alarms.empty() ? std::string("no alarm")
                                                  : bench.control.status().alarms.front().text);
    EXPECT_LE(bench.limitUse(), 1.0 + rounding);
    std::vector<geometry::Vector3> path = program.tips;
    path.insert(path.begin(), {0.0, 0.0, 50.0});
    path.push_back(path.back() + geometry::Vector3(0.0, 0.0, 100.0 - path.back().z()));
    EXPECT_LE(bench.missOf(path, program.first_cut_line, program.last_cut_line), 0.0101);
}

TEST(ControlMotion, SingleAxisMovesTakeTheClosedFormWithinATick) {
    Bench bench("three-axis");
    ASSERT_TRUE(bench.control.select("P.MPF", "G54 G90 G60\nSUPA G1 F6000 X5\nSUPA X55\nM30\n"));
    ASSERT_TRUE(bench.control.start());
    bench.control.runToRest(60.0);
    ASSERT_TRUE(bench.control.status().finished);
    double first = 0.0;
    double last = 0.0;
    for (const ControlSample& sample : bench.samples) {
        if (sample.axes[0] <= 5.0 + 1e-9) first = sample.time_s;
        if (sample.axes[0] < 55.0 - 1e-9) last = sample.time_s;
    }
    const dynamics::AxisLimits limits = dynamics::limitsOf(bench.machine);
    EXPECT_NEAR(last - first, dynamics::straightTime(50.0, {100.0, limits.acceleration[0], limits.jerk[0]}),
                2.0 * bench.options.tick_s);
}

TEST(ControlMotion, NcStopStaysOnThePathAndGoesOn) {
    Bench bench("fooke-endura-ca");
    const FiveAxisProgram program = fiveAxisProgram(600, 0.5);
    ASSERT_TRUE(bench.control.select("P.MPF", program.text));
    ASSERT_TRUE(bench.control.start());
    while (bench.control.status().executing_line < program.first_cut_line + 200) bench.control.advance(0.01);
    EXPECT_GT(bench.control.status().feed_mm_per_s, 10.0);
    const double pressed = bench.control.status().time_s;
    bench.control.stop();
    while (bench.control.status().state == ChannelState::Active && bench.control.status().time_s < pressed + 30.0)
        bench.control.advance(0.01);
    EXPECT_EQ(bench.control.status().waiting_for, "NC stop");
    EXPECT_LT(bench.control.status().time_s - pressed, 1.0);
    const auto held = bench.control.status().axes;
    bench.control.advance(1.0);
    EXPECT_EQ(bench.control.status().axes, held);
    ASSERT_TRUE(bench.control.start());
    bench.control.runToRest(600.0);
    ASSERT_TRUE(bench.control.status().finished);
    EXPECT_LE(bench.limitUse(), 1.0 + rounding);
    std::vector<geometry::Vector3> path = program.tips;
    path.insert(path.begin(), {0.0, 0.0, 50.0});
    path.push_back(path.back() + geometry::Vector3(0.0, 0.0, 100.0 - path.back().z()));
    EXPECT_LE(bench.missOf(path, program.first_cut_line, program.last_cut_line), 0.0101);
}

TEST(ControlMotion, OverrideScalesFeedWithinLimits) {
    Bench bench("three-axis");
    std::string program = "G54 G90 G64\nSUPA G0 X-450\nG1 F3000\n";
    for (int i = 1; i <= 1800; ++i) program += "SUPA X" + std::to_string(-450.0 + 0.5 * i) + "\n";
    ASSERT_TRUE(bench.control.select("P.MPF", program + "M30\n"));
    ASSERT_TRUE(bench.control.start());
    while (bench.control.status().executing_line < 50) bench.control.advance(0.01);
    const auto feedAfter = [&](double share, double seconds) {
        bench.control.setOverride(share);
        bench.control.advance(seconds);
        return bench.control.status().feed_mm_per_s;
    };
    EXPECT_NEAR(feedAfter(0.5, 1.0), 25.0, 0.5);
    EXPECT_NEAR(feedAfter(0.0, 2.0), 0.0, 1e-9);
    EXPECT_EQ(bench.control.status().state, ChannelState::Active);
    EXPECT_NEAR(feedAfter(1.0, 2.0), 50.0, 0.5);
    EXPECT_NEAR(feedAfter(1.2, 6.0), 60.0, 0.6);
    EXPECT_NEAR(feedAfter(0.6, 4.0), 30.0, 0.5);
    bench.control.setOverride(1.0);
    bench.control.runToRest(600.0);
    EXPECT_TRUE(bench.control.status().finished);
    EXPECT_LE(bench.limitUse(), 1.0 + rounding);
}

TEST(ControlMotion, ManyStopsAtRandomMomentsBreakNoLimit) {
    for (const double every_s : {0.317, 0.731}) {
        Bench bench("fooke-endura-ca");
        const FiveAxisProgram program = fiveAxisProgram(300, 0.5);
        ASSERT_TRUE(bench.control.select("P.MPF", program.text));
        for (int i = 0; i < 400 && !bench.control.status().finished; ++i) {
            static_cast<void>(bench.control.start());
            bench.control.advance(every_s);
            bench.control.stop();
            bench.control.advance(0.8);
        }
        static_cast<void>(bench.control.start());
        bench.control.runToRest(600.0);
        EXPECT_TRUE(bench.control.status().finished);
        EXPECT_LE(bench.limitUse(), 1.0 + rounding);
    }
}

TEST(ControlMotion, SameCallsSameSamples) {
    const auto run = [] {
        Bench bench("fooke-endura-ca");
        EXPECT_TRUE(bench.control.select("P.MPF", fiveAxisProgram(200, 0.5).text));
        EXPECT_TRUE(bench.control.start());
        bench.control.advance(2.0);
        bench.control.setOverride(0.7);
        bench.control.runToRest(600.0);
        return bench.samples;
    };
    const auto once = run();
    const auto again = run();
    ASSERT_EQ(once.size(), again.size());
    for (std::size_t i = 0; i < once.size(); ++i) ASSERT_EQ(once[i].axes, again[i].axes);
}

}  // namespace
}  // namespace cusp::comm::test
