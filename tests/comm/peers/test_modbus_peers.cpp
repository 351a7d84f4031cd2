// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Somebody else's Modbus, and the protocol written again from its page: pymodbus and mbpoll against our libmodbus ends.
#include "../dnc/served_control.hpp"
#include "../link/fault_bridge.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/child_process.hpp>

#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace cusp::comm {
namespace {

// The interpreter of the Debian packages, not one that happens to come first in PATH.
const std::string python = "/usr/bin/python3";
const std::string peer = CUSP_SOURCE_DIR "/tests/comm/peers/modbus_peer.py";

std::string programText() {
    std::string out;
    for (int line = 10; out.size() < 6000; line += 10)
        out += "N" + std::to_string(line) + " G1 X" + std::to_string(line * 37 % 1000) + "\n";
    return out;
}

class ModbusPeers : public ::testing::Test {
protected:
    void SetUp() override {
        const auto probe =
            base::runProcess({python, "-c", "import pymodbus, serial, serial_asyncio"}, {.wall_s = 30.0});
        if (!probe || !probe->succeeded())
            GTEST_SKIP() << "no independent peer here: python3-pymodbus and python3-serial-asyncio are not installed";
        const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
        folder = std::filesystem::path(::testing::TempDir()) /
                 (std::string("cusp_peer_") + info->name() + std::to_string(::getpid()));
        std::filesystem::create_directories(folder);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    /// The peer sends a program to a control of ours.
    void peerSends(test::ServedControl* control, const std::string& link) {
        ASSERT_TRUE(base::writeWholeFile((folder / "P.MPF").string(), programText()).has_value());
        const auto ran =
            base::runProcess({python, peer, "send", link, (folder / "P.MPF").string(), "P.MPF"}, {.wall_s = 60.0});
        ASSERT_TRUE(ran.has_value());
        EXPECT_EQ(ran->output, "verified\n") << ran->errors;
        control->stop();
        EXPECT_TRUE(control->host.programs["P.MPF"] == programText());
    }
    /// We send a program to a control of the peer's.
    void peerReceives(const std::string& link, const std::string& url) {
        const std::string stored = (folder / "STORED").string();
        std::FILE* pipe = ::popen((python + " " + peer + " control " + link + " " + stored + " 2>&1").c_str(), "r");
        ASSERT_NE(pipe, nullptr);
        char line[256] = {};
        EXPECT_STREQ(std::fgets(line, sizeof line, pipe), "ready\n");
        const auto opened = openLink(parseLinkUrl(url).value());
        ASSERT_TRUE(opened.has_value()) << base::toText(opened.error());
        Sender sender({.name = "P.MPF", .text = programText()}, {.arm = true}, (*opened)->traits());
        runTransfer(sender, **opened, base::noProgress());
        EXPECT_EQ(sender.outcome().end, TransferEnd::Delivered) << sender.outcome().message;
        EXPECT_TRUE(sender.outcome().armed);
        std::string rest;
        while (std::fgets(line, sizeof line, pipe) != nullptr) rest += line;
        EXPECT_EQ(::pclose(pipe), 0);
        EXPECT_EQ(rest, "verified P.MPF\n");
        EXPECT_TRUE(base::readWholeFile(stored, 1U << 20U).value_or("") == programText());
    }
    static std::uint16_t freePort() {
        const int descriptor = ::socket(AF_INET, SOCK_STREAM, 0);
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        EXPECT_EQ(::bind(descriptor, reinterpret_cast<sockaddr*>(&address), size), 0);
        ::getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size);
        ::close(descriptor);
        return ntohs(address.sin_port);
    }
    std::filesystem::path folder;
};

TEST_F(ModbusPeers, PymodbusSendsOverTcp) {
    test::ServedControl control("modbus-tcp://127.0.0.1:0");
    peerSends(&control, "tcp:" + std::to_string(control.port()));
}

// A pseudo terminal has no parity, and glibc tells whoever asks for it: none here.
TEST_F(ModbusPeers, PymodbusSendsOverRtu) {
    test::PtyBridge bridge({}, 1);
    test::ServedControl control("modbus-rtu://" + bridge.right() + "?parity=N");
    peerSends(&control, "rtu:" + bridge.left());
}

TEST_F(ModbusPeers, PymodbusReceivesOverTcp) {
    const std::string port = std::to_string(freePort());
    peerReceives("tcp:" + port, "modbus-tcp://127.0.0.1:" + port + "?connections=3");
}

TEST_F(ModbusPeers, PymodbusReceivesOverRtu) {
    test::PtyBridge bridge({}, 1);
    peerReceives("rtu:" + bridge.right(), "modbus-rtu://" + bridge.left() + "?parity=N");
}

TEST(Mbpoll, ReadsTheMagicOfTheRegisterMap) {
    test::ServedControl control("modbus-tcp://127.0.0.1:0");
    const auto ran = base::runProcess({"mbpoll", "-0", "-1", "-q", "-t", "4:hex", "-r", "0", "-c", "2", "-p",
                                       std::to_string(control.port()), "127.0.0.1"},
                                      {.wall_s = 30.0});
    if (!ran) GTEST_SKIP() << "mbpoll is not installed";
    EXPECT_EQ(ran->exit_code, 0) << ran->output << ran->errors;
    EXPECT_NE(ran->output.find("0xC501"), std::string::npos) << ran->output;
}

}  // namespace
}  // namespace cusp::comm
