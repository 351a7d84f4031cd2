// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp simulate` from the outside: slots whose volume is known, collisions that are there, input that is refused.
#include "command_line.hpp"

#include <cmath>
#include <numbers>

namespace cusp::cli {
namespace {

constexpr const char* library = R"(schema = 1
name = "tools"
[[tool]]
number = 1
name = "BALL_10"
shape = "ball"
diameter_mm = 10.0
cutting_height_mm = 10.0
gauge_length_mm = 60.0
shank_mm = [[20.0, 10.0]]
holder_mm = [[20.0, 40.0]]
)";

class SimulateCommand : public CommandLine {
protected:
    /// A slot along X with a ball of 10 mm, its tip at the depth.
    std::string slot(double depth_mm, const std::string& way_in = "") const {
        const std::string z = std::to_string(-depth_mm);
        return write("slot.apt", "UNITS/MM\nCUTTER/10,5,0,5,0,0,40\nLOADTL/1\nRAPID\nGOTO/-40,0,50\n" + way_in +
                                     "FEDRAT/1000,MMPM\nGOTO/-40,0," + z + "\nGOTO/40,0," + z +
                                     "\nGOTO/40,0,50\nFINI\n");
    }
    static std::vector<std::string> withBox(std::vector<std::string> words) {
        const std::vector<std::string> box{"--stock-box-mm", "-20", "-15", "-20", "20", "15", "0"};
        words.insert(words.end(), box.begin(), box.end());
        return words;
    }
    nlohmann::json simulate(const std::vector<std::string>& words, int exit_code) {
        auto all = withBox(words);
        all.insert(all.begin(), "simulate");
        all.emplace_back("--json");
        const auto outcome = run(all);
        EXPECT_EQ(outcome.exit_code, exit_code) << outcome.errors;
        return nlohmann::json::parse(outcome.output, nullptr, false);
    }
};

TEST_F(SimulateCommand, RemovesASlotAndMeasuresIt) {
    const std::string plane =
        write("plane.toml", "schema = 1\nname = \"plane\"\n[[face]]\nform = \"bezier\"\noutward = \"du x dv\"\n"
                            "points_mm = [[[-20, -1, -3.02], [-20, 1, -3.02]], [[20, -1, -3.02], [20, 1, -3.02]]]\n");
    const auto json = simulate({slot(3.0), "--nominal", plane, "--tolerance-mm", "0.2", "-o", path("out")}, 0);
    const double angle = std::acos(1.0 - 3.0 / 5.0);
    const double exact = 40.0 * 25.0 * (angle - std::sin(angle) * std::cos(angle));
    EXPECT_NEAR(json["removed_volume_mm3"].get<double>(), exact, 0.01 * exact);
    EXPECT_EQ(json["overcut_max_mm"].get<double>(), 0.0);
    EXPECT_NEAR(json["undercut_max_mm"].get<double>(), 5.0 - std::sqrt(24.0) + 0.02, 0.1);
    EXPECT_EQ(json["within_tolerance_percent"].get<double>(), 100.0);
    EXPECT_EQ(json["moves"], 3);
    EXPECT_TRUE(json["collisions"].empty());
    for (const char* name : {"simulation.html", "summary.json", "stock.ply", "moves.csv", "deviations.csv",
                             "before.png", "after.png", "deviation.png"})
        EXPECT_TRUE(std::filesystem::file_size(folder / "out" / name) > 100) << name;
    EXPECT_EQ(read("out/after.png").substr(1, 3), "PNG");
    EXPECT_EQ(nlohmann::json::parse(read("out/summary.json"))["removed_volume_mm3"], json["removed_volume_mm3"]);
}

TEST_F(SimulateCommand, TheMeshItWritesIsAStockItTakes) {
    simulate({slot(3.0), "-o", path("out")}, 0);
    const auto outcome =
        run({"simulate", slot(3.0), "--stock", path("out/stock.ply"), "--resolution-mm", "0.4", "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    // What the first run took is gone; only the edges its mesh cuts off differ.
    EXPECT_LT(nlohmann::json::parse(outcome.output)["removed_volume_mm3"].get<double>(), 5.0);
}

TEST_F(SimulateCommand, FindsTheHolderInTheStock) {
    // The holder of 40 mm begins 30 mm above the tip: 5 mm into the stock at a depth of 35 mm, were it so deep.
    const std::string tools = write("tools.toml", library);
    auto words = std::vector<std::string>{"simulate", slot(35.0), "--stock-box-mm", "-20", "-15",   "-40", "20",
                                          "15",       "0",        "--tool-library", tools, "--json"};
    const auto outcome = run(words);
    ASSERT_EQ(outcome.exit_code, 1) << outcome.errors;
    const auto json = nlohmann::json::parse(outcome.output);
    bool holder = false;
    for (const auto& collision : json["collisions"]) {
        holder = holder || collision["part"] == "holder";
        EXPECT_EQ(collision["with"], "stock");
        EXPECT_GT(collision["volume_mm3"].get<double>(), 0.0);
    }
    EXPECT_TRUE(holder);
}

TEST_F(SimulateCommand, ARapidMoveThroughTheStockIsACollision) {
    const auto json = simulate({slot(1.0, "RAPID\nGOTO/-40,0,-2\nRAPID\nGOTO/40,0,-2\nRAPID\nGOTO/-40,0,50\n")}, 1);
    ASSERT_FALSE(json["collisions"].empty());
    EXPECT_EQ(json["collisions"][0]["with"], "rapid");
    EXPECT_EQ(json["collisions"][0]["part"], "cutter");
}

TEST_F(SimulateCommand, AProgramGivesWhatItsClFileGives) {
    const std::string tools = write("tools.toml", library);
    const auto by_cl = simulate({slot(3.0), "--tool-library", tools}, 0);
    const std::string program = path("SLOT.MPF");
    const auto posted = run({"post", slot(3.0), "-m", "trunnion-ac", "-o", program});
    ASSERT_EQ(posted.exit_code, 0) << posted.errors;
    const auto json = simulate({program, "-m", "trunnion-ac", "--tool-library", tools, "--tool", "BALL_10"}, 0);
    EXPECT_NEAR(json["removed_volume_mm3"].get<double>(), by_cl["removed_volume_mm3"].get<double>(), 1e-3);
    EXPECT_EQ(json["machine_range_violations"], 0);
}

TEST_F(SimulateCommand, BadInputIsSaidBeforeWorkBegins) {
    const auto says = [&](const std::vector<std::string>& words, const std::string& what) {
        auto all = words;
        all.insert(all.begin(), "simulate");
        const auto outcome = run(all);
        EXPECT_EQ(outcome.exit_code, 3) << outcome.errors;
        EXPECT_NE(outcome.errors.find(what), std::string::npos) << outcome.errors;
        EXPECT_TRUE(outcome.output.empty());
    };
    says({slot(3.0)}, "the stock is needed, once: --stock FILE, or --stock-box-mm with two corners");
    says(withBox({slot(3.0), "--resolution-mm", "0.001"}), "[simulation.memory]");
    says(withBox({slot(3.0), "--resolution-mm", "-1"}), "a resolution of -1 mm is not possible");
    says(withBox({slot(3.0), "--clearance-mm", "-0.5", "--tool-library", write("tools.toml", library)}),
         "the clearance around shank and holder is -0.5 mm; it must be 0 or more");
    says({slot(3.0), "--stock-box-mm", "1000", "1000", "1000", "1020", "1020", "1020"},
         "the path never reaches the stock");
    const std::string open = write("open.stl", "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                                               "vertex 0 1 0\nendloop\nendfacet\nendsolid s\n");
    says({slot(3.0), "--stock", open}, "the mesh does not close a volume: 3 edges of one triangle only");
    says(withBox({slot(3.0), "--tool", "NONE", "--tool-library", write("tools.toml", library)}),
         "has no tool \"NONE\"; it has BALL_10");
    says(withBox({write("a.MPF", "G1 X0\nM30\n")}), "a program is read by the machine it is for: give it with -m");
}

}  // namespace
}  // namespace cusp::cli
