// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Tool calls and cutter shapes, per dialect; turning programs.
#include "cl_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cusp::toolpath::test {
namespace {

const std::string nx_end = "FEDRAT/MMPM,60.\nEND-OF-PATH\n";

TEST(NxTool, LoadToolCarriesNameNumberAndShape) {
    EXPECT_EQ(readOut("TOOL PATH/OP 1,TOOL,T/MILL 2\nTLDATA/MILL,16.,3.,50.,0.,0.\nLOAD/TOOL,7,ADJUST,1\nGOTO/0,0,0\n" +
                      nx_end)
                  .text,
              "1 operation 'OP 1'\n3 tool 7 'T/MILL 2' d=16 r=3 e=5 f=3 a=0 b=0 h=50\n4 go 0 0 0 axis 0 0 1\n"
              "5 feed 1 mm/s\n6 end\n");
}

TEST(NxTool, NameAloneCallsTheToolBeforeItIsUsed) {
    const std::string text =
        readOut("TOOL PATH/A,TOOL,X\nTLDATA/MILL,10.,5.,50.,0.,0.\nSPINDL/RPM,100,CLW\nGOTO/0,0,0\nEND-OF-PATH\n"
                "TOOL PATH/B,TOOL,X\nTLDATA/MILL,10.,5.,50.,0.,0.\nGOTO/1,0,0\nEND-OF-PATH\n"
                "TOOL PATH/C,TOOL,Y\nLOAD/TOOL,0,ADJUST,1\nGOTO/2,0,0\n" +
                nx_end)
            .text;
    EXPECT_EQ(
        text,
        "1 operation 'A'\n3 tool - 'X' d=10 r=5 e=0 f=5 a=0 b=0 h=50\n3 spindle clockwise 100 rpm\n4 go 0 0 0 axis 0 0 1\n"
        "6 operation 'B'\n8 go 1 0 0 axis 0 0 1\n"
        "10 operation 'C'\n11 tool - 'Y'\n12 go 2 0 0 axis 0 0 1\n13 feed 1 mm/s\n14 end\n");
}

TEST(NxTool, TaperAndPointPlaceTheCornerCircle) {
    const ReadOut out = readOut("TOOL PATH/A,TOOL,X\nTLDATA/MILL,10.,2.,50.,10.,20.\nGOTO/0,0,0\n" + nx_end);
    const geometry::Cutter cutter = std::get<ToolCall>(out.records[1].statement).cutter.value();
    // Witness: the distance of the corner circle's centre from both lines is the corner radius.
    const double a = 20.0 * std::numbers::pi / 180.0;
    const double b = 10.0 * std::numbers::pi / 180.0;
    const double edge_height = 5.0 * std::tan(a);
    const double to_tip_line = -cutter.corner_e_mm * std::sin(a) + cutter.corner_f_mm * std::cos(a);
    const double to_flank = (5.0 - cutter.corner_e_mm) * std::cos(b) - (edge_height - cutter.corner_f_mm) * std::sin(b);
    EXPECT_NEAR(to_tip_line, 2.0, 1e-12);
    EXPECT_NEAR(to_flank, 2.0, 1e-12);
}

TEST(NxTool, CornerCirclesThatAreGivenAndDrills) {
    const auto cutterOf = [](const std::string& data) {
        const ReadOut out = readOut("TOOL PATH/A,TOOL,X\nTLDATA/" + data + "\nGOTO/0,0,0\n" + nx_end);
        EXPECT_EQ(out.problems, "");
        return std::get<ToolCall>(out.records[1].statement).cutter.value();
    };
    const geometry::Cutter mill = cutterOf("MILL,10.,2.,50.,0.,0.,2.5,2.25");
    EXPECT_EQ(mill.corner_radius_mm, 2.0);
    EXPECT_EQ(mill.corner_e_mm, 2.5);
    EXPECT_EQ(mill.corner_f_mm, 2.25);
    // Without an upper circle, ten values are seven.
    EXPECT_EQ(cutterOf("MILL,10.,2.,50.,0.,0.,3.,2.,0.,0.,0.").corner_e_mm, 3.0);
    const geometry::Cutter drill = cutterOf("DRILL,MILL,8.,0.,80.,118.,35.");
    EXPECT_EQ(drill.diameter_mm, 8.0);
    EXPECT_EQ(drill.cutting_height_mm, 35.0);
    EXPECT_NEAR(drill.point_angle_rad, 31.0 * std::numbers::pi / 180.0, 1e-15);
    // The sharp edge lies where the cone meets the flank.
    EXPECT_NEAR(drill.corner_e_mm, 4.0, 1e-12);
    EXPECT_NEAR(drill.corner_f_mm, 4.0 * std::tan(31.0 * std::numbers::pi / 180.0), 1e-12);
    EXPECT_NE(readOut("TOOL PATH/A,TOOL,X\nTLDATA/MILL,10.,2.,50.,0.,0.,3.,2.,100.,90.,5.\nGOTO/0,0,0\n" + nx_end)
                  .problems.find("[cl.tool-shape]"),
              std::string::npos);
    EXPECT_EQ(readOut("TOOL PATH/A,TOOL,X\nTLDATA/MILL,10.,x,50.,0.,0.\nGOTO/0,0,0\n" + nx_end).problems,
              "2: error: TLDATA: 'x' is not a number [cl.number]\n");
}

TEST(NxTool, ShapesThatAreNotUnderstoodAreReported) {
    const ReadOut out = readOut("TOOL PATH/A,TOOL,X\nTLDATA/DRILL,MILL,5.,0.\nGOTO/0,0,0\n" + nx_end);
    EXPECT_EQ(out.problems,
              "2: warning: TLDATA/DRILL,MILL,5.,0.: only MILL with 5 or 7 values and DRILL with 5 are understood; "
              "the tool is called without its shape [cl.tool-shape]\n");
    EXPECT_EQ(readOut("TOOL PATH/A\nGOTO/0,0,0\n" + nx_end).problems,
              "1: error: TOOL PATH/operation,TOOL,name is expected [cl.syntax]\n");
}

TEST(CatiaTool, DescribedThenLoaded) {
    const std::string head = "CUTTER/ 16.000000,  0.000000,  8.000000,  4.618802, 30.000000,$\n 0.000000, 50.000000\n";
    EXPECT_EQ(recordsOf(head + "TOOLNO/1,   16.000000\nTPRINT/T1 Drill D 10,comment\nLOADTL/1\nLOADTL/1,1\nGOTO/0,0,0"),
              "5 tool 1 'T1 Drill D 10' d=16 r=0 e=8 f=4.6188 a=0.523599 b=0 h=50\n7 go 0 0 0 axis 0 0 1\n");
}

TEST(CatiaTool, EveryLengthOfCutter) {
    EXPECT_EQ(recordsOf("CUTTER/10\nLOADTL/1"), "2 tool 1 '' d=10 r=0 e=5 f=0 a=0 b=0 h=0\n");
    EXPECT_EQ(recordsOf("CUTTER/10,2\nLOADTL/1"), "2 tool 1 '' d=10 r=2 e=3 f=2 a=0 b=0 h=0\n");
    EXPECT_EQ(recordsOf("CUTTER/10,2,3\nLOADTL/1"), "2 tool 1 '' d=10 r=2 e=3 f=2 a=0 b=0 h=0\n");
    EXPECT_EQ(recordsOf("CUTTER/10,5,0,5,0,0,60\nLOAD/TOOL,2"), "2 tool 2 '' d=10 r=5 e=0 f=5 a=0 b=0 h=60\n");
}

TEST(CatiaTool, Problems) {
    EXPECT_EQ(problemsOf("CUTTER/1,2,3,4,5,6,7,8"), "1: error: CUTTER takes 1 to 7 values, not 8 [cl.syntax]\n");
    EXPECT_EQ(problemsOf("CUTTER/-10"), "1: error: CUTTER/-10 is not a possible cutter [cl.cutter]\n");
    EXPECT_EQ(problemsOf("LOADTL/A"), "1: error: LOADTL/A: the tool's number is expected [cl.tool]\n");
    EXPECT_EQ(problemsOf("LOAD/PART"), "1: error: LOAD/PART is not understood; LOAD/TOOL,number is [cl.tool]\n");
    EXPECT_EQ(problemsOf("TOOLNO/A"), "1: error: TOOLNO/A: the tool's number is expected first [cl.tool]\n");
    EXPECT_EQ(
        recordsOf("CUTTER/10\nTOOLNO/3\nLOADTL/4"),
        "3 tool 4 ''\n3: warning: LOADTL calls tool 4, but TOOLNO described tool 3: the tool is called without name and "
        "shape [cl.tool]\n");
    EXPECT_EQ(problemsOf("CUTTER/10\nGOTO/0,0,0\nGOTO/1,0,0"),
              "2: warning: a tool is described, but no LOADTL or LOAD/TOOL calls it before this motion "
              "[cl.tool-not-called]\n");
}

TEST(Turning, IsRefusedAtOnce) {
    const std::string text = "CUTTER/ 0.8\nTOOLNO/1,TURN,1,0,3, 0.4,$\n 0.1,MMPR, 500,SFM,$\nCCLW,ON\nCIRCLE/1\n";
    EXPECT_EQ(problemsOf(text), "2: error: this is a turning program (TOOLNO/1,TURN); cusp mills [cl.turning]\n");
    EXPECT_EQ(problemsOf("TURRET/1,OSETNO,1"),
              "1: error: this is a turning program (TURRET/1); cusp mills [cl.turning]\n");
    EXPECT_EQ(readOut("TOOL PATH/A,TOOL,B\nTLDATA/TURN,INSERT\n").problems,
              "2: error: this is a turning program (TLDATA/TURN); cusp mills [cl.turning]\n");
}

}  // namespace
}  // namespace cusp::toolpath::test
