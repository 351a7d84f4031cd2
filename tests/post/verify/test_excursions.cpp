// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A tool that leaves the part to unwind rotary axes and comes back to the same place, and those that do not.
#include "program_pair.hpp"

#include <gtest/gtest.h>

namespace cusp::post::verify::test {
namespace {

/// CL lines: 1 spindle, 2 feed, 3 to 6 the points. The C/A head stands upright throughout; program line 10 is the first.
VerifyReport verifySteps(const std::string& blocks) {
    static const toolpath::ToolPath path = straightPath({{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {10, 10, 80}});
    return verify("G54 G17 G710 G94 G90\nS1000 M3\nG0 C0 A0\nTRAORI\nORIAXES\nG54\nD1\nG0 X0 Y0 Z0 C0 A0\nF600\n" +
                      blocks + "M30\n",
                  path, shippedMachine("head-c200-a95"), {});
}

constexpr const char* rest = "X10\nY10\nZ80\n";

TEST(Excursions, OffThePartAndBackToTheSamePlace) {
    const VerifyReport report = verifySteps(std::string("G1 X4\nZ50 F5000\nG0 C180\nG1 Z0 F300\nF600 ") + rest);
    EXPECT_EQ(errorTexts(report), "");
    EXPECT_EQ(report.excursions, 1U);
    EXPECT_EQ(report.matched, 4U);
    EXPECT_EQ(report.extra, 0U);
    // At a point of the CL file too, and in two turns.
    const VerifyReport at_point = verifySteps("G1 X10\nZ50 F5000\nG0 C90\nC180\nG1 Z0 F300\nF600 Y10\nZ80\n");
    EXPECT_EQ(errorTexts(at_point), "");
    EXPECT_EQ(at_point.excursions, 1U);
}

TEST(Excursions, TheCutIsTakenUpAtFeed) {
    EXPECT_EQ(errorTexts(verifySteps(std::string("G1 X4\nZ50 F5000\nG0 C180\nZ0\nG1 F600 ") + rest)),
              "line 13: a rapid (G0) back onto the path: a cut is taken up at feed\n");
}

TEST(Excursions, MustComeBackToTheSamePlace) {
    const std::string away =
        "line 11: this move leaves the path along the tool axis and does not come back to the same "
        "place with the rotary axes turned (before CL line 4)\n";
    EXPECT_EQ(errorTexts(verifySteps(std::string("G1 X4\nZ50 F5000\nG0 C180\nG1 X5 Z0 F600\n") + rest)), away);
    // Nothing turned: what was it for?
    EXPECT_EQ(errorTexts(verifySteps(std::string("G1 X4\nZ50 F5000\nZ0 F600\n") + rest)), away);
    // The tip moves while the axes turn.
    EXPECT_EQ(errorTexts(verifySteps(std::string("G1 X4\nZ50 F5000\nG0 Z40 C180\nG1 Z0\nF600 ") + rest))
                  .substr(0, away.size()),
              away);
    // The program ends off the part.
    EXPECT_EQ(errorTexts(verifySteps("G1 X4\nZ50 F5000\nG0 C180\n")).substr(0, away.size()), away);
    // It goes home from there.
    EXPECT_EQ(errorTexts(verifySteps("G1 X4\nZ50 F5000\nTRAFOOF\nSUPA G0 Z0 D0\n")).substr(0, away.size()), away);
}

TEST(Excursions, TheSpindleKeepsTurning) {
    EXPECT_EQ(errorTexts(verifySteps(std::string("G1 X4\nZ50 F5000\nG0 C180 M5\nG1 Z0 F300\nM3 F600 ") + rest)),
              "line 13: the spindle is off in a feed move, the CL file has it clockwise (M3) (CL line 4)\n");
}

TEST(Excursions, LeaveAlongTheToolAxis) {
    EXPECT_NE(errorTexts(verifySteps(std::string("G1 X4\nX4.1 Z50 F5000\nG0 C180\nG1 X4 Z0\nF600 ") + rest)), "");
    EXPECT_NE(errorTexts(verifySteps(std::string("G1 X4\nZ-50 F5000\nG0 C180\nG1 Z0\nF600 ") + rest)), "");
    EXPECT_NE(errorTexts(verifySteps(std::string("G1 X4\nZ50 C90 F5000\nG0 C180\nG1 Z0\nF600 ") + rest)), "");
}

}  // namespace
}  // namespace cusp::post::verify::test
