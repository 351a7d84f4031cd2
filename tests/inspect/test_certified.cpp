// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Data with a known answer: made CMM files of the benchmark surface, and NIST's certified circles.
#include "analytic_shapes.hpp"

#include <cusp/inspect/alignment.hpp>
#include <cusp/inspect/circle_fit.hpp>
#include <cusp/inspect/deviation.hpp>
#include <cusp/inspect/point_reader.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace cusp::inspect::test {
namespace {

const std::filesystem::path folder = std::filesystem::path(CUSP_SHARED_DATA) / "cmm";

std::vector<double> numbersOf(const std::filesystem::path& path) {
    std::ifstream in(path);
    std::vector<double> out;
    for (double value = 0.0; in >> value;) out.push_back(value);
    return out;
}

/// The last column of every row.
std::vector<double> knownDeviations(const std::filesystem::path& path) {
    std::ifstream in(path);
    std::vector<double> out;
    for (std::string line; std::getline(in, line);)
        if (!line.starts_with('#') && !line.starts_with("section"))
            out.push_back(std::stod(line.substr(line.rfind(',') + 1)));
    return out;
}

class BenchmarkSections : public ::testing::TestWithParam<FitKind> {};

TEST_P(BenchmarkSections, KnownFrameAndDeviations) {
    const bool minimax = GetParam() == FitKind::Minimax;
    const auto path = folder / (minimax ? "eq14_sections_chebyshev.csv" : "eq14_sections_ls.csv");
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "the sections of the benchmark surface are not there: " << path;
    std::ifstream in(path);
    base::Diagnostics report;
    const auto points = readMeasuredPoints(in, path, {}, report);
    ASSERT_TRUE(points.has_value()) << toText(points.error());
    EXPECT_EQ(points->size(), 820U);
    EXPECT_EQ(points->kind, PointKind::Centre);
    EXPECT_EQ(points->probe_radius_mm, 1.0);
    EXPECT_EQ(points->section_labels, (std::vector<std::string>{"X=-5", "X=-30", "X=-60", "X=-90"}));
    const Patch patch = benchmarkPatch();
    const auto fit = align(points->positions, patch, {.fit = GetParam(), .offset_mm = 1.0});
    ASSERT_TRUE(fit.has_value()) << toText(fit.error());
    const auto known = knownDeviations(path);
    const auto found = deviationsOf(points->positions, fit->nominal_from_measured, patch, 1.0);
    ASSERT_EQ(known.size(), found.size());
    double worst_um = 0.0;
    for (std::size_t i = 0; i < known.size(); ++i)
        worst_um = std::max(worst_um, 1e3 * std::abs(found[i].deviation_mm - known[i]));
    EXPECT_LE(worst_um, 1e-6);
    if (minimax) {
        EXPECT_NEAR(1e3 * fit->minimax_mm, 8.0, 1e-6);
    }
    geometry::RigidTransform frame = geometry::RigidTransform::Identity();
    const Vector3 turn(0.004, -0.003, 0.005);
    frame.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix();
    frame.translation() = Vector3(0.2, -0.15, 0.1);
    const geometry::RigidTransform rest = fit->nominal_from_measured * frame;
    EXPECT_NEAR((rest.linear() - geometry::Matrix3::Identity()).norm(), 0.0, 1e-11);
    EXPECT_NEAR(rest.translation().norm(), 0.0, 1e-9);
    std::printf("largest error of a deviation: %.3g µm\n", worst_um);
}

INSTANTIATE_TEST_SUITE_P(Fits, BenchmarkSections, ::testing::Values(FitKind::LeastSquares, FitKind::Minimax),
                         [](const auto& test) { return test.param == FitKind::Minimax ? "Minimax" : "LeastSquares"; });

/// NIST's algorithm testing system: points (.ds, the first number is their count) and the certified fit (.fit: centre,
/// normal, diameter of the Gaussian circle).
TEST(NistCircles, CertifiedCentreAndRadius) {
    const auto circles = folder / "nist_ats";
    if (!std::filesystem::exists(circles)) GTEST_SKIP() << circles;
    int checked = 0;
    double worst_mm = 0.0;
    for (const auto& entry : std::filesystem::directory_iterator(circles)) {
        if (entry.path().extension() != ".ds") continue;
        const auto numbers = numbersOf(entry.path());
        auto certified_path = entry.path();
        const auto certified = numbersOf(certified_path.replace_extension(".fit"));
        ASSERT_EQ(certified.size(), 7U);
        std::vector<Vector3> points;
        for (std::size_t i = 1; i + 2 < numbers.size(); i += 3)
            points.emplace_back(numbers[i], numbers[i + 1], numbers[i + 2]);
        ASSERT_EQ(points.size(), static_cast<std::size_t>(numbers[0])) << entry.path();
        const auto fit = fitCircle(points);
        ASSERT_TRUE(fit.has_value()) << entry.path() << toText(fit.error());
        const double center_error = (fit->center - Vector3(certified[0], certified[1], certified[2])).norm();
        const double radius_error = std::abs(fit->radius_mm - 0.5 * certified[6]);
        worst_mm = std::max({worst_mm, center_error, radius_error});
        EXPECT_LE(center_error, 1e-6) << entry.path();
        EXPECT_LE(radius_error, 1e-6) << entry.path();
        ++checked;
    }
    EXPECT_EQ(checked, 12);
    std::printf("largest error of a centre or radius: %.3g mm\n", worst_mm);
}

}  // namespace
}  // namespace cusp::inspect::test
