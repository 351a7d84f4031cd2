// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp send` and `cusp controller` as two processes on every link: stored byte for byte, run, recorded and verified.
#include "../comm/link/fault_bridge.hpp"
#include "command_line.hpp"
#include "running_command.hpp"

#include <cmath>
#include <cstdio>
#include <memory>

namespace cusp::cli {
namespace {

const std::vector<std::string> place{"--wcs-origin-mm", "3000", "0", "-700"};

/// Winds in five axes, numbered; about 45 bytes a block.
std::string windingProgram(int blocks, double feed = 6000.0) {
    std::string text =
        "N1 G40 G17 G710 G94 G90 G60 G601\nN2 TRAFOOF\nN3 SUPA G0 Z0 D0\nN4 T=\"BALL_10\"\nN5 M6\nN6 D1\n"
        "N7 CYCLE832(0.01,_ORI_FINISH,0.1)\nN8 G54\nN9 S8000 M3\nN10 G0 C20 A15\nN11 TRAORI\nN12 G54\n"
        "N13 ORIAXES\nN14 G0 X0 Y0 C20 A15\nN15 Z30\nN16 G1 Z0 F" +
        std::to_string(static_cast<int>(feed)) + "\n";
    for (int i = 1; i <= blocks; ++i) {
        const double s = 0.5 * i;
        char block[160];
        std::snprintf(block, sizeof block, "N%d X%.5f Y%.5f Z%.5f C%.5f A%.5f\n", 16 + i, 40.0 * std::sin(s / 40.0),
                      0.05 * s + 0.4 * std::sin(s / 7.0), 2.0 * std::cos(s / 25.0) - 2.0,
                      20.0 + 10.0 * std::sin(s / 60.0), 15.0 + 5.0 * std::sin(s / 45.0));
        text += block;
    }
    return text + "N90001 G0 Z100\nN90002 TRAFOOF\nN90003 SUPA G0 Z0 D0\nN90004 M30\n";
}

class EndToEnd : public CommandLine {
protected:
    std::vector<std::string> controller(std::vector<std::string> more) const {
        std::vector<std::string> out{"controller", "-m", "fooke-endura-ca"};
        out.insert(out.end(), place.begin(), place.end());
        out.insert(out.end(), more.begin(), more.end());
        return out;
    }
    base::ProcessOutcome send(const std::string& file, const std::string& url, std::vector<std::string> more = {}) {
        std::vector<std::string> words{"send", file, "--to", url, "--no-ledger"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }
    /// Delivered over `to` and compared, stored byte for byte, armed, run to its end.
    void deliverAndRun(RunningCommand& control, const std::string& to) {
        // Line ends and bytes that a text mode would change.
        const std::string text = "; \xC3\xA4 \xFF\r\n" + windingProgram(60);
        const std::string program = write("P.MPF", text);
        const auto sent = send(program, to, {"--compare", "--arm"});
        ASSERT_EQ(sent.exit_code, 0) << sent.errors;
        EXPECT_NE(sent.output.find("compared byte by byte, armed"), std::string::npos) << sent.output;
        EXPECT_EQ(read("store/P.MPF"), text);
        control.type("start");
        control.behind("program finished");
        EXPECT_EQ(control.end(), 0);
    }
    void SetUp() override {
        CommandLine::SetUp();
        std::filesystem::create_directory(folder / "store");
    }
};

TEST_F(EndToEnd, Tcp) {
    RunningCommand control(controller({"--listen", "tcp://127.0.0.1:0", "--store", path("store")}));
    deliverAndRun(control, control.behind("listening on "));
}

TEST_F(EndToEnd, ModbusTcp) {
    RunningCommand control(controller({"--listen", "modbus-tcp://127.0.0.1:0", "--store", path("store")}));
    deliverAndRun(control, control.behind("listening on ") + "?connections=4");
}

TEST_F(EndToEnd, Serial) {
    comm::test::PtyBridge bridge({}, 1);
    RunningCommand control(controller({"--listen", "serial://" + bridge.right(), "--store", path("store")}));
    control.behind("listening on ");
    deliverAndRun(control, "serial://" + bridge.left());
}

TEST_F(EndToEnd, ModbusRtu) {
    comm::test::PtyBridge bridge({}, 1);
    RunningCommand control(
        controller({"--listen", "modbus-rtu://" + bridge.right() + "?parity=N", "--store", path("store")}));
    control.behind("listening on ");
    deliverAndRun(control, "modbus-rtu://" + bridge.left() + "?parity=N");
}

TEST_F(EndToEnd, ADripFedProgramRunsWhileItComes) {
    RunningCommand control(controller({"--listen", "tcp://127.0.0.1:0", "--store", path("store"), "--fifo-kb", "16"}));
    const std::string text = windingProgram(700);
    const std::string url = control.behind("listening on ");
    control.type("enable 60");
    control.type("status");
    control.behind("override 100");  // whatever was typed before has been done
    const auto sent = send(write("P.MPF", text), url, {"--drip", "--start"});
    EXPECT_EQ(sent.exit_code, 0) << sent.errors;
    control.behind("program finished");
    EXPECT_EQ(read("store/P.MPF"), text);
    EXPECT_EQ(control.said().find("alarm"), std::string::npos) << control.said();
    EXPECT_EQ(control.end(), 0);
}

/// The connection breaks in the middle of a drip feed: the tool lifts, an alarm says where to resume, and the rest is sent from
/// there behind a computed preamble and runs to its end.
TEST_F(EndToEnd, AStarvedProgramIsResumed) {
    RunningCommand control(controller({"--listen", "tcp://127.0.0.1:0", "--fifo-kb", "16"}));
    const std::string url = control.behind("listening on ");
    const auto port = static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1)));
    auto bridge = std::make_unique<comm::test::TcpBridge>(port, comm::test::BridgeFaults{}, 1);
    const std::string program = write("P.MPF", windingProgram(1200));
    control.type("enable 60");
    control.type("status");
    control.behind("override 100");
    {
        RunningCommand sender({"send", program, "--to", "tcp://127.0.0.1:" + std::to_string(bridge->port()), "--drip",
                               "--start", "--no-ledger"});
        control.behind("control active");
        bridge.reset();
        const std::string alarm = control.behind("alarm 700001 at line ");
        const std::string behind = "resume at line ";
        const std::size_t at = alarm.find(behind);
        ASSERT_NE(at, std::string::npos) << alarm;
        // Line and block number are the same in this program.
        const std::string resume = alarm.substr(at + behind.size());
        EXPECT_GT(std::stoi(resume), 17);
        control.forget();
        control.type("reset");
        control.behind("control reset, transfer idle");
        const auto rest =
            send(program, url, {"-m", "fooke-endura-ca", "--resume-block", resume, "--arm", "--name", "REST"});
        ASSERT_EQ(rest.exit_code, 0) << rest.errors;
    }
    control.type("override 120");
    control.type("start");
    control.behind("program finished");
    EXPECT_EQ(control.end(), 0);
}

