// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The tool library: the example that ships, derived cutters, and the reject corpus.
#include "cl_text.hpp"

#include <cusp/toolpath/tool_library.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>

namespace cusp::toolpath::test {
namespace {

const std::string example = CUSP_SOURCE_DIR "/machines/tools/example.toml";

TEST(ToolLibrary, TheExampleHasOneToolOfEachShape) {
    const base::Result<ToolLibrary> library = readToolLibraryFile(example);
    ASSERT_TRUE(library.has_value()) << base::toText(library.error());
    ASSERT_EQ(library->tools.size(), 4U);
    const Tool* const ball = library->findNumber(1);
    ASSERT_NE(ball, nullptr);
    EXPECT_EQ(ball, library->findName("BALL_10"));
    EXPECT_EQ(ball->gauge_length_mm, 120.0);
    EXPECT_EQ(ball->holder_mm, (std::vector<ToolRing>{{40.0, 28.0}, {30.0, 50.0}}));
    EXPECT_EQ(library->findNumber(99), nullptr);
    EXPECT_EQ(library->findName("BALL"), nullptr);
}

TEST(ToolLibrary, DerivesTheSevenValues) {
    const base::Result<ToolLibrary> library = readToolLibraryFile(example);
    ASSERT_TRUE(library.has_value());
    const geometry::Cutter ball = library->tools[0].cutter();
    EXPECT_EQ(ball.corner_radius_mm, 5.0);
    EXPECT_NEAR(ball.corner_e_mm, 0.0, 1e-12);
    EXPECT_NEAR(ball.corner_f_mm, 5.0, 1e-12);
    EXPECT_EQ(ball.cutting_height_mm, 20.0);
    const geometry::Cutter flat = library->tools[1].cutter();
    EXPECT_EQ(flat.corner_radius_mm, 0.0);
    EXPECT_NEAR(flat.corner_e_mm, 8.0, 1e-12);
    EXPECT_NEAR(flat.corner_f_mm, 0.0, 1e-12);
    const geometry::Cutter torus = library->tools[2].cutter();
    EXPECT_NEAR(torus.corner_e_mm, 5.0, 1e-12);
    EXPECT_NEAR(torus.corner_f_mm, 3.0, 1e-12);
    const geometry::Cutter taper = library->tools[3].cutter();
    const double b = 3.0 * std::numbers::pi / 180.0;
    EXPECT_NEAR(taper.taper_angle_rad, b, 1e-15);
    EXPECT_NEAR(taper.corner_f_mm, 1.0, 1e-12);
    // The flank leaves (1.5, 0) at the taper angle: the corner circle's centre is its radius away from it.
    EXPECT_NEAR((1.5 - taper.corner_e_mm) * std::cos(b) + taper.corner_f_mm * std::sin(b), 1.0, 1e-12);
}

TEST(ToolLibrary, WhatItPrintsItReads) {
    const base::Result<ToolLibrary> library = readToolLibraryFile(example);
    ASSERT_TRUE(library.has_value());
    const std::string text = toolLibrarySection().toToml(*library);
    const base::Result<ToolLibrary> again = readToolLibrary(text, "again.toml");
    ASSERT_TRUE(again.has_value()) << base::toText(again.error());
    EXPECT_EQ(toolLibrarySection().toToml(*again), text);
    EXPECT_EQ(again->tools[3].taper_rad, library->tools[3].taper_rad);
}

TEST(ToolLibrary, EveryRejectGivesItsExactProblems) {
    const std::string mark = "# expect: ";
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(CUSP_SOURCE_DIR "/tests/toolpath/reject_tools")) {
        const std::string text = fileText(entry.path());
        std::istringstream lines(text);
        std::string expected;
        for (std::string line; std::getline(lines, line) && line.starts_with(mark);) {
            expected += line.substr(mark.size()) + "\n";
        }
        const base::Result<ToolLibrary> library = readToolLibrary(text, "t.toml");
        ASSERT_FALSE(library.has_value()) << entry.path();
        EXPECT_EQ(base::toText(library.error()), expected) << entry.path();
        ++files;
    }
    EXPECT_GE(files, 4U);
}

}  // namespace
}  // namespace cusp::toolpath::test
