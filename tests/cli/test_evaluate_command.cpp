// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp evaluate` from the outside: a ball on a plane, whose remainder is known.
#include "command_line.hpp"

#include <cmath>

namespace cusp::cli {
namespace {

class EvaluateCommand : public CommandLine {
protected:
    void SetUp() override {
        CommandLine::SetUp();
        plane = write("plane.toml", "schema = 1\nname = \"plane\"\n[[face]]\nform = \"bezier\"\noutward = \"du x dv\"\n"
                                    "points_mm = [[[-8, -8, 0], [-8, 8, 0]], [[8, -8, 0], [8, 8, 0]]]\n");
    }
    /// A ball of 10 mm along X every 2 mm of Y, its tip at the height.
    std::string passes(double height_mm) const {
        std::string text = "UNITS/MM\nCUTTER/10,5,0,5,0,0,40\nLOADTL/1\nRAPID\nGOTO/-20,-10,50\nFEDRAT/1000,MMPM\n";
        for (int pass = -5; pass <= 5; ++pass) {
            const std::string y = std::to_string(2 * pass);
            const std::string z = std::to_string(height_mm);
            text += "GOTO/-20," + y + "," + z + "\nGOTO/20," + y + "," + z + "\nGOTO/20," + y + ",50\nGOTO/-20," + y +
                    ",50\n";
        }
        return write("passes.apt", text + "FINI\n");
    }
    std::string plane;
};

TEST_F(EvaluateCommand, TellsScallopAndOvercut) {
    const auto outcome = run({"evaluate", passes(-0.02), "--nominal", plane, "--grid-mm", "0.5", "--json"});
    ASSERT_EQ(outcome.exit_code, 1) << outcome.errors;
    const auto json = nlohmann::json::parse(outcome.output);
    EXPECT_NEAR(json["overcut_max_mm"].get<double>(), 0.02, 2e-6);
    EXPECT_NEAR(json["undercut_max_mm"].get<double>(), 5.0 - std::sqrt(24.0) - 0.02, 2e-6);
    EXPECT_EQ(json["reached_percent"].get<double>(), 100.0);
    EXPECT_EQ(json["cutter_locations"], 45);
    EXPECT_EQ(json["points"], 33 * 33);
}

TEST_F(EvaluateCommand, WithinToleranceIsDone) {
    const auto outcome = run({"evaluate", passes(-0.05), "--nominal", plane, "--grid-mm", "0.5", "--tolerance-mm",
                              "0.06", "--map", path("map.csv")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output << outcome.errors;
    const std::string map = read("map.csv");
    EXPECT_EQ(std::count(map.begin(), map.end(), '\n'), 33 * 33 + 1);
    EXPECT_EQ(map.substr(0, map.find('\n')), "x_mm,y_mm,z_mm,nx,ny,nz,deviation_mm,cl_line");
}

TEST_F(EvaluateCommand, AToolThatComesNowhereNearIsSaid) {
    const auto outcome = run({"evaluate", passes(30.0), "--nominal", plane});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.output.find("The tool comes nowhere near the surface: another frame, or another unit?"),
              std::string::npos)
        << outcome.output;
}

TEST_F(EvaluateCommand, BadInputsAreNamed) {
    const auto shapeless =
        run({"evaluate", write("p.apt", "UNITS/MM\nGOTO/0,0,0\nGOTO/1,0,0\nFINI\n"), "--nominal", plane});
    EXPECT_EQ(shapeless.exit_code, 3);
    EXPECT_NE(shapeless.errors.find("p.apt:2: error: the tool moves here, and the CL file has not told its shape"),
              std::string::npos)
        << shapeless.errors;
    EXPECT_EQ(run({"evaluate", passes(0.0), "--nominal", path("missing.toml")}).exit_code, 4);
    EXPECT_EQ(run({"evaluate", passes(0.0), "--nominal", plane, "--grid-mm", "0"}).exit_code, 2);
}

}  // namespace
}  // namespace cusp::cli
