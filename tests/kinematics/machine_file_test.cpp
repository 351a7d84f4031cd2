// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Machine files: what is read, what is refused and with which words, and what is known to be assumed.
#include "shipped_machines.hpp"

#include <cusp/base/units.hpp>
#include <cusp/post/control/control_definition.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

namespace cusp::kinematics::test {
namespace {

using base::radFromDeg;

std::string readText(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

TEST(MachineFile, KeepsUnitsInsideMmRadAndSeconds) {
    const machine::MachineDefinition machine = shippedMachine("head-c200-a95");
    EXPECT_EQ(machine.name, "C/A head, C ±200, A ±95");
    EXPECT_NEAR(machine.linear.at("Z").max_velocity_mm_per_s, 500.0, 1e-12);
    EXPECT_NEAR(machine.rotary.at("C").max_velocity_rad_per_s, radFromDeg(60.0), 1e-15);
    EXPECT_NEAR(machine.rotary.at("A").min_rad.value_or(0.0), radFromDeg(-95.0), 1e-15);
    EXPECT_NEAR(machine.anchors.at(0).rotary_rad.at("A"), radFromDeg(-70.529), 1e-15);
    EXPECT_NEAR(machine.anchors.at(0).tool_axis[2], 1.0 / 3.0, 1e-15);
}

TEST(MachineFile, NormalisesDirections) {
    const machine::Direction b = shippedMachine("nutating-45").rotary.at("B").direction;
    EXPECT_NEAR(b[0], -std::sqrt(0.5), 1e-15);
    EXPECT_EQ(b[1], 0.0);
    EXPECT_NEAR(b[2], -std::sqrt(0.5), 1e-15);
}

TEST(MachineFile, KnowsWhatTheTableCarries) {
    const machine::MachineDefinition nutating = shippedMachine("nutating-45");
    EXPECT_EQ(nutating.axisNames(), (std::vector<std::string>{"C", "X", "Y", "Z", "B"}));
    EXPECT_TRUE(nutating.carriesWorkpiece("C"));
    EXPECT_FALSE(nutating.carriesWorkpiece("B"));
    EXPECT_FALSE(nutating.carriesWorkpiece("X"));
}

TEST(MachineFile, ReadsBackWhatItPrints) {
    for (const std::string& name : shippedMachineNames()) {
        const auto file = post::readMachineFile(CUSP_SOURCE_DIR "/machines/" + name + ".toml");
        ASSERT_TRUE(file) << base::toText(file.error());
        const std::string printed = post::toToml(*file);
        const auto again = post::parseMachineFile(printed, name);
        ASSERT_TRUE(again) << base::toText(again.error());
        EXPECT_EQ(post::toToml(*again), printed) << name;
    }
}

TEST(MachineFile, ListsWhatNoSourceSpeaksOf) {
    EXPECT_EQ(machine::unknownProvenance(shippedMachine("three-axis")),
              (std::vector<std::string>{"chain", "linear.X", "linear.Y", "linear.Z", "spindle"}));
    EXPECT_EQ(machine::unknownProvenance(shippedMachine("haas-umc-bc")),
              (std::vector<std::string>{"linear.X", "linear.Y", "linear.Z", "rotary.B.point_mm", "rotary.B.winding",
                                        "rotary.B.min_deg", "rotary.B.max_deg", "rotary.B.home_deg",
                                        "rotary.B.max_velocity_deg_per_s", "rotary.B.max_acceleration_deg_per_s2",
                                        "rotary.B.max_jerk_deg_per_s3", "rotary.C.point_mm", "rotary.C.winding",
                                        "rotary.C.home_deg", "rotary.C.max_velocity_deg_per_s",
                                        "rotary.C.max_acceleration_deg_per_s2", "rotary.C.max_jerk_deg_per_s3",
                                        "spindle.gauge_point_mm", "spindle.max_speed_rpm"}));
    machine::MachineDefinition known = shippedMachine("three-axis");
    known.sources.push_back({.keys = {"chain", "linear", "spindle"}, .text = "a manual"});
    EXPECT_TRUE(machine::unknownProvenance(known).empty());
}

/// The `# expect:` lines at the top of a file.
std::vector<std::string> expectedDiagnostics(const std::string& text) {
    std::vector<std::string> expected;
    std::istringstream lines(text);
    const std::string mark = "# expect: ";
    for (std::string line; std::getline(lines, line) && line.starts_with(mark);)
        expected.push_back(line.substr(mark.size()));
    return expected;
}

std::vector<std::filesystem::path> rejectFiles() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(CUSP_SOURCE_DIR "/tests/kinematics/reject"))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

class RejectedMachineFiles : public testing::TestWithParam<std::filesystem::path> {};

TEST_P(RejectedMachineFiles, GiveExactlyTheDiagnosticsTheyExpect) {
    const std::string text = readText(GetParam());
    const auto file = post::parseMachineFile(text, GetParam().filename().string());
    ASSERT_FALSE(file) << "was accepted";
    std::vector<std::string> found;
    for (const base::Diagnostic& diagnostic : file.error()) found.push_back(base::toText(diagnostic));
    EXPECT_EQ(found, expectedDiagnostics(text));
}

INSTANTIATE_TEST_SUITE_P(Corpus, RejectedMachineFiles, testing::ValuesIn(rejectFiles()), [](const auto& file) {
    std::string name = file.param.stem().string();
    for (char& c : name)
        if (c == '-') c = '_';
    return name;
});

}  // namespace
}  // namespace cusp::kinematics::test
