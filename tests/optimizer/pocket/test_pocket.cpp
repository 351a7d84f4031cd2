// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Pockets against closed forms: areas, engagement of straight cuts and slots, order crossover, cutting loads; bad contours.
#include <cusp/optimizer/pocket/cutting_data.hpp>
#include <cusp/optimizer/pocket/path_builder.hpp>
#include <cusp/optimizer/pocket/path_search.hpp>
#include <cusp/optimizer/pocket/strategies.hpp>

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace {

using namespace cusp::pocket;
using std::numbers::pi;

Polygon box(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

PocketArea openSide() {
    return areaFor({.stock = {box(0, 0, 60, 40)}, .pockets = {box(-5, 8, 50, 32)}, .islands = {}}, 10.0, 0.0).value();
}

TEST(PocketRegion, ArcsOfAContourHaveTheirArea) {
    // A square with a half circle on one side, drawn clockwise.
    const auto polygon = toPolygon({{{0, 0}, {0, 10}, {10, 10}, {10, 0}}, {0, 0, -1.0, 0}}, 0.001).value();
    EXPECT_NEAR(areaOf({polygon}), 100.0 + pi * 25.0 / 2.0, 0.02);
}

TEST(PocketRegion, BadContoursAreNamed) {
    EXPECT_EQ(toPolygon({{{0, 0}, {10, 10}, {10, 0}, {0, 10}}, {}}, 0.01).error().front().code,
              "pocket.contour-crosses");
    EXPECT_EQ(toPolygon({{{0, 0}, {10, 0}}, {}}, 0.01).error().front().code, "pocket.contour-points");
    EXPECT_EQ(toPolygon({{{0, 0}, {10, 0}, {5, 5}}, {0.0}}, 0.01).error().front().code, "pocket.contour-points");
    EXPECT_EQ(toPolygon({{{0, 0}, {10, 0}, {5, 0}}, {}}, 0.01).error().front().code, "pocket.contour-area");
}

TEST(PocketArea, CornersOfARectangleAreOutOfReach) {
    const auto area =
        areaFor({.stock = {box(0, 0, 60, 40)}, .pockets = {box(10, 10, 50, 30)}, .islands = {}}, 10.0, 0.0).value();
    EXPECT_NEAR(areaOf(area.material), 800.0, 1e-6);
    EXPECT_NEAR(area.unreachable_area_mm2, (4.0 - pi) * 25.0, 0.05);
}

TEST(PocketArea, AToolThatFitsNowhereIsToldTheWidestThatDoes) {
    const auto area =
        areaFor({.stock = {box(0, 0, 60, 40)}, .pockets = {box(10, 10, 50, 17)}, .islands = {}}, 10.0, 0.0);
    ASSERT_FALSE(area);
    EXPECT_EQ(area.error().front().code, "pocket.tool-too-large");
    EXPECT_NE(area.error().front().message.find("takes 7.00 mm"), std::string::npos) << area.error().front().message;
}

TEST(PocketEngagement, AStraightCutAndASlotHaveTheirClosedForms) {
    const auto area = areaFor({.stock = {box(0, 0, 100, 40)}, .pockets = {}, .islands = {}}, 10.0, 0.0).value();
    for (const double ae : {0.5, 1.0, 2.5, 5.0}) {
        // Along the lower edge, so that ae of the tool is in the stock.
        const FlatPath path{"side", {-10.0, ae - 5.0}, {{{50.0, ae - 5.0}}}};
        EXPECT_NEAR(measureEngagement(path, area, 90.0, 1.0).max_deg, std::acos(1.0 - 2.0 * ae / 10.0) * 180.0 / pi,
                    0.05)
            << ae;
    }
    const FlatPath slot{"slot", {-10.0, 20.0}, {{{50.0, 20.0}}}};
    EXPECT_NEAR(measureEngagement(slot, area, 90.0, 1.0).max_deg, 180.0, 0.1);
    // The same way twice: nothing is left the second time.
    const FlatPath twice{"twice", {-10.0, 20.0}, {{{50.0, 20.0}}, {{-10.0, 20.0}}}};
    EXPECT_EQ(measureEngagement(twice, area, 90.0, 1.0).step_max_deg.back(), 0.0);
}

TEST(PocketPath, EveryStrategyClearsAnOpenPocketWithinTheLimit) {
    const auto area = openSide();
    const auto map = pointMap(area, 1.2, 20'000).value();
    const PathBuilder builder(area, map, {.limit_deg = 86.0});
    for (const Strategy s :
         {Strategy::ZigZag, Strategy::OneWay, Strategy::ContourParallel, Strategy::ConstantEngagement}) {
        const FlatPath path = builder.build(preferenceOf(map, s), toText(s));
        const Engagement e = measureEngagement(path, area, 90.0, 0.25);
        const auto above =
            std::count_if(e.step_max_deg.begin(), e.step_max_deg.end(), [](double d) { return d > 91.0; });
        EXPECT_LE(static_cast<double>(above), 0.01 * static_cast<double>(path.steps.size())) << path.name;
        EXPECT_LT(unclearedArea(path, area, 0.2), 0.002 * areaOf(area.coverable)) << path.name;
        EXPECT_LT(gougeOf(path, area), 0.01) << path.name;
        for (const FlatStep& step : path.steps) EXPECT_NE(step.kind, StepKind::Helix) << path.name;
    }
}

TEST(PocketPath, AClosedPocketIsOpenedByAHelix) {
    const auto area =
        areaFor({.stock = {box(0, 0, 60, 40)}, .pockets = {box(10, 8, 50, 32)}, .islands = {}}, 10.0, 0.0).value();
    const auto map = pointMap(area, 1.5, 20'000).value();
    const FlatPath path =
        PathBuilder(area, map, {.limit_deg = 90.0}).build(preferenceOf(map, Strategy::ConstantEngagement), "fronts");
    ASSERT_FALSE(path.steps.empty());
    EXPECT_EQ(path.steps.front().kind, StepKind::Helix);
    EXPECT_LT(unclearedArea(path, area, 0.2), 0.002 * areaOf(area.coverable));
    EXPECT_LT(gougeOf(path, area), 0.01);
}

TEST(PocketSearch, OrderCrossoverKeepsTheStretchAndIsAPermutation) {
    // Davis' example: the stretch of the first, then the second's order from behind it.
    EXPECT_EQ(crossOrder({0, 1, 2, 3, 4, 5, 6}, {3, 4, 0, 6, 2, 1, 5}, 2, 5), (Order{0, 6, 2, 3, 4, 1, 5}));
    cusp::base::Random random(5);
    Order a(40);
    for (std::uint32_t i = 0; i < 40; ++i) a[i] = i;
    for (int trial = 0; trial < 500; ++trial) {
        Order b = a;
        random.shuffle(b);
        const auto first = static_cast<std::size_t>(random.below(40));
        Order child = crossOrder(a, b, first, first + 1 + static_cast<std::size_t>(random.below(40 - first)));
        mutateOrder(child, random);
        std::sort(child.begin(), child.end());
        ASSERT_EQ(child, a);
    }
}

TEST(PocketCutting, LoadsFollowTheirFormulas) {
    const CutterLimits limits{.diameter_mm = 10.0,
                              .teeth = 4,
                              .overhang_mm = 30.0,
                              .max_spindle_rpm = 8000.0,
                              .spindle_power_kw = 5.0,
                              .engagement_deg = 90.0};
    const CuttingLoad load = loadOf({5.0, 2.5, 3000.0, 0.05}, limits, 2000.0);
    EXPECT_NEAR(load.feed_mm_per_min, 600.0, 1e-9);
    EXPECT_NEAR(load.mrr_mm3_per_min, 7500.0, 1e-9);  // eq. 4
    EXPECT_NEAR(load.engagement_deg, 60.0, 1e-9);
    EXPECT_NEAR(load.power_kw, 7500.0 * 2000.0 / 48e6, 1e-12);
    EXPECT_EQ(infeasibility({5.0, 2.5, 9000.0, 0.05}, limits, 2000.0), "spindle speed 9e+03 rpm above 8e+03 rpm");
}

TEST(PocketCutting, TheTableOfThePaperIsRead) {
    const auto table = readCuttingTableFile(std::string(CUSP_SOURCE_DIR) + "/machines/cutting/mitic-2023.toml").value();
    const auto range = rangeFor(table, "1.3", 18.0).value();
    EXPECT_EQ(range.fz_mm[1], 0.20);                                        // misprinted 0.02
    EXPECT_NEAR(range.spindle_rpm[0], 190.0 * 1000.0 / (pi * 18.0), 1e-6);  // eq. 2
    EXPECT_EQ(rangeFor(table, "9.9", 18.0).error().front().code, "pocket.no-such-material");
    EXPECT_EQ(rangeFor(table, "1.3", 40.0).error().front().code, "pocket.diameter");
}

}  // namespace
