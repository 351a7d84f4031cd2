// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Setup files: what is read, what is refused and with which words.
#include <cusp/base/atomic_file.hpp>
#include <cusp/machine/setup_definition.hpp>

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <sstream>

namespace cusp::machine {
namespace {

const std::string example = CUSP_SOURCE_DIR "/machines/setups/example.toml";

TEST(SetupFile, TheExampleIsRead) {
    const auto setup = readSetupFile(example);
    ASSERT_TRUE(setup.has_value()) << base::toText(setup.error());
    EXPECT_EQ(setup->tool_library, "../tools/example.toml");
    ASSERT_NE(setup->findOffset("G54"), nullptr);
    EXPECT_EQ(setup->findOffset("G54")->origin_mm, (std::array<double, 3>{2000.0, 0.0, -900.0}));
    EXPECT_EQ(setup->findOffset("G56"), nullptr);
    ASSERT_EQ(setup->fixtures.size(), 1U);
    EXPECT_EQ(setup->fixtures[0].min_mm, (std::array<double, 3>{-100.0, -80.0, -120.0}));
}

TEST(SetupFile, WhatItPrintsItReads) {
    const auto setup = readSetupFile(example);
    ASSERT_TRUE(setup.has_value());
    const std::string text = setupSection().toToml(*setup);
    const auto again = readSetup(text, "again.toml");
    ASSERT_TRUE(again.has_value()) << base::toText(again.error());
    EXPECT_EQ(setupSection().toToml(*again), text);
}

TEST(SetupFile, ToolsAreFoundByWhatAProgramCalls) {
    SetupDefinition setup;
    setup.tools = {{.number = 5, .name = "BALL_6", .length_mm = 100.0},
                   {.number = 7, .name = {}, .length_mm = 110.0},
                   {.number = std::nullopt, .name = "DRILL", .length_mm = 120.0},
                   {.number = 5, .name = "BALL_6", .length_mm = 999.0}};
    EXPECT_EQ(setup.toolLength(std::nullopt, "DRILL"), 120.0);
    EXPECT_EQ(setup.toolLength(7, ""), 110.0);
    EXPECT_EQ(setup.toolLength(5, ""), 100.0);
    // A program that gives a name calls by the name, whatever its number.
    EXPECT_EQ(setup.toolLength(7, "BALL_6"), 100.0);
    EXPECT_EQ(setup.toolLength(7, "MILL"), std::nullopt);
    EXPECT_EQ(setup.toolLength(std::nullopt, ""), std::nullopt);
    EXPECT_EQ(setup.toolLength(8, ""), std::nullopt);
}

std::vector<std::filesystem::path> rejectFiles() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(CUSP_SOURCE_DIR "/tests/kinematics/reject_setup"))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

class RejectedSetupFiles : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(RejectedSetupFiles, GiveExactlyTheDiagnosticsTheyExpect) {
    const std::string text = base::readWholeFile(GetParam().string(), std::size_t{1} << 20U).value_or("");
    const auto setup = readSetup(text, GetParam().filename().string());
    ASSERT_FALSE(setup.has_value()) << "was accepted";
    std::string expected;
    std::istringstream lines(text);
    const std::string mark = "# expect: ";
    for (std::string line; std::getline(lines, line) && line.starts_with(mark);)
        expected += line.substr(mark.size()) + "\n";
    EXPECT_EQ(base::toText(setup.error()), expected);
}

INSTANTIATE_TEST_SUITE_P(Corpus, RejectedSetupFiles, testing::ValuesIn(rejectFiles()), [](const auto& file) {
    std::string name = file.param.stem().string();
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

}  // namespace
}  // namespace cusp::machine
