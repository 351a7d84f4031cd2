// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp compensate`, `cusp calibrate`, `cusp demo`, and the tutorial docs/loop.md, every command of it.
#include "command_line.hpp"

#include <sstream>

namespace cusp::cli {
namespace {

class LoopCommands : public CommandLine {
protected:
    /// In the folder of the test, as a user stands in one.
    base::ProcessOutcome runHere(std::vector<std::string> arguments) {
        const auto before = std::filesystem::current_path();
        std::filesystem::current_path(folder);
        arguments.insert(arguments.begin(), CUSP_COMMAND);
        auto outcome = base::runProcess(arguments, {.wall_s = 240.0});
        std::filesystem::current_path(before);
        EXPECT_TRUE(outcome.has_value());
        return *outcome;
    }
};

/// Commands and files of a page: lines of plain code blocks, and blocks whose head names a file.
struct Tutorial {
    struct Step {
        std::vector<std::string> arguments;
        int exit_code = 0;
        std::string line;
    };
    std::vector<Step> steps;
    std::vector<std::pair<std::string, std::string>> files;

    explicit Tutorial(const std::string& text) {
        std::istringstream in(text);
        bool inside = false;
        std::string file;
        std::string content;
        for (std::string line; std::getline(in, line);) {
            if (line.starts_with("```")) {
                if (inside && !file.empty()) files.emplace_back(file, content);
                inside = !inside;
                const std::size_t blank = line.find(' ');
                file = inside && blank != std::string::npos ? line.substr(blank + 1) : std::string();
                content.clear();
                continue;
            }
            if (!inside) continue;
            if (!file.empty())
                content += line + "\n";
            else if (line.starts_with("cusp "))
                steps.push_back(stepOf(line));
        }
    }

private:
    static Step stepOf(const std::string& line) {
        Step out{.arguments = {}, .exit_code = line.ends_with("# exit code 1") ? 1 : 0, .line = line};
        std::istringstream words(
            line.substr(5, line.find(" #") == std::string::npos ? std::string::npos : line.find(" #") - 5));
        for (std::string word; words >> word;) out.arguments.push_back(word);
        return out;
    }
};

TEST_F(LoopCommands, TheTutorialRunsAsItIsWritten) {
    const Tutorial tutorial(base::readWholeFile(std::string(CUSP_SOURCE_DIR) + "/docs/loop.md", 1U << 20U).value());
    ASSERT_EQ(tutorial.files.size(), 1u);
    ASSERT_GE(tutorial.steps.size(), 12u);
    for (const auto& [name, text] : tutorial.files) write(name, text);
    for (const auto& step : tutorial.steps) {
        const auto outcome = runHere(step.arguments);
        ASSERT_EQ(outcome.exit_code, step.exit_code) << step.line << "\n" << outcome.output << outcome.errors;
    }
    const auto demo = nlohmann::json::parse(read("demo/demo.json"));
    EXPECT_GT(demo["before"]["max_abs_deviation_mm"].get<double>(), 0.030);
    EXPECT_LT(demo["after"]["max_abs_deviation_mm"].get<double>(), 0.010);
    EXPECT_GT(demo["uncorrected"]["max_abs_deviation_mm"].get<double>(), 0.025);
    EXPECT_EQ(demo["sections"].size(), 4u);
    EXPECT_EQ(demo["link"]["compared"], true);
    EXPECT_EQ(demo["link"]["address"].get<std::string>().substr(0, 13), "modbus-tcp://");
    EXPECT_NE(read("demo/index.html").find("Closed loop"), std::string::npos);
    const auto calibration = nlohmann::json::parse(read("calibration/calibration.json"));
    bool pivot = false;
    for (const auto& found : calibration["parameters"]) {
        if (found["name"] != "pivot_length_mm") continue;
        pivot = found["significant"];
        EXPECT_NEAR(found["value"].get<double>(), 0.06, 2.0 * found["interval_95"].get<double>());
    }
    EXPECT_TRUE(pivot);
    // The corrected machine file is one that every command takes.
    EXPECT_EQ(runHere({"machine", "check", "calibration/machine.toml"}).exit_code, 0);
}

const std::string benchmark = std::string(CUSP_SOURCE_DIR) + "/examples/benchmark/";

TEST_F(LoopCommands, CompensateRefusesWhatItCannotUse) {
    const std::string none = write("none.json", "{\"nominal\": \"x.toml\"}");
    const auto without =
        run({"compensate", benchmark + "surface_finish.cls", "--deviation", none, "-o", path("q.apt")});
    EXPECT_EQ(without.exit_code, 3);
    EXPECT_NE(without.errors.find("deviation-field"), std::string::npos) << without.errors;
    EXPECT_EQ(run({"compensate", benchmark + "surface_finish.cls", "--deviation", path("absent"), "-o", path("q.apt")})
                  .exit_code,
              4);
    EXPECT_EQ(
        run({"compensate", benchmark + "surface_finish.cls", "--deviation", none, "-o", path("q.apt"), "--gain", "7"})
            .exit_code,
        2);
    EXPECT_EQ(left(), std::vector<std::string>{"none.json"});
}

TEST_F(LoopCommands, CalibrateSaysWhatIsWrongWithAJob) {
    const std::string job =
        write("job.toml", "schema = 1\nmachine = \"fooke-endura-ca\"\ntool_length_mm = 100.0\nspeed = 3\n"
                          "[[part]]\ncl_file = \"a.apt\"\npoints = \"a.csv\"\n");
    const auto outcome = run({"calibrate", job, "-o", path("out")});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_NE(outcome.errors.find("speed"), std::string::npos) << outcome.errors;
    EXPECT_NE(outcome.errors.find("nominal"), std::string::npos) << outcome.errors;
    EXPECT_EQ(run({"calibrate", "-o", path("out")}).exit_code, 2);
    EXPECT_EQ(run({"calibrate", path("absent.toml"), "-o", path("out")}).exit_code, 4);
    EXPECT_EQ(left(), std::vector<std::string>{"job.toml"});
}

TEST_F(LoopCommands, AnArtefactIsPlannedForTheAxesOfItsMachine) {
    for (const std::string machine : {"nutating-45", "haas-umc-bc"}) {
        const std::string out = path(machine);
        ASSERT_EQ(run({"calibrate", "--plan", machine, "-o", out}).exit_code, 0);
        ASSERT_EQ(run({"measure", out + "/artefact.apt", "--nominal", out + "/artefact.toml", "-m", machine,
                       "--tool-length-mm", "100", "--points", out + "/targets.csv", "-o", out + "/artefact.csv"})
                      .exit_code,
                  0);
        const auto outcome = run({"calibrate", out + "/job.toml", "-o", out + "/found", "--json"});
        ASSERT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 1) << outcome.errors;
        EXPECT_LT(nlohmann::json::parse(outcome.output)["rms_mm"].get<double>(), 0.001)
            << "a machine without errors fits its own part";
    }
    const auto flat = run({"calibrate", "--plan", "three-axis", "-o", path("flat")});
    EXPECT_EQ(flat.exit_code, 3);
    EXPECT_NE(flat.errors.find("two rotary axes"), std::string::npos) << flat.errors;
    EXPECT_FALSE(std::filesystem::exists(path("flat")));
    EXPECT_EQ(run({"calibrate", "--plan", "no-such-machine", "-o", path("flat")}).exit_code, 3);
}

TEST_F(LoopCommands, DemoRefusesWhatItCannotUse) {
    EXPECT_EQ(run({"demo"}).exit_code, 2);
    EXPECT_EQ(run({"demo", "-o", path("d"), "-m", "no-such-machine"}).exit_code, 3);
    const auto budget = run({"demo", "-o", path("d"), "--sections", "X=500"});
    EXPECT_EQ(budget.exit_code, 3);
    EXPECT_NE(budget.errors.find("measure.section"), std::string::npos) << budget.errors;
}

}  // namespace
}  // namespace cusp::cli
