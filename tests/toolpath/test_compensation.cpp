// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Shifts of a compensated path against closed forms on planes and against contact by brute force.
#include "sloping_plane.hpp"

#include <cusp/base/random.hpp>
#include <cusp/toolpath/compensation.hpp>

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <sstream>

namespace cusp::toolpath {
namespace {

using geometry::Vector3;

constexpr std::uint64_t seed = 20260905;

geometry::DeviationField field(double slope, double deviation_mm) {
    std::vector<geometry::DeviationSample> samples;
    const Vector3 normal = Vector3(-slope, 0, 1).normalized();
    for (int i = 0; i <= 8; ++i)
        for (int j = 0; j <= 8; ++j) samples.push_back({{5.0 * i, 5.0 * j, slope * 5.0 * i}, normal, deviation_mm});
    return geometry::DeviationField::fit(samples, {}).value();
}

ToolPath pathOf(const std::string& moves, const std::string& frame = "MSYS/0,0,0,1,0,0,0,1,0\n") {
    std::istringstream in("UNITS/MM\nTOOL PATH/FINISH,TOOL,TOROID\nTLDATA/MILL,16.0,3.0,50.0,0.0,0.0\n" + frame +
                          "LOAD/TOOL,1\nFEDRAT/MMPM,1000\n" + moves + "END-OF-PATH\n");
    base::Diagnostics warnings;
    return readToolPath(in, "path.cls", {}, warnings).value();
}

std::vector<Vector3> tipsOf(const ToolPath& path) {
    std::vector<Vector3> out;
    for (const ClRecord& record : path.records)
        if (const auto* motion = std::get_if<LinearMotion>(&record.statement)) out.push_back(motion->location.tip_mm);
    return out;
}

TEST(Compensation, MovesEveryLocationAtThePartAgainstTheDeviation) {
    // A tool upright on a flat part, 0.02 mm too high everywhere; the last location is far off.
    const auto path = pathOf("GOTO/10,10,0,0,0,1\nGOTO/30,10,0\nGOTO/30,10,20\n");
    const auto done = compensate(path, test_support::slopingPlane(0.0), field(0.0, 0.02), {}).value();
    const auto tips = tipsOf(done.path);
    EXPECT_LT((tips[0] - Vector3(10, 10, -0.02)).norm(), 1e-9);
    EXPECT_LT((tips[1] - Vector3(30, 10, -0.02)).norm(), 1e-9);
    EXPECT_EQ(tips[2], Vector3(30, 10, 20));
    EXPECT_EQ(done.summary.locations, 3u);
    EXPECT_EQ(done.summary.moved, 2u);
    EXPECT_NEAR(done.summary.max_shift_mm, 0.02, 1e-9);
}

TEST(Compensation, GainClampAndFade) {
    const auto path = pathOf("GOTO/10,10,0,0,0,1\nGOTO/30,10,1.5\n");
    CompensationOptions options;
    options.gain = 0.5;
    const auto half = tipsOf(compensate(path, test_support::slopingPlane(0.0), field(0.0, 0.02), options).value().path);
    EXPECT_NEAR(half[0].z(), -0.01, 1e-9);
    // 1.5 mm over the part with a reach of 2 mm: half of the shift is left.
    EXPECT_NEAR(half[1].z(), 1.5 - 0.005, 1e-9);
    options = {};
    options.clamp_mm = 0.015;
    const auto clamped = compensate(path, test_support::slopingPlane(0.0), field(0.0, 0.02), options).value();
    EXPECT_NEAR(tipsOf(clamped.path)[0].z(), -0.015, 1e-9);
    EXPECT_EQ(clamped.summary.clamped, 2u);
    options.gain = 2.0;
    options.clamp_mm = 0.0;
    EXPECT_EQ(compensate(path, test_support::slopingPlane(0.0), field(0.0, 0.02), options).error().errorCount(), 2u);
}

TEST(Compensation, ARunOutOverTheEdgeKeepsTheShift) {
    // The tool still cuts the edge from there: faded out, it would cut it deeper than the shift says. Far off it stays.
    const auto path = pathOf("GOTO/39,10,0,0,0,1\nGOTO/48,10,0\nGOTO/70,10,0\n");
    const auto tips = tipsOf(compensate(path, test_support::slopingPlane(0.0), field(0.0, -0.02), {}).value().path);
    EXPECT_NEAR(tips[0].z(), 0.02, 1e-9);
    EXPECT_NEAR(tips[1].z(), 0.02, 1e-9);
    EXPECT_EQ(tips[2], Vector3(70, 10, 0));
}

TEST(Compensation, ALeaningCutterKeepsItsContactWhereTheShiftHasASlope) {
    // The part is 1 µm per mm too high along X, so the surface to cut is z = -0.001 x. A tool leaning 3° in Y fits like a ball
    // of 98 mm there; shifted along the normal alone it would touch 0.1 mm beside. An upright one goes straight down.
    const double slope = 0.001;
    std::vector<geometry::DeviationSample> samples;
    for (int i = 0; i <= 8; ++i)
        for (int j = 0; j <= 8; ++j) samples.push_back({{5.0 * i, 5.0 * j, 0.0}, Vector3::UnitZ(), slope * 5.0 * i});
    const auto high = geometry::DeviationField::fit(samples, {}).value();
    const geometry::Cutter toroid{.diameter_mm = 16.0,
                                  .corner_radius_mm = 3.0,
                                  .corner_e_mm = 5.0,
                                  .corner_f_mm = 3.0,
                                  .cutting_height_mm = 50.0};
    const auto nominal = test_support::slopingPlane(0.0);
    ToolPath path = pathOf("GOTO/20,20,0,0,0,1\nGOTO/20,20,0,0,0,1\n");
    CutterLocation leaning{.tip_mm = {20, 20, 0},
                           .axis = {0, std::sin(std::numbers::pi / 60.0), std::cos(std::numbers::pi / 60.0)}};
    leaning.tip_mm.z() -= cutterContact(leaning, toroid, nominal).gap_mm;
    for (ClRecord& record : path.records)
        if (auto* motion = std::get_if<LinearMotion>(&record.statement)) {
            motion->location = leaning;
            break;
        }
    const auto done = compensate(path, nominal, high, {}).value();
    const auto tips = tipsOf(done.path);
    const auto before = cutterContact(leaning, toroid, nominal);
    const auto after =
        cutterContact({.tip_mm = tips[0], .axis = leaning.axis}, toroid, test_support::slopingPlane(-slope));
    EXPECT_NEAR(after.gap_mm, 0.0, 2e-6);
    EXPECT_LT((after.foot.position - before.foot.position).head<2>().norm(), 0.002);
    EXPECT_GT((tips[0] - leaning.tip_mm).head<2>().norm(), 0.05);
    EXPECT_LT((tips[1] - Vector3(20, 20, -0.02)).norm(), 1e-6);
}

TEST(Compensation, FollowsTheFrameOfThePath) {
    // The same cut told in a frame that lies on its side: its Z is the part's −Y.
    const auto path = pathOf("GOTO/10,0,-10,0,1,0\n", "MSYS/0,0,0,1,0,0,0,0,1\n");
    const auto done = compensate(path, test_support::slopingPlane(0.0), field(0.0, 0.02), {}).value();
    EXPECT_LT((tipsOf(done.path)[0] - Vector3(10, -0.02, -10)).norm(), 1e-9);
}

TEST(Compensation, TheContactIsTheOneBruteForceFinds) {
    const auto nominal = test_support::slopingPlane(0.6);
    const Vector3 normal = Vector3(-0.6, 0, 1).normalized();
    const geometry::Cutter toroid{.diameter_mm = 16.0,
                                  .corner_radius_mm = 3.0,
                                  .corner_e_mm = 5.0,
                                  .corner_f_mm = 3.0,
                                  .cutting_height_mm = 50.0};
    base::Random random(seed);
    for (int i = 0; i < 50; ++i) {
        const Vector3 axis = (normal + 0.3 * Vector3(random.uniform(-1, 1), random.uniform(-1, 1), 0)).normalized();
        const CutterLocation at{.tip_mm = Vector3(20, 20, 12.0) + Vector3(0, 0, random.uniform(0, 2)), .axis = axis};
        const auto contact = cutterContact(at, toroid, nominal);
        double least = 1e9;
        const Vector3 one = axis.unitOrthogonal();
        const Vector3 two = axis.cross(one);
        for (int a = 0; a < 720; ++a)
            for (int b = 0; b <= 180; ++b) {
                const double around = a * std::numbers::pi / 360.0;
                const double down = b * std::numbers::pi / 360.0;  // of the corner's arc, from the side to the bottom
                const Vector3 out = std::cos(around) * one + std::sin(around) * two;
                const Vector3 point =
                    at.tip_mm + 3.0 * axis + 5.0 * out + 3.0 * (std::cos(down) * out - std::sin(down) * axis);
                least = std::min(least, normal.dot(point));
            }
        EXPECT_NEAR(contact.gap_mm, least, 2e-4) << i;
        EXPECT_LE(contact.gap_mm, least + 1e-12) << i;
    }
}

TEST(Compensation, RefusesByName) {
    const auto nominal = test_support::slopingPlane(0.0);
    const auto bent = field(0.0, 0.02);
    const auto codeOf = [&](const ToolPath& path) {
        const auto done = compensate(path, nominal, bent, {});
        return done ? std::string() : base::toText(done.error().front());
    };
    EXPECT_EQ(codeOf(pathOf("GOTO/10,10,500,0,0,1\n")),
              "path.cls: error: of 1 locations none comes within 2 mm of the nominal: another part, or another frame? "
              "[compensate.nothing]");
    ToolPath arc = pathOf("GOTO/10,10,0,0,0,1\n");
    arc.records.push_back({ArcMotion{.end = {.tip_mm = {20, 10, 0}, .axis = Vector3::UnitZ()},
                                     .center_mm = {15, 10, 0},
                                     .radius_mm = 5.0},
                           99});
    EXPECT_EQ(codeOf(arc),
              "path.cls:99: error: an arc ends at the surface; only paths of points can be compensated there "
              "[compensate.arc]");
    ToolPath nameless = pathOf("GOTO/10,10,0,0,0,1\n");
    std::erase_if(nameless.records, [](const ClRecord& r) { return std::holds_alternative<ToolCall>(r.statement); });
    EXPECT_NE(codeOf(nameless).find("compensate.no-cutter"), std::string::npos);
}

}  // namespace
}  // namespace cusp::toolpath
