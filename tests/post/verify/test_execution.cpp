// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Records made by hand, whose distance from the programmed path is known.
#include <cusp/post/verify/execution.hpp>

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <sstream>

namespace cusp::post::verify {
namespace {

/// A square with a quarter of a circle, and a rapid home.
const std::string program = "G17 G90 G94 G54 G710\n"
                            "G1 F1000 X0 Y0 Z0\n"  // 2
                            "X10\n"                // 3
                            "G3 X20 Y10 CR=10\n"   // 4
                            "G1 X20 Y20\n"         // 5
                            "G0 X0\n"              // 6
                            "M30\n";

MachineFile machineFile() {
    const auto file = readMachineFile(CUSP_SOURCE_DIR "/machines/three-axis.toml");
    EXPECT_TRUE(file.has_value());
    return *file;
}

/// The true way, `step` of every move apart.
std::vector<ExecutedSample> perfect(double step = 0.02) {
    std::vector<ExecutedSample> out;
    const auto add = [&](std::size_t line, double x, double y) {
        out.push_back({0.001 * static_cast<double>(out.size() + 1), line, {{x, y, 0.0}, {0.0, 0.0, 1.0}}});
    };
    const int count = static_cast<int>(std::lround(1.0 / step));
    for (int i = 0; i <= count; ++i) add(3, 10.0 * i * step, 0.0);
    for (int i = 0; i <= count; ++i) {
        const double angle = 0.5 * std::numbers::pi * i * step;
        add(4, 10.0 + 10.0 * std::sin(angle), 10.0 - 10.0 * std::cos(angle));
    }
    for (int i = 0; i <= count; ++i) add(5, 20.0, 10.0 + 10.0 * i * step);
    for (int i = 0; i <= count; ++i) add(6, 20.0 - 20.0 * i * step, 20.0);
    return out;
}

ExecutionReport compared(const std::vector<ExecutedSample>& samples) {
    std::istringstream in(program);
    auto report = compareExecution(in, "P.MPF", machineFile(), samples);
    EXPECT_TRUE(report.has_value()) << base::toText(report.error());
    return *report;
}

TEST(Execution, AFaithfulRunPassesWithItsFigures) {
    const ExecutionReport report = compared(perfect());
    EXPECT_TRUE(report.pass) << base::toText(report.findings);
    EXPECT_EQ(report.samples, 204u);
    EXPECT_EQ(report.cutting, 153u);
    EXPECT_EQ(report.points, 3u) << "the way to the first point begins nobody knows where";
    EXPECT_LT(report.max_tip_mm.value, 2e-4);
}

TEST(Execution, ADeviationIsFoundWhereItIs) {
    auto samples = perfect();
    samples[70].tool.tip_mm.z += 0.03;
    const double in_the_arc_s = samples[70].time_s;
    const ExecutionReport report = compared(samples);
    EXPECT_FALSE(report.pass);
    EXPECT_NEAR(report.max_tip_mm.value, 0.03, 1e-4);
    EXPECT_EQ(report.max_tip_mm.line, 4u);
    EXPECT_DOUBLE_EQ(report.max_tip_mm.time_s, in_the_arc_s);
    ASSERT_EQ(report.findings.errorCount(), 1u);
    EXPECT_EQ(report.findings.front().code, "execution.tip");
    EXPECT_EQ(base::toText(report.findings.front()),
              "P.MPF:4: error: at 0.071 s the tip was 0.0300 mm off the programmed path; 0.011 mm are allowed "
              "[execution.tip]");
}

TEST(Execution, AnAxisThatLeansIsMeasured) {
    auto samples = perfect();
    samples[20].tool.axis = {std::sin(0.01), 0.0, std::cos(0.01)};
    const ExecutionReport report = compared(samples);
    EXPECT_NEAR(report.max_axis_rad.value, 0.01, 1e-6);
    EXPECT_EQ(report.max_axis_rad.line, 3u);
}

TEST(Execution, WhatIsLeftOutIsFound) {
    auto samples = perfect();
    samples.erase(samples.begin() + 51, samples.begin() + 102);  // line 4: straight across the arc
    const ExecutionReport across = compared(samples);
    EXPECT_FALSE(across.pass);
    EXPECT_EQ(across.unreached, 0u);
    ASSERT_EQ(across.findings.errorCount(), 1u);
    EXPECT_EQ(across.findings.front().code, "execution.tip");
    samples = perfect();
    samples.resize(110);  // ends in line 5
    const ExecutionReport shorter = compared(samples);
    EXPECT_FALSE(shorter.pass);
    EXPECT_EQ(shorter.unreached, 1u);
    samples.resize(40);  // ends in line 3
    const ExecutionReport half = compared(samples);
    EXPECT_EQ(half.unreached, 3u);
    EXPECT_EQ(half.findings.front().code, "execution.unreached");
}

TEST(Execution, RapidsAreMeasuredAndNotJudged) {
    auto samples = perfect();
    samples.back().tool.tip_mm.y += 3.0;
    const ExecutionReport report = compared(samples);
    EXPECT_TRUE(report.pass);
    EXPECT_NEAR(report.max_tip_rapid_mm.value, 3.0, 1e-9);
}

TEST(Execution, ProgramsThatRepeatLinesAreRefused) {
    std::istringstream in("G54 G90 G94 G1 F100 X0 Y0 Z0\nREPEAT_HERE:\nX10\nX0\nREPEATB REPEAT_HERE P=2\nM30\n");
    const auto report = compareExecution(in, "P.MPF", machineFile(), perfect());
    ASSERT_FALSE(report.has_value());
    EXPECT_TRUE(report.error().front().code == "execution.repeats" || report.error().front().code.starts_with("nc."));
}

std::string problemsOf(const std::string& text) {
    std::istringstream in(text);
    const auto samples = readExecutionRecord(in, "R.csv");
    EXPECT_FALSE(samples.has_value());
    return samples ? "" : base::toText(samples.error());
}

const std::string heading = "time_s,X_mm,tip_x_mm,tip_y_mm,tip_z_mm,axis_i,axis_j,axis_k,line\n";

TEST(ExecutionRecord, ReadsColumnsByTheirNames) {
    std::istringstream in(heading + "0.002,7,1,2,3,0,0,1,5\r\n0.004,7,1.5,2,-3,0,1,0,6\n");
    const auto samples = readExecutionRecord(in, "R.csv");
    ASSERT_TRUE(samples.has_value());
    ASSERT_EQ(samples->size(), 2u);
    EXPECT_EQ((*samples)[1].line, 6u);
    EXPECT_EQ((*samples)[1].tool.tip_mm.x, 1.5);
    EXPECT_EQ((*samples)[1].tool.axis.y, 1.0);
}

TEST(ExecutionRecord, BadTablesAreRefusedWithTheirLine) {
    EXPECT_EQ(problemsOf("time_s,tip_x_mm,tip_y_mm,tip_z_mm,axis_i,axis_j,axis_k\n"),
              "R.csv:1: error: the first line names no column 'line' [record.heading]\n");
    EXPECT_EQ(problemsOf(heading), "R.csv: error: holds no sample [record.empty]\n");
    EXPECT_EQ(problemsOf(heading + "0.002,7,1,2,3,0,0,1\n"),
              "R.csv:2: error: has 8 fields; the heading has 9 [record.row]\n");
    EXPECT_EQ(problemsOf(heading + "0.002,7,1,nan,3,0,0,1,5\n"),
              "R.csv:2: error: tip_y_mm is 'nan', no number [record.row]\n");
    EXPECT_EQ(problemsOf(heading + "0.002,7,1,2,3,0,0,2,5\n"),
              "R.csv:2: error: the tool axis is 2 long; it has to be 1 [record.row]\n");
    EXPECT_EQ(problemsOf(heading + "0.004,7,1,2,3,0,0,1,5\n0.004,7,1,2,3,0,0,1,5\n"),
              "R.csv:3: error: time_s is 0.004 after 0.004; it has to grow [record.order]\n");
    EXPECT_EQ(problemsOf(heading + "0.002,7,1,2,3,0,0,1,-5\n"),
              "R.csv:2: error: line is no line number [record.row]\n");
    EXPECT_NE(problemsOf(std::string("\0\xFF\n", 3)).find("record.heading"), std::string::npos);
}

}  // namespace
}  // namespace cusp::post::verify
