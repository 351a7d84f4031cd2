// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Real CL files against a second, naive reader: a regular expression over lines, sharing nothing with the first.
#include "cl_text.hpp"

#include <cusp/toolpath/cl_writer.hpp>

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
    std::size_t arcs = 0;
    for (const ClRecord& record : out.records) {
        if (const auto* motion = std::get_if<LinearMotion>(&record.statement)) {
            const geometry::Vector3 tip = motion->location.tip_mm / file.mm_per_unit;
            points.push_back({tip.x(), tip.y(), tip.z()});
            rapids += motion->kind == MotionKind::Rapid ? 1U : 0U;
        } else if (const auto* arc = std::get_if<ArcMotion>(&record.statement)) {
            const geometry::Vector3 tip = arc->end.tip_mm / file.mm_per_unit;
            points.push_back({tip.x(), tip.y(), tip.z()});
            ++arcs;
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
    EXPECT_EQ(arcs, naive.circles);
    EXPECT_EQ(out.report.errorCount(), 0U) << out.problems;
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

/// Read, written, read: the same records; written again: the same text. CATIA and SolidWorks CAM files become plain APT.
TEST_F(RealFiles, ComeBackFromTheWriter) {
    ClReaderOptions options;
    options.mm_per_unit = 1.0;
    for (const char* name : {"nx_variable_axis.cls", "nx_apt_code.cls", "nx_zig.cls", "nx_zigzag_smoothed.cls",
                             "catia_demo2.apt", "catia_demo4.apt", "swcam_wall_holes.apt"}) {
        const std::string original = fileText(folder + name);
        const ReadOut first = readOut(original, name[0] == 'c' ? options : ClReaderOptions{});
        const base::Result<std::string> text = clText({name, first.dialect, 1.0, first.records});
        ASSERT_TRUE(text.has_value()) << base::toText(text.error());
        const ReadOut second = readOut(*text);
        EXPECT_EQ(second.problems, "") << name;
        ASSERT_EQ(second.records.size(), first.records.size()) << name;
        for (std::size_t i = 0; i < first.records.size(); ++i) {
            ASSERT_EQ(textOf(ClRecord{second.records[i].statement, 0}), textOf(ClRecord{first.records[i].statement, 0}))
                << name << ":" << first.records[i].line;
        }
        EXPECT_EQ(clText({name, second.dialect, 1.0, second.records}).value_or(""), *text) << name;
    }
}

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

TEST_F(RealFiles, Tapping) {
    ClReaderOptions options;
    options.mm_per_unit = 1.0;
    const ReadOut out = readOut(fileText(folder + "catia_demo2.apt"), options);
    EXPECT_EQ(out.problems, "");
    // The rapid before the cycle goes to the height that is taken for the clearance.
    EXPECT_NE(out.text.find("31 rapid 0 0 1 axis 0 0 1\n32 cycle tap depth 50.786017 clearance 1\n"
                            "33 hole 0 0 0 axis 0 0 1\n34 cycle end\n"),
              std::string::npos)
        << out.text;
}

std::size_t countOf(const std::string& text, const std::string& pattern) {
    const std::regex regex(pattern);
    return static_cast<std::size_t>(
        std::distance(std::sregex_iterator(text.begin(), text.end(), regex), std::sregex_iterator()));
}

template <class Statement>
std::size_t countOf(const ReadOut& out) {
    return static_cast<std::size_t>(std::count_if(out.records.begin(), out.records.end(), [](const ClRecord& record) {
        return std::holds_alternative<Statement>(record.statement);
    }));
}

TEST_F(RealFiles, SolidWorksDropsNothing) {
    const std::string text = fileText(folder + "swcam_wall_holes.apt");
    const ReadOut out = readOut(text);
    EXPECT_EQ(out.dialect, Dialect::SolidWorksCam);
    EXPECT_EQ(out.problems, "");
    EXPECT_EQ(countOf<ArcMotion>(out), 336U);
    EXPECT_EQ(countOf<ArcMotion>(out), countOf(text, "(^|\\n)CIRCLE/"));
    EXPECT_EQ(countOf<HoleLocation>(out), 6U);
    EXPECT_EQ(countOf<CycleStart>(out), countOf(text, "\\nCYCLE/D"));
    EXPECT_EQ(countOf<CycleEnd>(out), countOf(text, "\\nCYCLE/OFF"));
    EXPECT_EQ(countOf<CutterCompensation>(out), countOf(text, "\\nCUTCOM/"));
    EXPECT_EQ(countOf<WorkPlane>(out), countOf(text, "\\nCSYS/"));
    EXPECT_EQ(countOf<ToolCall>(out), countOf(text, "\\nLOAD/TOOL"));
    EXPECT_EQ(countOf<FeedRate>(out), countOf(text, "\\nFEDRAT/"));
    EXPECT_EQ(countOf<SpindleCommand>(out), countOf(text, "\\nSPINDL/"));
    EXPECT_EQ(countOf<LinearMotion>(out) + countOf<ArcMotion>(out) + countOf<HoleLocation>(out),
              countOf(text, "\\nGOTO/"));
    EXPECT_NE(out.text.find("249 cycle drill depth 5 clearance 3 retract 25 feed "), std::string::npos);
    EXPECT_NE(out.text.find(" first peck 5 peck 2\n266 hole 25 50 0 axis 0 0 1\n267 cycle end\n"), std::string::npos);
    EXPECT_NE(out.text.find("3158 hole 0 25 -30 axis -1 0 0\n"), std::string::npos);
    EXPECT_NE(out.text.find("2117 plane origin 0 0 0 x 0 -1 0 y 0 0 1 z -1 0 0\n"), std::string::npos);
}

/// Three tool directions: +Z, and those of six-value GOTOs. In every plane but the world's the axis that GOTO names is
/// checked against the plane's Z.
TEST_F(RealFiles, SolidWorksToolDirections) {
    const std::string text = fileText(folder + "swcam_wall_holes.apt");
    std::size_t axes[3] = {};
    geometry::Vector3 axis = geometry::Vector3::Zero();
    for (const ClRecord& record : readOut(text).records) {
        if (const auto* motion = std::get_if<LinearMotion>(&record.statement)) {
            axis = motion->location.axis;
        } else if (const auto* arc = std::get_if<ArcMotion>(&record.statement)) {
            EXPECT_EQ(arc->end.axis, axis) << "line " << record.line;
            axis = arc->end.axis;
        } else if (const auto* hole = std::get_if<HoleLocation>(&record.statement)) {
            axis = hole->location.axis;
        } else {
            continue;
        }
        axes[0] += axis == geometry::Vector3::UnitZ() ? 1U : 0U;
        axes[1] += axis == geometry::Vector3::UnitX() ? 1U : 0U;
        axes[2] += axis == geometry::Vector3(-1.0, 0.0, 0.0) ? 1U : 0U;
    }
    EXPECT_EQ(axes[1], countOf(text, "\\nGOTO/[^,\\n]+,[^,\\n]+,[^,\\n]+,1\\.,"));
    EXPECT_EQ(axes[2], countOf(text, "\\nGOTO/[^,\\n]+,[^,\\n]+,[^,\\n]+,-1\\.,"));
    EXPECT_EQ(axes[0] + axes[1] + axes[2], countOf(text, "\\nGOTO/"));
}

/// Every arc by its own numbers: start and end as far from the centre, by a walk over the text.
TEST_F(RealFiles, ArcsLieOnTheirCircles) {
    for (const char* name : {"nx_zig.cls", "nx_zigzag_smoothed.cls", "swcam_wall_holes.apt"}) {
        const ReadOut out = readOut(fileText(folder + name));
        geometry::Vector3 at = geometry::Vector3::Zero();
        for (const ClRecord& record : out.records) {
            if (const auto* motion = std::get_if<LinearMotion>(&record.statement)) {
                at = motion->location.tip_mm;
            } else if (const auto* arc = std::get_if<ArcMotion>(&record.statement)) {
                EXPECT_NEAR((at - arc->center_mm).norm(), arc->radius_mm, 2e-5) << name << ":" << record.line;
                EXPECT_NEAR((arc->end.tip_mm - arc->center_mm).norm(), arc->radius_mm, 2e-5)
                    << name << ":" << record.line;
                EXPECT_NEAR((at - arc->center_mm).dot(arc->normal), 0.0, 1e-9);
                EXPECT_NEAR((arc->end.tip_mm - arc->center_mm).dot(arc->normal), 0.0, 1e-9);
                EXPECT_EQ(arc->full_circle, at == arc->end.tip_mm) << name << ":" << record.line;
                at = arc->end.tip_mm;
            }
        }
    }
}

struct PostedArc {
    bool counter_clockwise;
    double x, y, i, j;  ///< mm
};

/// A naive reader of the posted programs (inch, absolute, I and J from the start), sharing nothing with any of ours.
std::vector<PostedArc> postedArcs(const std::string& text) {
    static const std::regex word(R"(([A-Z])(-?[0-9]*\.?[0-9]+))");
    std::vector<PostedArc> arcs;
    double x = 0.0;
    double y = 0.0;
    int mode = 0;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line[0] != 'N' || line.find("G53") != std::string::npos ||
            line.find("G28") != std::string::npos) {
            continue;
        }
        double i = 0.0;
        double j = 0.0;
        bool moves = false;
        for (std::sregex_iterator it(line.begin(), line.end(), word), end; it != end; ++it) {
            const double value = std::strtod((*it)[2].str().c_str(), nullptr) * 25.4;
            switch ((*it)[1].str()[0]) {
                case 'G': mode = value < 4.0 * 25.4 ? static_cast<int>(value / 25.4 + 0.5) : mode; break;
                case 'X':
                    x = value;
                    moves = true;
                    break;
                case 'Y':
                    y = value;
                    moves = true;
                    break;
                case 'I': i = value; break;
                case 'J': j = value; break;
                default: break;
            }
        }
        if (moves && mode >= 2) {
            arcs.push_back({mode == 3, x, y, i, j});
        }
    }
    return arcs;
}

