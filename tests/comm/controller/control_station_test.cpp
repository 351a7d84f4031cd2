// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A sender and a station in one process: the chain a caller builds, over a real link, as fast as possible.
#include "control_bench.hpp"

#include <cusp/comm/controller/control_station.hpp>

#include <atomic>
#include <gtest/gtest.h>
#include <thread>

namespace cusp::comm::test {
namespace {

TransferOutcome sendTo(const std::string& url, const std::string& text, SenderOptions options) {
    auto link = openLink(parseLinkUrl(url).value());
    EXPECT_TRUE(link.has_value());
    Sender sender({.name = "P.MPF", .text = text}, std::move(options), (*link)->traits());
    runTransfer(sender, **link, base::noProgress());
    return sender.outcome();
}

/// Steps the station until `done`, at most 60 s.
template <class Done>
void stepUntil(ControlStation& station, const Done& done) {
    const double until_s = transferClockSeconds() + 60.0;
    while (!done() && transferClockSeconds() < until_s) ASSERT_TRUE(station.step(0.005).has_value());
    ASSERT_TRUE(done());
}

/// A transfer from another thread while the station is stepped by this one, then its program run to the end.
void deliverAndRun(ControlStation& station, const std::string& url, const std::string& text, bool drip) {
    std::atomic<bool> sent{false};
    TransferOutcome outcome;
    std::thread sender([&] {
        SenderOptions options;
        options.mode = drip ? TransferMode::Drip : TransferMode::Store;
        options.arm = true;
        outcome = sendTo(url, text, options);
        sent = true;
    });
    bool started = false;
    stepUntil(station, [&] {
        if (!started && station.receiver().state() == ReceiverState::Armed) started = station.start();
        return sent && started && station.control().status().finished;
    });
    sender.join();
    EXPECT_EQ(outcome.end, TransferEnd::Delivered) << outcome.code << ": " << outcome.message;
    EXPECT_EQ(station.control().status().starvations, 0u);
}

TEST(ControlStation, RunsWhatModbusBringsFasterThanTheClock) {
    const FiveAxisProgram program = fiveAxisProgram(1500, 0.5);
    Bench alone("fooke-endura-ca");
    ASSERT_TRUE(alone.control.select("P.MPF", program.text));
    ASSERT_TRUE(alone.control.start());
    alone.control.runToRest(600.0);
    for (const bool drip : {false, true}) {
        ControlOptions options;
        options.fifo_bytes = 16 * 1024;
        Bench bench("fooke-endura-ca", options);
        ControlStation station(bench.control, {.boot_seed = 5, .pace = Pace::AsFastAsPossible});
        const auto url = station.listen("modbus-tcp://127.0.0.1:0");
        ASSERT_TRUE(url.has_value());
        deliverAndRun(station, *url + "?connections=4", program.text, drip);
        EXPECT_EQ(bench.control.status().axes, alone.control.status().axes);
        EXPECT_LE(bench.limitUse(), 1.0 + 1e-5);
        std::printf("%s: %.1f s of the control's time\n", drip ? "drip" : "stored", bench.control.status().time_s);
    }
}

TEST(ControlStation, LinksThatCannotBeListenedOnAreErrors) {
    Bench bench("three-axis");
    ControlStation station(bench.control, {});
    EXPECT_EQ(station.listen("nonsense").error().front().code, "link.url");
    EXPECT_EQ(station.listen("tcp://0.0.0.0:0").error().front().code, "link.not-loopback");
}

/// G54 at X0 with tool A of 100 mm, G55 at X100 with tool B of 160 mm; the axes have to differ by just that.
TEST(ControlSetup, EveryToolAndEveryWorkOffsetHasItsOwnPlace) {
    const auto setup = machine::readSetup("schema = 1\nname = \"two\"\n"
                                          "[work_offset.G54]\norigin_mm = [0.0, 0.0, -700.0]\n"
                                          "[work_offset.G55]\norigin_mm = [100.0, 20.0, -650.0]\n"
                                          "[[tool]]\nname = \"A\"\nlength_mm = 100.0\n"
                                          "[[tool]]\nnumber = 2\nlength_mm = 160.0\n",
                                          "two.toml");
    ASSERT_TRUE(setup.has_value());
    ControlOptions options;
    options.setup = &*setup;
    Bench bench("three-axis", options);
    const std::string program = "G17 G90 G94\nSUPA G0 Z0 D0\nT=\"A\"\nM6\nD1\nG54 G1 F6000 X10 Y20 Z30\nM0\n"
                                "SUPA G0 Z0 D0\nT2\nM6\nD1\nG55 G1 X10 Y20 Z30\nM0\nM30\n";
    ASSERT_TRUE(bench.control.select("P.MPF", program));
    ASSERT_TRUE(bench.control.start());
    bench.control.runToRest(100.0);
    ASSERT_EQ(bench.control.status().waiting_for, "M0")
        << (bench.control.status().alarms.empty() ? "" : bench.control.status().alarms.front().text);
    const auto first = bench.control.status().axes;
    EXPECT_NEAR((bench.control.status().tool.tip_mm - geometry::Vector3(10.0, 20.0, 30.0)).norm(), 0.0, 1e-9);
    ASSERT_TRUE(bench.control.start());
    bench.control.runToRest(100.0);
    const auto second = bench.control.status().axes;
    EXPECT_NEAR((bench.control.status().tool.tip_mm - geometry::Vector3(10.0, 20.0, 30.0)).norm(), 0.0, 1e-9);
    EXPECT_NEAR(second[0] - first[0], 100.0, 1e-9);
    EXPECT_NEAR(second[1] - first[1], 20.0, 1e-9);
    EXPECT_NEAR(second[2] - first[2], 50.0 + 60.0, 1e-9);
    EXPECT_LE(bench.limitUse(), 1.0 + 1e-5);
    // Another tool or offset is another tip with the same axes, and no motion.
    Bench watched("three-axis", options);
    ASSERT_TRUE(watched.control.select("P.MPF", program));
    ASSERT_TRUE(watched.control.start());
    double fastest = 0.0;
    for (int i = 0; i < 20'000 && !watched.control.status().finished; ++i) {
        watched.control.advance(options.tick_s);
        fastest = std::max(fastest, watched.control.status().feed_mm_per_s);
        static_cast<void>(watched.control.status().waiting_for == "M0" && watched.control.start());
    }
    EXPECT_TRUE(watched.control.status().finished);
    EXPECT_LT(fastest, 2000.0) << "mm/s, three rapids together";
    for (const auto& [text, number] : {std::pair{"G90 G54\nT=\"C\"\nM6\nD1\nG1 F100 X1\nM30\n", alarm::no_tool_length},
                                       std::pair{"G90 G56\nT2\nM6\nD1\nG1 F100 X1\nM30\n", alarm::no_work_offset}}) {
        Bench other("three-axis", options);
        ASSERT_TRUE(other.control.select("P.MPF", text));
        ASSERT_TRUE(other.control.start());
        other.control.runToRest(10.0);
        ASSERT_EQ(other.control.status().alarms.size(), 1u);
        EXPECT_EQ(other.control.status().alarms.front().number, number) << other.control.status().alarms.front().text;
    }
}

}  // namespace
}  // namespace cusp::comm::test
