// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What goes wrong at a measuring machine: every case is diagnosed, none ends in a confident wrong answer.
#include "made_measurement.hpp"

#include <cusp/geometry/turned_shape.hpp>
#include <cusp/inspect/inspection.hpp>
#include <cusp/inspect/pose_search.hpp>

#include <gtest/gtest.h>

namespace cusp::inspect::test {
namespace {

struct Outcome {
    std::optional<InspectionReport> report;
    std::string errors;
    std::string remarks;

    Verdict verdict() const { return report ? report->judged().decision.verdict : Verdict::NotAsked; }
};

Outcome inspected(const std::vector<Vector3>& positions, const geometry::NominalShape& nominal,
                  InspectionOptions options = {}, MeasuredPoints points = {}) {
    points.positions = positions;
    points.lines.resize(positions.size(), 1);
    if (!options.limits) options.limits = ToleranceLimits{-0.01, 0.01};
    base::Diagnostics report;
    auto result = inspectPoints(std::move(points), nominal, options, report);
    Outcome out;
    if (result)
        out.report = *std::move(result);
    else
        out.errors = toText(result.error());
    out.remarks = toText(report);
    return out;
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

class Misuse : public ::testing::Test {
protected:
    Misuse() {
        base::Random random(77);
        const Places places = randomPlaces(random, patch, 600);
        for (std::size_t i = 0; i < 600; ++i)
            points.emplace_back(places.foot[i] + random.normal(0.0, 0.001) * places.normal[i]);
    }
    std::vector<Vector3> transformed(const auto& change) const {
        std::vector<Vector3> out;
        for (const Vector3& p : points) out.push_back(change(p));
        return out;
    }

    Patch patch = benchmarkPatch();
    std::vector<Vector3> points;
};

TEST_F(Misuse, AGoodPartIsAccepted) {
    const Outcome out = inspected(points, patch);
    ASSERT_TRUE(out.report.has_value()) << out.errors;
    EXPECT_EQ(out.verdict(), Verdict::Accept) << out.remarks;
    EXPECT_TRUE(out.report->doubts.empty());
    EXPECT_NEAR(out.report->best_fit.decision.uncertainty.standard_mm, 0.001, 0.0003);
}

TEST_F(Misuse, WrongUnit) {
    for (const auto& [factor, words] :
         {std::pair(1.0 / 25.4, "this looks like inch read as mm"),
          std::pair(1e-3, "this looks like metres read as mm"), std::pair(25.4, "this looks like mm read as inch"),
          std::pair(1000.0, "this looks like micrometres read as mm")}) {
        const Outcome out = inspected(transformed([f = factor](const Vector3& p) { return Vector3(f * p); }), patch);
        EXPECT_TRUE(contains(out.errors, words)) << out.errors;
        EXPECT_TRUE(contains(out.errors, "[inspect.unit]"));
    }
}

TEST_F(Misuse, MirroredPart) {
    for (const auto& signs : {Vector3(-1, 1, 1), Vector3(1, 1, -1)}) {
        const Outcome out =
            inspected(transformed([&](const Vector3& p) { return Vector3(p.cwiseProduct(signs)); }), patch);
        EXPECT_TRUE(contains(out.errors + out.remarks, "the mirror image of the points fits"))
            << out.errors << out.remarks;
        EXPECT_TRUE(out.verdict() == Verdict::Undecided || !out.report);
    }
}

TEST_F(Misuse, WrongNominal) {
    base::Random random(4);
    const Outcome out = inspected(points, randomPatch(random));
    EXPECT_TRUE(contains(out.errors + out.remarks, "a wrong nominal")) << out.errors << out.remarks;
    EXPECT_TRUE(out.verdict() == Verdict::Undecided || !out.report);
}

TEST_F(Misuse, TooFewPoints) {
    const std::vector<Vector3> five(points.begin(), points.begin() + 5);
    EXPECT_EQ(inspected(five, patch).errors,
              "error: 5 points cannot determine 6 free freedoms [align.too-few-points]\n");
    const std::vector<Vector3> ten(points.begin(), points.begin() + 10);
    const Outcome out = inspected(ten, patch);
    EXPECT_EQ(out.verdict(), Verdict::Undecided);
    EXPECT_TRUE(contains(out.remarks,
                         "warning: 10 points for a fit of 6 freedoms: the fit follows the points; measure at "
                         "least 18 [inspect.few-points]"))
        << out.remarks;
}

TEST_F(Misuse, AllPointsOnAPlane) {
    base::Random random(3);
    std::vector<Vector3> flat;
    for (int i = 0; i < 200; ++i) flat.emplace_back(random.uniform(-90, -5), random.uniform(-95, -5), 20.0);
    EXPECT_EQ(
        inspected(flat, patch).errors,
        "error: the fit is not determined: all 200 points lie in one plane, the nominal does not; nothing holds tx, ty, "
        "rz; measure in other planes too, or lock them [align.not-determined]\n");
    std::vector<Vector3> line;
    for (int i = 0; i < 100; ++i) line.push_back(patch.at(0.01 * i, 0.4));
    EXPECT_TRUE(contains(inspected(line, patch).errors, "[align.not-determined]"));
}

TEST_F(Misuse, FortyPercentOutliers) {
    base::Random random(5);
    auto spoiled = points;
    for (std::size_t i = 0; i < 240; ++i)
        spoiled[i] += Vector3(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3));
    const Outcome out = inspected(spoiled, patch);
    EXPECT_EQ(out.verdict(), Verdict::Undecided);
    EXPECT_TRUE(contains(out.remarks, "[inspect.many-outliers]")) << out.remarks;
    // A robust fit finds the others where they are.
    InspectionOptions robust;
    robust.loss = Loss::Tukey;
    const Outcome found = inspected(spoiled, patch, robust);
    ASSERT_TRUE(found.report.has_value());
    EXPECT_NEAR(found.report->best_fit.statistics.median_mm, 0.0, 0.0005);
    EXPECT_GE(found.report->best_fit.outliers.size(), 225U);
    EXPECT_LE(found.report->best_fit.outliers.size(), 245U);
    EXPECT_EQ(found.verdict(), Verdict::Reject);
}

/// Half a kilometre off, the fit ends somewhere; what it found there is no verdict.
TEST_F(Misuse, FarOffTheOrigin) {
    const auto moved = transformed([](const Vector3& p) { return Vector3(p + Vector3(5e5, -3e5, 1e5)); });
    const Outcome out = inspected(moved, patch);
    EXPECT_TRUE(out.verdict() == Verdict::Undecided || out.verdict() == Verdict::Accept || !out.report);
    if (out.verdict() != Verdict::Accept) {
        EXPECT_TRUE(contains(out.errors + out.remarks, "--start scan finds one")) << out.errors << out.remarks;
    }
    InspectionOptions options;
    options.start = searchPose(moved, patch, {}).nominal_from_measured;
    const Outcome found = inspected(moved, patch, options);
    ASSERT_EQ(found.verdict(), Verdict::Accept) << found.errors << found.remarks;
    EXPECT_NEAR(found.report->best_fit.statistics.rms_mm, 0.001, 0.0001);
}

/// The normal of the nominal points into the material: centres then lie on its inner side, and fit nowhere else.
TEST_F(Misuse, NominalInsideOut) {
    class Borrowed : public geometry::NominalShape {
    public:
        explicit Borrowed(const geometry::NominalShape& shape) : shape_(shape) {}
        geometry::Footpoint closest(const Vector3& query) const override { return shape_.closest(query); }
        void closest(std::span<const Vector3> queries, std::span<geometry::Footpoint> feet, bool warm) const override {
            shape_.closest(queries, feet, warm);
        }
        Eigen::AlignedBox3d bounds() const override { return shape_.bounds(); }

    private:
        const geometry::NominalShape& shape_;
    };
    const geometry::TurnedShape turned(std::make_unique<Borrowed>(patch));
    base::Random random(78);
    const Places places = randomPlaces(random, patch, 600);
    std::vector<Vector3> centres;
    for (std::size_t i = 0; i < 600; ++i)
        centres.emplace_back(places.foot[i] + (2.0 + random.normal(0.0, 0.001)) * places.normal[i]);
    InspectionOptions options;
    options.probe_radius_mm = 2.0;
    for (const auto& kind : {std::optional<PointKind>{}, std::optional(PointKind::Centre)}) {
        MeasuredPoints measured;
        measured.kind = kind;
        EXPECT_EQ(inspected(centres, patch, options, measured).verdict(), Verdict::Accept);
        const Outcome out = inspected(centres, turned, options, measured);
        EXPECT_TRUE(contains(out.errors, "its outward normal points into the material; turn it by --flip-nominal "
                                         "[inspect.side]"))
            << out.errors << out.remarks;
    }
    const geometry::TurnedShape right(std::make_unique<geometry::TurnedShape>(std::make_unique<Borrowed>(patch)));
    const Outcome again = inspected(centres, right, options);
    ASSERT_TRUE(again.report.has_value());
    EXPECT_EQ(again.report->best_fit.statistics.rms_mm,
              inspected(centres, patch, options).report->best_fit.statistics.rms_mm);
}

TEST_F(Misuse, StartTooFarOff) {
    base::Random random(8);
    const auto pose = randomPose(random, 2.0, 400.0);
    const auto moved = transformed([&](const Vector3& p) { return Vector3(pose.inverse() * p); });
    const Outcome out = inspected(moved, patch);
    EXPECT_TRUE(contains(out.errors + out.remarks, "the start is too far off; --start scan finds one"))
        << out.errors << out.remarks;
    EXPECT_TRUE(out.verdict() == Verdict::Undecided || !out.report);
    InspectionOptions options;
    options.start = searchPose(moved, patch, {}).nominal_from_measured;
    const Outcome found = inspected(moved, patch, options);
    EXPECT_EQ(found.verdict(), Verdict::Accept) << found.errors << found.remarks;
    // The same fit as from the true start.
    const Outcome straight = inspected(points, patch);
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_NEAR(found.report->best_fit.deviations[i].deviation_mm,
                    straight.report->best_fit.deviations[i].deviation_mm, 1e-9);
}

TEST_F(Misuse, CentresOrSurfacePoints) {
    base::Random random(6);
    const auto made = leastSquaresMeasurement(random, patch, 400, 2.0, 0.002, randomPose(random, 0.002, 0.05));
    InspectionOptions options;
    options.probe_radius_mm = 2.0;
    Outcome out = inspected(made.points, patch, options);
    ASSERT_TRUE(out.report.has_value()) << out.errors;
    EXPECT_EQ(out.report->kind, PointKind::Centre);
    EXPECT_TRUE(contains(out.report->kind_source, "found: rms 0.00")) << out.report->kind_source;
    out = inspected(points, patch, options);
    ASSERT_TRUE(out.report.has_value()) << out.errors;
    EXPECT_EQ(out.report->kind, PointKind::Surface);
    EXPECT_EQ(out.report->probe_radius_mm, 0.0);
    // What the file states holds, and is doubted aloud.
    MeasuredPoints stated;
    stated.kind = PointKind::Surface;
    out = inspected(made.points, patch, options, stated);
    EXPECT_TRUE(contains(out.remarks, "stated are surface points, but the points fit as probe centres far better"))
        << out.remarks;
    stated.kind = PointKind::Centre;
    EXPECT_EQ(inspected(made.points, patch, {}, stated).errors,
              "error: the points are centres of the probe; its radius is needed: --probe-radius-mm [inspect.radius]\n");
    // A plane cannot tell them apart.
    std::vector<Vector3> flat;
    for (int i = 0; i < 100; ++i) flat.emplace_back(random.uniform(-40, 40), random.uniform(-40, 40), 0.0);
    options.locked = {true, true, false, false, false, true};
    EXPECT_EQ(inspected(flat, Plane(), options).errors.substr(0, 64),
              "error: are the points probe centres or surface points? Both fit ");
}

TEST_F(Misuse, FarOffPointsAreNeitherCentresNorSurfacePoints) {
    MeasuredPoints far;
    far.source = "far.csv";
    far.positions = transformed([](const Vector3& p) { return Vector3(p + Vector3(2e5, -3e5, 1e5)); });
    InspectionOptions options;
    options.probe_radius_mm = 1.0;
    base::Diagnostics remarks;
    const auto report = inspectPoints(far, patch, options, remarks);
    ASSERT_FALSE(report);
    EXPECT_EQ(
        toText(report.error()),
        "far.csv: error: the points fit neither as probe centres nor as surface points: the start is too far off; "
        "--start scan finds one; which they are can then be said with --points [inspect.kind]\n");
}

TEST_F(Misuse, DatumAndBestFitAreKeptApart) {
    const auto shifted = transformed([](const Vector3& p) { return Vector3(p + Vector3(0, 0, 0.05)); });
    InspectionOptions options;
    Outcome out = inspected(shifted, patch, options);
    ASSERT_TRUE(out.report.has_value());
    EXPECT_EQ(out.verdict(), Verdict::Accept);
    EXPECT_EQ(out.report->datum.decision.verdict, Verdict::Reject);
    EXPECT_GT(out.report->datum.statistics.mean_mm, 0.04);
    EXPECT_NEAR(out.report->best_fit.statistics.mean_mm, 0.0, 0.0001);
    options.judge_in_datum = true;
    EXPECT_EQ(inspected(shifted, patch, options).verdict(), Verdict::Reject);
}

}  // namespace
}  // namespace cusp::inspect::test
