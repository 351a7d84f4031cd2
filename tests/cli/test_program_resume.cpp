// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A resumed program does what is left of the whole one: every motion after the resumed block, by the reader.
#include "modal_words.hpp"
#include "program_resume.hpp"

#include <gtest/gtest.h>
#include <sstream>
#include <vector>

namespace cusp::cli {
namespace {

namespace nc = post::reader;

/// A motion as what a machine would do of it.
struct Done {
    std::size_t line = 0;
    nc::ToolPose end;
    bool placed = false;
    bool rapid = false;
    double feed = 0.0;
    double rpm = 0.0;
    std::string tool;
    std::string offset;
};

class DoneSink : public nc::ProgramSink {
public:
    void motion(const nc::ExecutedMotion& motion) override {
        Done done;
        done.line = motion.place.line;
        done.placed = motion.end_pose.has_value();
        if (done.placed) done.end = *motion.end_pose;
        done.rapid = motion.code == nc::MotionCode::Rapid;
        done.feed = motion.state->feed.value.value_or(0.0);
        done.rpm = motion.state->spindle_rpm;
        done.tool = motion.state->tool;
        done.offset = motion.state->work_offset;
        all.push_back(done);
    }
    void event(const nc::BlockPlace& /*place*/, const nc::ExecutedEvent& /*event*/) override {}
    std::vector<Done> all;
};

post::MachineFile machineFile(const std::string& name) {
    const auto file = post::readMachineFile(std::string(CUSP_SOURCE_DIR) + "/machines/" + name + ".toml");
    EXPECT_TRUE(file.has_value());
    return *file;
}

std::vector<Done> run(const std::string& text, const post::MachineFile& machine, std::size_t from_line) {
    DoneSink sink;
    std::istringstream in(text);
    base::Diagnostics report;
    nc::readProgram(in, "P.MPF", machine, {}, sink, report);
    EXPECT_FALSE(report.hasErrors()) << base::toText(report) << text;
    std::erase_if(sink.all, [&](const Done& done) { return done.line < from_line; });
    return sink.all;
}

std::size_t linesIn(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// Resumes at `block`, runs both, compares all that is left.
void expectSameRest(const std::string& text, const post::MachineFile& machine, std::uint32_t block) {
    const auto preamble = resumePreamble(text, "P.MPF", machine, {.block = block});
    ASSERT_TRUE(preamble.has_value()) << base::toText(preamble.error());
    const std::string resumed = preamble->text + text.substr(preamble->from_byte);
    const auto whole = run(text, machine, linesIn(text.substr(0, preamble->from_byte)) + 1);
    const auto rest = run(resumed, machine, linesIn(preamble->text) + 1);
    ASSERT_EQ(whole.size(), rest.size()) << preamble->text;
    ASSERT_FALSE(whole.empty());
    for (std::size_t i = 0; i < whole.size(); ++i) {
        EXPECT_EQ(whole[i].placed, rest[i].placed);
        EXPECT_LT(norm(whole[i].end.tip_mm - rest[i].end.tip_mm), 1e-4);
        EXPECT_LT(angleBetween(whole[i].end.axis, rest[i].end.axis), 1e-6);
        EXPECT_EQ(whole[i].rapid, rest[i].rapid);
        EXPECT_EQ(whole[i].feed, rest[i].feed);
        EXPECT_EQ(whole[i].rpm, rest[i].rpm);
        EXPECT_EQ(whole[i].tool, rest[i].tool);
        EXPECT_EQ(whole[i].offset, rest[i].offset);
    }
}

const std::string five_axis =
    "N1 G40 G17 G710 G94 G90 G60 G601\nN2 TRAFOOF\nN3 SUPA G0 Z0 D0\nN4 T=\"BALL_10\"\nN5 M6\nN6 D1\n"
    "N7 CYCLE832(0.01,_ORI_FINISH,0.1)\nN8 G54\nN9 S8000 M3\nN10 G0 C20 A15\nN11 TRAORI\nN12 G54\nN13 ORIAXES\nN14 M8\n"
    "N15 G0 X0 Y0 C20 A15\nN16 Z50\nN17 G1 Z0 F3000\nN18 X1 Y2 C21 A15.5\nN19 X2 Y2.5 Z-0.25 C22 A16\nN20 X3 F1500\n"
    "N21 X4 Z-1.5 A17\nN22 MSG(\"second\") ; a comment\nN23 S9000\nN24 X5\nN25 G0 Z60\nN26 TRAFOOF\nN27 SUPA G0 Z0 D0\n"
    "N28 T=\"MILL\"\nN29 M6\nN30 D1\nN31 G55\nN32 S4000 M3\nN33 G0 C0 A0\nN34 TRAORI\nN35 G55\nN36 ORIAXES\n"
    "N37 G0 X10 Y10\nN38 Z5\nN39 G1 Z-1 F500\nN40 G2 X20 Y0 CR=10\nN41 G1 X30\nN42 G0 Z60\nN43 M5\nN44 M30\n";

TEST(ProgramResume, EveryBlockOfAFiveAxisProgramWithTwoTools) {
    const auto machine = machineFile("fooke-endura-ca");
    for (const std::uint32_t block : {18U, 19U, 20U, 21U, 24U, 25U, 39U, 40U, 41U, 42U}) {
        SCOPED_TRACE(block);
        expectSameRest(five_axis, machine, block);
    }
}

TEST(ProgramResume, VectorsAndThreeAxes) {
    const auto machine = machineFile("fooke-endura-ca");
    const std::string vectors =
        "N1 G90 G94 G17 G54\nN2 T=\"B\" M6\nN3 D1\nN4 S5000 M3\nN5 TRAORI\nN6 ORIWKS\nN7 G0 X0 Y0 Z50 A3=0 B3=0 C3=1\n"
        "N8 G1 Z0 F1000\nN9 X1 A3=0.1 B3=0 C3=0.99\nN10 X2 A3=0.2 B3=0 C3=0.97\nN11 X3 A3=0.2 B3=0.1 C3=0.97\nN12 X4\nN13 M30\n";
    for (const std::uint32_t block : {9U, 10U, 11U, 12U}) expectSameRest(vectors, machine, block);
    const auto plain = machineFile("three-axis");
    const std::string flat =
        "N1 G90 G94 G17 G64\nN2 G54\nN3 G0 X0 Y0 Z10\nN4 G1 Z-1 F300\nN5 X10\nN6 G3 X20 Y10 CR=10\nN7 G1 Y20\n"
        "N8 G0 Z10\nN9 X50\nN10 Z1\nN11 G1 Z-2 F200\nN12 Y0\nN13 M30\n";
    for (const std::uint32_t block : {5U, 6U, 7U, 8U, 11U, 12U}) expectSameRest(flat, plain, block);
}

TEST(ProgramResume, BacksUpOverBlocksThatOnlyMove) {
    const auto machine = machineFile("fooke-endura-ca");
    const auto from = [&](std::uint32_t block, unsigned back) {
        const auto preamble = resumePreamble(five_axis, "P.MPF", machine, {.block = block, .back_up_blocks = back});
        EXPECT_TRUE(preamble.has_value());
        return five_axis.substr(preamble->from_byte, 3);
    };
    EXPECT_EQ(from(21, 0), "N21");
    EXPECT_EQ(from(21, 2), "N19");
    EXPECT_EQ(from(24, 3), "N24") << "a new spindle speed stands before it";
    const auto preamble =
        resumePreamble(five_axis, "P.MPF", machine, {.block = 21, .back_up_blocks = 0, .approach_mm = 25.0});
    ASSERT_TRUE(preamble.has_value());
    EXPECT_EQ(
        preamble->text,
        "; resumes before N21, computed by cusp\nG40 G90 G17 G710 G94 G60 G601\nTRAFOOF\nSUPA G0 Z0 D0\n"
        "T=\"BALL_10\"\nM6\nD1\nCYCLE832(0.01,_ORI_FINISH,0.1)\nG54\nS8000 M3\nM8\nG0 C22 A16\nTRAORI\nG54\nORIAXES\n"
        "G0 X5.581389 Y-3.889163 C22 A16\nZ23.781542\nG1 F1500 X3 Y2.5 Z-0.25 C22 A16\nG1\nF1500\n");
}

std::string problem(const std::string& text, std::uint32_t block) {
    const auto preamble = resumePreamble(text, "P.MPF", machineFile("three-axis"), {.block = block});
    EXPECT_FALSE(preamble.has_value());
    return preamble ? "" : base::toText(preamble.error().front());
}

TEST(ProgramResume, WhatCannotBeRepeatedIsRefusedWithItsLine) {
    const std::string by_hand = ": what comes before block N9 has to be written by hand (--preamble) [send.resume]";
    EXPECT_EQ(problem("G90 G54\nM88\nN9 G1 F100 X1 Y1 Z1\nM30\n", 9),
              "P.MPF:2: error: M88 belongs to the machine builder" + by_hand);
    EXPECT_EQ(problem("G90 G54\nR1=5\nN9 G1 F100 X1\nM30\n", 9), "P.MPF:2: error: R1=5 cannot be repeated" + by_hand);
    EXPECT_EQ(problem("G90 G54\nTRANS X5\nN9 G1 F100 X1\nM30\n", 9),
              "P.MPF:2: error: TRANS cannot be repeated" + by_hand);
    EXPECT_EQ(problem("G90 G54\nG0 X0 Y0 Z0\nG1 F100 G91 X1\nN9 X1\nM30\n", 9),
              "P.MPF:4: error: incremental dimensions (G91) hold there; resume where G90 does [send.resume]");
    EXPECT_EQ(
        problem("G90 G54\nG0 X0 Y0 Z0\nG1 G41 F100 X1\nN9 X2\nM30\n", 9),
        "P.MPF:4: error: radius compensation is on there; resume before the block that switches it on [send.resume]");
    EXPECT_EQ(problem("G90 G54\nN9 G1 F100 X1\nM30\n", 9),
              "P.MPF:2: error: the program alone does not say where the tool is there [send.resume]");
    EXPECT_EQ(problem("G90 G54\nN9 M30\n", 9),
              "P.MPF:2: error: nothing moves from this block on: there is nothing to resume [send.resume]");
    EXPECT_EQ(problem("G90 G54\nN9 M30\n", 8), "P.MPF: error: has no block N8 [send.no-block]");
}

TEST(ModalWords, WordsAreScannedAsTheyAreWritten) {
    const auto words = wordsOf("N10 g1 X-1.5Y+2 A3=0.5 T=\"A B;C\" CYCLE832(0.01,_ORI(1),2) G01 ; X9");
    std::string text;
    for (const NcWord& word : words) text += word.name + "|" + word.value + " ";
    EXPECT_EQ(text, "G|1 X|-1.5 Y|+2 A3|0.5 T|\"A B;C\" CYCLE832|(0.01,_ORI(1),2) G|01 ");
    EXPECT_TRUE(wordsOf("; nothing").empty());
    EXPECT_TRUE(ModalWords::onlyMoves("N5 G1 X1 Y2 F100"));
    EXPECT_FALSE(ModalWords::onlyMoves("N5 G1 X1 M8"));
    EXPECT_FALSE(ModalWords::onlyMoves("N5"));
}

}  // namespace
}  // namespace cusp::cli
