// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Drilling cycles as the heights they visit: r for rapid, f for feed.
#include "nc_recorder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace cusp::post::reader::test {
namespace {

/// "r2 f-20 r10" from the second motion on; dwells as d0.5.
std::string heights(const Recording& out) {
    std::string text;
    for (const RecordedMotion& recorded : out.motions)
        if (recorded.motion.in_cycle)
            text +=
                fmt::format("{}{}{:.5g}", text.empty() ? "" : " ",
                            recorded.motion.code == MotionCode::Rapid ? "r" : "f", *recorded.motion.end.linear_mm[2]);
    return text;
}

Recording drill(const std::string& calls) {
    return run("G54 F100 S1000 M3\nG0 X0 Y0 Z50\n" + calls + "\nM30\n", shippedMachine("three-axis"));
}

struct CycleCase {
    const char* call;
    const char* heights;
};

void PrintTo(const CycleCase& c, std::ostream* out) { *out << c.call; }

class Cycles : public testing::TestWithParam<CycleCase> {};

TEST_P(Cycles, Heights) {
    const Recording out = drill(GetParam().call);
    EXPECT_EQ(out.problems, "");
    EXPECT_EQ(heights(out), GetParam().heights);
}

INSTANTIATE_TEST_SUITE_P(
    ByHand, Cycles,
    testing::Values(CycleCase{"CYCLE81(10,0,2,-20)", "r2 f-20 r10"}, CycleCase{"CYCLE81(10,0,2,,20)", "r2 f-20 r10"},
                    CycleCase{"CYCLE81(10,5,2,-99,20)", "r7 f-15 r10"},
                    CycleCase{"CYCLE82(10,0,2,-20,,0.5)", "r2 f-20 r10"},
                    CycleCase{"CYCLE83(10,0,2,-20,,-8,,0,0,0,1,1)", "r2 f-8 r2 r-7.4 f-16 r2 r-15.4 f-20 r10"},
                    CycleCase{"CYCLE83(10,0,2,-20,,,8,0,0,0,1,0)", "r2 f-8 f-7 f-16 f-15 f-20 r10"},
                    // 8, 6, then 4, then the rest of 2 in the end
                    CycleCase{"CYCLE83(10,0,2,-20,,,8,2,0,0,1,0)", "r2 f-8 f-7 f-14 f-13 f-18 f-17 f-20 r10"},
                    CycleCase{"CYCLE84(10,0,2,-20,,,3,6,,,500,500)", "r2 f-20 f2 r10"},
                    CycleCase{"CYCLE840(10,0,2,-20,,,4,3,0,,1.5)", "r2 f-20 f2 r10"},
                    CycleCase{"CYCLE85(10,0,2,-20,,,80,200)", "r2 f-20 f2 r10"},
                    CycleCase{"CYCLE86(10,0,2,-20,,0.5,3,0,0,0,0)", "r2 f-20 r2 r10"},
                    CycleCase{"CYCLE86(10,0,2,-20,,,4,-1,2,0.5,0)", "r2 f-20 r-19.5 r2 r2 r10"},
                    CycleCase{"MCALL CYCLE81(10,0,2,-20)\nX10\nX20 Y5\nMCALL\nX30", "r2 f-20 r10 r2 f-20 r10"}));

TEST(Cycles, FeedsSpindleAndDwell) {
    const Recording out = drill("CYCLE85(10,0,2,-20,,0.5,80,200)\nCYCLE84(10,0,2,-20,,,3,6,,,500,600)");
    ASSERT_EQ(out.problems, "");
    ASSERT_EQ(out.motions.size(), 9U);
    EXPECT_EQ(*out.motions[2].state.feed.value, 80.0);
    EXPECT_EQ(*out.motions[3].state.feed.value, 200.0);
    // M6: 1 mm of pitch at 500 and, on the way out, 600 rpm the other way round.
    EXPECT_EQ(*out.motions[6].state.feed.value, 500.0);
    EXPECT_EQ(out.motions[6].state.spindle, SpindleTurn::Clockwise);
    EXPECT_EQ(*out.motions[7].state.feed.value, 600.0);
    EXPECT_EQ(out.motions[7].state.spindle, SpindleTurn::CounterClockwise);
    EXPECT_EQ(out.motions[8].state.spindle, SpindleTurn::Clockwise);
    bool dwelt = false;
    for (const auto& [place, event] : out.events)
        if (const auto* dwell = std::get_if<DwellTime>(&event)) dwelt = dwell->seconds == 0.5;
    EXPECT_TRUE(dwelt);
}

TEST(Cycles, BoringStepsAsideWithTheSpindleAtRest) {
    const Recording out = drill("CYCLE86(10,0,2,-20,,,4,-1,2,0.5,0)");
    ASSERT_EQ(out.problems, "");
    ASSERT_EQ(out.motions.size(), 7U);
    EXPECT_EQ(out.motions[2].state.spindle, SpindleTurn::CounterClockwise);
    EXPECT_NEAR(norm(out.motions[3].motion.end_pose->tip_mm - Vector3{-1, 2, -19.5}), 0.0, 1e-12);
    EXPECT_EQ(out.motions[3].state.spindle, SpindleTurn::Off);
    EXPECT_NEAR(norm(out.motions[6].motion.end_pose->tip_mm - Vector3{0, 0, 10}), 0.0, 1e-12);
    EXPECT_EQ(out.motions[6].state.spindle, SpindleTurn::CounterClockwise);
}

TEST(Cycles, ATapTurnsTheSpindleByTheSignOfItsPitch) {
    const Recording out = drill("M5\nCYCLE84(10,0,2,-20,,,5,,-1,,500,500)");
    ASSERT_EQ(out.problems, "");
    EXPECT_EQ(out.motions[2].state.spindle, SpindleTurn::CounterClockwise);
    EXPECT_EQ(out.motions[3].state.spindle, SpindleTurn::Clockwise);
    EXPECT_EQ(out.motions[4].state.spindle, SpindleTurn::Off);
}

TEST(Cycles, InASwivelledPlane) {
    const Recording out =
        runLines("G54 F100\nCYCLE800(1,\"TC\",0,57,0,0,0,90,0,0,0,0,0,-1)\nG0 X0 Y0 Z50\nCYCLE81(10,0,2,-20)");
    ASSERT_EQ(out.problems, "");
    EXPECT_NEAR(norm(out.motions[2].motion.end_pose->tip_mm - Vector3{0, 20, 0}), 0.0, 1e-12);
}

}  // namespace
}  // namespace cusp::post::reader::test
