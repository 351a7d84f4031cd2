// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp measure` from the outside, and what `cusp inspect` makes of its files.
#include "command_line.hpp"

#include <cmath>

namespace cusp::cli {
namespace {

using MeasureCommand = CommandLine;

const std::string benchmark = std::string(CUSP_SOURCE_DIR) + "/examples/benchmark/";

std::vector<std::string> measureArguments(const std::vector<std::string>& more) {
    std::vector<std::string> out{"measure",
                                 benchmark + "surface_finish.cls",
                                 "--nominal",
                                 benchmark + "surface.toml",
                                 "-m",
                                 "fooke-endura-ca",
                                 "--wcs-origin-mm",
                                 "3000",
                                 "0",
                                 "-800",
                                 "--sections",
                                 "X=-5,-30,-60,-90"};
    out.insert(out.end(), more.begin(), more.end());
    return out;
}

TEST_F(MeasureCommand, InspectTakesEveryFormatAndFindsTheSame) {
    const auto outcome =
        run(measureArguments({"-o", path("p.csv"), "-o", path("p.dmo"), "-o", path("p.qif"), "--json"}));
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    const auto json = nlohmann::json::parse(outcome.output);
    EXPECT_EQ(json["points"], 816);
    EXPECT_EQ(json["not_cut"], 0);
    std::vector<double> rms;
    for (const char* name : {"p.csv", "p.dmo", "p.qif"}) {
        const auto inspected = run({"inspect", path(name), "--nominal", benchmark + "surface.toml", "--json", "--fit",
                                    "none", "--probe-radius-mm", "1"});
        ASSERT_LE(inspected.exit_code, 1) << inspected.errors;  // 1: a path of 3° lead is a doubtful part
        rms.push_back(nlohmann::json::parse(inspected.output)["datum_deviation"]["rms_mm"]);
    }
    EXPECT_NEAR(rms[1], rms[0], 1e-9);
    EXPECT_NEAR(rms[2], rms[0], 1e-9);
}

TEST_F(MeasureCommand, APivotErrorShowsInTheFixedDatums) {
    const std::string errors = write("e.toml", "schema = 1\n[error]\npivot_length_mm = 0.05\n");
    const std::vector<std::string> exact{"--noise-mm", "0", "--form-mm", "0", "--drift-mm", "0", "--json"};
    auto good = exact;
    good.insert(good.end(), {"-o", path("good.csv"), "--truth", path("good_truth.csv")});
    auto bad = exact;
    bad.insert(bad.end(), {"-o", path("bad.csv"), "--errors", errors, "--truth", path("bad_truth.csv")});
    ASSERT_EQ(run(measureArguments(good)).exit_code, 0);
    ASSERT_EQ(run(measureArguments(bad)).exit_code, 0);
    // −0.05·n·(u − e_z): at most 21 µm of overcut on this surface, nowhere material left.
    std::istringstream before(read("good_truth.csv"));
    std::istringstream after(read("bad_truth.csv"));
    double most = 0.0;
    double least = 0.0;
    std::string a;
    std::string b;
    std::getline(before, a);
    std::getline(after, b);
    while (std::getline(before, a) && std::getline(after, b)) {
        const double change = std::stod(b.substr(b.rfind(',') + 1)) - std::stod(a.substr(a.rfind(',') + 1));
        most = std::max(most, change);
        least = std::min(least, change);
    }
    EXPECT_LT(most, 0.0005);
    EXPECT_NEAR(least, -0.0207, 0.0005);
}

TEST_F(MeasureCommand, SameSeedSameBytes) {
    ASSERT_EQ(run(measureArguments({"-o", path("a.csv"), "--seed", "5"})).exit_code, 0);
    ASSERT_EQ(run(measureArguments({"-o", path("b.csv"), "--seed", "5"})).exit_code, 0);
    ASSERT_EQ(run(measureArguments({"-o", path("c.csv"), "--seed", "6"})).exit_code, 0);
    EXPECT_EQ(read("a.csv"), read("b.csv"));
    EXPECT_NE(read("a.csv"), read("c.csv"));
}

TEST_F(MeasureCommand, RefusesAndLeavesNothingBehind) {
    EXPECT_EQ(run(measureArguments({"-o", path("p.csv"), "--errors", path("absent.toml")})).exit_code, 4);
    EXPECT_EQ(run(measureArguments({"-o", path("p.stl")})).exit_code, 3);
    EXPECT_EQ(run(measureArguments({"-o", path("p.csv"), "-o", path("p.stl")})).exit_code, 3);
    EXPECT_EQ(run({"measure", benchmark + "surface_finish.cls", "--nominal", benchmark + "surface.toml", "-m",
                   "fooke-endura-ca", "-o", path("p.csv")})
                  .exit_code,
              2);
    const auto outside = run({"measure", benchmark + "surface_finish.cls", "--nominal", benchmark + "surface.toml",
                              "-m", "fooke-endura-ca", "-o", path("p.csv"), "--sections", "X=500"});
    EXPECT_EQ(outside.exit_code, 3);
    EXPECT_NE(outside.errors.find("measure.section"), std::string::npos) << outside.errors;
    const std::string list = write("list.csv", "x,y,z\n-50,-50,99\n");
    const auto off = run({"measure", benchmark + "surface_finish.cls", "--nominal", benchmark + "surface.toml", "-m",
                          "fooke-endura-ca", "-o", path("p.csv"), "--points", list});
    EXPECT_EQ(off.exit_code, 3);
    EXPECT_NE(off.errors.find("measure.targets"), std::string::npos) << off.errors;
    EXPECT_EQ(left(), std::vector<std::string>{"list.csv"});
}

}  // namespace
}  // namespace cusp::cli
