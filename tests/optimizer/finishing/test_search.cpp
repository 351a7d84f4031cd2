// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Levelled passes and the paper's problem: what they promise holds on surfaces nobody tuned them to.
#include <cusp/base/units.hpp>
#include <cusp/geometry/surface_file.hpp>
#include <cusp/optimizer/evolution/search.hpp>
#include <cusp/optimizer/finishing/level_passes.hpp>
#include <cusp/optimizer/finishing/optimize_job.hpp>
#include <cusp/optimizer/finishing/paper_problem.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

namespace cusp::finishing {
namespace {

/// A wave, hollow at one end and domed at the other: z = 8 u² (3 − 2 u) + v (1 − v) over 50 × 30 mm.
std::vector<geometry::SurfaceFace> wave() {
    return geometry::readSurface("schema = 1\nname = \"wave\"\n[[face]]\nform = \"polynomial\"\noutward = \"du x dv\"\n"
                                 "x_mm = { \"u\" = 50.0 }\ny_mm = { \"v\" = 30.0 }\n"
                                 "z_mm = { \"u^2\" = 24.0, \"u^3\" = -16.0, \"v\" = 1.0, \"v^2\" = -1.0 }\n",
                                 "wave.toml")
        .value();
}

toolpath::ToolLibrary tools() {
    return toolpath::readToolLibraryFile(CUSP_SOURCE_DIR "/examples/benchmark/tools.toml").value();
}

TEST(LevelPasses, KeepTheToleranceOnAConvexConcaveWave) {
    const auto faces = wave();
    const Workpiece part{faces, nullptr};
    const geometry::Cutter cutter = tools().findName("TORUS_12_R2")->cutter();
    PlanOptions options;
    options.passes.family = PassOptions::Family::ConstantV;
    options.passes.placement = PassOptions::Placement::Scallop;
    options.passes.scallop_mm = 0.02;
    options.passes.step_over_mm = 12.0;
    options.orientation.adaptive = true;
    options.orientation.lead_rad = base::radFromDeg(0.5);
    options.orientation.depth_offset_mm = -0.008;
    options.steps.chord_tolerance_mm = 0.001;
    options.links.run_out_mm = 5.0;
    LevelOptions level;
    level.grid_mm = 0.8;
    const auto usual = layOutPasses(faces, nullptr, cutter, options);
    ASSERT_TRUE(usual.has_value());
    const auto path = levelPasses(part, cutter, options, static_cast<std::int64_t>(usual->size()) + 2, level);
    ASSERT_TRUE(path.has_value());
    EXPECT_LE(path->excess, 1.0) << path->left.overcut_max_mm << " " << path->left.undercut_max_mm;
    // Its options plan the same path again, and a grid four times as fine finds no more than the tolerance they stand for.
    const auto again = lookAtPath(part, cutter, path->path.contacts.options, {.grid_mm = 0.2});
    ASSERT_TRUE(again.has_value());
    EXPECT_EQ(again->path.contacts.points.size(), path->path.contacts.points.size());
    EXPECT_LE(again->left.overcut_max_mm, 0.01);
    EXPECT_LE(again->left.undercut_max_mm, 0.01);
}

TEST(PaperProblem, SameSeedSameResultAndNoWorseThanChance) {
    const auto faces = geometry::readSurfaceFile(CUSP_SOURCE_DIR "/examples/benchmark/surface.toml").value();
    const Workpiece part{faces, nullptr};
    PaperProblem problem;
    problem.tools = tools().tools;
    problem.normalising_samples = 64;
    problem.options.steps = {StepOptions::Method::Bisection, StepOptions::Measure::Surface, 0.01, 1000.0, 3.0};
    const auto encoding = paperEncoding(problem);
    ASSERT_TRUE(encoding.has_value());
    EXPECT_EQ(encoding->length(), 46U);
    const auto objective = paperObjective(part, problem);
    ASSERT_TRUE(objective.has_value());
    optimizer::SearchOptions options;
    options.max_evaluations = 200;
    const auto evaluate = paperEvaluator(part, problem, *objective);
    const auto first = optimizer::search(*encoding, evaluate, options);
    const auto second = optimizer::search(*encoding, evaluate, options);
    options.algorithm = optimizer::Algorithm::RandomSearch;
    const auto chance = optimizer::search(*encoding, evaluate, options);
    ASSERT_TRUE(first && second && chance);
    EXPECT_EQ(first->bestValues(), second->bestValues());
    EXPECT_EQ(first->evaluations, 200U);
    EXPECT_LT(first->bestObjective(), chance->bestObjective());
}

std::string fileText(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

TEST(OptimizeJobs, EveryRejectGivesItsExactProblems) {
    std::size_t files = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(CUSP_SOURCE_DIR "/tests/optimizer/finishing/reject/optimize")) {
        const std::string text = fileText(entry.path());
        std::string expected;
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);)
            if (line.starts_with("# expect: ")) expected += line.substr(10) + "\n";
        const auto job = readOptimizeJob(text, "job.toml");
        ASSERT_FALSE(job.has_value()) << entry.path();
        EXPECT_EQ(base::toText(job.error()), expected) << entry.path();
        ++files;
    }
    EXPECT_GE(files, 2U);
}

TEST(OptimizeJobs, ExamplesReadAndPrintBackTheSame) {
    for (const char* name : {"paper.toml", "true.toml"}) {
        const auto job = readOptimizeJobFile(std::string(CUSP_SOURCE_DIR "/examples/benchmark/") + name);
        ASSERT_TRUE(job.has_value()) << base::toText(job.error());
        const std::string printed = optimizeJobSection().toToml(*job);
        const auto again = readOptimizeJob(printed, "printed.toml");
        ASSERT_TRUE(again.has_value()) << base::toText(again.error());
        EXPECT_EQ(optimizeJobSection().toToml(*again), printed);
    }
}

}  // namespace
}  // namespace cusp::finishing
