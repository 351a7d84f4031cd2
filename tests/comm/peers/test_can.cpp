// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The CAN adapter on real SocketCAN: our ISO-TP and the kernel's, classic and FD, each against the other, and against a
// control in Python.
#include "../dnc/served_control.hpp"

#include <cusp/base/child_process.hpp>

#include <cstdio>
#include <gtest/gtest.h>
#include <net/if.h>
#include <string>

namespace cusp::comm {
namespace {

std::string programText() {
    std::string out;
    for (int line = 10; out.size() < 20'000; line += 10)
        out += "N" + std::to_string(line) + " G1 X" + std::to_string(line * 37 % 1000) + "\n";
    return out;
}

struct Pairing {
    const char* sender;
    const char* control;
};

class SocketCan : public ::testing::TestWithParam<Pairing> {
protected:
    void SetUp() override {
        if (::if_nametoindex("vcan0") == 0)
            GTEST_SKIP()
                << "no CAN interface vcan0 on this machine (tests/comm/peers/can_machine.sh starts one that has it)";
    }
};

TEST_P(SocketCan, CarriesAndComparesAProgram) {
    const std::string control_url = std::string("can://vcan0?") + GetParam().control;
    const std::string sender_url = std::string("can://vcan0?") + GetParam().sender;
    test::ServedControl control(control_url);
    auto link = openLink(parseLinkUrl(sender_url).value());
    ASSERT_TRUE(link.has_value()) << base::toText(link.error());
    Sender sender({.name = "P.MPF", .text = programText()}, {.compare = true, .arm = true}, (*link)->traits());
    runTransfer(sender, **link, base::noProgress());
    EXPECT_EQ(sender.outcome().end, TransferEnd::Delivered)
        << sender.outcome().code << ": " << sender.outcome().message;
    EXPECT_TRUE(sender.outcome().compared);
    control.stop();
    EXPECT_TRUE(control.host.programs["P.MPF"] == programText());
    std::printf("%s -> %s: %llu chunks, %llu repeated\n", sender_url.c_str(), control_url.c_str(),
                static_cast<unsigned long long>(sender.statistics().chunks_sent),
                static_cast<unsigned long long>(sender.statistics().chunks_repeated));
}

INSTANTIATE_TEST_SUITE_P(Pairings, SocketCan,
                         ::testing::Values(Pairing{"transport=own", "transport=own"},
                                           Pairing{"transport=own&fd=1", "transport=own&fd=1"},
                                           Pairing{"transport=own", "transport=kernel"},
                                           Pairing{"transport=kernel", "transport=own"},
                                           Pairing{"transport=own&fd=1", "transport=kernel&fd=1"},
                                           Pairing{"transport=kernel&fd=1", "transport=own&fd=1"},
                                           Pairing{"transport=kernel", "transport=kernel"}));

TEST_F(SocketCan, PythonsSocketsReceiveAProgram) {
    const std::string peer = CUSP_SOURCE_DIR "/tests/comm/peers/can_peer.py";
    std::FILE* pipe = ::popen(("/usr/bin/python3 " + peer + " vcan0 2>&1").c_str(), "r");
    ASSERT_NE(pipe, nullptr);
    char line[256] = {};
    EXPECT_STREQ(std::fgets(line, sizeof line, pipe), "ready\n");
    auto link = openLink(parseLinkUrl("can://vcan0?transport=own").value());
    ASSERT_TRUE(link.has_value()) << base::toText(link.error());
    Sender sender({.name = "P.MPF", .text = programText()}, {.arm = true}, (*link)->traits());
    runTransfer(sender, **link, base::noProgress());
    EXPECT_EQ(sender.outcome().end, TransferEnd::Delivered)
        << sender.outcome().code << ": " << sender.outcome().message;
    EXPECT_STREQ(std::fgets(line, sizeof line, pipe), ("verified " + base::sha256Hex(programText()) + "\n").c_str());
    EXPECT_EQ(::pclose(pipe), 0);
}

}  // namespace
}  // namespace cusp::comm
