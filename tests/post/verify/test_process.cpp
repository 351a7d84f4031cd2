// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Everything but geometry: the exact words when program and CL file disagree.
#include "program_pair.hpp"

#include <gtest/gtest.h>

#include <algorithm>

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
              "line 4: runs in G55, the work offset of the CL file's frame is G54 (CL line 4)\n");
}

TEST(Process, TheCuttingEdge) {
    EXPECT_EQ(errorTexts(verifyHead("G54 T7 M6 D2\nS1000 M3 M8 F600")),
              "line 4: the tool is applied with D2, expected is D1 (CL line 4)\n");
    VerifyOptions options;
    options.cutting_edge = 2;
    EXPECT_EQ(errorTexts(verify("G54 T7 M6 D2\nS1000 M3 M8 F600\nG0 X0 Y0 Z0\nG1 X10\nX20\nM30\n", pathWithTool(),
                                shippedMachine("three-axis"), options)),
              "");
}

/// Under CUTCOM the contour is compared, and the report says so.
TEST(Process, CutterCompensation) {
    ToolPath path = pathWithTool();
    const auto motion = std::find_if(path.records.begin(), path.records.end(), [](const ClRecord& record) {
        const auto* linear = std::get_if<LinearMotion>(&record.statement);
        return linear != nullptr && linear->kind == MotionKind::Feed;
    });
    path.records.insert(motion, {CutterCompensation{CutterCompensation::Side::Left, std::nullopt}, 3});
    const auto with = [&](const std::string& code) {
        return verify("G54 T7 M6\nS1000 M3 M8 F600\nG0 X0 Y0 Z0\n" + code + " G1 X10\nX20\nG40\nM30\n", path,
                      shippedMachine("three-axis"));
    };
    const VerifyReport left = with("G41");
    EXPECT_TRUE(left.pass);
    ASSERT_EQ(left.findings.size(), 1U);
    EXPECT_EQ(left.findings.front().code, "verify.contour");
    EXPECT_EQ(errorTexts(with("G42")),
              "line 4: cutter compensation is right (G42), the CL file has it left (G41) (CL line 4)\n");
    EXPECT_EQ(errorTexts(with("")), "line 4: cutter compensation is off, the CL file has it left (G41) (CL line 4)\n");
}

/// Points are in the frame of their MSYS; each frame has a work offset of its own.
TEST(Process, EachFrameOfTheClFileHasItsWorkOffset) {
    ToolPath path;
    std::uint32_t line = 0;
    const auto record = [&](ClStatement statement) { path.records.push_back({std::move(statement), ++line}); };
    record(SpindleCommand{SpindleCommand::Turn::Clockwise, 1000.0, SpindleCommand::Unit::Rpm});
    record(FeedRate{10.0, FeedRate::Unit::MmPerS});
    for (const double x : {0.0, 100.0, 0.0}) {
        ProgrammingFrame frame;
        frame.part_from_programming.translation().x() = x;
        record(frame);
        for (const double end : {0.0, 10.0}) {
            LinearMotion motion;
            motion.location.tip_mm = {end, 0.0, 0.0};
            motion.kind = end == 0.0 ? MotionKind::Rapid : MotionKind::Feed;
            record(motion);
        }
    }
    const auto run = [&](const std::string& second, const std::string& third, std::vector<std::string> names = {}) {
        const std::string cut = " G0 X0 Y0 Z0\nG1 X10 F600\n";
        VerifyOptions options;
        options.work_offsets = std::move(names);
        return errorTexts(verify("S1000 M3\nG54" + cut + second + cut + third + cut + "M30\n", path,
                                 shippedMachine("three-axis"), options));
    };
    EXPECT_EQ(run("G55", "G54"), "");
    EXPECT_EQ(run("G54", "G54"), "line 5: runs in G54, the work offset of the CL file's frame is G55 (CL line 8)\n");
    EXPECT_EQ(run("G55", "G56"), "line 7: runs in G56, the work offset of the CL file's frame is G54 (CL line 11)\n");
    EXPECT_EQ(run("G505", "G54", {"G54", "G505"}), "");
    EXPECT_EQ(run("G55", "G54", {"G54", "G505"}),
              "line 5: runs in G55, the work offset of the CL file's frame is G505 (CL line 8)\n");
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
