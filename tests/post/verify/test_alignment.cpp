// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Which block belongs to which CL point, on small programs one can follow by eye.
#include "program_pair.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace cusp::post::verify::test {
namespace {

constexpr const char* begin = "G54 G17 G710 G94 G90\nS1000 M3\nG0 X0 Y0 Z0\nF600\n";

/// CL lines: 1 spindle, 2 feed, 3 to 7 the points.
VerifyReport verifySteps(const std::string& blocks, const VerifyOptions& options = {}) {
    static const toolpath::ToolPath path = straightPath({{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {20, 10, 0}, {20, 10, 5}});
    return verify(begin + blocks + "M30\n", path, shippedMachine("three-axis"), options);
}

TEST(Alignment, EveryPointIsMet) {
    const VerifyReport report = verifySteps("G1 X10\nY10\nX20\nZ5\n");
    EXPECT_EQ(errorTexts(report), "");
    EXPECT_TRUE(report.pass);
    EXPECT_EQ(report.points, 5U);
    EXPECT_EQ(report.matched, 5U);
    EXPECT_EQ(report.max_tip_error_mm.value, 0.0);
    EXPECT_FALSE(report.linear_travel_checked);
}

TEST(Alignment, PointsOnTheWayAreIntermediate) {
    const VerifyReport report = verifySteps("G1 X3\nX7.5\nX10\nY10\nX20\nZ1\nZ5\n");
    EXPECT_EQ(errorTexts(report), "");
    EXPECT_EQ(report.intermediate, 3U);
}

TEST(Alignment, GoingBackOnTheWayIsNoProgress) {
    EXPECT_EQ(errorTexts(verifySteps("G1 X7\nX3\nX10\nY10\nX20\nZ5\n")),
              "line 6: this feed move leads nowhere in the CL file (before CL line 4)\n");
}

TEST(Alignment, ADisplacedPointIsNamedWithItsDistance) {
    const VerifyReport report = verifySteps("G1 X10\nN60 Y10.012\nN70 X20 Y10\nZ5\n");
    EXPECT_EQ(errorTexts(report), "block N60 (line 6): tip is 0.012 mm from CL line 5, tolerance 0.001 mm\n");
    EXPECT_EQ(report.missed, 1U);
    EXPECT_NEAR(report.max_tip_error_mm.value, 0.012, 1e-12);
    EXPECT_EQ(report.max_tip_error_mm.program_line, 6U);
    EXPECT_EQ(report.max_tip_error_mm.cl_line, 5U);
}

TEST(Alignment, DroppedPointsAreNamed) {
    const VerifyReport report = verifySteps("G1 X20 Y10\nZ5\n");
    EXPECT_EQ(errorTexts(report), "CL line 4: no block ends at this point\nCL line 5: no block ends at this point\n");
    EXPECT_EQ(report.matched, 3U);
}

TEST(Alignment, TheEndMayNotBeMissing) {
    EXPECT_EQ(errorTexts(verifySteps("G1 X10\nY10\nX20\n")), "CL line 7: no block ends at this point\n");
}

TEST(Alignment, ABlockTooManyIsNamed) {
    EXPECT_EQ(errorTexts(verifySteps("G1 X10\nX11 Y-3\nX10 Y10\nX20\nZ5\n")),
              "line 6: this feed move leads nowhere in the CL file (before CL line 5)\n");
    EXPECT_EQ(errorTexts(verifySteps("G1 X10\nY10\nX20\nZ5\nZ-5\n")),
              "line 9: this feed move leads nowhere in the CL file, whose last point is met\n");
    EXPECT_EQ(errorTexts(verifySteps("G1 X10\nX10\nY10\nX20\nZ5\n")),
              "line 6: repeats the point before it, which the CL file has once (before CL line 5)\n");
}

TEST(Alignment, APointTheClFileHasTwiceNeedsOneBlockOrTwo) {
    const toolpath::ToolPath path = straightPath({{0, 0, 0}, {10, 0, 0}, {10, 0, 0}, {20, 0, 0}});
    const MachineFile machine = shippedMachine("three-axis");
    for (const char* blocks : {"G1 X10\nX20\nM30\n", "G1 X10\nX10\nX20\nM30\n"}) {
        const VerifyReport report = verify(std::string(begin) + blocks, path, machine);
        EXPECT_EQ(errorTexts(report), "") << blocks;
        EXPECT_EQ(report.matched, 4U) << blocks;
    }
}

TEST(Alignment, LinksAreAllowedOutsideOperationsOnly) {
    const VerifyReport good = verifySteps("G1 X10\nY10\nX20\nZ5\nSUPA G0 Z0\nG0 X500\n");
    EXPECT_EQ(errorTexts(good), "");
    EXPECT_EQ(good.links, 2U);
    EXPECT_EQ(errorTexts(verifySteps("G1 X10\nSUPA G0 Z0\nG0 X10 Y0 Z0\nG1 Y10\nX20\nZ5\n")),
              "line 6: this rapid leaves the path in the middle of an operation (before CL line 5)\n"
              "line 7: a rapid (G0) where CL line 5 is a feed move\n");
}

TEST(Alignment, RapidAndFeedAreToldApart) {
    EXPECT_EQ(errorTexts(verifySteps("G0 X10\nG1 Y10\nX20\nZ5\n")),
              "line 5: a rapid (G0) where CL line 4 is a feed move\n");
}

TEST(Alignment, AnArcMustStayOnTheClMove) {
    EXPECT_EQ(errorTexts(verifySteps("G2 X10 CR=50\nG1 Y10\nX20\nZ5\n")),
              "line 5: between its ends the tip is up to 0.251 mm off the move to CL line 4, tolerance 0.001 mm\n");
}

TEST(Alignment, TolerancesAreOptions) {
    VerifyOptions loose;
    loose.tip_tolerance_mm = 0.02;
    loose.between_tip_tolerance_mm = 0.02;
    const VerifyReport report = verifySteps("G1 X10\nY10.012\nX20 Y10\nZ5\n", loose);
    EXPECT_EQ(errorTexts(report), "");
    EXPECT_NEAR(report.max_tip_error_mm.value, 0.012, 1e-12);
}

TEST(Alignment, WithoutAClFileTheProgramAloneIsLookedAt) {
    std::istringstream in("TRAORI\nG54 G1 X0 Y0 Z0 A96 C201 F100\nM30\n");
    const auto report = verifyProgram(in, "P.MPF", shippedMachine("head-c200-a95"), nullptr);
    ASSERT_TRUE(report);
    EXPECT_FALSE(report->compared);
    EXPECT_EQ(errorTexts(*report),
              "line 2: axis C is at 201°, beyond its limit 200°\nline 2: axis A is at 96°, beyond its limit 95°\n");
    EXPECT_EQ(report->limit_violations, 2U);
    EXPECT_EQ(report->findings.warningCount(), 1U);
}

}  // namespace
}  // namespace cusp::post::verify::test