/// The posted inch program is rounded to 0.0001 inch.
TEST_F(RealFiles, NxArcsAreThoseOfThePostedPrograms) {
    constexpr double rounding_mm = 0.0051;
    const std::pair<const char*, const char*> pairs[] = {{"nx_zig.cls", "nx_zig_haas.nc"},
                                                         {"nx_zigzag_smoothed.cls", "nx_zigzag_smoothed_haas.nc"}};
    std::size_t compared = 0;
    std::size_t posted_as_line = 0;
    for (const auto& [cl_name, nc_name] : pairs) {
        const std::vector<PostedArc> posted = postedArcs(fileText(folder + "../nc/" + nc_name));
        std::size_t next = 0;
        geometry::Vector3 start = geometry::Vector3::Zero();
        for (const ClRecord& record : readOut(fileText(folder + cl_name)).records) {
            if (const auto* motion = std::get_if<LinearMotion>(&record.statement)) {
                start = motion->location.tip_mm;
            }
            const auto* arc = std::get_if<ArcMotion>(&record.statement);
            if (arc == nullptr) {
                continue;
            }
            const geometry::Vector3 from = std::exchange(start, arc->end.tip_mm);
            if ((arc->end.tip_mm - from).norm() < 0.04) {
                ++posted_as_line;  // NX's post wrote the one arc of 0.036 mm as a line
                continue;
            }
            ASSERT_LT(next, posted.size()) << cl_name;
            const PostedArc& p = posted[next++];
            EXPECT_EQ(arc->normal.z() > 0.0, p.counter_clockwise) << cl_name << ":" << record.line;
            EXPECT_NEAR(arc->end.tip_mm.x(), p.x, rounding_mm) << cl_name << ":" << record.line;
            EXPECT_NEAR(arc->end.tip_mm.y(), p.y, rounding_mm) << cl_name << ":" << record.line;
            EXPECT_NEAR(arc->center_mm.x() - from.x(), p.i, rounding_mm) << cl_name << ":" << record.line;
            EXPECT_NEAR(arc->center_mm.y() - from.y(), p.j, rounding_mm) << cl_name << ":" << record.line;
            ++compared;
        }
        EXPECT_EQ(next, posted.size()) << cl_name;
    }
    EXPECT_EQ(compared, 64U);
    EXPECT_EQ(posted_as_line, 1U);
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
