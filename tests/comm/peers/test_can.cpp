// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The CAN adapter on real SocketCAN: our ISO-TP and the kernel's, classic and FD, each against the other, and against a
// control in Python; can-utils; and netem between two interfaces.
#include "../dnc/served_control.hpp"

#include <cusp/base/child_process.hpp>

#include <cctype>
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

/// can-utils' own ISO-TP tools ask the control for its status and print what it answers.
TEST_F(SocketCan, CanUtilsAreAnswered) {
    if (!base::runProcess({"isotpsend", "-?"}, {.wall_s = 10.0})) GTEST_SKIP() << "can-utils are not installed";
    test::ServedControl control("can://vcan0?transport=own");
    RequestMessage status;
    status.type = RequestType::Status;
    status.tag = 77;
    std::string hex;
    for (const std::uint8_t byte : encode(status)) {
        char digits[4];
        std::snprintf(digits, sizeof digits, "%02x ", byte);
        hex += digits;
    }
    const std::string ids = "-s 700 -d 701 vcan0";
    // Asked again until the listener, started beside it, has heard the answer: a status may be asked for any number of times.
    const auto ran =
        base::runProcess({"/bin/sh", "-c",
                          "out=$(mktemp); timeout 20 isotprecv " + ids + " > $out & for i in $(seq 200); do echo '" +
                              hex + "' | isotpsend " + ids + "; [ -s $out ] && break; done; wait; cat $out; rm $out"},
                         {.wall_s = 40.0});
    ASSERT_TRUE(ran.has_value());
    std::string answer = ran->output;
    for (char& c : answer) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    EXPECT_EQ(answer.substr(0, 12), "c5 01 00 4d ")
        << "magic, version, tag 77; it said: " << ran->output << ran->errors;
}

/// A pair of CAN interfaces between which netem does harm.
class HarmedCan : public ::testing::TestWithParam<const char*> {
protected:
    void SetUp() override {
        if (::if_nametoindex("vx0") == 0) GTEST_SKIP() << "no vxcan pair vx0, vx1 on this machine";
        const auto set = base::runProcess(words("add"), {.wall_s = 20.0});
        if (!set || set->exit_code != 0) GTEST_SKIP() << "tc cannot set netem: " << (set ? set->errors : "no tc");
    }
    void TearDown() override { static_cast<void>(base::runProcess(words("del"), {.wall_s = 20.0})); }
    static std::vector<std::string> words(const std::string& what) {
        return {"/bin/sh", "-c",
                "for i in 0 1; do tc qdisc " + what + " dev vx$i root" +
                    (what == "add" ? std::string(" netem ") + GetParam() : "") + " || exit 1; done"};
    }
};

TEST_P(HarmedCan, EndsBitExactOrExplained) {
    std::string program;
    for (int line = 10; program.size() < 3'000; line += 10)
        program += "N" + std::to_string(line) + " G1 X" + std::to_string(line * 37 % 1000) + "\n";
    test::ServedControl control("can://vx1?transport=own");
    auto link = openLink(parseLinkUrl("can://vx0?transport=own").value());
    ASSERT_TRUE(link.has_value()) << base::toText(link.error());
    SenderOptions options;
    options.first_timeout_s = 0.3;
    options.most_timeout_s = 0.5;
    options.silence_s = 5.0;
    options.first_chunk_bytes = 128;
    Sender sender({.name = "P.MPF", .text = program}, options, (*link)->traits());
    runTransfer(sender, **link, base::noProgress());
    control.stop();
    const bool delivered = sender.outcome().end == TransferEnd::Delivered;
    const std::string& stored = control.host.programs["P.MPF"];
    EXPECT_TRUE(stored.empty() || stored == program) << "silent corruption";
    EXPECT_TRUE(delivered ? stored == program : sender.outcome().resumable && !sender.outcome().message.empty());
    std::printf("netem %s: %s, %llu of %llu chunks repeated\n", GetParam(),
                delivered ? "delivered" : sender.outcome().code.c_str(),
                static_cast<unsigned long long>(sender.statistics().chunks_repeated),
                static_cast<unsigned long long>(sender.statistics().chunks_sent));
}

INSTANTIATE_TEST_SUITE_P(Netem, HarmedCan,
                         ::testing::Values("loss 1%", "duplicate 2%", "corrupt 1%", "delay 1ms 1ms",
                                           "delay 2ms reorder 10%", "loss 2% duplicate 1% corrupt 1%"));

}  // namespace
}  // namespace cusp::comm
