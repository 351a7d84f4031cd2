// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// CYCLE in the forms of CATIA, NX and SolidWorks CAM; CUTCOM.
#include "cl_text.hpp"

#include <gtest/gtest.h>

namespace cusp::toolpath::test {
namespace {

/// The record of one CYCLE statement, or its problem.
std::string cycle(const std::string& text) { return recordsOf("CYCLE/" + text + "\nCYCLE/OFF\nGOTO/0,0,0"); }
std::string expected(const std::string& text) { return "1 cycle " + text + "\n2 cycle end\n3 go 0 0 0 axis 0 0 1\n"; }

TEST(Cycle, MakesHolesOfLocations) {
    EXPECT_EQ(recordsOf("RAPID\nGOTO/0,0,5\nCYCLE/DRILL,DEPTH,4.6,MMPR,.08,CLEAR,2,RETURN,0\nGOTO/1,0,0\nRAPID\n"
                        "GOTO/2,0,0\nCYCLE/OFF\nGOTO/3,0,9"),
              "2 rapid 0 0 5 axis 0 0 1\n3 cycle drill depth 4.6 clearance 2 feed 0.08 mm/rev\n"
              "4 hole 1 0 0 axis 0 0 1\n6 hole 2 0 0 axis 0 0 1\n7 cycle end\n8 go 3 0 9 axis 0 0 1\n");
    EXPECT_EQ(recordsOf("CYCLE/OFF\nGOTO/1,0,0"), "2 go 1 0 0 axis 0 0 1\n") << "nothing was on";
}

TEST(Cycle, WordsAndNumbersInEveryOrder) {
    EXPECT_EQ(cycle("DRILL,FEDTO,5.,MMPM,600.,RAPTO,3.,RTRCTO,25.,DWELL,0"),
              expected("drill depth 5 clearance 3 retract 25 feed 10 mm/s"));
    EXPECT_EQ(cycle("DEEP2,FEDTO,50.,1STPECK,5.,SUBPECK,2.,MMPM,600,RAPTO,3.,RTRCTO,25."),
              expected("deep depth 50 clearance 3 retract 25 feed 10 mm/s first peck 5 peck 2"));
    EXPECT_EQ(cycle("BRKCHP,DEPTH,10,STEP,2,IPM,60,CLEAR,1"),
              expected("break chip depth 10 clearance 1 feed 25.4 mm/s peck 2"));
    EXPECT_EQ(cycle("BORE,DEPTH,10,DWELL,1.5"), expected("bore depth 10 dwell 1.5"));
    EXPECT_EQ(cycle("REAM,DEPTH,10,PERMIN,60"), expected("bore depth 10 feed 1 mm/s"));
    EXPECT_EQ(cycle("TAP,DEPTH,10,PITCH,1.5,CLEAR,5"), expected("tap depth 10 clearance 5 feed 1.5 mm/rev"));
    EXPECT_EQ(recordsOf("SPINDL/120,RPM,CLW\nCYCLE/DRILL,DEPTH,10,DWELL,REV,4\nCYCLE/OFF\nGOTO/0,0,0"),
              "1 spindle clockwise 120 rpm\n2 cycle drill depth 10 dwell 2\n3 cycle end\n4 go 0 0 0 axis 0 0 1\n");
}

TEST(Cycle, NumbersWithoutWords) {
    EXPECT_EQ(cycle("TAP,   50.786017,    1.000000"), expected("tap depth 50.786017 clearance 1"));
    EXPECT_EQ(cycle("DRILL,  126.000000,   60.000000,    1.000000,MMPM"),
              expected("drill depth 126 clearance 1 feed 1 mm/s"));
    EXPECT_EQ(cycle("DRILL,.4,60.,MMPM,.1"), expected("drill depth 0.4 clearance 0.1 feed 1 mm/s"));
    EXPECT_EQ(cycle("DRILL,4,MMPM,60,1"), expected("drill depth 4 clearance 1 feed 1 mm/s"));
    EXPECT_EQ(cycle("DRILL,4,60,1"), expected("drill depth 4 clearance 1 feed 1 mm/s"));
    EXPECT_EQ(cycle("DRILL,4"), expected("drill depth 4"));
    EXPECT_EQ(cycle("DRILL,4,60,MMPM"), expected("drill depth 4 feed 1 mm/s"));
}

TEST(Cycle, NxCountsFedtoAsAHeight) {
    const std::string head = "TOOL PATH/A,TOOL,B\n";
    const ReadOut out = readOut(head + "RAPID\nGOTO/0,0,50\nCYCLE/DRILL,DEEP,STEP,2.5,CLEAR,3.,FEDTO,-10.,RTRCTO,AUTO,"
                                       "MMPM,60.\nGOTO/0,0,10\nCYCLE/OFF\nEND-OF-PATH\n");
    EXPECT_EQ(out.problems, "");
    EXPECT_EQ(out.mm_per_unit, 1.0) << "the cycle's feed tells the unit";
    EXPECT_EQ(out.text, "1 operation 'A'\n3 tool - 'B'\n3 rapid 0 0 50 axis 0 0 1\n"
                        "4 cycle deep depth 10 clearance 3 feed 1 mm/s peck 2.5\n5 hole 0 0 10 axis 0 0 1\n"
                        "6 cycle end\n7 end\n");
    EXPECT_EQ(readOut(head + "GOTO/0,0,50\nCYCLE/DRILL,FEDTO,10.,MMPM,60.\nEND-OF-PATH\n").problems,
              "3: error: CYCLE/DRILL: the depth must lie below the hole's location; it is -10 mm [cl.cycle]\n");
}

TEST(Cycle, RefusesWhatItCannotMean) {
    const auto problem = [](const std::string& text) { return problemsOf("CYCLE/" + text); };
    const auto error = [](const std::string& text) { return "1: error: CYCLE/" + text + " [cl.cycle]\n"; };
    EXPECT_EQ(problem("MILL,1"),
              "1: error: CYCLE/MILL is not yet read; without it the tool would go elsewhere than the "
              "file says [cl.unsupported-motion]\n");
    EXPECT_EQ(problem("INIT"), "1: error: CYCLE/INIT is not yet read; without it the tool would go elsewhere than the "
                               "file says [cl.unsupported-motion]\n");
    EXPECT_EQ(problem("DRILL,DEPTH,5,ORIENT,90"), error("DRILL: 'ORIENT' is not understood"));
    EXPECT_EQ(problem("BORE,BACK,DEPTH,5"), error("BORE: 'BACK' is not understood"));
    EXPECT_EQ(problem("DRILL,CLEAR,2"), error("DRILL: the depth must lie below the hole's location; it is 0 mm"));
    EXPECT_EQ(problem("DRILL,DEPTH"), error("DRILL: a number is expected behind DEPTH"));
    EXPECT_EQ(problem("DRILL,5,MMPM"), error("DRILL: a number is expected behind the feed's unit"));
    EXPECT_EQ(problem("DRILL,DEPTH,5,CLEAR,3,RAPTO,2"), error("DRILL: 'RAPTO' is not understood"));
    EXPECT_EQ(problem("DRILL,DEPTH,5,CLEAR,-3"), error("DRILL: the clearance -3 mm lies below the hole's location"));
    EXPECT_EQ(problem("DRILL,DEPTH,5,CLEAR,3,RTRCTO,2"),
              error("DRILL: the retract height 2 mm lies below the clearance"));
    EXPECT_EQ(problem("DRILL,DEPTH,5,MMPM,0"), error("DRILL: the feed must be more than 0"));
    EXPECT_EQ(problem("DRILL,DEPTH,5,DWELL,-1"), error("DRILL: a dwell cannot be negative"));
    EXPECT_EQ(problem("DRILL,DEPTH,5,DWELL,2,REV"),
              error("DRILL: DWELL in revolutions, but no spindle speed in RPM holds here"));
    EXPECT_EQ(problem("DEEP,DEPTH,5"), error("DEEP: drilling in pecks needs the size of the peck"));
    EXPECT_EQ(problem("DRILL,DEPTH,5,STEP,1"), error("DRILL: a peck is given, but this cycle goes to depth at once"));
    EXPECT_EQ(problem("DRILL,1,2,3,4"), error("DRILL: more numbers than depth, feed and clearance"));
    EXPECT_EQ(problemsOf("GOTO/2,0,0\nCYCLE/DRILL,5\nCIRCLE/0,0,0,0,0,1,2"),
              "3: error: CIRCLE while a cycle is on is not understood [cl.arc]\n");
    EXPECT_EQ(problemsOf("GOTO/2,0,0\nCYCLE/DRILL,5\nGOTO/2,0,0\nCYCLE/OFF\nCIRCLE/0,0,0,0,0,1,2\nGOTO/0,2,0"),
              "5: error: CIRCLE: where the arc starts is not known: no GOTO right before it [cl.arc]\n");
}

TEST(Cutcom, IsRecordedWhenItChanges) {
    EXPECT_EQ(recordsOf("CUTCOM/OFF\nCUTCOM/LEFT\nGOTO/1,0,0\nCUTCOM/OFF\nCUTCOM/OFF\nCUTCOM/RIGHT,12"),
              "2 compensation left\n3 go 1 0 0 axis 0 0 1\n4 compensation off\n6 compensation right 12\n");
    EXPECT_EQ(problemsOf("CUTCOM/LEFT,1.5"), "1: error: CUTCOM: '1.5' is not the number of an offset [cl.cutcom]\n");
    EXPECT_EQ(
        problemsOf("CUTCOM/LEFT,XYPLAN,5"),
        "1: error: CUTCOM/LEFT,XYPLAN,5 is not yet read; without it the tool would go elsewhere than the file says "
        "[cl.unsupported-motion]\n");
    EXPECT_EQ(problemsOf("CUTCOM/ON"),
              "1: error: CUTCOM/ON is not yet read; without it the tool would go elsewhere than "
              "the file says [cl.unsupported-motion]\n");
}

}  // namespace
}  // namespace cusp::toolpath::test
