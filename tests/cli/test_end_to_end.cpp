// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp send` and `cusp controller` as two processes on every link: stored byte for byte, run, recorded and verified.
#include "../comm/link/fault_bridge.hpp"
#include "command_line.hpp"
#include "running_command.hpp"
#include "winding_program.hpp"

namespace cusp::cli {
namespace {

class EndToEnd : public CommandLine {
protected:
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
    // More than the FIFO holds, so that the program runs by then, and less than all of it.
    comm::test::TcpBridge bridge(port, {.dies_after_bytes = 30'000}, 1);
    const std::string program = write("P.MPF", windingProgram(1200));
    control.type("enable 60");
    control.type("status");
    control.behind("override 100");
    RunningCommand sender({"send", program, "--to", "tcp://127.0.0.1:" + std::to_string(bridge.port()), "--drip",
                           "--start", "--no-ledger"});
    control.behind("control active");
    const std::string alarm = control.behind("alarm 700001 at line ");
    const std::string behind = "resume at line ";
    const std::size_t at = alarm.find(behind);
    ASSERT_NE(at, std::string::npos) << alarm;
    // Line and block number are the same in this program.
    const std::string resume = alarm.substr(at + behind.size());
    EXPECT_GT(std::stoi(resume), 17);
    EXPECT_LT(std::stoi(resume), 30'000 / 45 + 17);
    control.forget();
    control.type("reset");
    control.behind("control reset, transfer idle");
    const auto rest =
        send(program, url, {"-m", "fooke-endura-ca", "--resume-block", resume, "--arm", "--name", "REST"});
    ASSERT_EQ(rest.exit_code, 0) << rest.errors;
    control.type("start");
    control.behind("program finished");
    EXPECT_EQ(control.end(), 0);
}

/// One in real time: as long by the clock as by the control.
TEST_F(EndToEnd, ByTheClock) {
    const std::string program = write("P.MPF", "G54 G90 G60\nSUPA G1 F6000 X50\nM30\n");
    const auto alone = run({"controller", "-m", "three-axis", "--run", program, "--json"});
    const double needs_s = nlohmann::json::parse(alone.output)["time_s"];
    RunningCommand control({"controller", "-m", "three-axis", "--listen", "tcp://127.0.0.1:0"});
    ASSERT_EQ(send(program, control.behind("listening on "), {"--arm"}).exit_code, 0);
    const auto begin = std::chrono::steady_clock::now();
    control.type("start");
    control.behind("program finished");
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    EXPECT_GT(needs_s, 0.5);
    EXPECT_GE(took.count(), needs_s - 0.25) << "what a step makes up for at most";
    EXPECT_EQ(control.end(), 0);
}

TEST_F(EndToEnd, WhatWasRunIsWhatWasProgrammed) {
    const std::string program = write("P.MPF", windingProgram(150));
    std::vector<std::string> running{"controller", "-m",       "fooke-endura-ca", "--run",
                                     program,      "--record", path("R.csv")};
    running.insert(running.end(), place.begin(), place.end());
    ASSERT_EQ(run(running).exit_code, 0);
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
