// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp plan` as its users run it: the path is a CL file that the other commands take.
#include "command_line.hpp"

namespace cusp::cli {
namespace {

using PlanCommand = CommandLine;

const std::string benchmark = std::string(CUSP_SOURCE_DIR) + "/examples/benchmark/";

TEST_F(PlanCommand, TheBenchmarkIsPlannedPostedAndVerified) {
    const auto planned = run({"plan", benchmark + "table2_vega.toml", "-o", path("p.apt"), "--json"});
    ASSERT_EQ(planned.exit_code, 0) << planned.errors;
    const auto json = nlohmann::json::parse(planned.output);
    EXPECT_NEAR(json.at("cc_points").get<double>(), 289.0, 0.02 * 289.0);
    EXPECT_NEAR(json.at("mean_chord_error_mm").get<double>(), 0.0036, 0.15 * 0.0036);
    EXPECT_EQ(json.at("passes"), 15);
    EXPECT_GT(json.at("machining_time_s").get<double>(), 30.0);
    const std::string text = read("p.apt");
    EXPECT_NE(text.find("CUTTER/16,3,5,3,0,0,32"), std::string::npos);
    EXPECT_NE(text.find("\nRAPID\n"), std::string::npos);
    EXPECT_EQ(run({"post", path("p.apt"), "-m", "fooke-endura-ca", "-o", path("p.MPF")}).exit_code, 0);
    const auto verified = run({"verify", path("p.MPF"), "-m", "fooke-endura-ca", "--against", path("p.apt"), "--json"});
    EXPECT_EQ(verified.exit_code, 0) << verified.output;
}

TEST_F(PlanCommand, SameJobSameBytes) {
    for (const char* name : {"a.apt", "b.apt"})
        ASSERT_EQ(run({"plan", benchmark + "table2_ga.toml", "-o", path(name)}).exit_code, 0);
    EXPECT_EQ(read("a.apt"), read("b.apt"));
}

/// A job on the benchmark with its own last lines.
std::string jobWith(const std::string& tool, const std::string& rest) {
    return "schema = 1\n[part]\nnominal = \"" + benchmark + "surface.toml\"\n[tool]\nlibrary = \"" + benchmark +
           "tools.toml\"\nname = \"" + tool + "\"\n[passes]\nstep_over_mm = 5.0\n" + rest;
}

TEST_F(PlanCommand, BadJobsSayWhatToChangeAndLeaveNoFile) {
    const auto fails = [&](const std::string& text, const std::string& message) {
        const auto outcome = run({"plan", write("job.toml", text), "-o", path("p.apt")});
        EXPECT_EQ(outcome.exit_code, 3);
        EXPECT_NE(outcome.errors.find(message), std::string::npos) << outcome.errors;
        EXPECT_EQ(left(), std::vector<std::string>{"job.toml"});
    };
    fails(jobWith("FLAT_16", ""),
          "a flat cutter at lead 0 and tilt 0 touches with its whole bottom and cuts in with its rim; "
          "lead_deg above 0, or adaptive = true, is needed: 8.408° clears the most hollow place of this "
          "surface [finishing.lead-zero]");
    fails(jobWith("DRILL_3", ""), "the library has no tool \"DRILL_3\"; it has FLAT_8, BALL_8, TORUS_8_R1, FLAT_12");
    // Too far down for a head whose A ends at ±110°.
    fails(jobWith("BALL_8", "[orientation]\nlead_deg = 80.0\ntilt_deg = 70.0\n[machine]\nname = \"fooke-endura-ca\"\n"),
          "the machine cannot lean the tool to");
}

TEST_F(PlanCommand, UsageErrors) {
    EXPECT_EQ(run({"plan", benchmark + "table2_ga.toml"}).exit_code, 2);
    EXPECT_EQ(run({"plan", path("none.toml"), "-o", path("p.apt")}).exit_code, 4);
}

}  // namespace
}  // namespace cusp::cli
