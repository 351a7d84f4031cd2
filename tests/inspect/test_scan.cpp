// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Scans that may lie anywhere: found, and then fitted as from a start; a missing or broken cusp-scan is said.
#include "made_measurement.hpp"

#include <cusp/inspect/scan/scan_registration.hpp>

#include <gtest/gtest.h>

namespace cusp::inspect::test {
namespace {

TEST(Scan, AnyPoseEndsInTheSameFit) {
    const Patch patch = benchmarkPatch();
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        SCOPED_TRACE(seed);
        base::Random random(seed);
        const auto pose = randomPose(random, random.uniform(0.0, 3.1), 800.0);
        auto made = leastSquaresMeasurement(random, patch, 3000, 0.0, 0.002, pose);
        const auto start = findScanStart(made.points, patch, {.program = CUSP_SCAN_PROGRAM});
        ASSERT_TRUE(start.has_value()) << toText(start.error());
        const auto fit = align(made.points, patch, {.start = start->nominal_from_measured});
        ASSERT_TRUE(fit.has_value()) << toText(fit.error());
        for (std::size_t i = 0; i < made.points.size(); i += 10)
            EXPECT_NEAR(patch.closest(fit->nominal_from_measured * made.points[i]).distance_mm, made.deviations[i],
                        1e-8);
    }
}

TEST(Scan, StrayPointsAreCounted) {
    const Patch patch = benchmarkPatch();
    base::Random random(9);
    auto made = leastSquaresMeasurement(random, patch, 2000, 0.0, 0.002, randomPose(random, 2.0, 300.0));
    for (int i = 0; i < 40; ++i)
        made.points.emplace_back(made.points[static_cast<std::size_t>(i)] +
                                 randomVector(random, random.uniform(30.0, 60.0)));
    const auto start = findScanStart(made.points, patch, {.program = CUSP_SCAN_PROGRAM});
    ASSERT_TRUE(start.has_value()) << toText(start.error());
    EXPECT_GE(start->outliers, 30U);
    EXPECT_LE(start->outliers, 150U);
    const auto fit = align(made.points, patch, {.loss = Loss::Tukey, .start = start->nominal_from_measured});
    ASSERT_TRUE(fit.has_value()) << toText(fit.error());
    EXPECT_LT((fit->nominal_from_measured * made.points[100] - made.nominal_from_measured * made.points[100]).norm(),
              0.05);
}

TEST(Scan, AMissingOrBrokenProgramIsSaid) {
    const Patch patch = benchmarkPatch();
    const std::vector<Vector3> points{patch.at(0.1, 0.2), patch.at(0.4, 0.4), patch.at(0.9, 0.1)};
    EXPECT_EQ(findScanStart(points, patch, {.program = "/nowhere/cusp-scan"}).error().front().code, "scan.program");
    EXPECT_EQ(toText(findScanStart(points, patch, {.program = "/bin/false"}).error()),
              "error: the registration of the scan failed: exit code 1 [scan.program]\n");
    EXPECT_EQ(toText(findScanStart(points, patch, {.program = "/bin/true"}).error()),
              "error: cusp-scan gave an answer that is none; is it of another version? [scan.answer]\n");
    EXPECT_EQ(findScanStart({}, patch, {.program = CUSP_SCAN_PROGRAM}).error().front().code, "align.too-few-points");
}

}  // namespace
}  // namespace cusp::inspect::test
