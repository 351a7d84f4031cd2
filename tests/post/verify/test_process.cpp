// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Everything but geometry: the exact words when program and CL file disagree.
#include "program_pair.hpp"

#include <gtest/gtest.h>

namespace cusp::post::verify::test {
namespace {

using namespace cusp::toolpath;

ToolPath pathWithTool() {
    ToolPath path = straightPath({{0, 0, 0}, {10, 0, 0}, {20, 0, 0}});
    path.records.insert(path.records.begin(), {ToolCall{7, "MILL_8", std::nullopt}, 1});
    path.records.insert(path.records.begin(), {CoolantCommand{CoolantCommand::Kind::Flood}, 1});
    return path;
}

VerifyReport verifyHead(const std::string& head, const std::string& last = "X20") {
    return verify(head + "\nG0 X0 Y0 Z0\nG1 X10\n" + last + "\nM30\n", pathWithTool(), shippedMachine("three-axis"));
}

TEST(Process, AllAsTheClFileSays) {
    EXPECT_EQ(errorTexts(verifyHead("G54 T7 M6\nS1000 M3 M8 F600")), "");
    EXPECT_EQ(errorTexts(verifyHead("G54 T=\"mill_8\" M6\nS1000 M3 M8 F600")), "");
    EXPECT_EQ(errorTexts(verifyHead("G54 T7 M6\nG95 S1000 M3 M8 F0.6")), "") << "0.6 mm/rev at 1000 rpm is 600 mm/min";
}

/// 600 mm/min over 10 mm is 60 per minute.
TEST(Process, InverseTimeFeedIsTurnedIntoMmPerMinute) {
    const auto at = [](const std::string& inverse_time) {
        return verify("G54 T7 M6\nS1000 M3 M8\nG0 X0 Y0 Z0\nG93 G1 X10 F" + inverse_time + "\nX20 F60\nM30\n",
                      pathWithTool(), shippedMachine("three-axis"));
    };
    EXPECT_EQ(errorTexts(at("60")), "");
    EXPECT_EQ(errorTexts(at("6")), "line 4: feed is 60 mm/min, the CL file has 600 mm/min (CL line 4)\n");
}

TEST(Process, EachDifferenceInWords) {
    EXPECT_EQ(errorTexts(verifyHead("G54 T7 M6\nS1000 M3 M8 F6000")),
              "line 4: feed is 6000 mm/min, the CL file has 600 mm/min (CL line 4)\n");
    EXPECT_EQ(errorTexts(verifyHead("G54 T7 M6\nS900 M3 M8 F600")),
              "line 4: the spindle runs at 900 rpm, the CL file has 1000 rpm (CL line 4)\n");
    EXPECT_EQ(
        errorTexts(verifyHead("G54 T7 M6\nS1000 M4 M8 F600")),
        "line 4: the spindle is counter-clockwise (M4) in a feed move, the CL file has it clockwise (M3) (CL line 4)\n");
    EXPECT_EQ(errorTexts(verifyHead("G54 T7 M6\nS1000 M8 F600")),
              "line 4: the spindle is off in a feed move, the CL file has it clockwise (M3) (CL line 4)\n");
    EXPECT_EQ(errorTexts(verifyHead("G54 T8 M6\nS1000 M3 M8 F600")),
              "line 4: tool \"8\" is in the spindle, the CL file has tool 7 \"MILL_8\" (CL line 4)\n");
    EXPECT_EQ(errorTexts(verifyHead("G54 T7\nS1000 M3 M8 F600")),
              "line 4: no tool has been changed in, the CL file has tool 7 \"MILL_8\" (CL line 4)\n");
    EXPECT_EQ(errorTexts(verifyHead("G54 T7 M6\nS1000 M3 M7 F600")),
              "line 4: coolant is mist (M7), the CL file has it flood (CL line 4)\n");
    EXPECT_EQ(errorTexts(verifyHead("G54 T7 M6 D0\nS1000 M3 M8 F600")),
              "line 4: the tool length is not applied (D0) in a feed move (CL line 4)\n");
    EXPECT_EQ(errorTexts(verifyHead("G55 T7 M6\nS1000 M3 M8 F600")),
              "line 4: runs in G55, the machine file's work offset is G54 (CL line 4)\n");
}

TEST(Process, ADifferenceThatLastsIsSaidOnceAndAgainWhenItReturns) {
    const std::string head = "G54 T7 M6\nS1000 M3 M8 F6000";
    EXPECT_EQ(verifyHead(head).findings.errorCount(), 1U);
    EXPECT_EQ(errorTexts(verifyHead(head, "X12 F600\nX20 F6000")),
              "line 4: feed is 6000 mm/min, the CL file has 600 mm/min (CL line 4)\n"
              "line 6: feed is 6000 mm/min, the CL file has 600 mm/min (CL line 5)\n");
}

TEST(Process, ASpindleNobodyStartsIsAWarning) {
    ToolPath path = straightPath({{0, 0, 0}, {10, 0, 0}});
    path.records.erase(path.records.begin());
    const VerifyReport report = verify("G54 G0 X0 Y0 Z0\nG1 X10 F600\nM30\n", path, shippedMachine("three-axis"));
    EXPECT_TRUE(report.pass);
    ASSERT_EQ(report.findings.warningCount(), 1U);
    EXPECT_EQ(report.findings.front().message,
              "line 2: the spindle is off in a feed move, as in the CL file (CL line 4)");
}

TEST(Process, TheReportReadsAsAPage) {
    EXPECT_EQ(toText(verifyHead("G54 T7 M6\nS1000 M3 M8 F600")),
              "blocks                6 with words, 3 of them move\n"
              "points                3 in the CL file: 3 met, 0 not\n"
              "other motions         0 on the way between points, 0 links, 0 leading nowhere\n"
              "at block ends         tip 0 mm\n"
              "                      axis 0°\n"
              "between, in cuts      tip 0 mm\n"
              "                      axis 0°\n"
              "between, in rapids    tip 0 mm\n"
              "                      axis 0°\n"
              "rotary limits         kept\n"
              "linear travel         not checked (no setup)\n"
              "result                pass\n");
}

}  // namespace
}  // namespace cusp::post::verify::test
