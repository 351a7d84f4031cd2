// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp tilt` as a planner runs it, on to the posted program and its proof.
#include "command_line.hpp"

namespace cusp::cli {
namespace {

using Tilt = CommandLine;

const char* const small_job = R"(
schema = 1
name = "SMALL"
machine = "trunnion-ac"
origin_mm = [0.0, 0.0, 60.0]
[part]
min_mm = [-20.0, -20.0, -24.0]
max_mm = [20.0, 20.0, 0.0]
spacing_mm = 1.0
[[part.feature]]
kind = "pocket"
size_mm = [24.0, 24.0]
corner_radius_mm = 12.0
level_mm = -20.0
draft_deg = 4.0
fillet_mm = 2.0
[tool]
diameter_mm = 2.0
cutting_height_mm = 1.0
shank_mm = [[30.0, 2.0, 9.0]]
holder_mm = [[30.0, 24.0, 30.0]]
[path]
step_over_mm = 4.0
[path.area]
radius_mm = 11.0
[search]
cube_mm = 60.0
generations = 6
proof_mm = 0.5
)";

TEST_F(Tilt, FromTheJobToAProvenProgram) {
    const auto tilted = run({"tilt", write("job.toml", small_job), "-o", path("out"), "--json"});
    ASSERT_EQ(tilted.exit_code, 0) << tilted.errors;
    const auto summary = nlohmann::json::parse(tilted.output);
    EXPECT_TRUE(summary["collision_free"].get<bool>());
    EXPECT_EQ(summary["tilt_points_mm"].size(), 1U);
    EXPECT_GE(summary["generations_to_collision_free"].get<int>(), 0);
    EXPECT_EQ(summary["fitness"]["collision_volume_mm3"].get<double>(), 0.0);
    EXPECT_GT(summary["rotary_travel_deg"][0].get<double>(), 0.0);
    EXPECT_GT(summary["machining_time_s"].get<double>(), 0.0);
    EXPECT_GT(summary["start"]["proof"]["collision_volume_mm3"].get<double>(), 0.0);
    EXPECT_EQ(summary["tilted"]["proof"]["collision_volume_mm3"].get<double>(), 0.0);
    EXPECT_TRUE(summary["proven"].get<bool>());
    EXPECT_TRUE(summary["posted"]["verify_pass"].get<bool>());
    EXPECT_EQ(summary["posted"]["matched"], summary["posted"]["points"]);
    EXPECT_GT(summary["posted"]["matched"].get<int>(), 100);
    EXPECT_EQ(summary["posted"]["simulated"]["collision_volume_mm3"].get<double>(), 0.0);
    EXPECT_NE(read("out/report.html").find("<html"), std::string::npos);
    EXPECT_EQ(read("out/convergence.csv").substr(0, 8), "run,seed");

    const auto posted = run({"post", path("out/tilted.apt"), "-m", "trunnion-ac", "-o", path("SMALL.MPF")});
    EXPECT_EQ(posted.exit_code, 0) << posted.errors;
    const auto verified = run({"verify", path("SMALL.MPF"), "-m", "trunnion-ac", "--against", path("out/tilted.apt")});
    EXPECT_EQ(verified.exit_code, 0) << verified.errors << verified.output;
    // The program the command proved is one that others find in order too.
    const auto again =
        run({"verify", path("out/tilted.mpf"), "-m", "trunnion-ac", "--against", path("out/tilted.apt")});
    EXPECT_EQ(again.exit_code, 0) << again.errors << again.output;
}

TEST_F(Tilt, TheSameSeedGivesTheSameFile) {
    const std::string job = write("job.toml", small_job);
    ASSERT_EQ(run({"tilt", job, "-o", path("a"), "--generations", "2"}).limit, base::LimitHit::None);
    ASSERT_EQ(run({"tilt", job, "-o", path("b"), "--generations", "2"}).limit, base::LimitHit::None);
    EXPECT_EQ(read("a/tilted.apt"), read("b/tilted.apt"));
    EXPECT_NE(read("a/tilted.apt"), "");
}

TEST_F(Tilt, ATiltPointByHandIsJudged) {
    std::string job = small_job;
    job.replace(job.find("[part]"), 0, "tilt_points_mm = [[25.0, 0.0, 10.0]]\n");
    const auto outcome = run({"tilt", write("job.toml", job), "-o", path("out")});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.errors;
    EXPECT_NE(outcome.output.find("tilt point         X25.000 Y0.000 Z10.000"), std::string::npos) << outcome.output;
}

TEST_F(Tilt, SaysWhatIsWrongBeforeItBegins) {
    const auto outcome = run({"tilt", write("job.toml", "schema = 1\nname = \"T\"\n"), "-o", path("out")});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_NE(outcome.errors.find("machine"), std::string::npos) << outcome.errors;
    EXPECT_EQ(left(), std::vector<std::string>{"job.toml"});
    EXPECT_EQ(run({"tilt", path("job.toml")}).exit_code, 2);
}

}  // namespace
}  // namespace cusp::cli
