// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp inspect` from the files a user has to the files the user gets.
#include "command_line.hpp"

#include <cusp/base/random.hpp>

#include <fmt/format.h>

#include <cmath>
#include <sstream>

namespace cusp::cli {
namespace {

class InspectCommand : public CommandLine {
protected:
    const std::string nominal = CUSP_SOURCE_DIR "/examples/benchmark/surface.toml";

    /// Points of Fountas 2017 eq. 14, off by noise of this size along Z; decimal commas and semicolons.
    static std::string points(double noise_mm, double lift_mm = 0.0) {
        base::Random random(1);
        std::string out = "section_X;x;y;z\n";
        for (const double v : {0.1, 0.35, 0.7, 0.95})
            for (int i = 1; i < 50; ++i) {
                const double u = i / 50.0;
                const double x = -94.4 + 88.9 * v + 5.6 * v * v;
                const double y = -131.3 * u + 28.1 * u * u;
                const double z = 5.9 * (u * u * v * v + u * u * v) - 3.9 * v * v * u + 76.2 * u * u + 6.7 * v * v -
                                 27.3 * u * v - 50.8 * u + 25.0 * v + 12.1 + random.uniform(-noise_mm, noise_mm) +
                                 lift_mm;
                std::string row = fmt::format("{:.3f};{:.9f};{:.9f};{:.9f}\n", x, x, y, z);
                for (char& c : row) c = c == '.' ? ',' : c;
                out += row;
            }
        return out;
    }
    base::ProcessOutcome inspectPoints(const std::string& text, std::vector<std::string> flags) {
        std::vector<std::string> arguments{"inspect", write("points.csv", text), "--nominal", nominal};
        arguments.insert(arguments.end(), flags.begin(), flags.end());
        return run(arguments);
    }
};

TEST_F(InspectCommand, WritesItsFolder) {
    const auto out =
        inspectPoints(points(0.002), {"--limits-mm=-0.01,0.01", "--uncertainty-mm=0.001", "-o", path("report")});
    ASSERT_EQ(out.exit_code, 0) << out.errors << out.output;
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(path("report")))
        files.push_back(entry.path().filename());
    std::sort(files.begin(), files.end());
    EXPECT_EQ(files, (std::vector<std::string>{"deviations.ply", "points.csv", "report.html", "report.json",
                                               "report.qif", "sections.csv"}));
    std::istringstream rows(read("report/points.csv"));
    std::string header;
    std::getline(rows, header);
    EXPECT_EQ(header, "point,line,x_mm,y_mm,z_mm,nominal_x_mm,nominal_y_mm,nominal_z_mm,i,j,k,deviation_mm,"
                      "datum_deviation_mm,best_fit_deviation_mm,beyond_edge_mm,outlier,section");
    int count = 0;
    for (std::string row; std::getline(rows, row); ++count)
        EXPECT_TRUE(row.starts_with(fmt::format("{},{},", count, count + 2))) << row;
    EXPECT_EQ(count, 196);
    const auto json = nlohmann::json::parse(read("report/report.json"));
    EXPECT_EQ(json["points"], 196);
    EXPECT_EQ(json["sections"].size(), 4U);
    EXPECT_EQ(json["decision"]["verdict"], "accept");
    EXPECT_TRUE(read("report/deviations.ply").starts_with("ply\nformat binary_little_endian 1.0\n"));
}

TEST_F(InspectCommand, JsonHasWhatScriptsNeed) {
    const auto out = inspectPoints(points(0.002, 0.05), {"--limits-mm=-0.01,0.01", "--json"});
    const auto json = nlohmann::json::parse(out.output);
    EXPECT_EQ(out.exit_code, 0) << out.errors;
    for (const char* key : {"rotation_vector_rad", "translation_mm"}) EXPECT_EQ(json["alignment"][key].size(), 3U);
    for (const char* key : {"min_mm", "max_mm", "mean_mm", "rms_mm"}) EXPECT_TRUE(json["deviation"][key].is_number());
    // Lifted by 50 µm: out in the fixed datums, in best-fitted.
    EXPECT_EQ(json["datum_deviation"]["decision"]["verdict"], "reject");
    EXPECT_EQ(json["decision"]["verdict"], "accept");
    const auto in_datum = inspectPoints(points(0.002, 0.05), {"--limits-mm=-0.01,0.01", "--fit", "none", "--json"});
    EXPECT_EQ(in_datum.exit_code, 1);
    EXPECT_EQ(nlohmann::json::parse(in_datum.output)["decision"]["verdict"], "reject");
}

TEST_F(InspectCommand, ScallopsAreMeasuredAgainstThePlan) {
    // Ridges 4 µm high over a line at v = 0.4, their feet at every fifth millimetre of Y.
    std::string text = "section_X,x,y,z\n";
    const double v = 0.4;
    const double x = -94.4 + 88.9 * v + 5.6 * v * v;
    for (int i = 1; i < 600; ++i) {
        const double u = i / 600.0;
        const double y = -131.3 * u + 28.1 * u * u;
        const double in_pass = std::fmod(-y, 5.0) / 5.0 - 0.5;
        const double z = 5.9 * (u * u * v * v + u * u * v) - 3.9 * v * v * u + 76.2 * u * u + 6.7 * v * v -
                         27.3 * u * v - 50.8 * u + 25.0 * v + 12.1 + 0.004 * 4.0 * in_pass * in_pass;
        text += fmt::format("{:.6f},{:.9f},{:.9f},{:.9f}\n", x, x, y, z);
    }
    const auto out =
        inspectPoints(text, {"--step-over-mm=5.5", "--points=surface", "--fit=none", "--json", "-o", path("report")});
    ASSERT_EQ(out.exit_code, 0) << out.errors;
    const auto json = nlohmann::json::parse(out.output);
    EXPECT_EQ(json["planned_step_over_mm"], 5.5);
    const auto& section = json["sections"][0];
    EXPECT_EQ(section["pieces"], 1);
    const auto& scallops = section["scallops"];
    EXPECT_EQ(scallops["count"], 20);  // whole ridges within 103.2 mm of Y
    EXPECT_NEAR(scallops["planned_count"].get<double>(), section["length_mm"].get<double>() / 5.5, 1e-9);
    EXPECT_NEAR(scallops["max_height_mm"].get<double>(), 0.0038, 0.0003);  // along the normal, less than along Z
    EXPECT_EQ(nlohmann::json::parse(read("report/report.json"))["sections"][0]["scallops"], scallops);
    EXPECT_NE(read("report/report.html").find("planned_step_over_mm"), std::string::npos);
    const auto told = inspectPoints(text, {"--step-over-mm=5.5", "--points=surface", "--fit=none"});
    EXPECT_NE(told.output.find("20 found"), std::string::npos) << told.output;
    // Without a plan ridges of noise would count.
    const auto unplanned = inspectPoints(text, {"--points=surface", "--fit=none", "--json"});
    EXPECT_FALSE(nlohmann::json::parse(unplanned.output)["sections"][0].contains("scallops"));
    EXPECT_TRUE(nlohmann::json::parse(unplanned.output)["planned_step_over_mm"].is_null());
}

TEST_F(InspectCommand, WeightsOfTheTableCountWhenAsked) {
    std::string text = "x,y,z,weight\n";
    std::istringstream rows(points(0.001));
    std::string row;
    std::getline(rows, row);
    for (int k = 0; std::getline(rows, row); ++k) {
        for (char& c : row) c = c == ',' ? '.' : c;
        for (char& c : row) c = c == ';' ? ',' : c;
        row = row.substr(row.find(',') + 1);
        const bool spoiled = k % 5 == 0;  // a fifth of the points 0.2 mm high, without weight
        if (spoiled) {
            const std::size_t last = row.rfind(',');
            row = row.substr(0, last + 1) + fmt::format("{:.9f}", std::stod(row.substr(last + 1)) + 0.2);
        }
        text += row + (spoiled ? ",0\n" : ",1\n");
    }
    const auto median = [](const base::ProcessOutcome& out) {
        return nlohmann::json::parse(out.output)["best_fit_deviation"]["median_mm"].get<double>();
    };
    const auto weighted = inspectPoints(text, {"--weights", "--json"});
    EXPECT_NEAR(median(weighted), 0.0, 0.001);
    EXPECT_TRUE(nlohmann::json::parse(weighted.output)["alignment"]["weighted"]);
    const auto unweighted = inspectPoints(text, {"--json"});
    EXPECT_LT(median(unweighted), -0.01);
    EXPECT_NE(unweighted.errors.find("[inspect.weights-unused]"), std::string::npos);
    const auto none = inspectPoints(points(0.001), {"--weights"});
    EXPECT_EQ(none.exit_code, 3);
    EXPECT_NE(none.errors.find("--weights needs a column \"weight\" in a table [inspect.weights]"), std::string::npos);
    const auto negative = inspectPoints("x,y,z,weight\n1,2,3,-1\n", {"--weights"});
    EXPECT_NE(
        negative.errors.find(":2: error: column 4: '-1' is no weight; a weight is a number, 0 or more [points.number]"),
        std::string::npos)
        << negative.errors;
}

TEST_F(InspectCommand, ProfileToleranceIsTheWholeWidth) {
    const auto out = inspectPoints(points(0.004), {"--profile-t-mm=0.02", "--uncertainty-mm=0", "--json"});
    const auto json = nlohmann::json::parse(out.output);
    EXPECT_EQ(json["decision"]["lower_limit_mm"], -0.01);
    EXPECT_EQ(json["decision"]["upper_limit_mm"], 0.01);
    EXPECT_EQ(out.exit_code, 0);
    EXPECT_EQ(inspectPoints(points(0.004), {"--profile-t-mm=0.004", "--uncertainty-mm=0"}).exit_code, 1);
}

TEST_F(InspectCommand, BadInputLeavesNothing) {
    auto out = inspectPoints("x;y;z\n1,5;2;three\n", {"-o", path("report")});
    EXPECT_EQ(out.exit_code, 3);
    EXPECT_EQ(out.errors, path("points.csv") + ":2: error: column 3: 'three' is no number [points.number]\n");
    out = inspectPoints(points(0.001), {"--limits-mm=0.01,-0.01"});
    EXPECT_EQ(out.exit_code, 3);
    EXPECT_EQ(out.errors,
              "error: the lower limit must be below the upper one, e.g. --limits-mm=-0.01,0.01 [inspect.limits]\n");
    out = inspectPoints(points(0.001), {"--sections", "Q=3"});
    EXPECT_EQ(out.exit_code, 3);
    EXPECT_EQ(inspectPoints(points(0.001), {"--lock", "tw"}).exit_code, 2);
    EXPECT_EQ(run({"inspect", path("none.csv"), "--nominal", nominal}).exit_code, 4);
    EXPECT_EQ(left(), (std::vector<std::string>{"points.csv"}));
}

TEST_F(InspectCommand, SectionsAndLocks) {
    const auto out = inspectPoints(points(0.002), {"--sections", "Y=-40,-60", "--section-width-mm", "4", "--lock",
                                                   "tx,rz", "--fit", "minimax", "--json"});
    ASSERT_EQ(out.exit_code, 0) << out.errors;
    const auto json = nlohmann::json::parse(out.output);
    EXPECT_EQ(json["alignment"]["locked"], (nlohmann::json{"tx", "rz"}));
    EXPECT_EQ(json["alignment"]["translation_mm"][0], 0.0);
    EXPECT_EQ(json["alignment"]["fit"], "minimax");
    EXPECT_EQ(json["sections"][0]["label"], "Y=-40");
    EXPECT_GT(json["sections"][1]["points"], 2);
}

}  // namespace
}  // namespace cusp::cli
