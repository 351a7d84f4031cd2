// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp simulate` from the outside: slots whose volume is known, collisions that are there, input that is refused.
#include "command_line.hpp"

#include <array>
#include <cmath>
#include <map>
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

/// A closed box as STL text.
std::string boxStl(const std::array<double, 3>& low, const std::array<double, 3>& high) {
    const auto corner = [&](int i) {
        return std::to_string((i & 1) != 0 ? high[0] : low[0]) + " " + std::to_string((i & 2) != 0 ? high[1] : low[1]) +
               " " + std::to_string((i & 4) != 0 ? high[2] : low[2]);
    };
    constexpr int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    std::string out = "solid box\n";
    for (const auto& f : faces)
        for (const auto& t : {std::array{f[0], f[1], f[2]}, std::array{f[0], f[2], f[3]}}) {
            out += "facet normal 0 0 0\nouter loop\n";
            for (const int c : t) out += "vertex " + corner(c) + "\n";
            out += "endloop\nendfacet\n";
        }
    return out + "endsolid box\n";
}

TEST_F(SimulateCommand, ShankHolderAndHeadMeetFixtureTableAndNominal) {
    const std::string tools = write("tools.toml", library);
    // Tip at Z −3; the holder, 40 mm wide, from Z 27 to Z 47; the head, 80 mm wide, from Z 57 to Z 77.
    const std::string clamp = write("clamp.stl", boxStl({-10, 15, 0}, {10, 30, 32}));
    const std::string post = write("post.stl", boxStl({-10, 30, -20}, {10, 45, 60}));
    const std::string table = write("table.stl", boxStl({-30, -30, -40}, {30, 30, -2}));
    const auto found = [&](const std::vector<std::string>& more, int exit_code) {
        std::vector<std::string> words{slot(3.0), "--tool-library", tools, "--head-mm", "20,80,80"};
        words.insert(words.end(), more.begin(), more.end());
        std::map<std::string, double> deepest;
        const auto json = simulate(words, exit_code);
        for (const auto& c : json["collisions"]) {
            double& depth = deepest[c["part"].get<std::string>() + " " + c["with"].get<std::string>()];
            depth = std::max(depth, c["depth_mm"].get<double>());
        }
        return deepest;
    };
    EXPECT_TRUE(found({}, 0).empty());
    const auto clamped = found({"--fixture", clamp}, 1);
    // 5 mm into the clamp from its top, and as far from its side.
    ASSERT_EQ(clamped.size(), 1U);
    EXPECT_NEAR(clamped.at("holder fixture"), 5.0, 0.5);
    const auto posted = found({"--fixture", post}, 1);
    ASSERT_EQ(posted.size(), 1U);
    EXPECT_NEAR(posted.at("head fixture"), 3.0, 0.5);
    // The cutter itself must not touch a table: its tip is 1 mm in it. Depths are looked at where the rays are.
    const auto scratched = found({"--table", table}, 1);
    ASSERT_EQ(scratched.size(), 1U);
    EXPECT_NEAR(scratched.at("cutter table"), 1.0, 0.3);
    // What shall stand beside the slot is in the holder's way, though nothing is there yet.
    const auto beside = found({"--nominal", clamp, "--tolerance-mm", "100"}, 1);
    ASSERT_EQ(beside.count("holder nominal"), 1U);
    const auto both = found({"--fixture", clamp, "--fixture", post, "--table", table}, 1);
    EXPECT_EQ(both.size(), 3U);
}

TEST_F(SimulateCommand, ARamKeepsItsDirection) {
    // The tool leans by 30° towards −X; the swivel, 100 mm above the tip, lies 50 mm aside, and the ram, 40 mm
    // wide, hangs from there straight up: between X −90 and X −10 while the tip goes from X −20 to X 20.
    const std::string tools = write("tools.toml", library);
    const std::string file =
        write("lean.apt", "UNITS/MM\nCUTTER/10,5,0,5,0,0,40\nLOADTL/1\nMULTAX/ON\nFEDRAT/1000,MMPM\n"
                          "GOTO/-20,0,-1,-0.5,0,0.8660254038\nGOTO/20,0,-1,-0.5,0,0.8660254038\nFINI\n");
    const auto parts = [&](double x, const std::vector<std::string>& more, int exit_code) {
        const std::string post = write("post.stl", boxStl({x, -10, 90}, {x + 5, 10, 140}));
        std::vector<std::string> words{file, "--tool-library", tools, "--ram-mm", "80,40,40", "--pivot-mm",
                                       "40", "--fixture",      post};
        words.insert(words.end(), more.begin(), more.end());
        const auto json = simulate(words, exit_code);
        std::string out;
        for (const auto& c : json["collisions"])
            out += c["part"].get<std::string>() + " " + c["with"].get<std::string>();
        EXPECT_EQ(json["moves"], 1);
        return out;
    };
    EXPECT_EQ(parts(-93.0, {}, 1), "ram fixture");
    EXPECT_EQ(parts(-96.0, {}, 0), "");
    EXPECT_EQ(parts(-12.0, {}, 1), "ram fixture");
    EXPECT_EQ(parts(-9.0, {}, 0), "");
    const auto refused = run({"simulate", file, "--stock-box-mm", "-20", "-15", "-20", "20", "15", "11",
                              "--tool-library", tools, "--ram-mm", "80,40,40", "-m", "trunnion-ac"});
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_NE(refused.errors.find("turns the workpiece"), std::string::npos) << refused.errors;
}

TEST_F(SimulateCommand, ConesOfTheLibraryAreCones) {
    // A cone on the cutter, 10 mm wide at Z 7 and 30 mm at Z 27; a wall that begins 8 mm from the axis, up to Z 15.
    const auto run_with = [&](const std::string& shank, int exit_code) {
        std::string text = library;
        text.replace(text.find("[[20.0, 10.0]]"), 14, shank);
        const std::string wall = write("wall.stl", boxStl({-10, 8, 0}, {10, 30, 15}));
        return simulate({slot(3.0), "--tool-library", write("cones.toml", text), "--fixture", wall}, exit_code);
    };
    EXPECT_TRUE(run_with("[[20.0, 10.0, 30.0]]", 1)["collisions"][0]["part"] == "shank");
    EXPECT_TRUE(run_with("[[20.0, 10.0, 15.9]]", 0)["collisions"].empty());
    EXPECT_TRUE(run_with("[[20.0, 10.0]]", 0)["collisions"].empty());
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
    // The tip stays 2 mm above, though within the height of the cutter.
    says({slot(3.0), "--stock-box-mm", "-20", "-15", "-25", "20", "15", "-5"}, "the path never reaches the stock");
    const std::string sheet =
        write("sheet.toml", "schema = 1\nname = \"sheet\"\n[[face]]\nform = \"bezier\"\noutward = \"du x dv\"\n"
                            "points_mm = [[[-20, -9, -3], [-20, 9, -3]], [[20, -9, -2], [20, 9, -2]]]\n");
    says({slot(3.0), "--stock", sheet}, "the shape does not close a volume");
    says(withBox({slot(3.0), "--tool-library", write("tools.toml", library), "--head-mm", "20,-80,80"}),
         "is not possible");
    says(withBox({slot(3.0), "--tool", "NONE", "--tool-library", write("tools.toml", library)}),
         "has no tool \"NONE\"; it has BALL_10");
    says(withBox({write("a.MPF", "G1 X0\nM30\n")}), "a program is read by the machine it is for: give it with -m");
}

}  // namespace
}  // namespace cusp::cli
