// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Drip feeding: the FIFO, starvation, lifting, resuming.
#include "control_bench.hpp"

#include <gtest/gtest.h>

namespace cusp::comm::test {
namespace {

/// Feeds whole lines as the FIFO takes them, at most `bytes_per_s`.
class Dripper {
public:
    Dripper(VirtualControl& control, std::string text, double bytes_per_s)
        : control_(control), text_(std::move(text)), bytes_per_s_(bytes_per_s) {}

    void prefill() {
        while (put(1e9)) continue;
    }
    void run(double seconds) {
        constexpr double slice_s = 0.01;
        for (double t = 0.0; t < seconds && control_.status().state == ChannelState::Active; t += slice_s) {
            credit_ += bytes_per_s_ * slice_s;
            while (put(credit_)) continue;
            control_.advance(slice_s);
        }
    }

private:
    bool put(double most) {
        if (at_ >= text_.size()) return false;
        const std::size_t length = text_.find('\n', at_) + 1 - at_;
        if (static_cast<double>(length) > most || !control_.feed(text_.substr(at_, length))) return false;
        at_ += length;
        credit_ -= static_cast<double>(length);
        if (at_ >= text_.size()) control_.endFeed();
        return true;
    }
    VirtualControl& control_;
    std::string text_;
    double bytes_per_s_;
    double credit_ = 0.0;
    std::size_t at_ = 0;
};

TEST(ControlFifo, AProgramLargerThanTheFifoRunsAsFromMemory) {
    ControlOptions options;
    options.fifo_bytes = 4096;
    const FiveAxisProgram program = fiveAxisProgram(600, 0.5);
    ASSERT_GT(program.text.size(), 20000u);
    Bench memory("fooke-endura-ca", options);
    ASSERT_TRUE(memory.control.select("P.MPF", program.text));
    ASSERT_TRUE(memory.control.start());
    memory.control.runToRest(600.0);
    Bench drip("fooke-endura-ca", options);
    ASSERT_TRUE(drip.control.selectFifo("P.MPF"));
    Dripper dripper(drip.control, program.text, 1e6);
    dripper.prefill();
    EXPECT_LT(drip.control.fifoFree(), 60u);
    ASSERT_TRUE(drip.control.start());
    dripper.run(600.0);
    ASSERT_TRUE(drip.control.status().finished);
    EXPECT_EQ(drip.control.status().starvations, 0u);
    EXPECT_EQ(drip.control.status().axes, memory.control.status().axes);
    EXPECT_NEAR(drip.control.status().time_s, memory.control.status().time_s, 0.1);
}

TEST(ControlFifo, StarvationBrakesLiftsAndSaysWhereToResume) {
    ControlOptions options;
    options.lift_mm = 3.0;
    Bench bench("fooke-endura-ca", options);
    const FiveAxisProgram program = fiveAxisProgram(600, 0.5);
    ASSERT_TRUE(bench.control.selectFifo("P.MPF"));
    // The line breaks in the middle of the cut.
    std::size_t cut = 0;
    for (std::size_t i = 0; i < program.first_cut_line + 299; ++i) cut = program.text.find('\n', cut) + 1;
    ASSERT_TRUE(bench.control.feed(program.text.substr(0, cut)));
    ASSERT_TRUE(bench.control.start());
    bench.control.runToRest(600.0);
    const ControlStatus& status = bench.control.status();
    EXPECT_EQ(status.state, ChannelState::Interrupted);
    ASSERT_EQ(status.alarms.size(), 1u);
    EXPECT_EQ(status.alarms.front().number, 700001);
    EXPECT_EQ(status.starvations, 1u);
    EXPECT_EQ(status.completed_line, program.first_cut_line + 299);
    EXPECT_EQ(status.resume_line, program.first_cut_line + 300);
    const geometry::Vector3& last = program.tips[300];
    EXPECT_NEAR((status.tool.tip_mm - last - 3.0 * status.tool.axis).norm(), 0.0, 1e-5) << "five decimals are printed";
    EXPECT_GT(status.contact_s, 0.01);
    EXPECT_LT(status.contact_s, 0.5);
    EXPECT_LE(bench.limitUse(), 1.0 + 1e-5);
}

TEST(ControlFifo, ALinkSlowerThanTheFeedIsFollowedWithinLimits) {
    ControlOptions options;
    options.fifo_bytes = 8192;
    Bench bench("fooke-endura-ca", options);
    const FiveAxisProgram program = fiveAxisProgram(500, 0.5);
    ASSERT_TRUE(bench.control.selectFifo("P.MPF"));
    Dripper dripper(bench.control, program.text, 3000.0);
    dripper.prefill();
    ASSERT_TRUE(bench.control.start());
    dripper.run(600.0);
    // 53 blocks of 0.5 mm come in a second, and 100 are wanted: the look-ahead shortens, and the feed falls with it.
    EXPECT_TRUE(bench.control.status().finished);
    EXPECT_EQ(bench.control.status().starvations, 0u);
    EXPECT_GT(bench.control.status().time_s, static_cast<double>(program.text.size() - options.fifo_bytes) / 3000.0);
    EXPECT_LE(bench.limitUse(), 1.0 + 1e-5);
}

TEST(ControlFifo, ResetEmptiesIt) {
    Bench bench("fooke-endura-ca");
    ASSERT_TRUE(bench.control.selectFifo("P.MPF"));
    ASSERT_TRUE(bench.control.feed("G54\n"));
    EXPECT_FALSE(bench.control.feed(std::string(40000, 'X')));
    bench.control.reset();
    bench.control.advance(0.01);
    EXPECT_EQ(bench.control.status().fifo_bytes, 0u);
    EXPECT_FALSE(bench.control.feed("G54\n"));
    EXPECT_FALSE(bench.control.start());
}

TEST(ControlFifo, AJumpInDripModeIsAnAlarm) {
    Bench bench("three-axis");
    ASSERT_TRUE(bench.control.selectFifo("P.MPF"));
    ASSERT_TRUE(bench.control.feed("LOOP:\nG54 G90\nG1 F100 SUPA X1\nGOTOB LOOP\n"));
    ASSERT_TRUE(bench.control.start());
    bench.control.runToRest(60.0);
    ASSERT_EQ(bench.control.status().alarms.size(), 1u);
    EXPECT_EQ(bench.control.status().alarms.front().number, 12080);
}

}  // namespace
}  // namespace cusp::comm::test
