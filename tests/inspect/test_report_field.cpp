// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The deviation fields of a report against the form and the pose the points were made with.
#include "made_measurement.hpp"

#include <cusp/inspect/inspection.hpp>

#include <gtest/gtest.h>
#include <numbers>

namespace cusp::inspect::test {
namespace {

double formAt(const Vector3& p) { return 0.015 * std::sin(0.05 * p.x()) * std::cos(0.04 * p.y()); }

/// Surface points with form, scallops along y and noise, moved by the inverse of `pose`.
MeasuredPoints partOf(const Patch& patch, double scallop_mm, const geometry::RigidTransform& pose) {
    base::Random random(77);
    const Places places = randomPlaces(random, patch, 3000);
    MeasuredPoints out;
    out.source = "part";
    out.unit_stated = true;
    out.kind = PointKind::Surface;
    for (std::size_t i = 0; i < places.foot.size(); ++i) {
        const Vector3& p = places.foot[i];
        const double d =
            formAt(p) + scallop_mm * std::cos(2.0 * std::numbers::pi * p.y() / 6.0) + random.normal(0.0, 0.001);
        out.positions.emplace_back(pose.inverse() * Vector3(p + d * places.normal[i]));
    }
    return out;
}

geometry::RigidTransform somePose() {
    base::Random random(78);
    return randomPose(random, 0.0005, 0.02);
}

TEST(ReportField, TheDatumFieldHoldsPoseAndFormAndTheFittedOneTheForm) {
    const Patch patch = benchmarkPatch();
    const geometry::RigidTransform pose = somePose();
    InspectionOptions options;
    options.planned_step_over_mm = 6.0;
    base::Diagnostics remarks;
    const auto report = inspectPoints(partOf(patch, 0.004, pose), patch, options, remarks);
    ASSERT_TRUE(report);
    ASSERT_TRUE(report->datum.field);
    ASSERT_TRUE(report->best_fit.field);
    EXPECT_GE(report->datum.field->data().shortest_wave_mm, 24.0);
    const geometry::RigidTransform datum_from_fitted =
        report->datum.nominal_from_measured * report->best_fit.nominal_from_measured.inverse();
    double datum_worst = 0.0;
    double difference_worst = 0.0;
    for (int i = 1; i <= 9; ++i)
        for (int j = 1; j <= 9; ++j) {
            const Vector3 p = patch.at(0.1 * i, 0.1 * j);
            const Vector3 n = patch.normalAt(0.1 * i, 0.1 * j);
            // In the datums the part lies where the inverse of the pose has put it.
            const double truth_mm = n.dot(pose.inverse() * Vector3(p + formAt(p) * n) - p);
            datum_worst = std::max(datum_worst, std::abs(report->datum.field->deviation(p, n) - truth_mm));
            // The two fields differ by the fitted pose, and by nothing else.
            const double pose_mm = n.dot(datum_from_fitted * p - p);
            difference_worst = std::max(difference_worst, std::abs(report->datum.field->deviation(p, n) - pose_mm -
                                                                   report->best_fit.field->deviation(p, n)));
        }
    EXPECT_LT(datum_worst, 0.0015);
    EXPECT_LT(difference_worst, 0.0003);
    EXPECT_NEAR(report->datum.field->data().residual_mm, std::hypot(0.001, 0.004 / std::numbers::sqrt2), 0.0005);
    const base::Json json = toJson(*report);
    EXPECT_EQ(json["deviation_field"]["datum"], report->datum.field->toJson());
    EXPECT_EQ(json["deviation_field"]["reason"], "");
}

TEST(ReportField, IsWithheldWhereTheResultIsDoubtful) {
    const Patch patch = benchmarkPatch();
    MeasuredPoints points = partOf(patch, 0.0, somePose());
    points.positions.resize(14);
    base::Diagnostics remarks;
    const auto report = inspectPoints(points, patch, {}, remarks);
    ASSERT_TRUE(report);
    ASSERT_FALSE(report->doubts.empty());
    EXPECT_FALSE(report->datum.field);
    const base::Json json = toJson(*report);
    EXPECT_TRUE(json["deviation_field"]["best_fit"].is_null());
    EXPECT_EQ(json["deviation_field"]["reason"], "withheld: " + report->doubts.front());
}

}  // namespace
}  // namespace cusp::inspect::test
