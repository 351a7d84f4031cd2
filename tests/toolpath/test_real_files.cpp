// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Real CL files against a second, naive reader: a regular expression over lines, sharing nothing with the first.
#include "cl_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <regex>
#include <sstream>

namespace cusp::toolpath::test {
namespace {

const std::string folder = std::string(CUSP_SHARED_DATA) + "/cl/";

struct Counts {
    std::vector<std::array<double, 3>> points;  ///< in the unit of the file
    std::vector<double> feeds;                  ///< as printed
    std::size_t rapids = 0;
    std::size_t circles = 0;
};

/// The witness: one statement per line, numbers by strtod.
Counts countNaively(const std::string& text) {
    static const std::regex go(R"(^GOTO\s*/\s*([^,]+),([^,]+),([^,]+).*)");
    static const std::regex feed(R"(^FEDRAT\s*/.*?([0-9]+\.?[0-9]*).*)");
    Counts counts;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::smatch match;
        if (std::regex_match(line, match, go)) {
            counts.points.push_back({std::strtod(match[1].str().c_str(), nullptr),
                                     std::strtod(match[2].str().c_str(), nullptr),
                                     std::strtod(match[3].str().c_str(), nullptr)});
        } else if (std::regex_match(line, match, feed)) {
            counts.feeds.push_back(std::strtod(match[1].str().c_str(), nullptr));
        }
        counts.rapids += line.rfind("RAPID", 0) == 0 ? 1U : 0U;
        counts.circles += line.rfind("CIRCLE/", 0) == 0 ? 1U : 0U;
    }
    return counts;
}

struct RealFile {
    const char* name;
    Dialect dialect;
    double mm_per_unit;
};

class RealFiles : public testing::TestWithParam<RealFile> {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(folder)) {
            GTEST_SKIP() << folder << " is missing";
        }
    }
};

TEST_P(RealFiles, AgreeWithTheNaiveReader) {
    const RealFile file = GetParam();
    const std::string text = fileText(folder + file.name);
    const Counts naive = countNaively(text);
    const ReadOut out = readOut(text);
    EXPECT_EQ(out.dialect, file.dialect);
    EXPECT_EQ(out.mm_per_unit, file.mm_per_unit);
    std::vector<std::array<double, 3>> points;
    std::vector<double> feeds;
    std::size_t rapids = 0;
    for (const ClRecord& record : out.records) {
        if (const auto* motion = std::get_if<LinearMotion>(&record.statement)) {
            const geometry::Vector3 tip = motion->location.tip_mm / file.mm_per_unit;
            points.push_back({tip.x(), tip.y(), tip.z()});
            rapids += motion->kind == MotionKind::Rapid ? 1U : 0U;
        } else if (const auto* feed = std::get_if<FeedRate>(&record.statement)) {
            feeds.push_back(feed->value * (feed->unit == FeedRate::Unit::MmPerS ? 60.0 : 1.0) / file.mm_per_unit);
        }
    }
    ASSERT_EQ(points.size(), naive.points.size());
    ASSERT_GT(points.size(), 10U);
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            ASSERT_NEAR(points[i][axis], naive.points[i][axis], 1e-12 * std::abs(naive.points[i][axis]))
                << "point " << i;
        }
    }
    ASSERT_EQ(feeds.size(), naive.feeds.size());
    for (std::size_t i = 0; i < feeds.size(); ++i) {
        EXPECT_NEAR(feeds[i], naive.feeds[i], 1e-9);
    }
    EXPECT_EQ(rapids, naive.rapids);
    // Every arc, and nothing else in these files, is an error.
    EXPECT_EQ(out.report.errorCount(), naive.circles);
}

INSTANTIATE_TEST_SUITE_P(, RealFiles,
                         testing::Values(RealFile{"nx_variable_axis.cls", Dialect::Nx, 25.4},
                                         RealFile{"nx_apt_code.cls", Dialect::Nx, 25.4},
                                         RealFile{"nx_zig.cls", Dialect::Nx, 1.0},
                                         RealFile{"nx_zigzag_smoothed.cls", Dialect::Nx, 1.0},
                                         RealFile{"catia_demo4.apt", Dialect::Catia, 1.0}),
                         [](const auto& instance) {
                             std::string name = instance.param.name;
                             std::replace(name.begin(), name.end(), '.', '_');
                             return name;
                         });

