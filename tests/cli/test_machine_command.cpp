// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp machine check` from the outside.
#include "command_line.hpp"

namespace cusp::cli {
namespace {

using MachineCommand = CommandLine;

std::string shippedMachine(const std::string& name) {
    return base::readWholeFile(std::string(CUSP_SOURCE_DIR) + "/machines/" + name + ".toml", std::size_t{1} << 20U)
        .value();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST_F(MachineCommand, EveryShippedMachineIsSound) {
    std::size_t machines = 0;
    for (const auto& entry : std::filesystem::directory_iterator(std::string(CUSP_SOURCE_DIR) + "/machines")) {
        if (entry.path().extension() != ".toml") continue;
        ++machines;
        const auto outcome = run({"machine", "check", entry.path().string(), "--poses", "2000"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.output << outcome.errors;
        EXPECT_EQ(run({"machine", "check", entry.path().stem().string(), "--poses", "10"}).exit_code, 0);
    }
    EXPECT_GE(machines, 6U);
}

TEST_F(MachineCommand, AWrongSignIsSeenByTheAnchor) {
    const std::string text =
        replaced(shippedMachine("head-c200-a95"), "[rotary.A]\ndirection = [1.0,", "[rotary.A]\ndirection = [-1.0,");
    const std::string file = write("wrong.toml", text);
    const auto outcome = run({"machine", "check", file, "--poses", "100"});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.output << outcome.errors;
    EXPECT_NE(outcome.output.find("NOT MET"), std::string::npos) << outcome.output;
}

TEST_F(MachineCommand, EveryProblemIsToldAtOnceWithItsPlace) {
    std::string text = shippedMachine("fooke-endura-ca");
    text = replaced(text, "winding = \"limited\"", "winding = \"never\"");
    text = replaced(text, "max_speed_rpm", "max_speed");
    const auto outcome = run({"machine", "check", write("broken.toml", text)});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_NE(outcome.errors.find("broken.toml:"), std::string::npos) << outcome.errors;
    EXPECT_NE(outcome.errors.find("winding"), std::string::npos) << outcome.errors;
    EXPECT_NE(outcome.errors.find("max_speed"), std::string::npos) << outcome.errors;
}

TEST_F(MachineCommand, PrintConfigReadsBackToItself) {
    const auto first = run({"machine", "check", "nutating-45", "--print-config"});
    ASSERT_EQ(first.exit_code, 0) << first.errors;
    const auto second = run({"machine", "check", write("again.toml", first.output), "--print-config"});
    EXPECT_EQ(second.exit_code, 0) << second.errors;
    EXPECT_EQ(first.output, second.output);
    EXPECT_NE(first.output.find("[control]"), std::string::npos);
}

TEST_F(MachineCommand, JsonListsLawsAnchorsAndAssumptions) {
    const auto outcome = run({"machine", "check", "haas-umc-bc", "fooke-endura-ca", "--poses", "500", "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    const auto json = nlohmann::json::parse(outcome.output);
    ASSERT_EQ(json["machines"].size(), 2U);
    EXPECT_TRUE(json["machines"][0]["sound"]);
    EXPECT_GE(json["machines"][0]["anchors"].size(), 3U);
    EXPECT_GE(json["machines"][0]["laws"].size(), 5U);
    EXPECT_GE(json["machines"][1]["assumed"].size(), 1U);
}

TEST_F(MachineCommand, ALawThatDoesNotApplyIsNotCalledBroken) {
    const auto outcome = run({"machine", "check", "three-axis", "--poses", "200"});
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.output.find("tool axis at the pole, first axis anywhere       does not apply to this machine\n"),
              std::string::npos)
        << outcome.output;
    EXPECT_EQ(outcome.output.find("BROKEN"), std::string::npos) << outcome.output;
    const auto json = nlohmann::json::parse(run({"machine", "check", "three-axis", "--poses", "200", "--json"}).output);
    for (const auto& law : json["machines"][0]["laws"]) EXPECT_EQ(law["pass"].is_null(), law["checked"] == 0) << law;
}

TEST_F(MachineCommand, AnUnanchoredMachineSaysSoWhenItIsUsed) {
    const std::string cl = write("part.cls", small_cl);
    const std::string said = "this machine is unanchored";
    const auto fooke = run({"post", cl, "-m", "fooke-endura-ca", "-o", path("A.MPF")});
    EXPECT_NE(fooke.output.find(said), std::string::npos) << fooke.output;
    EXPECT_EQ(run({"post", cl, "-m", "head-c200-a95", "-o", path("B.MPF")}).output.find(said), std::string::npos);
    EXPECT_NE(run({"verify", path("A.MPF"), "-m", "fooke-endura-ca", "--against", cl}).output.find(said),
              std::string::npos);
    EXPECT_EQ(run({"verify", path("B.MPF"), "-m", "head-c200-a95", "--against", cl}).output.find(said),
              std::string::npos);
}

}  // namespace
}  // namespace cusp::cli
