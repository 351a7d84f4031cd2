// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The document of the inspection page: every point in its place, and what thinning keeps.
#include "inspection_page.hpp"

#include <cusp/base/random.hpp>
#include <cusp/pages/render.hpp>

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace cusp::cli {
namespace {

constexpr std::uint64_t seed = 20'170'401;

/// Points on a plane with normal deviations; the datums are 5 µm off, the last point lies beyond an edge.
inspect::InspectionReport reportOf(std::size_t points) {
    base::Random random(seed);
    inspect::InspectionReport report;
    report.points_file = "plane.csv";
    report.alignment.fit = inspect::FitKind::LeastSquares;
    for (std::size_t i = 0; i < points; ++i) {
        const inspect::Vector3 at(0.1 * static_cast<double>(i), 2.0, 3.0);
        const double deviation_mm = random.normal(0.0, 0.003);
        report.points.positions.push_back(at);
        report.best_fit.deviations.push_back({at, inspect::Vector3::UnitZ(), deviation_mm, 0.0});
        report.datum.deviations.push_back({at, inspect::Vector3::UnitZ(), deviation_mm + 0.005, 0.0});
    }
    report.best_fit.deviations.back().beyond_edge_mm = 1.0;
    report.best_fit.deviations.back().deviation_mm = 9.0;
    report.best_fit.statistics.count = points;
    inspect::SectionResult section;
    section.label = "Y=2";
    section.points = {4, 2, 0};
    section.arc_length_mm = {0.0, 0.2, 0.4};
    report.sections.push_back(section);
    return report;
}

TEST(InspectionDocument, HoldsEveryPointInTheOrderOfTheFile) {
    const inspect::InspectionReport report = reportOf(50);
    const base::Json document = inspectionDocument(report);
    EXPECT_EQ(document["points"], 50);
    const base::Json& map = document["map"];
    for (const char* list : {"x_mm", "y_mm", "z_mm", "normal_x", "normal_y", "normal_z", "deviation_mm",
                             "best_fit_deviation_mm", "datum_deviation_mm"})
        ASSERT_EQ(map[list].size(), 50U) << list;
    EXPECT_FALSE(map.contains("thinning"));
    for (std::size_t i = 0; i < 49; ++i) {
        const double deviation_mm = report.best_fit.deviations[i].deviation_mm;
        EXPECT_NEAR(map["deviation_mm"][i].get<double>(), deviation_mm, 0.51e-6);
        EXPECT_NEAR(map["datum_deviation_mm"][i].get<double>(), deviation_mm + 0.005, 0.51e-6);
        EXPECT_NEAR(map["x_mm"][i].get<double>(), 0.1 * static_cast<double>(i), 0.51e-4);
        EXPECT_NEAR(map["z_mm"][i].get<double>(), 3.0 + deviation_mm, 0.51e-4);
    }
}

TEST(InspectionDocument, CurvesFollowTheSection) {
    const inspect::InspectionReport report = reportOf(50);
    const base::Json curve = inspectionDocument(report)["sections"][0]["curve"];
    EXPECT_EQ(curve["arc_length_mm"], base::Json::parse("[0.0, 0.2, 0.4]"));
    ASSERT_EQ(curve["deviation_mm"].size(), 3U);
    EXPECT_NEAR(curve["deviation_mm"][0].get<double>(), report.best_fit.deviations[4].deviation_mm, 0.51e-6);
    EXPECT_NEAR(curve["deviation_mm"][2].get<double>(), report.best_fit.deviations[0].deviation_mm, 0.51e-6);
}

TEST(InspectionDocument, SectionsHaveFormAndScallopsAgainstThePlan) {
    // 100 points 0.1 mm apart; ridges of 3 µm every 2 mm over a slow bow.
    inspect::InspectionReport report = reportOf(200);
    inspect::SectionResult& section = report.sections[0];
    section.points.clear();
    section.arc_length_mm.clear();
    for (std::uint32_t i = 0; i < 100; ++i) {
        const double x = 0.1 * i;
        section.points.push_back(i);
        section.arc_length_mm.push_back(x);
        report.best_fit.deviations[i].deviation_mm =
            0.003 * std::abs(std::sin(std::acos(-1.0) * x / 2.0)) + 1e-3 * (x - 5.0) * (x - 5.0);
    }
    const base::Json planned = inspectionDocument(report, 2.0)["sections"][0];
    EXPECT_EQ(planned["scallops"]["count"], 5);  // at 1, 3, 5, 7 and 9 mm
    EXPECT_EQ(planned["curve"]["form_mm"].size(), 100U);
    EXPECT_GE(planned["form"]["order"].get<int>(), 2);
    const base::Json unplanned = inspectionDocument(report)["sections"][0];
    EXPECT_FALSE(unplanned.contains("scallops"));
    EXPECT_TRUE(unplanned.contains("form"));
}

TEST(InspectionDocument, ThinningKeepsTheLargestAndSaysSo) {
    const inspect::InspectionReport report = reportOf(10'000);
    const base::Json document = inspectionDocument(report, 0.0, 400);
    const base::Json& map = document["map"];
    EXPECT_LE(map["x_mm"].size(), 400U);
    EXPECT_GE(map["x_mm"].size(), 350U);
    EXPECT_EQ(map["thinning"].get<std::string>(), "Shown are " + std::to_string(map["x_mm"].size()) +
                                                      " of 10000 points, the 100 largest deviations among them.");
    // By brute force: the 100 largest of the points that count.
    std::vector<double> sizes;
    for (std::size_t i = 0; i + 1 < 10'000; ++i) sizes.push_back(std::abs(report.best_fit.deviations[i].deviation_mm));
    std::sort(sizes.begin(), sizes.end(), std::greater<>());
    std::vector<double> shown;
    for (const auto& value : map["deviation_mm"]) shown.push_back(std::abs(value.get<double>()));
    std::sort(shown.begin(), shown.end(), std::greater<>());
    for (std::size_t i = 0; i < 100; ++i) EXPECT_NEAR(shown[i], sizes[i], 0.51e-6) << i;
    EXPECT_NEAR(std::abs(document["worst"][0]["deviation_mm"].get<double>()), sizes[0], 1e-15);
    EXPECT_EQ(document["worst"].size(), 10U);
}

TEST(InspectionDocument, BecomesAPage) {
    const auto html = inspectionPage(reportOf(5));
    ASSERT_TRUE(html.has_value());
    EXPECT_NE(html->find("plane.csv"), std::string::npos);
}

}  // namespace
}  // namespace cusp::cli
