// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Payload of whole transfers in real time against what each link can carry: real sockets and pseudo terminals, behind a bridge
// that paces bytes like a line or delays them like a network.
#include "../../tests/comm/dnc/served_control.hpp"
#include "../../tests/comm/link/fault_bridge.hpp"

#include <cstdio>
#include <string>

namespace {

using namespace cusp::comm;
using test::BridgeFaults;
using test::PtyBridge;
using test::ServedControl;
using test::TcpBridge;

std::string linesOf(std::size_t bytes) {
    std::string out;
    for (int line = 10; out.size() < bytes; line += 10) out += "N" + std::to_string(line) + " X1.234 Y-5.678 Z0.125\n";
    return out;
}

/// Bytes a second of one transfer, opening and commit included; 0 when it did not end well.
double rateOf(const std::string& url, std::size_t bytes) {
    auto link = openLink(parseLinkUrl(url).value());
    if (!link) return 0.0;
    Sender sender({.name = "P.MPF", .text = linesOf(bytes)}, {}, (*link)->traits());
    const double begin_s = transferClockSeconds();
    runTransfer(sender, **link, cusp::base::noProgress());
    if (sender.outcome().end != TransferEnd::Delivered) return 0.0;
    return sender.totalBytes() / (transferClockSeconds() - begin_s);
}

void say(const char* link, double rate, double limit) {
    std::printf("%-46s %8.2f kB/s of %8.2f kB/s: %5.1f %%\n", link, rate / 1e3, limit / 1e3, 100.0 * rate / limit);
}

double overPty(const std::string& scheme, const std::string& parameters, std::size_t bytes) {
    BridgeFaults line;
    line.bytes_per_s = 11520.0;
    const PtyBridge bridge(line, 1);
    const ServedControl control(scheme + "://" + bridge.right() + parameters);
    return rateOf(scheme + "://" + bridge.left() + parameters, bytes);
}

double overNetwork(unsigned connections, std::size_t bytes) {
    BridgeFaults network;
    network.delay_s = 0.010;
    const ServedControl control("modbus-tcp://127.0.0.1:0");
    const TcpBridge bridge(control.port(), network, 1);
    return rateOf("modbus-tcp://127.0.0.1:" + std::to_string(bridge.port()) +
                      "?connections=" + std::to_string(connections),
                  bytes);
}

}  // namespace

int main() {
    std::printf("payload in real time; on a busy machine these are lower bounds\n");
    say("serial, 115200 baud, paced", overPty("serial", "", 60'000), 11520.0);
    // Function 16 with 123 registers carries 228 bytes of program in 255 and is confirmed by 8, with silences of 3.5 characters.
    const double transaction_s = (255.0 + 8.0 + 7.0) / 11520.0;
    say("Modbus RTU, 115200 baud, paced", overPty("modbus-rtu", "?parity=N", 40'000), 228.0 / transaction_s);
    const double one_outstanding = 232.0 / 0.020;
    say("Modbus TCP, 20 ms round trip, 1 connection", overNetwork(1, 40'000), one_outstanding);
    say("Modbus TCP, 20 ms round trip, 8 connections", overNetwork(8, 400'000), one_outstanding);
    return 0;
}
