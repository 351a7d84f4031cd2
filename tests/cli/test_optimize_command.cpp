// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp optimize` as a planner runs it: the files it leaves, judged by the other commands.
#include "command_line.hpp"

#include <cstdlib>

namespace cusp::cli {
namespace {

using Optimize = CommandLine;

const std::string benchmark = std::string(CUSP_SOURCE_DIR) + "/examples/benchmark/";

/// A hollow of 30 × 24 mm, small enough to be searched in a second; nothing in the house is tuned to it.
const char* const hollow = "schema = 1\nname = \"hollow\"\n[[face]]\nform = \"polynomial\"\noutward = \"du x dv\"\n"
                           "x_mm = { \"u\" = 30.0 }\ny_mm = { \"v\" = 24.0 }\n"
                           "z_mm = { \"u^2\" = 1.6, \"u\" = -1.6, \"v^2\" = 1.0, \"v\" = -1.0, \"u v\" = 0.3 }\n";

std::string trueJob(const std::string& rest) {
    return "schema = 1\nname = \"Hollow\"\nmode = \"true\"\n[part]\nnominal = \"hollow.toml\"\ntolerance_mm = 0.01\n"
           "[tools]\nlibrary = \"" +
           benchmark +
           "tools.toml\"\nnames = [\"FLAT_12\", \"TORUS_12_R2\"]\nspindle_rpm = 9950.0\n"
           "[machine]\nname = \"fooke-endura-ca\"\n[passes]\nalong = \"v\"\nstep_over_mm = 12.0\n"
           "[steps]\nchord_tolerance_mm = 0.001\nstep_max_mm = 10.0\n[links]\nrun_out_mm = 5.0\nlift_mm = 0.5\n"
           "[feed]\nfeed_mm_per_min = 3000.0\n[search]\npopulation = 4\nevaluations = 6\nfront_passes = 1\n" +
           rest;
}

TEST_F(Optimize, PaperModeGivesTheKeysAndAPathOthersTake) {
    const auto found = run({"optimize", benchmark + "paper.toml", "-o", path("out"), "--evaluations", "40", "--json"});
    ASSERT_EQ(found.exit_code, 0) << found.errors;
    const auto json = nlohmann::json::parse(found.output);
    for (const char* key : {"best", "cc_points", "mean_chord_error_mm", "overcut_max_mm", "undercut_max_mm",
                            "within_tolerance_percent", "machining_time_s", "evaluations", "seed", "objective"})
        EXPECT_TRUE(json.contains(key)) << key;
    EXPECT_EQ(json.at("evaluations"), 40);
    EXPECT_EQ(json.at("seed"), 1);
    EXPECT_EQ(nlohmann::json::parse(read("out/summary.json")), json);
    EXPECT_NE(read("out/report.html").find("<html"), std::string::npos);
    // The job it leaves plans the same path again.
    const auto again = run({"plan", path("out/best.toml"), "-o", path("again.apt"), "--json"});
    ASSERT_EQ(again.exit_code, 0) << again.errors;
    const auto planned = nlohmann::json::parse(again.output);
    EXPECT_EQ(planned.at("cc_points"), json.at("cc_points"));
    EXPECT_NEAR(planned.at("machining_time_s").get<double>(), json.at("machining_time_s").get<double>(), 1e-6);
    EXPECT_EQ(run({"post", path("out/best.apt"), "-m", "fooke-endura-ca", "-o", path("P.MPF")}).exit_code, 0);
}

TEST_F(Optimize, ASearchGoneOnWithIsTheSearchThatRanThrough) {
    const std::string job = benchmark + "paper.toml";
    ASSERT_EQ(run({"optimize", job, "-o", path("whole"), "--evaluations", "70"}).exit_code, 0);
    ASSERT_EQ(run({"optimize", job, "-o", path("parts"), "--evaluations", "45"}).exit_code, 0);
    const std::string short_one = read("parts/convergence.csv");
    ASSERT_EQ(run({"optimize", job, "-o", path("parts"), "--evaluations", "70", "--resume"}).exit_code, 0);
    EXPECT_NE(read("parts/convergence.csv"), short_one);
    for (const char* name : {"best.apt", "convergence.csv", "map.csv"})
        EXPECT_EQ(read(std::string("parts/") + name), read(std::string("whole/") + name)) << name;
    const auto other = run({"optimize", job, "-o", path("parts"), "--seed", "2", "--resume"});
    EXPECT_EQ(other.exit_code, 3);
    EXPECT_NE(other.errors.find("checkpoint.json"), std::string::npos) << other.errors;
}

TEST_F(Optimize, TrueModeKeepsTheToleranceByEvaluateAndBeatsConstantLead) {
    write("hollow.toml", hollow);
    const auto found = run({"optimize", write("job.toml", trueJob("[compare]\nleads_deg = [1.0, 2.0, 4.0, 6.0]\n")),
                            "-o", path("out"), "--json"});
    ASSERT_EQ(found.exit_code, 0) << found.errors;
    const auto json = nlohmann::json::parse(found.output);
    EXPECT_LE(json.at("overcut_max_mm").get<double>(), 0.01);
    EXPECT_LE(json.at("undercut_max_mm").get<double>(), 0.01);
    const auto judged = run({"evaluate", path("out/best.apt"), "--nominal", path("hollow.toml"), "--grid-mm", "0.08",
                             "--tolerance-mm", "0.01", "--json"});
    const auto evaluated = nlohmann::json::parse(judged.output);
    EXPECT_LE(evaluated.at("overcut_max_mm").get<double>(), 0.01);
    EXPECT_LE(evaluated.at("undercut_max_mm").get<double>(), 0.01);
    EXPECT_NEAR(evaluated.at("reached_percent").get<double>(), 100.0, 1e-9);
    if (json.at("constant_lead").at("found").get<bool>() &&
        json.at("constant_lead").at("keeps_tolerance").get<bool>()) {
        EXPECT_LE(json.at("machining_time_s").get<double>(),
                  json.at("constant_lead").at("machining_time_s").get<double>());
    }
    // One line for each levelled path, the fastest within the tolerance among them, and no path on the front that is beaten.
    const std::string front = read("out/front.csv");
    EXPECT_EQ(front.substr(0, front.find('\n')), "tool,passes,machining_time_s,deviation_mm,on_front");
    EXPECT_NE(front.find(",1\n"), std::string::npos) << front;
}

TEST_F(Optimize, TrueModeKeepsTheToleranceOnASaddle) {
    write("hollow.toml", "schema = 1\nname = \"saddle\"\n[[face]]\nform = \"polynomial\"\noutward = \"du x dv\"\n"
                         "x_mm = { \"u\" = 40.0 }\ny_mm = { \"v\" = 30.0 }\n"
                         "z_mm = { \"u^2\" = 5.0, \"u\" = -5.0, \"v^2\" = -3.0, \"v\" = 3.0 }\n");
    const auto found = run({"optimize", write("job.toml", trueJob("")), "-o", path("out"), "--json"});
    ASSERT_EQ(found.exit_code, 0) << found.errors;
    const auto judged = run({"evaluate", path("out/best.apt"), "--nominal", path("hollow.toml"), "--grid-mm", "0.13",
                             "--tolerance-mm", "0.01", "--json"});
    const auto evaluated = nlohmann::json::parse(judged.output);
    EXPECT_LE(evaluated.at("overcut_max_mm").get<double>(), 0.01);
    EXPECT_LE(evaluated.at("undercut_max_mm").get<double>(), 0.01);
    EXPECT_NEAR(evaluated.at("reached_percent").get<double>(), 100.0, 1e-9);
}

TEST_F(Optimize, AnyNumberOfThreadsGivesTheSameBytes) {
    write("hollow.toml", hollow);
    const std::string job = write("job.toml", trueJob(""));
    ASSERT_EQ(run({"optimize", job, "-o", path("many")}).exit_code, 0);
    // One processor: TBB takes as many threads as it may run on.
    const auto one =
        base::runProcess({"taskset", "-c", "0", CUSP_COMMAND, "optimize", job, "-o", path("one")}, {.wall_s = 120.0});
    if (!one) GTEST_SKIP() << "taskset is not installed";
    ASSERT_EQ(one->exit_code, 0) << one->errors;
    for (const char* name : {"best.apt", "front.csv", "convergence.csv", "map.csv"})
        EXPECT_EQ(read(std::string("one/") + name), read(std::string("many/") + name)) << name;
}

TEST_F(Optimize, AnOutsideCamPlans) {
    // It answers every candidate with the same path: all are alike then, and the first is as good as any.
    ASSERT_EQ(run({"plan", benchmark + "table2_vega.toml", "-o", path("cam.apt")}).exit_code, 0);
    const std::string command = "tee -a " + path("asked.txt") + " > /dev/null; cat " + path("cam.apt");
    const auto found = run({"optimize", benchmark + "paper.toml", "-o", path("out"), "--evaluations", "20",
                            "--evaluator", command, "--json"});
    ASSERT_EQ(found.exit_code, 0) << found.errors;
    const auto json = nlohmann::json::parse(found.output);
    EXPECT_EQ(json.at("planner"), "outside");
    EXPECT_EQ(read("out/best.apt"), read("cam.apt"));
    EXPECT_NEAR(json.at("cc_points").get<double>(), 289.0, 0.05 * 289.0);
    const std::string asked = read("asked.txt");
    EXPECT_EQ(std::count(asked.begin(), asked.end(), '\n'), 21);  // 20 candidates, and the best for its path
    const auto first = nlohmann::json::parse(asked.substr(0, asked.find('\n')));
    EXPECT_GE(first.at("step_over_mm").get<double>(), 0.2 * first.at("tool_diameter_mm").get<double>() - 1e-9);
    EXPECT_LE(first.at("lead_deg").get<double>(), 5.0 + 1e-9);
}

TEST_F(Optimize, AnOutsideCamThatFailsIsSaidAndLeavesNothing) {
    const auto fails = [&](const std::string& command, const std::string& message) {
        const auto outcome = run({"optimize", benchmark + "paper.toml", "-o", path("out"), "--evaluations", "20",
                                  "--evaluator", command, "--evaluator-seconds", "5"});
        EXPECT_EQ(outcome.exit_code, 3);
        EXPECT_NE(outcome.errors.find(message), std::string::npos) << outcome.errors;
        EXPECT_EQ(left(), std::vector<std::string>{});
    };
    fails("echo no licence >&2; exit 3",
          "the outside CAM failed (exit code 3): no licence; it was asked for {\"schema\":1,");
    fails("echo UNITS/MM; echo FINI", "answer of the outside CAM:2: error: the file moves no tool");
    fails(
        "printf 'UNITS/MM\\nCUTTER/8,4,0,4,0,0,30\\nLOADTL/1\\nFEDRAT/1000,MMPM\\nGOTO/0,0,900,0,0,1\\nGOTO/9,0,900,0,0,1\\nFINI\\n'",
        "nowhere touches the part at feed");
    const auto true_mode =
        run({"optimize", benchmark + "true.toml", "-o", path("out"), "--evaluator", "cat /dev/null"});
    EXPECT_EQ(true_mode.exit_code, 3);
    EXPECT_NE(true_mode.errors.find("[optimize.evaluator]"), std::string::npos) << true_mode.errors;
}

TEST_F(Optimize, UsageErrors) {
    EXPECT_EQ(run({"optimize", benchmark + "paper.toml"}).exit_code, 2);
    EXPECT_EQ(run({"optimize", path("none.toml"), "-o", path("out")}).exit_code, 4);
    EXPECT_EQ(left(), std::vector<std::string>{});
}

}  // namespace
}  // namespace cusp::cli