std::string readReal(const std::string& name) { return readOut(fileText(folder + name)).problems; }

TEST_F(RealFiles, TurningProgramsAreRefused) {
    EXPECT_EQ(readReal("catia_demo1.apt"),
              "18: error: this is a turning program (TOOLNO/1,TURN); cusp mills [cl.turning]\n");
    EXPECT_EQ(readReal("catia_demo5.apt"),
              "17: error: this is a turning program (TOOLNO/1,TURN); cusp mills [cl.turning]\n");
    EXPECT_NE(
        readReal("catia_demo3.apt").find("29: error: this is a turning program (TURRET/1); cusp mills [cl.turning]\n"),
        std::string::npos);
}

TEST_F(RealFiles, TappingIsNotYetRead) {
    ClReaderOptions options;
    options.mm_per_unit = 1.0;
    EXPECT_EQ(readOut(fileText(folder + "catia_demo2.apt"), options).problems,
              "32: error: CYCLE/TAP is not yet read; without it the tool would go elsewhere than the file says "
              "[cl.unsupported-motion]\n");
}

TEST_F(RealFiles, SolidWorksPointsAxesAndTools) {
    const std::string text = fileText(folder + "swcam_wall_holes.apt");
    const ReadOut out = readOut(text);
    EXPECT_EQ(out.dialect, Dialect::SolidWorksCam);
    const Counts naive = countNaively(text);
    std::size_t points = 0;
    std::size_t tools = 0;
    std::size_t axes[2] = {};
    for (const ClRecord& record : out.records) {
        tools += std::holds_alternative<ToolCall>(record.statement) ? 1U : 0U;
        if (const auto* motion = std::get_if<LinearMotion>(&record.statement)) {
            ++points;
            axes[0] += motion->location.axis == geometry::Vector3::UnitZ() ? 1U : 0U;
            axes[1] += motion->location.axis.cross(geometry::Vector3::UnitX()).norm() == 0.0 ? 1U : 0U;
        }
    }
    EXPECT_EQ(points, naive.points.size());
    EXPECT_EQ(tools, 10U);
    // Six-value GOTOs, by a search of the text, are those across Z.
    static const std::regex six(R"(GOTO/([^,\n]+,){5}[^,\n]+)");
    const auto across = static_cast<std::size_t>(
        std::distance(std::sregex_iterator(text.begin(), text.end(), six), std::sregex_iterator()));
    EXPECT_EQ(axes[1], across);
    EXPECT_EQ(axes[0], points - across);
    // Arcs, tool radius compensation switched on, and drilling cycles: nothing else is in the way.
    static const std::regex unread(R"((^|\n)(CIRCLE/|CUTCOM/(LEFT|RIGHT)|CYCLE/(INIT|DRILL|DEEP2)))");
    EXPECT_EQ(out.report.errorCount(),
              static_cast<std::size_t>(
                  std::distance(std::sregex_iterator(text.begin(), text.end(), unread), std::sregex_iterator())));
    EXPECT_EQ(out.report.warningCount(), 0U);
}

TEST_F(RealFiles, ToolsFramesAndAxes) {
    const std::string nx = readOut(fileText(folder + "nx_variable_axis.cls")).text;
    EXPECT_EQ(nx.substr(0, nx.find("10 rapid")),
              "1 operation 'NORM_PART'\n"
              "3 frame origin 76.19999999999999 76.19999999999999 0 x 1 0 0 y 0 1 0 z 0 0 1\n"
              "10 tool - 'BALL_MILL_1.00' d=25.4 r=12.7 e=0 f=12.7 a=0 b=0 h=76.19999999999999\n");
    EXPECT_NE(readOut(fileText(folder + "nx_apt_code.cls")).text.find("7 tool 1 'MILL_0.120RAD' d="),
              std::string::npos);
    const std::string catia = readOut(fileText(folder + "catia_demo4.apt")).text;
    EXPECT_NE(catia.find("25 tool 1 'T1 Drill D 10' d=16 r=0 e=8 f=4.6188 a=0.523599 b=0 h=50\n"), std::string::npos);
    EXPECT_NE(catia.find("11 frame origin 0 0 94.21417 x 1 0 0 y 0 1 0 z 0 0 1\n"), std::string::npos);
}

}  // namespace
}  // namespace cusp::toolpath::test
