// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// FEDRAT, SPINDL, COOLNT, DELAY, STOP, remarks.
#include "cl_text.hpp"

#include <gtest/gtest.h>

namespace cusp::toolpath::test {
namespace {

TEST(Fedrat, AllForms) {
    EXPECT_EQ(recordsOf("FEDRAT/3000.,MMPM"), "1 feed 50 mm/s\n");
    EXPECT_EQ(recordsOf("FEDRAT/MMPM,3000."), "1 feed 50 mm/s\n");
    EXPECT_EQ(recordsOf("FEDRAT/  300.0000,IPM"), "1 feed 127 mm/s\n");
    EXPECT_EQ(recordsOf("FEDRAT/IPM,300"), "1 feed 127 mm/s\n");
    EXPECT_EQ(recordsOf("FEDRAT/600"), "1 feed 10 mm/s\n");
    EXPECT_EQ(recordsOf("FEDRAT/PERMIN,600"), "1 feed 10 mm/s\n");
    EXPECT_EQ(recordsOf("FEDRAT/.25,MMPR"), "1 feed 0.25 mm/rev\n");
    EXPECT_EQ(recordsOf("FEDRAT/.25,PERREV"), "1 feed 0.25 mm/rev\n");
    EXPECT_EQ(recordsOf("FEDRAT/.01,IPR"), "1 feed 0.254 mm/rev\n");
}

TEST(Fedrat, BareNumberIsInTheUnitOfTheFile) {
    EXPECT_EQ(readOut("UNITS/INCHES\nFEDRAT/60\nFEDRAT/.01,PERREV\nGOTO/1,0,0\nFINI").text,
              "2 feed 25.4 mm/s\n3 feed 0.254 mm/rev\n4 go 25.4 0 0 axis 0 0 1\n5 end\n");
}

TEST(Fedrat, RefusesWhatIsNotAFeed) {
    EXPECT_EQ(problemsOf("FEDRAT/0,MMPM"), "1: error: FEDRAT: a feed of 0 is not possible [cl.feed]\n");
    EXPECT_EQ(problemsOf("FEDRAT/-5"), "1: error: FEDRAT: a feed of -5 is not possible [cl.feed]\n");
    EXPECT_EQ(problemsOf("FEDRAT/"), "1: error: FEDRAT: the feed is missing [cl.feed]\n");
    EXPECT_EQ(problemsOf("FEDRAT/5,INVERS"), "1: error: FEDRAT: 'INVERS' is not understood [cl.feed]\n");
    EXPECT_EQ(problemsOf("FEDRAT/5,6"), "1: error: FEDRAT: '6' is not understood [cl.feed]\n");
}

TEST(Spindl, AllForms) {
    EXPECT_EQ(recordsOf("SPINDL/9950,RPM,CLW"), "1 spindle clockwise 9950 rpm\n");
    EXPECT_EQ(recordsOf("SPINDL/RPM,9950,CCLW"), "1 spindle counter-clockwise 9950 rpm\n");
    EXPECT_EQ(recordsOf("SPINDL/CLW,200,SMM"), "1 spindle clockwise 200 m/min\n");
    EXPECT_EQ(recordsOf("SPINDL/ 500.0000,SFM,CCLW"), "1 spindle counter-clockwise 152.4 m/min\n");
    EXPECT_EQ(recordsOf("SPINDL/500"), "1 spindle clockwise 500 rpm\n");
    EXPECT_EQ(recordsOf("SPINDL/500,CCLW\nSPINDL/OFF\nSPINDL/ON"),
              "1 spindle counter-clockwise 500 rpm\n2 spindle off\n3 spindle counter-clockwise\n");
}

TEST(Spindl, TheGearRangeIsLeftToTheMachine) {
    EXPECT_EQ(
        recordsOf("SPINDL/RPM,500,CLW,RANGE,2"),
        "1 spindle clockwise 500 rpm\n1: warning: SPINDL: the gear range 2 is left to the machine [cl.spindle]\n");
    EXPECT_EQ(problemsOf("SPINDL/500,RANGE"), "1: error: SPINDL: 'RANGE' is not understood [cl.spindle]\n");
}

TEST(Spindl, RefusesTheRest) {
    EXPECT_EQ(problemsOf("SPINDL/ORIENT,90"), "1: error: SPINDL: 'ORIENT' is not understood [cl.spindle]\n");
    EXPECT_EQ(problemsOf("SPINDL/"), "1: error: SPINDL/ is not understood [cl.spindle]\n");
    EXPECT_EQ(problemsOf("SPINDL/-10,RPM"), "1: error: SPINDL/-10,RPM is not understood [cl.spindle]\n");
    EXPECT_EQ(problemsOf("SPINDL/10,OFF"), "1: error: SPINDL/10,OFF is not understood [cl.spindle]\n");
}

TEST(Coolnt, AllForms) {
    EXPECT_EQ(recordsOf("COOLNT/ON\nCOOLNT/FLOOD\nCOOLNT/MIST\nCOOLNT/THRU\nCOOLNT/OFF"),
              "1 coolant flood\n2 coolant flood\n3 coolant mist\n4 coolant through\n5 coolant off\n");
    EXPECT_EQ(recordsOf("COOLNT/ON,FLOOD\nCOOLNT/MIST,ON"), "1 coolant flood\n2 coolant mist\n");
    EXPECT_EQ(problemsOf("COOLNT/OFF,ON"),
              "1: warning: COOLNT/OFF,ON is not understood; the coolant stays as it is [cl.coolant]\n");
    EXPECT_EQ(problemsOf("COOLNT/"),
              "1: warning: COOLNT/ is not understood; the coolant stays as it is [cl.coolant]\n");
    ClReaderOptions strict;
    strict.strict = true;
    EXPECT_EQ(readOut("UNITS/MM\nCOOLNT/AIR\nGOTO/0,0,0\nFINI", strict).problems,
              "2: error: COOLNT/AIR is not understood; the coolant stays as it is [cl.coolant]\n");
}

TEST(Delay, SecondsOrRevolutions) {
    EXPECT_EQ(recordsOf("DELAY/ 2.5"), "1 dwell 2.5 s\n");
    EXPECT_EQ(recordsOf("SPINDL/600,RPM\nDELAY/5,REV"), "1 spindle clockwise 600 rpm\n2 dwell 0.5 s\n");
    EXPECT_EQ(recordsOf("SPINDL/600,RPM\nDELAY/REV,5"), "1 spindle clockwise 600 rpm\n2 dwell 0.5 s\n");
    EXPECT_EQ(recordsOf("DELAY/3,SEC\nDELAY/SEC,4"), "1 dwell 3 s\n2 dwell 4 s\n");
    EXPECT_EQ(problemsOf("DELAY/3,MIN"),
              "1: error: DELAY/3,MIN is not understood; seconds, or revolutions with REV, are [cl.delay]\n");
    EXPECT_EQ(problemsOf("DELAY/5,REV"),
              "1: error: DELAY in revolutions, but no spindle speed in RPM holds here [cl.delay]\n");
    EXPECT_EQ(problemsOf("DELAY/-1"),
              "1: error: DELAY/-1 is not understood; seconds, or revolutions with REV, are [cl.delay]\n");
}

TEST(Stop, BothKinds) { EXPECT_EQ(recordsOf("STOP\nOPSTOP"), "1 stop\n2 optional stop\n"); }

TEST(Remark, TakesTheLineAsItStands) {
    EXPECT_EQ(
        recordsOf("PARTNO/1\nPARTNO Part Operation.1\nPPRINT -prva, $5 $$ strana $\nINSERT/[HOLDER=C40] 20MM\nINSERT"),
        "1 part '1'\n2 part 'Part Operation.1'\n3 message '-prva, $5 $$ strana $'\n4 insert '[HOLDER=C40] 20MM'\n"
        "5 insert ''\n");
}

TEST(Tolerance, IsKept) {
    EXPECT_EQ(recordsOf("INTOL / .01\nOUTTOL/0"), "1 tolerance inside 0.01\n2 tolerance outside 0\n");
    EXPECT_EQ(readOut("UNITS/INCHES\nOUTTOL/.001\nGOTO/0,0,0\nFINI").text,
              "2 tolerance outside 0.0254\n3 go 0 0 0 axis 0 0 1\n4 end\n");
    EXPECT_EQ(problemsOf("INTOL/x"), "1: warning: INTOL/x is not understood and is passed over [cl.tolerance]\n");
    EXPECT_EQ(problemsOf("OUTTOL/-1"), "1: warning: OUTTOL/-1 is not understood and is passed over [cl.tolerance]\n");
}

TEST(NoMeaning, IsPassedOverInSilence) {
    EXPECT_EQ(recordsOf("PAINT/COLOR,42\nREWIND/0\nDISPLY/ON\nSEQNO/10,INCR,10\nSET/MODE,ABSOL\nTRANS/0,0,0\n"
                        "ORIGIN/ 0., 0., 0."),
              "");
    const std::string elsewhere = " is not yet read; without it the tool would go elsewhere than the file says "
                                  "[cl.unsupported-motion]\n";
    EXPECT_EQ(problemsOf("TRANS/0,0,1"), "1: error: TRANS" + elsewhere);
    EXPECT_EQ(problemsOf("ORIGIN/1,0,0"), "1: error: ORIGIN" + elsewhere);
    EXPECT_EQ(problemsOf("TRANS/"), "1: error: TRANS" + elsewhere);
    EXPECT_EQ(problemsOf("SET/MODE,INCR"), "1: error: SET/MODE,INCR" + elsewhere);
}

}  // namespace
}  // namespace cusp::toolpath::test
