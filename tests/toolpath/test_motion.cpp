// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// GOTO, GODLTA, GOHOME, RAPID, FROM, TLAXIS, MULTAX, and the words that are not yet read.
#include "cl_text.hpp"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <random>

namespace cusp::toolpath::test {
namespace {

TEST(Goto, TakesPointAndAxis) {
    EXPECT_EQ(recordsOf("GOTO/1,2,3,0,0,1"), "1 go 1 2 3 axis 0 0 1\n");
    EXPECT_EQ(recordsOf("GOTO  /    1.00000,   -2.50000,    3.00000"), "1 go 1 -2.5 3 axis 0 0 1\n");
    EXPECT_EQ(recordsOf("goto/.9625,-.5,1."), "1 go 0.9625 -0.5 1 axis 0 0 1\n");
    EXPECT_EQ(recordsOf("GOTO/1,$\n  2,$ hidden behind the mark\n 3"), "1 go 1 2 3 axis 0 0 1\n");
    EXPECT_EQ(recordsOf("GOTO/1,2,3 $$ remark"), "1 go 1 2 3 axis 0 0 1\n");
}

TEST(Goto, NormalisesTheAxis) {
    const ReadOut out = readOut("UNITS/MM\nGOTO/0,0,0,0.6000400,0.0000000,0.8000000\nGOTO/0,0,0,0.6,0,0.7999\nFINI\n");
    ASSERT_EQ(out.problems, "");
    ASSERT_EQ(out.records.size(), 3U);
    for (int i = 0; i < 2; ++i) {
        const auto& motion = std::get<LinearMotion>(out.records[static_cast<std::size_t>(i)].statement);
        EXPECT_NEAR(motion.location.axis.norm(), 1.0, 1e-15);
    }
}

TEST(Goto, RefusesWhatIsNotAPose) {
    EXPECT_EQ(problemsOf("GOTO/1,2"),
              "1: error: GOTO takes 3 values (point) or 6 (point and tool axis), not 2 [cl.syntax]\n");
    EXPECT_EQ(problemsOf("GOTO/1,2,P3"), "1: error: GOTO: 'P3' is not a number [cl.number]\n");
    EXPECT_EQ(problemsOf("GOTO/1,,3"), "1: error: GOTO: '' is not a number [cl.number]\n");
    EXPECT_EQ(problemsOf("GOTO/1,2,nan"), "1: error: GOTO: 'nan' is not a number [cl.number]\n");
    EXPECT_EQ(problemsOf("GOTO/1,2,1e999"), "1: error: GOTO: '1e999' is not a number [cl.number]\n");
    EXPECT_EQ(problemsOf("GOTO/1,2,3,0,0,0"), "1: error: GOTO: the axis 0,0,0 has length 0; it must be 1 [cl.axis]\n");
    EXPECT_EQ(problemsOf("GOTO/1,2,3,0,0,1.0011"),
              "1: error: GOTO: the axis 0,0,1.0011 has length 1.0011; it must be 1 [cl.axis]\n");
    EXPECT_EQ(problemsOf("GOTO/1,2,3,0,0,1.0009"), "");
}

TEST(Goto, ReadsEveryNumberAsTheStandardLibraryDoes) {
    constexpr unsigned seed = 20170401;
    std::mt19937_64 random(seed);
    std::string text = "UNITS/MM\n";
    std::vector<double> expected;
    for (int i = 0; i < 3 * 20000; ++i) {
        const double magnitude = std::exp2(std::uniform_real_distribution<double>(-40.0, 49.0)(random));
        const double value = random() % 2 == 0 ? magnitude : -magnitude;
        std::string number;
        switch (random() % 4) {
            case 0: number = fmt::format("{:.5f}", value); break;
            case 1: number = fmt::format("{:.17g}", value); break;
            case 2: number = fmt::format("{:.9E}", value); break;
            default: number = fmt::format("{:.12f}", value); break;
        }
        double witness = 0.0;
        std::from_chars(number.data(), number.data() + number.size(), witness);
        expected.push_back(witness);
        text += (i % 3 == 0 ? "GOTO/" : ",") + number + (i % 3 == 2 ? "\n" : "");
    }
    const ReadOut out = readOut(text + "FINI\n");
    ASSERT_EQ(out.problems, "") << "seed " << seed;
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const auto& motion = std::get<LinearMotion>(out.records[i / 3].statement);
        ASSERT_EQ(motion.location.tip_mm[static_cast<Eigen::Index>(i % 3)], expected[i])
            << "seed " << seed << " i " << i;
    }
    EXPECT_EQ(recordsOf("GOTO/1.5D+2,1.E-1,+3"), "1 go 150 0.1 3 axis 0 0 1\n");
}

TEST(ToolAxis, IsModalInNx) {
    const ReadOut out =
        readOut("TOOL PATH/A,TOOL,B\nFEDRAT/MMPM,1.\nGOTO/0,0,0\nGOTO/1,0,0,0,1,0\nGOTO/2,0,0\nEND-OF-PATH\n");
    EXPECT_EQ(out.text, "1 operation 'A'\n2 feed 0.016666666666666666 mm/s\n3 tool - 'B'\n3 go 0 0 0 axis 0 0 1\n"
                        "4 go 1 0 0 axis 0 1 0\n5 go 2 0 0 axis 0 1 0\n6 end\n");
}

TEST(ToolAxis, IsDeclaredInPlainApt) {
    EXPECT_EQ(recordsOf("TLAXIS/0,1,0\nGOTO/1,0,0\nTLAXIS/1,0,0\nGOTO/1,0,0"),
              "2 go 1 0 0 axis 0 1 0\n4 go 1 0 0 axis 1 0 0\n");
    EXPECT_EQ(recordsOf("MULTAX\nGOTO/1,0,0,0,1,0\nGOTO/2,0,0\nMULTAX/OFF\nGOTO/3,0,0"),
              "2 go 1 0 0 axis 0 1 0\n3 go 2 0 0 axis 0 1 0\n5 go 3 0 0 axis 0 0 1\n");
    EXPECT_EQ(
        problemsOf("GOTO/1,0,0,0,1,0\nGOTO/2,0,0"),
        "2: error: GOTO has 3 values, but the GOTO before it had a tool axis other than TLAXIS and MULTAX is not on: "
        "which axis holds here is not clear [cl.axis]\n");
    EXPECT_EQ(problemsOf("TLAXIS/0,1\nMULTAX/MAYBE"),
              "1: error: TLAXIS takes 3 values, not 2 [cl.syntax]\n"
              "2: error: MULTAX/MAYBE is not understood; ON, OFF or nothing is [cl.syntax]\n");
}

TEST(Rapid, HoldsForOneMove) {
    EXPECT_EQ(recordsOf("RAPID\nGOTO/1,0,0\nGOTO/2,0,0\nRAPID/\nPPRINT x\nGOTO/3,0,0"),
              "2 rapid 1 0 0 axis 0 0 1\n3 go 2 0 0 axis 0 0 1\n5 message 'x'\n6 rapid 3 0 0 axis 0 0 1\n");
    EXPECT_EQ(
        recordsOf("RAPID\nFEDRAT/60\nGOTO/1,0,0"),
        "2 feed 1 mm/s\n3 go 1 0 0 axis 0 0 1\n"
        "2: warning: FEDRAT follows RAPID before any GOTO: the next move is made at this feed [cl.rapid-cancelled]\n");
    EXPECT_EQ(problemsOf("RAPID/ON"),
              "1: error: RAPID with values is not understood; RAPID alone makes the next GOTO rapid [cl.syntax]\n");
}

TEST(From, IsRecordedAndMovesNothing) {
    EXPECT_EQ(recordsOf("FROM/0,0,100\nGOTO/1,0,0"), "1 from 0 0 100 axis 0 0 1\n2 go 1 0 0 axis 0 0 1\n");
    EXPECT_EQ(problemsOf("FROM/0,0"),
              "1: error: FROM takes 3 values (point) or 6 (point and tool axis), not 2 [cl.syntax]\n");
    EXPECT_EQ(problemsOf("FROM/0,0,1,0,0,0"), "1: error: FROM: the axis 0,0,0 has length 0; it must be 1 [cl.axis]\n");
}

TEST(Godlta, StepsFromWhereTheToolStands) {
    EXPECT_EQ(recordsOf("GOTO/1,2,3\nGODLTA/1,0,-1\nRAPID\nGODLTA/5"),
              "1 go 1 2 3 axis 0 0 1\n2 go 2 2 2 axis 0 0 1\n4 rapid 2 2 7 axis 0 0 1\n");
    EXPECT_EQ(recordsOf("MULTAX\nGOTO/1,2,3,0,0.6,0.8\nGODLTA/10"),
              "2 go 1 2 3 axis 0 0.6 0.8\n3 go 1 8 11 axis 0 0.6 0.8\n");
    EXPECT_EQ(recordsOf("FROM/1,1,1\nGODLTA/0,0,1\nGOTO/0,0,0"),
              "1 from 1 1 1 axis 0 0 1\n2 go 1 1 2 axis 0 0 1\n3 go 0 0 0 axis 0 0 1\n");
    EXPECT_EQ(readOut("UNITS/INCHES\nGOTO/1,0,0\nGODLTA/0,1,0\nFINI\n").text,
              "2 go 25.4 0 0 axis 0 0 1\n3 go 25.4 25.4 0 axis 0 0 1\n4 end\n");
    EXPECT_EQ(problemsOf("GODLTA/1,0,0"),
              "1: error: GODLTA: where the tool stands is not known: no GOTO or FROM before "
              "it [cl.start-unknown]\n");
    EXPECT_EQ(problemsOf("GOTO/0,0,0\nGODLTA/1,0"),
              "2: error: GODLTA takes 3 values (step) or 1 (step along the tool axis), not 2 [cl.syntax]\n");
}

TEST(Gohome, LeavesForAnUnknownPlace) {
    EXPECT_EQ(recordsOf("GOTO/1,2,3\nGOHOME"), "1 go 1 2 3 axis 0 0 1\n2 home\n");
    EXPECT_EQ(problemsOf("GOTO/1,2,3\nGOHOME\nGODLTA/1,0,0"),
              "3: error: GODLTA: where the tool stands is not known: no GOTO or FROM before it [cl.start-unknown]\n");
    EXPECT_EQ(problemsOf("GOHOME/1,2,3"), "1: error: GOHOME with values is not understood [cl.syntax]\n");
}

TEST(UnsupportedMotion, IsAlwaysAnError) {
    for (const std::string word :
         {"COPY/1", "ORIGIN/0,0,5", "ROTABL/90", "SYN/'A','B'", "TLRGT,GOFWD/C1", "TRANS/1,2,3", "TRACUT/M1"}) {
        EXPECT_EQ(
            problemsOf("PPRINT x\n" + word),
            "2: error: " + word.substr(0, word.find_first_of("/,")) +
                " is not yet read; without it the tool would go elsewhere than the file says [cl.unsupported-motion]\n");
    }
    EXPECT_EQ(problemsOf("CYCLE/OFF\nCUTCOM/OFF"), "");
    EXPECT_EQ(
        problemsOf("L1) GOTO/1,2,3\nGOTO/1,2,3"),
        "1: error: 'L1) GOTO/1,2,3' is not understood, and GOTO in it may move the tool [cl.unsupported-motion]\n");
    EXPECT_EQ(problemsOf("GOTO(1,2,3)"),
              "1: error: GOTO: a slash or the end of the statement is expected behind the word [cl.syntax]\n");
}

}  // namespace
}  // namespace cusp::toolpath::test
