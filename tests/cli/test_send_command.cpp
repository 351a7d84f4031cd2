// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp send` from the outside: to a control in this process, into a folder, and back; exit codes, JSON, ledger.
#include "../comm/dnc/served_control.hpp"
#include "../comm/link/fault_bridge.hpp"
#include "command_line.hpp"

#include <cusp/base/hash.hpp>
#include <cusp/comm/dnc/ledger.hpp>

namespace cusp::cli {
namespace {

using comm::test::ServedControl;

const std::string program_text = "N10 G90 G94\nN20 G1 X1 F1000\nN30 X2\nN40 M30\n";

class SendCommand : public CommandLine {
protected:
    void SetUp() override {
        CommandLine::SetUp();
        program = write("P.MPF", program_text);
    }
    base::ProcessOutcome send(std::vector<std::string> more) {
        std::vector<std::string> arguments{"send"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        if (std::ranges::find(arguments, "--no-ledger") == arguments.end())
            arguments.insert(arguments.end(), {"--ledger", path("ledger.sqlite")});
        return run(arguments);
    }
    std::string program;
};

TEST_F(SendCommand, DeliversVerifiesComparesAndRecords) {
    ServedControl control("tcp://127.0.0.1:0");
    const auto outcome = send({program, "--to", control.url(), "--compare", "--arm", "--measure", "--operator",
                               "shift 2", "--control", "mill 7", "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    const auto json = nlohmann::json::parse(outcome.output);
    EXPECT_EQ(json["end"], "delivered");
    EXPECT_EQ(json["bytes"], program_text.size());
    EXPECT_EQ(json["blocks"], 4);
    EXPECT_EQ(json["digest"], base::sha256Hex(program_text));
    EXPECT_TRUE(json["compared"]);
    EXPECT_TRUE(json["armed"]);
    EXPECT_GT(json["link_bytes_per_s"].get<double>(), 1000.0);
    control.stop();
    EXPECT_EQ(control.host.programs["P.MPF"], program_text);

    auto ledger = comm::Ledger::open(path("ledger.sqlite"));
    ASSERT_TRUE(ledger.has_value());
    const auto entries = ledger->last(10).value();
    ASSERT_EQ(entries.size(), 2U);
    EXPECT_EQ(entries[0].event, "begun");
    EXPECT_EQ(entries[1].event, "delivered");
    EXPECT_EQ(entries[1].transfer, json["transfer"]);
    EXPECT_EQ(entries[1].operator_label, "shift 2");
    EXPECT_EQ(entries[1].machine, "mill 7");
    EXPECT_EQ(entries[1].digest, base::sha256Hex(program_text));
    EXPECT_EQ(ledger->firstBroken().value(), 0);
}

TEST_F(SendCommand, BringsAProgramBack) {
    ServedControl control("modbus-tcp://127.0.0.1:0");
    ASSERT_EQ(send({program, "--to", control.url() + "?connections=2"}).exit_code, 0);
    const auto outcome = send({"--fetch", "P.MPF", "-o", path("BACK.MPF"), "--to", control.url()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_EQ(read("BACK.MPF"), program_text);
    const auto missing = send({"--fetch", "NONE.MPF", "-o", path("NONE.MPF"), "--to", control.url()});
    EXPECT_EQ(missing.exit_code, 1);
    EXPECT_EQ(missing.errors, control.url() + ": error: NONE.MPF: the control has no such program [dnc.not-found]\n");
    EXPECT_EQ(left(), (std::vector<std::string>{"BACK.MPF", "P.MPF", "ledger.sqlite"}));
}

TEST_F(SendCommand, ARefusalAndAMissingControlHaveTheirExitCodes) {
    std::string url;
    {
        ServedControl control("tcp://127.0.0.1:0");
        url = control.url();
        control.host.refuse_with = comm::Reason::Refused;
        const auto refused = send({program, "--to", url, "--json"});
        EXPECT_EQ(refused.exit_code, 1);
        EXPECT_EQ(refused.errors, url + ": error: P.MPF was refused: the control refuses the program [dnc.refused]\n");
        EXPECT_EQ(nlohmann::json::parse(refused.output)["end"], "refused");
    }
    const auto gone = send({program, "--to", url});
    EXPECT_EQ(gone.exit_code, 4);
    EXPECT_EQ(gone.errors, url + ": error: cannot open: Connection refused [io.link-open]\n");
    const auto entries = comm::Ledger::open(path("ledger.sqlite"))->last(10).value();
    ASSERT_EQ(entries.size(), 4U);
    EXPECT_EQ(entries[1].event, "refused");
    EXPECT_EQ(entries[3].event, "no link");
}

TEST_F(SendCommand, AStartNeedsTheOperator) {
    ServedControl control("tcp://127.0.0.1:0");
    const auto outcome = send({program, "--to", control.url(), "--start"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.errors.find("the start is not enabled at the control"), std::string::npos) << outcome.errors;
    control.stop();
    EXPECT_EQ(control.host.starts, 0);
    EXPECT_EQ(control.host.programs["P.MPF"], program_text);
}

/// Whoever sends while another's program is armed learns why nothing happens.
TEST_F(SendCommand, AHeldControlIsSaidToBeHeld) {
    comm::ReceiverOptions options;
    options.lease_s = 0.5;
    ServedControl control("tcp://127.0.0.1:0", {}, options);
    const auto first = send({program, "--to", control.url(), "--arm"});
    ASSERT_EQ(first.exit_code, 0) << first.errors;
    EXPECT_EQ(first.errors.find("[dnc.busy]"), std::string::npos);
    const auto second = send({program, "--to", control.url()});
    EXPECT_EQ(second.exit_code, 0) << second.errors;
    EXPECT_NE(second.errors.find("the control is held for another sender or a program just armed; asking again for up "
                                 "to 40 s [dnc.busy]"),
              std::string::npos)
        << second.errors;
}

TEST_F(SendCommand, WhatIsNoTextIsDoubted) {
    ServedControl control("tcp://127.0.0.1:0");
    const std::string text("%PDF-1.4\n\0\0\xff\n", 13);
    const auto outcome = send({write("D.MPF", text), "--to", control.url()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_NE(outcome.errors.find("holds NUL bytes, as no NC program does; it is sent all the same [send.binary]"),
              std::string::npos)
        << outcome.errors;
    control.stop();
    EXPECT_EQ(control.host.programs["D.MPF"], text);
}

TEST_F(SendCommand, AKeyIsSentWithTheCommit) {
    const std::string key = write("key", "open sesame\n");
    ServedControl control("tcp://127.0.0.1:0", {}, {.commit_key = "open sesame"});
    const auto without = send({program, "--to", control.url()});
    EXPECT_EQ(without.exit_code, 1);
    EXPECT_NE(without.errors.find("demands a key"), std::string::npos) << without.errors;
    EXPECT_EQ(send({program, "--to", control.url(), "--key-file", key}).exit_code, 0);
}

TEST_F(SendCommand, DripFeedsRefuseBackwardJumps) {
    const std::string looping =
        write("LOOP.MPF", "N10 G1 X1 F100\n; GOTOB in a comment\nN20 MSG(\"GOTOB\")\nN30 GOTOB A1\n");
    const auto outcome = send({looping, "--to", "tcp://127.0.0.1:1", "--drip"});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_EQ(outcome.errors, looping +
                                  ":4: error: may lead backward, where a drip-fed program is gone already; send it "
                                  "whole [send.jumps]\n");
}

TEST_F(SendCommand, ASlowLinkIsRefusedWithItsNumbersBeforeTheStart) {
    // 600 blocks of 1 mm at 60 m/min in about 0.6 s: some 10 kB that a 1 kB/s line cannot bring.
    std::string fast = "N1 G90 G94 G17 G710\nN2 G54\nN3 G1 X0 Y0 Z0 F60000\n";
    for (int i = 1; i <= 4000; ++i) fast += "N" + std::to_string(10 + i) + " X" + std::to_string(i % 200) + "\n";
    fast += "M30\n";
    const std::string file = write("FAST.MPF", fast);
    comm::test::BridgeFaults slow;
    slow.bytes_per_s = 4000.0;
    comm::test::PtyBridge bridge(slow, 1);
    ServedControl control("serial://" + bridge.right());
    control.host.fifo_bytes = 1000;
    const auto outcome =
        send({file, "--to", "serial://" + bridge.left() + "?baud=38400", "--drip", "-m", "fooke-endura-ca", "--json"});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.errors;
    const auto json = nlohmann::json::parse(outcome.output);
    EXPECT_EQ(json["code"], "dnc.link-too-slow");
    EXPECT_EQ(json["confirmed_bytes"], 0);
    EXPECT_LT(json["rate_check"]["link_bytes_per_s"].get<double>(), 4000.0);
    EXPECT_GT(json["rate_check"]["needed_bytes_per_s"].get<double>(), 4000.0);
}

TEST_F(SendCommand, FoldersGetAnAtomicCopyItsDigestAndACaller) {
    std::filesystem::create_directory(folder / "share");
    const auto outcome = send({program, "--to", "file://" + path("share"), "--extcall", "--json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_EQ(read("share/P.MPF"), program_text);
    EXPECT_EQ(read("share/P.MPF.sha256"), base::sha256Hex(program_text) + "  P.MPF\n");
    EXPECT_NE(read("share/CALL_P.MPF").find("EXTCALL(\"P.MPF\")\nM30\n"), std::string::npos);
    const auto missing = send({program, "--to", "file://" + path("none")});
    EXPECT_EQ(missing.exit_code, 4);
    EXPECT_EQ(missing.errors, path("none") + ": error: is no folder that can be reached [io.no-folder]\n");
}

TEST_F(SendCommand, ResumesWithAPreambleOnly) {
    ServedControl control("tcp://127.0.0.1:0");
    const std::string preamble = write("PRE.MPF", "G90 G94 F1000\n");
    EXPECT_EQ(send({program, "--to", control.url(), "--resume-block", "30"}).exit_code, 2) << "no machine file either";
    EXPECT_EQ(send({program, "--to", control.url(), "--resume-block", "30", "--preamble", preamble}).exit_code, 0);
    EXPECT_EQ(send({program, "--to", control.url(), "--resume-block", "31", "--preamble", preamble}).exit_code, 3);
    control.stop();
    EXPECT_EQ(control.host.programs["P.MPF"], "G90 G94 F1000\nN30 X2\nN40 M30\n");
}

TEST_F(SendCommand, WrongUrlsSayWhatWouldBeRight) {
    const auto wrong = [&](const std::string& url) {
        const auto outcome = send({program, "--to", url});
        EXPECT_EQ(outcome.exit_code, 3);
        return outcome.errors;
    };
    EXPECT_EQ(wrong("ftp://x"), "error: ftp://x: begins with none of tcp://, serial://, modbus-tcp://, modbus-rtu://, "
                                "can://, file:// [link.url]\n");
    EXPECT_EQ(wrong("tcp://x"), "error: tcp://x: names no port: tcp://192.168.0.10:5000 [link.url]\n");
    EXPECT_EQ(send({"--to", "tcp://127.0.0.1:1"}).exit_code, 2);
}

TEST_F(SendCommand, NothingIsSentThatCannotBeRecorded) {
    ServedControl control("tcp://127.0.0.1:0");
    const auto outcome = run({"send", program, "--to", control.url(), "--ledger", path("no/such/folder/l.sqlite")});
    EXPECT_EQ(outcome.exit_code, 4);
    EXPECT_EQ(outcome.errors,
              path("no/such/folder/l.sqlite") + ": error: ledger: unable to open database file [io.ledger]\n");
    control.stop();
    EXPECT_TRUE(control.host.programs.empty());
}

}  // namespace
}  // namespace cusp::cli
