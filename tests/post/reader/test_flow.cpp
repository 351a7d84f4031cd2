// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Jumps, structures, subprograms: each program is told by the X positions it visits.
#include "nc_recorder.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <sstream>

namespace cusp::post::reader::test {
namespace {

/// "1 2 3": where X went.
std::string visited(const Recording& out) {
    std::string text;
    for (const RecordedMotion& motion : out.motions)
        text += fmt::format("{}{:g}", text.empty() ? "" : " ", *motion.motion.end.linear_mm[0]);
    return text;
}

/// Under G0, which is put in front, or behind the heading.
Recording runText(std::string text) {
    text.insert(text.front() == '%' ? text.find('\n') + 1 : 0, "G0\n");
    return run(text, shippedMachine("three-axis"));
}

struct FlowCase {
    const char* name;
    const char* program;
    const char* visits;
};

void PrintTo(const FlowCase& c, std::ostream* out) { *out << c.name; }

class Flow : public testing::TestWithParam<FlowCase> {};

TEST_P(Flow, VisitsInOrder) {
    const Recording out = runText(GetParam().program);
    EXPECT_EQ(out.problems, "");
    EXPECT_EQ(visited(out), GetParam().visits);
}

INSTANTIATE_TEST_SUITE_P(
    Structures, Flow,
    testing::Values(
        FlowCase{"if", "R1=1\nIF R1==1\nX1\nELSE\nX2\nENDIF\nIF R1>1\nX3\nELSE\nX4\nENDIF\nIF R1<>1\nX5\nENDIF\nM30",
                 "1 4"},
        FlowCase{"nested if", "R1=2\nIF R1>1\nIF R1>2\nX1\nELSE\nX2\nENDIF\nX3\nELSE\nX4\nENDIF\nM30", "2 3"},
        FlowCase{"while", "R1=0\nWHILE R1<3\nX=R1\nR1=R1+1\nENDWHILE\nX9\nM30", "0 1 2 9"},
        FlowCase{"while never", "R1=5\nWHILE R1<3\nX=R1\nENDWHILE\nX9\nM30", "9"},
        FlowCase{"for", "DEF INT I_\nFOR I_=1 TO 3\nX=I_*10\nENDFOR\nX=I_\nM30", "10 20 30 4"},
        FlowCase{"for with R parameters", "R2=2\nFOR R1=R2-1 TO R2*2\nX=R1\nENDFOR\nM30", "1 2 3 4"},
        FlowCase{"for never", "FOR R1=3 TO 1\nX=R1\nENDFOR\nX9\nM30", "9"},
        FlowCase{"loop left by a jump", "R1=0\nLOOP\nX=R1\nR1=R1+1\nIF R1>2 GOTOF DONE\nENDLOOP\nDONE: X9\nM30",
                 "0 1 2 9"},
        FlowCase{"repeat", "R1=5\nREPEAT\nX=R1\nR1=R1+1\nUNTIL R1>=5\nM30", "5"},
        FlowCase{"loops in loops", "FOR R1=1 TO 2\nFOR R2=1 TO 2\nX=R1*10+R2\nENDFOR\nENDFOR\nM30", "11 12 21 22"},
        FlowCase{"labels", "GOTOF ONE_\nX1\nONE_: X2\nM30", "2"},
        FlowCase{"block numbers", "N10 R1=0\nN20 X=R1\nN30 R1=R1+1\nN40 IF R1<3 GOTOB N20\nN50 M30", "0 1 2"},
        FlowCase{"the nearest label in the direction", "GOTOF AA\nX1\nAA: X2\nR1=1\nGOTOF AA\nX3\nAA: X4\nM30", "2 4"},
        FlowCase{"goto looks ahead first", "R1=0\nAA: X1\nR1=R1+1\nIF R1==2 GOTO BB\nGOTO AA\nBB: X2\nM30", "1 1 2"},
        FlowCase{"gotoc without target", "GOTOC NOWHERE\nX1\nM30", "1"},
        FlowCase{"two conditions", "R1=2\nIF R1==1 GOTOF AA IF R1==2 GOTOF BB\nX1\nAA: X2\nM30\nBB: X3\nM30", "3"},
        FlowCase{"case", "R1=2\nCASE (R1) OF 1 GOTOF AA 2 GOTOF BB DEFAULT GOTOF CC\nAA: X1\nBB: X2\nCC: X3\nM30",
                 "2 3"},
        FlowCase{"case default", "R1=7\nCASE (R1) OF 1 GOTOF AA DEFAULT GOTOF CC\nAA: X1\nCC: X3\nM30", "3"},
        FlowCase{"case without default", "R1=7\nCASE (R1) OF 1 GOTOF AA\nX5\nAA: X1\nM30", "5 1"}));

INSTANTIATE_TEST_SUITE_P(
    Subprograms, Flow,
    testing::Values(
        FlowCase{"by name", "%_N_MAIN_MPF\nX1\nPART_A\nX3\nM30\n%_N_PART_A_SPF\nX2\nM17", "1 2 3"},
        FlowCase{"L number", "%_N_MAIN_MPF\nL10\nM30\n%_N_L10_SPF\nX2\nM17", "2"},
        FlowCase{"several runs", "%_N_MAIN_MPF\nPART_A P3\nM30\n%_N_PART_A_SPF\nX2\nRET", "2 2 2"},
        FlowCase{"arguments",
                 "%_N_MAIN_MPF\nPART_A(4,2.6)\nM30\n%_N_PART_A_SPF\nPROC PART_A(REAL AA, INT BB)\nX=AA\nX=BB\nM17",
                 "4 3"},
        FlowCase{"own variables, common R parameters",
                 "%_N_MAIN_MPF\nDEF REAL AA=1\nPART_A\nX=AA\nX=R1\nM30\n%_N_PART_A_SPF\nDEF REAL AA=2\nR1=5\nX=AA\nM17",
                 "2 1 5"},
        FlowCase{"in one another",
                 "%_N_MAIN_MPF\nPART_A\nX9\nM30\n%_N_PART_A_SPF\nPART_B\nX2\nM17\n%_N_PART_B_SPF\nX1\nM17", "1 2 9"}));

TEST(Flow, OperatorsBindAsOnTheControl) {
    // Comparisons bind loosest: 1 < (2 AND 0) is 1 < 0.
    const Recording out =
        runText("R1=1<2 AND 0\nX=R1\nR1=(1<2) AND (3>=3)\nX=R1\nR1=NOT 0\nX=R1\nR1=5 B_AND 6 B_OR 1\nX=R1\n"
                "R1=TRUE XOR FALSE\nX=R1\nR1=0.1+0.2==0.3\nX=R1\nM30");
    EXPECT_EQ(out.problems, "");
    EXPECT_EQ(visited(out), "0 1 1 5 1 1");
}

TEST(Flow, AnEndlessProgramEndsInAnError) {
    ReaderOptions options;
    options.max_repeated_lines = 100;
    const Recording out = run("AA:\nGOTOB AA\nM30", shippedMachine("three-axis"), options);
    EXPECT_EQ(
        out.problems,
        "1: error: 100 lines were run a second time and more without an end: the program does not end [nc.endless]\n");
}

TEST(Flow, AnErrorInALoopIsSaidOnce) {
    const Recording out = runText("FOR R1=1 TO 5\nX=R9\nENDFOR\nM30");
    EXPECT_EQ(out.problems, "3:3: error: R9 is used before the program sets it [nc.unset-parameter]\n");
}

/// A stream that cannot go back, as a pipe.
class Pipe : public std::stringbuf {
public:
    using std::stringbuf::stringbuf;

protected:
    pos_type seekoff(off_type, std::ios_base::seekdir, std::ios_base::openmode) override {
        return pos_type(off_type(-1));
    }
    pos_type seekpos(pos_type, std::ios_base::openmode) override { return pos_type(off_type(-1)); }
};

class Quiet : public ProgramSink {
public:
    void motion(const ExecutedMotion& motion) override { x.push_back(*motion.end.linear_mm[0]); }
    void event(const BlockPlace&, const ExecutedEvent&) override {}
    std::vector<double> x;
};

TEST(Flow, ThroughAPipeOnlyWhatFollowsTheFirstJumpIsKept) {
    const auto through = [](const std::string& text, base::Diagnostics& report) {
        Pipe pipe(text);
        std::istream in(&pipe);
        Quiet sink;
        static_cast<void>(readProgram(in, "", shippedMachine("three-axis"), {}, sink, report));
        return sink.x;
    };
    base::Diagnostics good;
    EXPECT_EQ(through("G0 X5\nFOR R1=1 TO 3\nX=R1\nENDFOR\nM30", good), (std::vector<double>{5, 1, 2, 3}));
    EXPECT_TRUE(good.empty()) << base::toText(good);
    base::Diagnostics bad;
    static_cast<void>(through("G0\nAA: X1\nGOTOB AA\nM30", bad));
    EXPECT_EQ(base::toText(bad),
              "3:1: error: GOTOB AA: there is no such target before this block; of a program that comes through a pipe "
              "only what follows its first jump is kept [nc.jump-target]\n");
}

}  // namespace
}  // namespace cusp::post::reader::test