TEST_F(EndToEnd, WhatWasRunIsWhatWasProgrammed) {
    const std::string program = write("P.MPF", windingProgram(150));
    auto words = controller({"--run", program, "--record", path("R.csv")});
    ASSERT_EQ(run(words).exit_code, 0);
    std::vector<std::string> verifying{
        "verify", program, "-m", "fooke-endura-ca", "--record", path("R.csv"), "--tool-length-mm", "100", "--json"};
    verifying.insert(verifying.end(), place.begin(), place.end());
    const auto good = run(verifying);
    EXPECT_EQ(good.exit_code, 0) << good.output << good.errors;
    const auto json = nlohmann::json::parse(good.output);
    EXPECT_TRUE(json["execution"]["pass"]);
    EXPECT_EQ(json["execution"]["points"], 151);
    EXPECT_EQ(json["execution"]["unreached"], 0);
    EXPECT_LT(json["execution"]["max_tip_mm"]["value"].get<double>(), 0.011);
    EXPECT_GT(json["execution"]["max_tip_mm"]["value"].get<double>(), 1e-6) << "smoothing rounds something";
    // Of another program it is no record.
    const std::string other = write("Q.MPF", windingProgram(152));
    verifying[1] = other;
    const auto bad = run(verifying);
    EXPECT_EQ(bad.exit_code, 1);
    EXPECT_NE(bad.errors.find("[execution.unreached]"), std::string::npos) << bad.errors;
    verifying[5] = write("broken.csv", "time_s\n1\n");
    const auto broken = run(verifying);
    EXPECT_EQ(broken.exit_code, 3);
    EXPECT_NE(broken.errors.find("the first line names no column 'tip_x_mm' [record.heading]"), std::string::npos);
}

}  // namespace
}  // namespace cusp::cli
