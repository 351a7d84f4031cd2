// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The virtual CMM against parts whose form is known, and its files against the readers of inspect.
#include "sloping_plane.hpp"

#include <cusp/inspect/inspection.hpp>
#include <cusp/inspect/point_reader.hpp>
#include <cusp/loop/measurement_files.hpp>
#include <cusp/loop/virtual_cmm.hpp>

#include <cmath>
#include <gtest/gtest.h>
#include <sstream>

namespace cusp::loop {
namespace {

geometry::Cutter ball(double diameter_mm) {
    return {.diameter_mm = diameter_mm,
            .corner_radius_mm = diameter_mm / 2.0,
            .corner_f_mm = diameter_mm / 2.0,
            .cutting_height_mm = 50.0};
}

/// A ball that goes along Y, at every `step_mm` of X, and leaves `height_mm` on the plane where it touches.
simulation::CutterPath ballPasses(double slope, double diameter_mm, double step_mm, double height_mm) {
    simulation::CutterPath path{.moves = {}, .cutters = {ball(diameter_mm)}};
    const Vector3 normal = Vector3(-slope, 0.0, 1.0).normalized();
    for (double x = -20.0; x <= 60.0; x += step_mm) {
        const Vector3 centre = Vector3(x, 0.0, slope * x) + (diameter_mm / 2.0 + height_mm) * normal;
        const Vector3 tip = centre - Vector3(0.0, 0.0, diameter_mm / 2.0);
        path.moves.push_back({.from = {.tip_mm = tip - Vector3(0, 10, 0)}, .to = {.tip_mm = tip + Vector3(0, 50, 0)}});
    }
    return path;
}

CmmOptions exactProbe() { return {.noise_mm = 0.0, .form_mm = 0.0, .drift_mm = 0.0}; }

CmmPlan sections(const geometry::NominalShape& nominal, const char* text) {
    return sectionTargets(nominal, inspect::parseSectionPlan(text).value(), {}).value();
}

TEST(VirtualCmm, TouchesAPlaneWhereItIs) {
    const auto nominal = test_support::slopingPlane(0.5);
    const auto plan = sections(nominal, "X=10,20");
    ASSERT_EQ(plan.targets.size(), 2u * 77u);  // 40 mm at 0.5 mm, less 1 mm at the ends
    const auto run = measurePart(ballPasses(0.5, 10.0, 0.01, 0.02), plan, nominal, exactProbe()).value();
    const Vector3 normal = Vector3(-0.5, 0.0, 1.0).normalized();
    for (std::size_t i = 0; i < run.points.size(); ++i) {
        // 0.01 mm between passes leave scallops of s²/8R = 2.5 nm.
        EXPECT_NEAR(normal.dot(run.points.positions[i]), 1.0 + 0.02, 4e-6);
        EXPECT_NEAR(run.true_deviation_mm[i], 0.02, 4e-6);
    }
}

TEST(VirtualCmm, ComesAlongTheApproach) {
    const auto nominal = test_support::slopingPlane(0.5);
    const auto plan = sections(nominal, "X=10");
    CmmOptions options = exactProbe();
    options.approach = Vector3::UnitZ();
    const auto run = measurePart(ballPasses(0.5, 10.0, 0.01, 0.02), plan, nominal, options).value();
    const Vector3 normal = Vector3(-0.5, 0.0, 1.0).normalized();
    for (std::size_t i = 0; i < run.points.size(); ++i) {
        const Vector3 centre = run.targets[i].position + normal + Vector3(0, 0, 0.02 / normal.z());
        EXPECT_LT((run.points.positions[i] - centre).norm(), 1e-5);
    }
    options.approach = -Vector3::UnitZ();
    const auto behind = measurePart(ballPasses(0.5, 10.0, 0.01, 0.02), plan, nominal, options);
    ASSERT_FALSE(behind);
    EXPECT_EQ(behind.error().front().code, "measure.approach");
}

TEST(VirtualCmm, TheBallBridgesCuspsItDoesNotFitInto) {
    // Grooves of a ball of 0.5 mm radius, 0.2 mm apart: 10.1 µm high cusps. A ball of 1 mm radius hangs between two cusps
    // 0.1 mm to each side of it, (0.1)²/2 = 5.0 µm lower than they are.
    const auto nominal = test_support::slopingPlane(0.0);
    CmmPlan plan;
    plan.targets.push_back({.position = {20.0, 20.0, 0.0}, .normal = Vector3::UnitZ()});
    const auto path = ballPasses(0.0, 1.0, 0.2, 0.0);
    const auto run = measurePart(path, plan, nominal, exactProbe()).value();
    const double cusp = 0.5 - std::sqrt(0.25 - 0.01);
    const double exact = cusp + std::sqrt(1.0 - 0.01) - 1.0;
    EXPECT_NEAR(run.true_deviation_mm[0], 0.0, 2e-6);
    EXPECT_GT(run.points.positions[0].z() - 1.0, 0.001);
    EXPECT_LE(run.points.positions[0].z() - 1.0, exact + 1e-6);
}

TEST(VirtualCmm, NoiseFormAndDriftAreAsAskedFor) {
    const auto nominal = test_support::slopingPlane(0.0);
    SectionSteps fine;
    fine.step_mm = 0.05;
    const auto plan = sectionTargets(nominal, inspect::parseSectionPlan("X=5,10,15,20,25,30,35").value(), fine).value();
    const auto path = ballPasses(0.0, 10.0, 0.02, 0.0);
    CmmOptions noisy = exactProbe();
    noisy.noise_mm = 0.001;
    noisy.seed = 7;
    const auto run = measurePart(path, plan, nominal, noisy).value();
    double sum = 0.0;
    for (const auto& at : run.points.positions) sum += (at.z() - 1.0) * (at.z() - 1.0);
    const double n = static_cast<double>(run.points.size());
    EXPECT_GT(n, 5000.0);
    // χ² of n freedoms: four standard deviations are 4·√(2/n).
    EXPECT_NEAR(sum / n / 1e-6, 1.0, 4.0 * std::sqrt(2.0 / n));
    EXPECT_EQ(measurePart(path, plan, nominal, noisy).value().points.positions.back(), run.points.positions.back());
    CmmOptions drifting = exactProbe();
    drifting.drift_mm = 0.01;
    const auto drifted = measurePart(path, plan, nominal, drifting).value();
    const auto still = measurePart(path, plan, nominal, exactProbe()).value();
    EXPECT_LT((drifted.points.positions.front() - still.points.positions.front()).norm(), 1e-12);
    EXPECT_NEAR((drifted.points.positions.back() - still.points.positions.back()).norm(), 0.01, 1e-12);
}

TEST(VirtualCmm, WhatIsNotCutIsLeftOutAndSaid) {
    const auto nominal = test_support::slopingPlane(0.0);
    auto path = ballPasses(0.0, 10.0, 0.02, 0.0);
    for (auto& move : path.moves) move.to.tip_mm.y() = 15.0;
    const auto run = measurePart(path, sections(nominal, "X=20"), nominal, exactProbe()).value();
    EXPECT_GT(run.not_cut, 20u);
    EXPECT_EQ(run.not_cut + run.points.size(), 77u);
    for (auto& move : path.moves) move.from.tip_mm.z() = move.to.tip_mm.z() = 20.0;
    const auto nothing = measurePart(path, sections(nominal, "X=20"), nominal, exactProbe());
    ASSERT_FALSE(nothing);
    EXPECT_EQ(nothing.error().front().code, "measure.not-cut");
}

TEST(VirtualCmm, RefusesWhatMakesNoSense) {
    const auto nominal = test_support::slopingPlane(0.0);
    const auto outside = sectionTargets(nominal, inspect::parseSectionPlan("X=50").value(), {});
    ASSERT_FALSE(outside);
    EXPECT_EQ(outside.error().front().code, "measure.section");
    CmmOptions options = exactProbe();
    options.noise_mm = -1.0;
    options.probe_radius_mm = 0.0;
    const auto bad = measurePart(ballPasses(0.0, 10.0, 1.0, 0.0), sections(nominal, "X=20"), nominal, options);
    ASSERT_FALSE(bad);
    EXPECT_EQ(bad.error().errorCount(), 2u);
    EXPECT_EQ(measurementFormat("a.step").error().front().code, "measure.format");
}

class Files : public ::testing::TestWithParam<const char*> {};

TEST_P(Files, AreTakenByTheReaders) {
    const auto nominal = test_support::slopingPlane(0.5);
    CmmOptions options;
    options.probe_radius_mm = 1.5;
    options.seed = 3;
    const auto run =
        measurePart(ballPasses(0.5, 10.0, 0.1, 0.0), sections(nominal, "X=10,20"), nominal, options).value();
    std::istringstream in(measurementText(run.points, GetParam(), {"made by a test -- twice"}));
    base::Diagnostics remarks;
    const auto read = inspect::readMeasuredPoints(in, "file", {}, remarks).value();
    ASSERT_EQ(read.size(), run.points.size());
    EXPECT_EQ(read.format, std::string(GetParam()) == "csv" ? "table" : GetParam());
    EXPECT_EQ(read.kind, inspect::PointKind::Centre);
    for (std::size_t i = 0; i < read.size(); ++i) {
        EXPECT_LT((read.positions[i] - run.points.positions[i]).norm(), 1e-7);
        EXPECT_LT((read.directions[i] - run.points.directions[i]).norm(), 2e-7);
    }
    if (read.format != "dmis") {
        EXPECT_EQ(read.probe_radius_mm, 1.5);
    }
    if (read.format == "table") {
        EXPECT_EQ(read.section_labels, run.points.section_labels);
        EXPECT_EQ(read.sections, run.points.sections);
    }
}
INSTANTIATE_TEST_SUITE_P(VirtualCmm, Files, ::testing::Values("csv", "dmis", "qif"));

}  // namespace
}  // namespace cusp::loop
