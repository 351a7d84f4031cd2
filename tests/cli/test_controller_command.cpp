// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp controller` from the outside.
#include "command_line.hpp"

namespace cusp::cli {
namespace {

using ControllerCommand = CommandLine;

const std::string small_program = "G54 G90 G60\nSUPA G1 F6000 X50\nG4 F2\nM30\n";

TEST_F(ControllerCommand, RunsAProgramInVirtualTime) {
    const std::string program = write("P.MPF", small_program);
    const auto outcome = run({"controller", "-m", "three-axis", "--run", program, "--json", "--record", path("P.csv")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    const auto json = nlohmann::json::parse(outcome.output);
    EXPECT_EQ(json["command"], "controller");
    EXPECT_EQ(json["finished"], true);
    EXPECT_EQ(json["blocks"], 1);
    EXPECT_EQ(json["alarms"].size(), 0u);
    // 50 mm at 100 mm/s, two seconds of dwell, and some tenths to reach the feed.
    EXPECT_GT(json["time_s"].get<double>(), 2.5);
    EXPECT_LT(json["time_s"].get<double>(), 3.0);
    const std::string record = read("P.csv");
    EXPECT_EQ(record.substr(0, record.find('\n')),
              "time_s,X_mm,Y_mm,Z_mm,tip_x_mm,tip_y_mm,tip_z_mm,axis_i,axis_j,axis_k,line");
    EXPECT_NE(record.find(",50.000000,0.000000,0.000000,"), std::string::npos);
}

TEST_F(ControllerCommand, AnAlarmIsFoundAndSaid) {
    const std::string program = write("P.MPF", "G54 G90\nSUPA G1 F6000 X99999\nM30\n");
    const auto outcome = run({"controller", "-m", "three-axis", "--run", program});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.output.find("alarm 10720 at line 2: axis X would go to 99999.000 mm"), std::string::npos)
        << outcome.output;
}

TEST_F(ControllerCommand, ExitCodes) {
    EXPECT_EQ(run({"controller", "-m", "three-axis"}).exit_code, 2);
    EXPECT_EQ(run({"controller", "-m", "three-axis", "--run", path("absent")}).exit_code, 4);
    EXPECT_EQ(run({"controller", "-m", "three-axis", "--listen", "nonsense"}).exit_code, 3);
    const auto outside = run({"controller", "-m", "three-axis", "--listen", "tcp://0.0.0.0:0"});
    EXPECT_NE(outside.exit_code, 0);
    EXPECT_NE(outside.errors.find("link.not-loopback"), std::string::npos) << outside.errors;
    EXPECT_EQ(
        run({"controller", "-m", "three-axis", "--listen", "tcp://127.0.0.1:0", "--store", path("absent")}).exit_code,
        4);
}

TEST_F(ControllerCommand, ListensAndObeysTheOperator) {
    const auto outcome =
        run({"controller", "-m", "three-axis", "--listen", "tcp://127.0.0.1:0"}, "start\nhelp\nstatus\nquit\n");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_EQ(outcome.output.substr(0, 29), "listening on tcp://127.0.0.1:");
    EXPECT_NE(outcome.output.find("nothing to start\n"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("reset  line 0 feed 0.0 mm/min override 100 %"), std::string::npos) << outcome.output;
}

}  // namespace
}  // namespace cusp::cli
