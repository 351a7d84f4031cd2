// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Statistics, histogram, decision, sections and reference points against closed forms.
#include "made_measurement.hpp"

#include <cusp/inspect/circle_fit.hpp>
#include <cusp/inspect/conformance.hpp>
#include <cusp/inspect/reference_alignment.hpp>
#include <cusp/inspect/section.hpp>

#include <gtest/gtest.h>

#include <numbers>
#include <numeric>

namespace cusp::inspect::test {
namespace {

TEST(Deviation, IsSignedAlongTheOutwardNormal) {
    const Sphere sphere({1, 2, 3}, 10.0);
    const std::vector<Vector3> points{{1, 2, 3 + 10.5}, {1 + 9.75, 2, 3}};
    const auto d = deviationsOf(points, RigidTransform::Identity(), sphere, 0.0);
    EXPECT_NEAR(d[0].deviation_mm, 0.5, 1e-14);
    EXPECT_NEAR(d[1].deviation_mm, -0.25, 1e-14);
    // A probe centre 10.5 from the middle with a ball of radius 1 touched half a millimetre inside.
    EXPECT_NEAR(deviationsOf(points, RigidTransform::Identity(), sphere, 1.0)[0].deviation_mm, -0.5, 1e-14);
    EXPECT_NEAR((d[0].surfacePoint() - points[0]).norm(), 0.0, 1e-14);
}

TEST(Deviation, BeyondTheEdgeIsSaid) {
    const Patch patch = benchmarkPatch();
    const Vector3 edge = patch.at(0.0, 0.5);
    const auto d =
        deviationsOf(std::vector<Vector3>{edge + Vector3(0, 2.0, 0)}, RigidTransform::Identity(), patch, 0.0);
    EXPECT_GT(d[0].beyond_edge_mm, 1.0);
    EXPECT_LT(d[0].beyond_edge_mm, 2.0);
    EXPECT_NEAR(std::hypot(d[0].beyond_edge_mm, d[0].deviation_mm),
                (patch.closest(edge + Vector3(0, 2.0, 0)).position - edge - Vector3(0, 2.0, 0)).norm(), 1e-12);
}

TEST(Statistics, OfKnownNumbers) {
    const std::vector<double> d{-0.003, 0.001, 0.002, 0.004};
    const auto s = statisticsOf(d);
    EXPECT_EQ(s.count, 4U);
    EXPECT_EQ(s.min_mm, -0.003);
    EXPECT_EQ(s.max_mm, 0.004);
    EXPECT_EQ(s.min_point, 0U);
    EXPECT_EQ(s.max_point, 3U);
    EXPECT_NEAR(s.mean_mm, 0.001, 1e-18);
    EXPECT_NEAR(s.rms_mm, std::sqrt(30e-6 / 4), 1e-15);
    EXPECT_NEAR(s.standard_deviation_mm, std::sqrt((16 + 0 + 1 + 9) * 1e-6 / 3), 1e-15);
    EXPECT_NEAR(s.median_mm, 0.0015, 1e-18);
    EXPECT_NEAR(s.mad_mm, 0.0015, 1e-18);
    EXPECT_EQ(s.profile_mm, 0.008);
    EXPECT_NEAR(outlierDistance(s, {}), 5 * 1.4826 * 0.0015, 1e-12);
    EXPECT_EQ(outlierDistance(statisticsOf(std::vector<double>{1e-9, 1e-9}), {}), 1e-4);
}

TEST(Statistics, HistogramHoldsEveryDeviation) {
    base::Random random(3);
    for (const double scale : {1e-7, 1e-3, 0.7, 1234.0}) {
        std::vector<double> d(1000);
        for (double& value : d) value = random.normal(0.0, scale);
        const Histogram h = histogramOf(d);
        EXPECT_EQ(std::accumulate(h.counts.begin(), h.counts.end(), std::size_t{0}), 1000U);
        EXPECT_GE(h.counts.size(), 15U);
        EXPECT_LE(h.counts.size(), 42U);
        EXPECT_GT(h.counts.front(), 0U);
        EXPECT_GT(h.counts.back(), 0U);
        EXPECT_LE(h.low_mm, *std::min_element(d.begin(), d.end()));
    }
    EXPECT_EQ(histogramOf(std::vector<double>{0.001, 0.001}).counts, (std::vector<std::size_t>{2}));
    EXPECT_TRUE(histogramOf({}).counts.empty());
}

/// With u far below the tolerance the guard band of 95 % is 1.6449 u.
TEST(Decision, ProbabilityRule) {
    const ToleranceLimits limits{-0.01, 0.01};
    const Uncertainty u{0.001, true, "stated"};
    const auto verdict = [&](double d) {
        return decide(std::vector<double>{0.0, d}, limits, u, DecisionRule::Probability);
    };
    EXPECT_EQ(verdict(0.01 - 1.64490 * 0.001).verdict, Verdict::Accept);
    EXPECT_EQ(verdict(0.01 - 1.64480 * 0.001).verdict, Verdict::Undecided);
    EXPECT_EQ(verdict(0.01 + 1.64480 * 0.001).verdict, Verdict::Undecided);
    EXPECT_EQ(verdict(0.01 + 1.64490 * 0.001).verdict, Verdict::Reject);
    EXPECT_EQ(verdict(-0.01 - 1.64490 * 0.001).verdict, Verdict::Reject);
    const Decision at_the_limit = verdict(0.01);
    EXPECT_NEAR(at_the_limit.least_conforming_probability, 0.5, 1e-12);
    EXPECT_EQ(at_the_limit.worst_point, 1U);
    EXPECT_EQ(at_the_limit.reason, "of 2 points 1 lie too close to a limit for the uncertainty of 0.001 mm");
    // An uncertainty as large as the zone: nothing can be accepted, though nothing is outside.
    EXPECT_EQ(decide(std::vector<double>{0.0}, limits, {0.01, true, ""}, DecisionRule::Probability).verdict,
              Verdict::Undecided);
}

TEST(Decision, GuardBandRuleAndNoUncertainty) {
    const ToleranceLimits limits{-0.01, 0.02};
    const Uncertainty u{0.001, true, "stated"};
    const auto verdict = [&](double d) {
        return decide(std::vector<double>{d}, limits, u, DecisionRule::GuardBand).verdict;
    };
    EXPECT_EQ(verdict(0.01799), Verdict::Accept);
    EXPECT_EQ(verdict(0.01801), Verdict::Undecided);
    EXPECT_EQ(verdict(0.02199), Verdict::Undecided);
    EXPECT_EQ(verdict(0.02201), Verdict::Reject);
    EXPECT_EQ(verdict(-0.01201), Verdict::Reject);
    for (const DecisionRule rule : {DecisionRule::GuardBand, DecisionRule::Probability}) {
        EXPECT_EQ(decide(std::vector<double>{0.02}, limits, {}, rule).verdict, Verdict::Accept);
        const Decision out = decide(std::vector<double>{0.0, 0.0201, 0.03}, limits, {}, rule);
        EXPECT_EQ(out.verdict, Verdict::Reject);
        EXPECT_EQ(out.points_outside, 2U);
        EXPECT_EQ(out.worst_point, 2U);
        EXPECT_EQ(out.reason, "2 of 3 points do not conform");
    }
}

TEST(Decision, UncertaintyOfNeighboursIsTheirNoise) {
    base::Random random(5);
    std::vector<Vector3> positions;
    std::vector<double> deviations;
    for (int i = 0; i < 20000; ++i) {
        positions.emplace_back(random.uniform(0, 100), random.uniform(0, 100), 0.0);
        // A form error of 20 µm, ten times the noise, but smooth.
        deviations.push_back(0.02 * std::sin(positions.back().x() / 15.0) + random.normal(0.0, 0.002));
    }
    const Uncertainty u = uncertaintyFromNeighbours(positions, deviations);
    EXPECT_NEAR(u.standard_mm, 0.002, 0.0001);
    EXPECT_FALSE(u.stated);
}

TEST(Sections, TextOfAPlan) {
    const auto plan = parseSectionPlan("X=-5,-30,-60.5");
    ASSERT_TRUE(plan.has_value());
    EXPECT_EQ(plan->axis, 0);
    EXPECT_EQ(plan->positions_mm, (std::vector<double>{-5, -30, -60.5}));
    EXPECT_EQ(parseSectionPlan("z=1")->axis, 2);
    for (const std::string text : {"", "X", "X=", "W=1", "X=1,", "X=1;2", "X=a", "=1"})
        EXPECT_EQ(toText(parseSectionPlan(text).error()), "error: '" + text +
                                                              "' names no sections; they are written like "
                                                              "X=-5,-30,-60,-90 [sections.text]\n");
}

/// A band cut from a sphere: the section X = 6 of radius 10 is a circle of radius 8.
TEST(Sections, ArcLengthOfACircle) {
    const Sphere sphere(Vector3::Zero(), 10.0);
    base::Random random(7);
    MeasuredPoints points;
    std::vector<double> angles;
    for (int i = 0; i < 400; ++i) {
        const double x = 6.0 + random.uniform(-0.25, 0.25);
        const double angle = random.uniform(-1.4, 1.4);
        const double r = std::sqrt(100.0 - x * x);
        angles.push_back(angle);
        points.positions.emplace_back(x, r * std::sin(angle), r * std::cos(angle));
    }
    const auto d = deviationsOf(points.positions, RigidTransform::Identity(), sphere, 0.0);
    const auto sections = cutSections({.axis = 0, .positions_mm = {6.0}, .width_mm = 0.5}, points, d, sphere, 0.1);
    ASSERT_EQ(sections.size(), 1U);
    ASSERT_EQ(sections[0].points.size(), 400U);
    EXPECT_EQ(sections[0].label, "X=6");
    const double first = angles[sections[0].points.front()];
    for (std::size_t k = 0; k < 400; ++k)
        EXPECT_NEAR(sections[0].arc_length_mm[k], 8.0 * std::abs(angles[sections[0].points[k]] - first), 1e-9);
}

/// All around: ordered by the angle.
TEST(Sections, ClosedSection) {
    const Sphere sphere(Vector3::Zero(), 10.0);
    MeasuredPoints points;
    for (int i = 0; i < 360; ++i) {
        const double a = (i * 7 % 360) * std::numbers::pi / 180.0;
        points.positions.emplace_back(10.0 * std::cos(a), 10.0 * std::sin(a), 0.0);
    }
    const auto d = deviationsOf(points.positions, RigidTransform::Identity(), sphere, 0.0);
    const auto sections = cutSections({.axis = 2, .positions_mm = {0.0}, .width_mm = 1.0}, points, d, sphere, 0.1);
    EXPECT_NEAR(sections[0].arc_length_mm.back(), 20.0 * std::numbers::pi * 359 / 360, 1e-9);
}

/// A line of the benchmark surface at X = −30 by 0.5 mm: arc length against a fine polygon of the same curve.
TEST(Sections, ArcLengthOnTheBenchmarkSurface) {
    const Patch patch = benchmarkPatch();
    const double v = 0.695;  // wherever X = x(v) is
    const double x = patch.at(0.0, v).x();
    MeasuredPoints points;
    std::vector<double> lengths;
    double length = 0.0;
    constexpr int steps = 200000;
    Vector3 last = patch.at(0.01, v);
    for (int i = 0; i <= steps; ++i) {
        const Vector3 p = patch.at(0.01 + 0.98 * i / steps, v);
        length += (p - last).norm();
        last = p;
        if (i % 1000 != 0) continue;
        points.positions.push_back(p);
        points.sections.push_back(0);
        lengths.push_back(length);
    }
    points.section_labels = {sectionLabel(0, x)};
    const auto d = deviationsOf(points.positions, RigidTransform::Identity(), patch, 0.0);
    for (const auto& sections : {cutSections({.axis = 0, .positions_mm = {x}, .width_mm = {}}, points, d, patch, 0.1),
                                 measuredSections(points, d, patch, 0.1)}) {
        ASSERT_EQ(sections.size(), 1U);
        ASSERT_EQ(sections[0].arc_length_mm.size(), lengths.size());
        EXPECT_EQ(sections[0].points.front(), 0U);  // as measured
        for (std::size_t k = 0; k < lengths.size(); ++k) EXPECT_NEAR(sections[0].arc_length_mm[k], lengths[k], 1e-6);
    }
}

TEST(References, SixDirectionsGiveThePoseExactly) {
    base::Random random(41);
    for (int k = 0; k < 20; ++k) {
        const auto pose = randomPose(random, random.uniform(0.0, 3.0), 500.0);
        const std::vector<Vector3> nominal{{0, 0, 0}, {100, 0, 0}, {0, 80, 0}, {10, 0, 5}, {90, 0, 5}, {0, 40, 5}};
        const std::vector<Vector3> directions{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}};
        std::vector<ReferencePoint> references;
        for (std::size_t i = 0; i < 6; ++i)
            // Along the faces a measured point may be off: only its direction counts.
            references.push_back({pose.inverse() * Vector3(nominal[i] + directions[i].unitOrthogonal() * 0.3),
                                  nominal[i], directions[i]});
        const auto out = alignToReferences(references);
        ASSERT_TRUE(out.has_value()) << toText(out.error());
        for (const double residual : out->residuals_mm) EXPECT_NEAR(residual, 0.0, 1e-10);
        EXPECT_NEAR((out->nominal_from_measured.matrix() - pose.matrix()).norm(), 0.0, 1e-9);
        references.resize(5);
        EXPECT_EQ(toText(alignToReferences(references).error()),
                  "error: 5 reference directions cannot fix six freedoms; six are needed [reference.too-few]\n");
        references.push_back({pose.inverse() * Vector3(50, 50, 0), {50, 50, 0}, {0, 0, 1}});
        EXPECT_EQ(toText(alignToReferences(references).error()),
                  "error: the reference directions leave tx free [reference.not-determined]\n");
    }
}

TEST(References, Table) {
    const std::string header = "measured_x,measured_y,measured_z,nominal_x,nominal_y,nominal_z,i,j,k\n";
    const auto out = readReferences("# RPS\n" + header + "1,2,3,4,5,6,0,0,1\n", "rps.csv");
    ASSERT_TRUE(out.has_value());
    EXPECT_EQ((*out)[0].nominal, Vector3(4, 5, 6));
    EXPECT_EQ(
        toText(readReferences(header + "1,2,3,4,5,6,0,0\n1,b,3,4,5,6,0,0,1\n1,2,3,4,5,6,0,0,7\n", "rps.csv").error()),
        "rps.csv:2: error: 8 columns where there must be 9 [reference.columns]\n"
        "rps.csv:3: error: measured_y: 'b' is no number [reference.number]\n"
        "rps.csv:4: error: i, j, k have the length 7, not 1 [reference.direction]\n");
    EXPECT_EQ(
        toText(readReferences("x,y\n", "rps.csv").error()),
        "rps.csv:1: error: the header must be measured_x,measured_y,measured_z,nominal_x,nominal_y,nominal_z,i,j,k "
        "[reference.header]\n");
}

TEST(Circle, ShortArcsInAnyPlane) {
    base::Random random(43);
    for (int k = 0; k < 30; ++k) {
        const auto pose = randomPose(random, random.uniform(0.0, 3.0), 800.0);
        const double radius = random.uniform(1.0, 100.0);
        const double span = random.uniform(0.5, 6.2);
        std::vector<Vector3> points;
        for (int i = 0; i < 40; ++i) {
            const double a = span * i / 39;
            points.emplace_back(pose * Vector3(radius * std::cos(a), radius * std::sin(a), 0.0));
        }
        const auto fit = fitCircle(points);
        ASSERT_TRUE(fit.has_value());
        EXPECT_NEAR(fit->radius_mm, radius, 1e-9);
        EXPECT_NEAR((fit->center - pose.translation()).norm(), 0.0, 1e-9);
        EXPECT_NEAR(std::abs(fit->normal.dot(pose.linear().col(2))), 1.0, 1e-10);
    }
    EXPECT_EQ(toText(fitCircle(std::vector<Vector3>{{0, 0, 0}, {1, 1, 1}}).error()),
              "error: a circle needs three points [circle.too-few-points]\n");
    EXPECT_EQ(toText(fitCircle(std::vector<Vector3>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {5, 5, 5}}).error()),
              "error: the points lie on a line: no circle goes through them [circle.not-determined]\n");
}

}  // namespace
}  // namespace cusp::inspect::test
