// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp texture`: parameters of a known profile, the folder it leaves, and what it refuses.
#include "command_line.hpp"

#include <cmath>
#include <numbers>

namespace cusp::cli {
namespace {

class TextureCommand : public CommandLine {
protected:
    /// 6 mm of a cosine of amplitude 0.5 µm and wavelength 0.05 mm, even about its middle; 0.5 µm apart.
    std::string cosine(const std::string& name) const {
        std::string text = "cusp_stylus_profile,1\nspacing_um,0.5\nheight_nm\n";
        for (int i = 0; i <= 12'000; ++i)
            text += std::to_string(500.0 * std::cos(2.0 * std::numbers::pi * i / 100.0)) + "\n";
        return write(name, text);
    }

    static double value(const nlohmann::json& profile, const std::string& name) {
        for (const auto& parameter : profile["parameters"][name.substr(0, 1)])
            if (parameter["name"] == name) return parameter["value"];
        return NAN;
    }
};

TEST_F(TextureCommand, GivesTheParametersOfAKnownProfile) {
    const auto outcome = run({"texture", cosine("wave.csv"), "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    const auto summary = nlohmann::json::parse(outcome.output);
    EXPECT_EQ(summary["command"], "texture");
    const auto& profile = summary["profiles"][0];
    // Heights are written to 1e-6 nm; the filter keeps all but 6e-78 of such a short wave.
    EXPECT_NEAR(value(profile, "Pa"), 1.0 / std::numbers::pi, 2e-7);
    EXPECT_NEAR(value(profile, "Pq"), 0.5 / std::sqrt(2.0), 2e-7);
    EXPECT_NEAR(value(profile, "Rz"), 1.0, 1e-3);
    EXPECT_NEAR(value(profile, "RSm"), 0.05, 1e-6);
    EXPECT_NEAR(value(profile, "PLq"), 0.05, 1e-6);
}

TEST_F(TextureCommand, LeavesAPageAndTables) {
    const auto outcome = run({"texture", cosine("one.csv"), cosine("two.csv"), "-o", path("report")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_NE(outcome.output.find("one.csv: 12001 heights, 0.0005 mm apart, over 6 mm"), std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(read("report/texture.json"))["profiles"].size(), 2U);
    EXPECT_TRUE(read("report/texture.csv").starts_with("profile,parameter,value,unit,condition,source\n"));
    EXPECT_TRUE(read("report/texture.html").starts_with("<!doctype html>"));
}

TEST_F(TextureCommand, RefusesPointsOfAMeasuringMachine) {
    const std::string points = write("points.csv", "x_mm,y_mm,z_mm\n1,2,3\n");
    const auto outcome = run({"texture", points, cosine("fine.csv"), "-o", path("report")});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_EQ(outcome.errors, points +
                                  ":1: error: a stylus profile begins with the line cusp_stylus_profile,1; points of a "
                                  "coordinate measuring machine give form and scallops, but no texture "
                                  "[texture.format]\n");
    EXPECT_EQ(left(), (std::vector<std::string>{"fine.csv", "points.csv"}));
}

TEST_F(TextureCommand, NamesTheFileThatIsTooShort) {
    const std::string file = cosine("wave.csv");
    const auto outcome = run({"texture", file, "--cutoff-mm", "8"});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_EQ(outcome.errors,
              file + ": error: a trace of 6 mm leaves 0 mm between its ends: less than one cut-off of 8 mm "
                     "[texture.too-short]\n");
    EXPECT_EQ(run({"texture", file, "--cutoff-mm", "0"}).exit_code, 2);
    EXPECT_EQ(run({"texture", path("absent.csv")}).exit_code, 4);
}

}  // namespace
}  // namespace cusp::cli
