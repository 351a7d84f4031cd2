// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Work offsets, tilted planes, compensation, and the sequences of the machine file, as steps.
#include "planner_fixture.hpp"

namespace cusp::post {
namespace {

TEST_F(Planner, EveryProgrammingFrameHasItsWorkOffset) {
    const auto operation = [](const std::string& name, const std::string& msys) {
        return "TOOL PATH/" + name + ",TOOL,BALL_6\nTLDATA/MILL,6.0,3.0,50.0,0.0,0.0\nMSYS/" + msys +
               "\nRAPID\nGOTO/0.0,0.0,9.0,0.0,0.0,1.0\nFEDRAT/MMPM,100.0\nGOTO/0.0,0.0,0.0\nEND-OF-PATH\n";
    };
    const std::string flat = ",1.0,0.0,0.0,0.0,1.0,0.0";
    const std::string cl = "UNITS/MM\nSPINDL/RPM,100,CLW\n" + operation("A", "0.0,0.0,0.0" + flat) +
                           operation("B", "50.0,0.0,5.0" + flat) + operation("C", "0.0,0.0,0.0" + flat);
    const std::string text = plan(cl);
    EXPECT_FALSE(report.hasErrors()) << base::toText(report);
    const auto second = text.find("comment work offset G55: the programming frame, origin X50.0000 Y0.0000 Z5.0000");
    ASSERT_NE(second, std::string::npos) << text;
    EXPECT_NE(text.find("work-offset G55\n", second), std::string::npos);
    EXPECT_NE(text.find("work-offset G54\n", text.find("operation C")), std::string::npos);
    ASSERT_EQ(summary.work_offsets.size(), 2U);
    EXPECT_EQ(summary.work_offsets[1].name, "G55");

    PostOptions chosen;
    chosen.work_offsets = {"G505", "G57"};
    plan(cl, chosen);
    EXPECT_EQ(summary.work_offsets[0].name, "G505");
    EXPECT_EQ(summary.work_offsets[1].name, "G57");
    chosen.work_offsets = {"G599"};
    report = base::Diagnostics();
    plan(cl, chosen);
    ASSERT_TRUE(report.hasErrors());
    EXPECT_EQ(base::toText(report),
              "part.cls:13: error: no work offset is left for this programming frame (MSYS): give more names in "
              "work_offsets [post.work-offsets]\n");
}

TEST_F(Planner, ATurnedFrameIsToldOnce) {
    plan(
        std::string(head) + "SPINDL/RPM,100,CLW\nFEDRAT/MMPM,100.0\nGOTO/0.0,0.0,0.0,0.0,0.0,1.0\nEND-OF-PATH\n" +
        "TOOL PATH/OP2,TOOL,BALL_6\nMSYS/0.0,0.0,5.0,0.0,1.0,0.0,-1.0,0.0,0.0\nGOTO/0.0,0.0,0.0,0.0,0.0,1.0\nEND-OF-PATH\n");
    EXPECT_EQ(
        base::toText(report),
        "part.cls:9: warning: the programming frame of G55 is turned by 90° against that of G54: the workpiece has to "
        "lie so in G55, and the offset itself stays without rotation [post.turned-frame]\n");
}

TEST_F(Planner, APlaneOfSolidWorksIsTilted) {
    // The plane of CSYS leans to +X: its Z is world X, its X world −Z. An arc and a hole in it.
    const std::string cl = "PARTNO/1\nUNIT/MM\nCUTTER/6,0,3,0,0,0,50\nLOAD/TOOL,4\nSPINDL/500,RPM,CLW\n"
                           "TRNTYP/WORLD,0,0,0\nCSYS/0,0,1,0,0,1,0,0,-1,0,0,0\nRAPID/\nGOTO/30,10,0,1,0,0\n"
                           "FEDRAT/600,MMPM\nGOTO/20,10,0,1,0,0\nCIRCLE/20,0,0,1,0,0\nGOTO/20,0,10,1,0,0\n"
                           "RAPID/\nGOTO/30,0,10,1,0,0\nCYCLE/DRILL,FEDTO,5,MMPM,100,RAPTO,3,RTRCTO,10\n"
                           "GOTO/20,4,5,1,0,0\nCYCLE/OFF\nFINI\n";
    const std::string text = plan(cl);
    ASSERT_FALSE(report.hasErrors()) << base::toText(report);
    const auto body = text.find("tilted-plane");
    ASSERT_NE(body, std::string::npos) << text;
    EXPECT_EQ(
        text.substr(body, text.find("spindle off") - body),
        "tilted-plane X0.0000 Y90.0000 Z0.0000 at X0.0000 Y0.0000 Z0.0000 C90.0000 A90.0000\n"
        "approach rapid X0.0000 Y10.0000 Z30.0000 C90.0000 A90.0000\n"
        "move feed X0.0000 Y10.0000 Z20.0000 C90.0000 A90.0000 600.000 mm/min\n"
        "arc ccw X-10.0000 Y0.0000 Z20.0000 I0.0000 J-10.0000 C90.0000 A90.0000 600.000 mm/min\n"
        "move rapid X-10.0000 Y0.0000 Z30.0000 C90.0000 A90.0000\n"
        "hole-cycle drill retract Z30.0000 surface Z20.0000 clearance 3.0000 depth 5.0000 dwell 0.000 peck 0.0000 "
        "0.0000 pitch 0.0000 100.000 mm/min\n"
        "hole X-5.0000 Y4.0000 C90.0000 A90.0000\n"
        "hole-cycle off\n"
        "plane-off\n");
    file.control.swivel.available = false;
    plan(cl);
    EXPECT_EQ(
        base::toText(report),
        "part.cls:17: error: a hole that is not along Z needs a tilted plane (CYCLE800), and the machine file says it "
        "has none [post.cycle]\n");
}

TEST_F(Planner, CutterCompensationBeginsInAStraightMove) {
    const std::string cut = "UNITS/MM\nLOADTL/4\nSPINDL/500,RPM,CLW\nFEDRAT/600,MMPM\nRAPID\nGOTO/0,0,0\n";
    EXPECT_NE(plan(cut + "CUTCOM/LEFT\nGOTO/10,0,0\nGOTO/20,0,0\nCUTCOM/OFF\nGOTO/20,10,0\nFINI\n")
                  .find("radius-compensation left\nmove feed X10.0000 Y0.0000 Z0.0000 C0.0000 A0.0000 600.000 mm/min\n"
                        "move feed X20.0000 Y0.0000 Z0.0000 C0.0000 A0.0000 600.000 mm/min\nradius-compensation off\n"),
              std::string::npos);
    EXPECT_TRUE(report.empty()) << base::toText(report);
    plan(cut + "CUTCOM/LEFT\nCIRCLE/0,10,0,0,0,1,10\nGOTO/10,10,0\nFINI\n");
    EXPECT_EQ(
        base::toText(report),
        "part.cls:8: error: cutter compensation (CUTCOM) begins or ends on an arc: an 840D takes a straight move for it "
        "[post.radius-compensation]\n");
}

TEST_F(Planner, AnOperationAtThePartBeginsWithItsModalState) {
    const std::string op = "RAPID\nGOTO/0.0,0.0,9.0,0.0,0.0,1.0\nFEDRAT/MMPM,100.0\nGOTO/0.0,0.0,0.0\nEND-OF-PATH\n";
    const std::string cl = std::string(head) + "SPINDL/RPM,8000,CLW\nCOOLNT/ON\n" + op +
                           "TOOL PATH/OP2,TOOL,BALL_6\nTLDATA/MILL,6.0,3.0,50.0,0.0,0.0\n" + op;
    const std::string again = "modal-start\nsmoothing on\nblock D1\nwork-offset G54\nspindle cw 8000.000 rpm\n"
                              "coolant flood\ntip-programming on\nmove rapid X0.0000 Y0.0000 Z9.0000";
    const std::string text = plan(cl);
    EXPECT_NE(text.find(again, text.find("operation OP2")), std::string::npos) << text;
    EXPECT_EQ(summary.tool_changes, 1U);
    file.control.sequence.operations_from_home = true;
    const std::string from_home = plan(cl);
    EXPECT_NE(from_home.find("go-home\ncomment operation OP2\nmessage OP2\nchange-tool \"BALL_6\"\nblock M6\n"
                             "smoothing on\n"),
              std::string::npos)
        << from_home;
}

TEST_F(Planner, TheSequenceIsTheMachineFiles) {
    file.control.sequence.tool_change = {"{tool}", "L6", "D1"};
    file.control.sequence.retract = {"{coolant_off}", "{transformation_off}", "{home}", "{spindle_off}"};
    file.control.sequence.program_end = {"M2"};
    const std::string text = plan(std::string(head) + "SPINDL/RPM,100,CLW\nFEDRAT/MMPM,100.0\n"
                                                      "GOTO/0.0,0.0,0.0,0.0,0.0,1.0\nEND-OF-PATH\n");
    EXPECT_NE(text.find("change-tool \"BALL_6\"\nblock L6\nblock D1\n"), std::string::npos) << text;
    EXPECT_TRUE(text.ends_with("tip-programming off\ngo-home\nspindle off\nblock M2\n")) << text;
}

TEST_F(Planner, ASmoothingFinerThanThePathIsTold) {
    const std::string cut = "UNITS/MM\nLOADTL/4\nSPINDL/500,RPM,CLW\nFEDRAT/600,MMPM\nGOTO/0,0,0\n";
    plan("INTOL/0.005\nOUTTOL/0.01\n" + cut);
    EXPECT_TRUE(report.empty()) << base::toText(report);
    plan("INTOL/0.005\nOUTTOL/0.03\n" + cut);
    ASSERT_EQ(report.warningCount(), 1U) << base::toText(report);
    EXPECT_EQ(report.front().code, "post.smoothing-tolerance");
}

}  // namespace
}  // namespace cusp::post
