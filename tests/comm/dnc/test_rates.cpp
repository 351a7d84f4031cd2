// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Rates in virtual time: how near a whole transfer, opening and commit included, comes to what the link can carry; and
// the check of a program's need against it.
#include "memory_host.hpp"
#include "virtual_medium.hpp"

#include <cusp/comm/dnc/sender.hpp>

#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

namespace cusp::comm {
namespace {

using namespace test;

std::string linesOf(std::size_t bytes) {
    std::string out;
    for (int line = 10; out.size() < bytes; line += 10) out += "N" + std::to_string(line) + " X1.234 Y-5.678 Z0.125\n";
    return out;
}

/// One transfer over a sound link; bytes per second of virtual time.
template <class SomeMedium, class Rates>
double rateOver(const Rates& rates, std::size_t bytes, Sender::Phase* last = nullptr) {
    Timeline timeline;
    MemoryHost host;
    host.store_bytes = bytes * 2;
    Receiver receiver({}, host, 1);
    SomeMedium medium(timeline, {}, base::Random(1), rates);
    medium.peer = [&](ByteView request) { return receiver.handle(request, timeline.nowSeconds()); };
    medium.peer_area = [&](ReplyArea area) { return receiver.area(area); };
    Sender sender({.name = "P.MPF", .text = linesOf(bytes)}, {}, medium.traits());
    double wake_s = -1.0;
    std::function<void()> pump = [&] {
        while (!sender.over() && medium.ready()) {
            const auto request = sender.poll(timeline.nowSeconds());
            if (!request) break;
            medium.send(*request);
        }
        const double next_s = sender.nextWakeSeconds(timeline.nowSeconds());
        if (sender.over() || (wake_s > timeline.nowSeconds() && wake_s <= next_s)) return;
        wake_s = next_s;
        timeline.at(next_s, pump);
    };
    medium.on_reply = [&](ByteView reply) {
        sender.receive(reply, timeline.nowSeconds());
        pump();
    };
    medium.on_ready = pump;
    pump();
    while (!sender.over() && timeline.step()) {
    }
    EXPECT_EQ(sender.outcome().end, TransferEnd::Delivered) << sender.outcome().message;
    EXPECT_EQ(sender.statistics().chunks_repeated, 0U);
    if (last != nullptr) *last = sender.phase();
    return static_cast<double>(sender.totalBytes()) / timeline.nowSeconds();
}

void expectShare(const char* link, double rate, double limit) {
    std::printf("%s: %.2f kB/s of %.2f kB/s, %.1f %%\n", link, rate / 1e3, limit / 1e3, 100.0 * rate / limit);
    EXPECT_GE(rate, 0.95 * limit) << link;
    EXPECT_LE(rate, limit) << link << ": faster than the link is no rate";
}

TEST(Rates, Rs232At115200) { expectShare("RS-232 115200", rateOver<StreamMedium>(StreamRates{}, 200'000), 11520.0); }

TEST(Rates, ModbusRtuAt115200) {
    // The limit: function 16 with all 123 registers of which 9 are the chunk's header, and its confirmation of 8 bytes.
    const RegisterRates rates;
    Timeline timeline;
    const RegisterMedium medium(timeline, {}, base::Random(1), rates);
    const double limit = 228.0 / medium.transactionSeconds(9 + 246, 8);
    expectShare("Modbus RTU 115200", rateOver<RegisterMedium>(rates, 200'000), limit);
}

TEST(Rates, CanAtOneMegabit) {
    for (const bool fd : {false, true}) {
        CanRates rates;
        rates.fd = fd;
        Timeline timeline;
        const CanMedium medium(timeline, {}, base::Random(1), rates);
        const double limit = fd ? 63.0 / medium.frameSeconds(64) : 7.0 / medium.frameSeconds(8);
        expectShare(fd ? "CAN FD 1M/5M" : "CAN 1 Mbit/s", rateOver<CanMedium>(rates, 1'000'000), limit);
    }
}

TEST(Rates, ModbusTcpOverALongRoundTripNeedsConnections) {
    RegisterRates rates;
    rates.exchanges = true;
    rates.bytes_per_s = 12.5e6;
    rates.silence_s = 0.0;
    rates.latency_s = 0.010;
    const double one = rateOver<RegisterMedium>(rates, 100'000);
    rates.connections = 8;
    const double eight = rateOver<RegisterMedium>(rates, 400'000);
    std::printf("Modbus TCP, 20 ms round trip: 1 connection %.2f kB/s, 8 connections %.2f kB/s\n", one / 1e3,
                eight / 1e3);
    EXPECT_LT(one, 11.6e3);
    EXPECT_GE(eight, 4.0 * 11.6e3);
}

DemandProfile constantDemand(double bytes_per_s, double seconds) {
    DemandProfile out;
    out.steps.assign(static_cast<std::size_t>(std::round(seconds / out.step_s)),
                     {bytes_per_s * out.step_s, bytes_per_s * out.step_s / 50.0});
    return out;
}

TEST(Demand, AConstantNeedIsTheClosedForm) {
    // 60 s at 10 kB/s from 30 kB of buffer: starves when need × t = buffer + link × t.
    const DemandProfile demand = constantDemand(10'000.0, 60.0);
    const RateCheck slow = checkRate(demand, 8'000.0, 30'000.0);
    ASSERT_TRUE(slow.starves_at_s.has_value());
    EXPECT_NEAR(*slow.starves_at_s, 30'000.0 / 2'000.0, demand.step_s + 1e-9);
    EXPECT_NEAR(slow.needed_bytes_per_s, (600'000.0 - 30'000.0) / 60.0, 1.0);
    EXPECT_NEAR(slow.mean_bytes_per_s, 10'000.0, 1e-6);
    EXPECT_NEAR(slow.peak_blocks_per_s, 200.0, 1e-6);
    EXPECT_FALSE(checkRate(demand, 9'600.0, 30'000.0).starves_at_s.has_value());
    EXPECT_FALSE(checkRate(demand, 0.0, 600'000.0).starves_at_s.has_value()) << "all of it is buffered";
}

TEST(Demand, ABurstIsBornByTheBufferOrNot) {
    DemandProfile demand = constantDemand(1'000.0, 100.0);
    for (std::size_t i = 500; i < 510; ++i) demand.steps[i] = {2'000.0, 40.0};  // one second of 20 kB/s
    const RateCheck small = checkRate(demand, 5'000.0, 10'000.0);
    ASSERT_TRUE(small.starves_at_s.has_value());
    EXPECT_NEAR(*small.starves_at_s, 50.0 + (10'000.0 / 15'000.0), 0.11);
    EXPECT_NEAR(small.peak_bytes_per_s, 20'000.0, 1e-6);
    EXPECT_NEAR(small.peak_at_s, 50.0, 1e-6);
    EXPECT_FALSE(checkRate(demand, 5'000.0, 16'000.0).starves_at_s.has_value());
    EXPECT_EQ(
        toText(small),
        "the link brings 5.00 kB/s; the program needs 1.19 kB/s in the mean and up to 20.00 kB/s (400 blocks/s) at "
        "0:50; with 10.0 kB buffered it starves at 0:50, and would need a link of 10.00 kB/s");
}

}  // namespace
}  // namespace cusp::comm
