// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Jobs that cannot be planned end in the exact diagnostics their first lines announce.
#include <cusp/geometry/surface_file.hpp>
#include <cusp/optimizer/finishing/feasibility.hpp>
#include <cusp/optimizer/finishing/plan_job.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

namespace cusp::finishing {
namespace {

std::string fileText(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string expectedProblems(const std::string& text) {
    const std::string mark = "# expect: ";
    std::istringstream lines(text);
    std::string expected;
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(mark)) expected += line.substr(mark.size()) + "\n";
    return expected;
}

TEST(PlanJobs, EveryRejectGivesItsExactProblems) {
    std::size_t files = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(CUSP_SOURCE_DIR "/tests/optimizer/finishing/reject/plan")) {
        const std::string text = fileText(entry.path());
        const auto job = readPlanJob(text, "job.toml");
        ASSERT_FALSE(job.has_value()) << entry.path();
        EXPECT_EQ(base::toText(job.error()), expectedProblems(text)) << entry.path();
        ++files;
    }
    EXPECT_GE(files, 5U);
}

TEST(PlanJobs, ExamplesReadAndPrintBackTheSame) {
    for (const char* name : {"table2_ga.toml", "table2_vega.toml"}) {
        const auto job = readPlanJobFile(std::string(CUSP_SOURCE_DIR "/examples/benchmark/") + name);
        ASSERT_TRUE(job.has_value()) << base::toText(job.error());
        const std::string printed = planJobSection().toToml(*job);
        const auto again = readPlanJob(printed, "printed.toml");
        ASSERT_TRUE(again.has_value()) << base::toText(again.error());
        EXPECT_EQ(planJobSection().toToml(*again), printed);
    }
}

geometry::Cutter cutterOf(double diameter_mm, double corner_mm) {
    geometry::Cutter cutter;
    cutter.diameter_mm = diameter_mm;
    cutter.corner_radius_mm = corner_mm;
    cutter.corner_e_mm = diameter_mm / 2.0 - corner_mm;
    cutter.corner_f_mm = corner_mm;
    cutter.cutting_height_mm = 30.0;
    return cutter;
}

/// A trough along X: z = y² / (2 R), its smallest radius R at the bottom, known.
std::vector<geometry::SurfaceFace> trough(double radius_mm) {
    return geometry::readSurface(
               "schema = 1\nname = \"trough\"\n[[face]]\nform = \"polynomial\"\noutward = \"du x dv\"\n"
               "u_range = [-1.0, 1.0]\nx_mm = { \"u\" = 10.0 }\ny_mm = { \"v\" = 20.0, \"1\" = -10.0 }\n"
               "z_mm = { \"v^2\" = " +
                   std::to_string(200.0 / radius_mm) + ", \"v\" = " + std::to_string(-200.0 / radius_mm) +
                   ", \"1\" = " + std::to_string(50.0 / radius_mm) + " }\n",
               "trough.toml")
        .value();
}

std::string codesOf(const base::Diagnostics& report) {
    std::string out;
    for (const auto& item : report) out += item.code + (item.severity == base::Severity::Error ? "! " : " ");
    return out;
}

TEST(Feasibility, KnowsTheSmallestRadius) {
    const auto faces = trough(25.0);
    EXPECT_NEAR(mostHollow({faces, nullptr}).curvature_per_mm, 1.0 / 25.0, 1e-9);
}

TEST(Feasibility, SaysWhatIsWrong) {
    const auto faces = trough(25.0);
    const auto tight = trough(4.0);
    OrientationOptions upright;
    OrientationOptions leaned;
    leaned.lead_rad = 0.35;
    EXPECT_EQ(codesOf(checkFeasible({faces, nullptr}, cutterOf(16.0, 0.0), upright)),
              "finishing.lead-zero! finishing.lead-low ");
    EXPECT_EQ(codesOf(checkFeasible({faces, nullptr}, cutterOf(16.0, 3.0), upright)), "finishing.lead-low ");
    EXPECT_EQ(codesOf(checkFeasible({faces, nullptr}, cutterOf(16.0, 3.0), leaned)), "");
    EXPECT_EQ(codesOf(checkFeasible({tight, nullptr}, cutterOf(16.0, 8.0), leaned)), "finishing.offset! ");
    EXPECT_EQ(codesOf(checkFeasible({tight, nullptr}, cutterOf(16.0, 3.0), leaned)), "finishing.offset! ");
    OrientationOptions adaptive;
    adaptive.adaptive = true;
    adaptive.lead_max_rad = 0.1;
    EXPECT_EQ(codesOf(checkFeasible({faces, nullptr}, cutterOf(16.0, 0.0), adaptive)), "finishing.lead-max ");
    const auto text = toText(checkFeasible({tight, nullptr}, cutterOf(16.0, 8.0), leaned));
    EXPECT_NE(text.find("a ball radius of 8 mm is larger than the smallest radius of the surface, 4.000 mm"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("a ball diameter below 8.000 mm is needed"), std::string::npos) << text;
}

}  // namespace
}  // namespace cusp::finishing
