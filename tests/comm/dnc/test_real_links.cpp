// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The protocol over the real adapters: sockets, pseudo terminals, libmodbus; sound, slow, and through a bridge that harms.
#include "../link/fault_bridge.hpp"
#include "served_control.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <gtest/gtest.h>
#include <map>

namespace cusp::comm {
namespace {

using test::BridgeFaults;
using test::PtyBridge;
using test::ServedControl;
using test::TcpBridge;

std::string programOf(std::size_t bytes) {
    base::Random random(7);
    std::string out;
    for (int line = 10; out.size() < bytes; line += 10)
        out += "N" + std::to_string(line) + " X" + std::to_string(random.integer(-99999, 99999)) + "\n";
    return out;
}

struct Sent {
    TransferOutcome outcome;
    SenderStatistics statistics;
    double seconds = 0.0;
};

Sent sendOver(const std::string& url, const std::string& program, SenderOptions options = {}) {
    auto link = openLink(parseLinkUrl(url).value());
    if (!link) {
        Sent failed;
        failed.outcome.code = "io";
        failed.outcome.message = base::toText(link.error());
        return failed;
    }
    Sender sender({.name = "P.MPF", .text = program}, options, (*link)->traits());
    const double begin_s = transferClockSeconds();
    runTransfer(sender, **link, base::noProgress());
    return {sender.outcome(), sender.statistics(), transferClockSeconds() - begin_s};
}

void expectDelivered(const Sent& sent, ServedControl& control, const std::string& program) {
    EXPECT_EQ(sent.outcome.end, TransferEnd::Delivered) << sent.outcome.code << ": " << sent.outcome.message;
    control.stop();
    EXPECT_TRUE(control.host.programs["P.MPF"] == program);
}

TEST(RealLinks, TcpCarriesAndComparesAProgram) {
    ServedControl control("tcp://127.0.0.1:0");
    const std::string program = programOf(300'000);
    const Sent sent = sendOver(control.url(), program, {.compare = true, .arm = true});
    EXPECT_TRUE(sent.outcome.compared);
    EXPECT_TRUE(sent.outcome.armed);
    expectDelivered(sent, control, program);
}

TEST(RealLinks, ModbusTcpCarriesAndComparesAProgram) {
    ServedControl control("modbus-tcp://127.0.0.1:0");
    const std::string program = programOf(30'000);
    const Sent sent = sendOver(control.url() + "?connections=4", program, {.compare = true});
    EXPECT_TRUE(sent.outcome.compared);
    expectDelivered(sent, control, program);
}

TEST(RealLinks, SerialCarriesAndComparesAProgram) {
    PtyBridge bridge({}, 1);
    ServedControl control("serial://" + bridge.right() + "?flow=xonxoff");
    const std::string program = programOf(20'000);
    const Sent sent = sendOver("serial://" + bridge.left() + "?flow=xonxoff", program, {.compare = true});
    EXPECT_TRUE(sent.outcome.compared);
    expectDelivered(sent, control, program);
}

TEST(RealLinks, ModbusRtuCarriesAndComparesAProgram) {
    PtyBridge bridge({}, 1);
    ServedControl control("modbus-rtu://" + bridge.right());
    const std::string program = programOf(5'000);
    const Sent sent = sendOver("modbus-rtu://" + bridge.left(), program, {.compare = true});
    EXPECT_TRUE(sent.outcome.compared);
    expectDelivered(sent, control, program);
}

/// 50 seeded schedules in real time: `run` sends once over a link with these faults.
void campaign(const char* name, const std::function<Sent(const BridgeFaults&, std::uint64_t, std::string&)>& run) {
    std::map<std::string, int> ends;
    const std::string program = programOf(900);
    for (std::uint64_t seed = 500; seed < 550; ++seed) {
        base::Random random(seed);
        BridgeFaults faults;
        const auto rate = [&] { return random.chance(0.5) ? random.uniform(0.0, 0.15) : 0.0; };
        faults.loss = rate();
        faults.duplication = rate();
        faults.corruption = rate();
        faults.disconnect = random.chance(0.2) ? 0.02 : 0.0;
        faults.piece_bytes = static_cast<std::size_t>(random.integer(40, 500));
        std::string stored;
        const Sent sent = run(faults, seed, stored);
        const bool delivered = sent.outcome.end == TransferEnd::Delivered;
        ++ends[delivered ? "delivered" : sent.outcome.code];
        EXPECT_TRUE(stored.empty() || stored == program) << name << ", seed " << seed << ": stored something else";
        EXPECT_TRUE(!delivered || stored == program) << name << ", seed " << seed;
        EXPECT_TRUE(delivered || (sent.outcome.resumable && !sent.outcome.message.empty()))
            << name << ", seed " << seed << ": " << sent.outcome.code << ' ' << sent.outcome.message;
    }
    std::printf("%s, 50 real-time schedules from seed 500:", name);
    for (const auto& [end, count] : ends) std::printf(" %s %d", end.c_str(), count);
    std::printf("\n");
    EXPECT_GT(ends["delivered"], 25);
}

SenderOptions hasty() {
    SenderOptions options;
    options.first_chunk_bytes = 120;
    options.first_timeout_s = 0.1;
    options.most_timeout_s = 0.2;
    options.silence_s = 3.0;
    return options;
}

template <class Bridge>
std::function<Sent(const BridgeFaults&, std::uint64_t, std::string&)> overTcp(const std::string& scheme,
                                                                              const std::string& parameters) {
    return [=](const BridgeFaults& faults, std::uint64_t seed, std::string& stored) {
        ServedControl control(scheme + "://127.0.0.1:0");
        const Bridge bridge(control.port(), faults, seed);
        Sent sent =
            sendOver(scheme + "://127.0.0.1:" + std::to_string(bridge.port()) + parameters, programOf(900), hasty());
        // A connection that was never made leaves nothing to resume, and nothing behind.
        if (sent.outcome.code == "io") sent.outcome.resumable = true;
        control.stop();
        stored = control.host.programs["P.MPF"];
        return sent;
    };
}

std::function<Sent(const BridgeFaults&, std::uint64_t, std::string&)> overPty(const std::string& scheme,
                                                                              const std::string& parameters) {
    return [=](BridgeFaults faults, std::uint64_t seed, std::string& stored) {
        faults.disconnect = 0.0;
        const PtyBridge bridge(faults, seed);
        ServedControl control(scheme + "://" + bridge.right());
        const Sent sent = sendOver(scheme + "://" + bridge.left() + parameters, programOf(900), hasty());
        control.stop();
        stored = control.host.programs["P.MPF"];
        return sent;
    };
}

TEST(RealLinkCampaign, Tcp) { campaign("tcp", overTcp<TcpBridge>("tcp", "")); }
TEST(RealLinkCampaign, ModbusTcp) {
    campaign("modbus-tcp", overTcp<TcpBridge>("modbus-tcp", "?connections=2&timeout_ms=60"));
}
TEST(RealLinkCampaign, Serial) { campaign("serial", overPty("serial", "")); }
TEST(RealLinkCampaign, ModbusRtu) { campaign("modbus-rtu", overPty("modbus-rtu", "?timeout_ms=60")); }

}  // namespace
}  // namespace cusp::comm
