// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Fits whose answer is known: made measurements, statistics of noise, locked freedoms, fits that are not determined.
#include "made_measurement.hpp"

#include <gtest/gtest.h>

#include <oneapi/tbb/global_control.h>

namespace cusp::inspect::test {
namespace {

constexpr double nanometre = 1e-6;

double deviationError(const MadeMeasurement& made, const Patch& patch, const AlignmentSummary& fit, double radius_mm) {
    double worst = 0.0;
    for (std::size_t i = 0; i < made.points.size(); ++i) {
        const auto foot = patch.closest(fit.nominal_from_measured * made.points[i]);
        worst = std::max(worst, std::abs(foot.distance_mm - radius_mm - made.deviations[i]));
    }
    return worst;
}

TEST(Alignment, LeastSquaresRecoversMadeDeviations) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        SCOPED_TRACE(seed);
        base::Random random(seed);
        const Patch patch = seed == 1 ? benchmarkPatch() : randomPatch(random);
        const double radius_mm = seed % 3 == 0 ? 0.0 : random.uniform(0.25, 4.0);
        const auto pose = randomPose(random, 10.0 * 0.0174533, 5.0);
        const auto made = leastSquaresMeasurement(random, patch, 400, radius_mm, 0.004, pose);
        const auto fit = align(made.points, patch, {.offset_mm = radius_mm});
        ASSERT_TRUE(fit.has_value()) << toText(fit.error());
        EXPECT_EQ(fit->termination, Termination::Converged);
        EXPECT_LE(deviationError(made, patch, *fit, radius_mm), 1e-3 * nanometre);
        EXPECT_EQ(fit->points, 400U);
    }
}

TEST(Alignment, MinimaxRecoversMadeDeviations) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        SCOPED_TRACE(seed);
        base::Random random(100 + seed);
        const Patch patch = seed == 1 ? benchmarkPatch() : randomPatch(random);
        const double radius_mm = random.uniform(0.25, 4.0);
        const auto pose = randomPose(random, 0.02, 1.0);
        const auto made = minimaxMeasurement(random, patch, 1500, radius_mm, 0.008, pose);
        const auto fit = align(made.points, patch, {.fit = FitKind::Minimax, .offset_mm = radius_mm});
        ASSERT_TRUE(fit.has_value()) << toText(fit.error());
        EXPECT_EQ(fit->termination, Termination::Converged);
        EXPECT_NEAR(fit->minimax_mm, 0.008, 1e-3 * nanometre);
    }
}

/// No pose near the minimax fit has a smaller largest deviation.
TEST(Alignment, MinimaxIsAMinimum) {
    base::Random random(7);
    const Patch patch = benchmarkPatch();
    const auto made = leastSquaresMeasurement(random, patch, 300, 0.0, 0.004, geometry::RigidTransform::Identity());
    const auto squares = align(made.points, patch, {});
    const auto fit = align(made.points, patch, {.fit = FitKind::Minimax});
    ASSERT_TRUE(squares && fit);
    EXPECT_LT(fit->minimax_mm, squares->minimax_mm);
    for (int k = 0; k < 200; ++k) {
        const auto nudge = randomPose(random, 1e-6, 1e-5) * fit->nominal_from_measured;
        double largest = 0.0;
        for (const Vector3& p : made.points)
            largest = std::max(largest, std::abs(patch.closest(nudge * p).distance_mm));
        EXPECT_GE(largest, fit->minimax_mm - 1e-12);
    }
}

/// The error of the fit along the normals, N·rms²/σ², is χ² with six degrees of freedom: its mean over 200 seeds lies
/// within three standard errors 3·√(12/200) of 6 for a fit that uses all the points know, and above for any other.
TEST(Alignment, IsStatisticallyEfficient) {
    constexpr int seeds = 200;
    constexpr double sigma_mm = 0.001;
    const Patch patch = benchmarkPatch();
    double mean = 0.0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        base::Random random(1000 + seed);
        const Places places = randomPlaces(random, patch, 250);
        Eigen::VectorXd noise(250);
        for (double& value : noise) value = random.normal(0.0, sigma_mm);
        const auto pose = randomPose(random, 10.0 * 0.0174533, 5.0);
        const auto made = measured(places, noise, 0.0, pose);
        const auto fit = align(made.points, patch, {});
        ASSERT_TRUE(fit.has_value());
        const auto error = fit->nominal_from_measured * pose.inverse();
        for (std::size_t i = 0; i < places.foot.size(); ++i) {
            const double off_mm = (error * places.foot[i] - places.foot[i]).dot(places.normal[i]);
            mean += off_mm * off_mm / (sigma_mm * sigma_mm) / seeds;
        }
    }
    std::printf("mean of N·rms²/σ² over %d seeds: %.3f\n", seeds, mean);
    EXPECT_NEAR(mean, 6.0, 3.0 * std::sqrt(12.0 / seeds));
}

/// The covariance says how far the pose is off: squared errors over variances are χ² with six degrees of freedom.
TEST(Alignment, CovarianceIsThatOfThePose) {
    constexpr int seeds = 150;
    const Patch patch = benchmarkPatch();
    double mean = 0.0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        base::Random random(2000 + seed);
        const Places places = randomPlaces(random, patch, 300);
        Eigen::VectorXd noise(300);
        for (double& value : noise) value = random.normal(0.0, 0.002);
        const auto made = measured(places, noise, 1.0, geometry::RigidTransform::Identity());
        const auto fit = align(made.points, patch, {.offset_mm = 1.0});
        ASSERT_TRUE(fit.has_value());
        Eigen::Matrix<double, 6, 1> error;
        error.head<3>() = fit->nominal_from_measured * fit->pivot_mm - fit->pivot_mm;
        error.tail<3>() = fit->rotation_vector_rad;
        mean += error.dot(fit->covariance.inverse() * error) / seeds;
    }
    // F-distributed about 6·294/292; three standard errors.
    EXPECT_NEAR(mean, 6.04, 3.0 * std::sqrt(12.5 / seeds));
}

TEST(Alignment, LockedFreedomsStay) {
    base::Random random(5);
    const Patch patch = benchmarkPatch();
    const auto made = leastSquaresMeasurement(random, patch, 300, 0.0, 0.003, randomPose(random, 0.01, 0.3));
    for (unsigned mask = 0; mask < 64; ++mask) {
        AlignmentOptions options;
        for (unsigned i = 0; i < 6; ++i) options.locked[i] = ((mask >> i) & 1U) != 0;
        const auto fit = align(made.points, patch, options);
        ASSERT_TRUE(fit.has_value()) << mask << toText(fit.error());
        for (unsigned i = 0; i < 3; ++i) {
            if (options.locked[i + 3]) {
                EXPECT_NEAR(fit->rotation_vector_rad[i], 0.0, 1e-14) << mask;
            }
            if (options.locked[i]) {
                EXPECT_NEAR(fit->translation_mm[i], 0.0, 1e-12) << mask;
                EXPECT_EQ(fit->covariance(i, i), 0.0) << mask;
            }
        }
        EXPECT_EQ(fit->termination, mask == 63 ? Termination::NotAsked : Termination::Converged);
    }
}

TEST(Alignment, SameBitsAtAnyNumberOfThreads) {
    base::Random random(9);
    const Patch patch = benchmarkPatch();
    const auto made = leastSquaresMeasurement(random, patch, 20000, 1.0, 0.003, randomPose(random, 0.1, 3.0));
    std::vector<geometry::RigidTransform> poses;
    for (const std::size_t threads : {1U, 2U, 4U}) {
        const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
        const auto fit = align(made.points, patch, {.fit = FitKind::Minimax, .offset_mm = 1.0});
        ASSERT_TRUE(fit.has_value());
        poses.push_back(fit->nominal_from_measured);
    }
    EXPECT_EQ(poses[0].matrix(), poses[1].matrix());
    EXPECT_EQ(poses[0].matrix(), poses[2].matrix());
}

TEST(Alignment, FarOffTheOrigin) {
    base::Random random(11);
    const Vector3 far(450000.0, 5400000.0, 120.0);
    const Patch patch = benchmarkPatch(far);
    auto places = randomPlaces(random, patch, 500);
    // Rows about the patch, not about an origin 5 km away.
    for (Eigen::Index i = 0; i < 500; ++i)
        places.J.row(i).tail<3>() = (places.foot[static_cast<std::size_t>(i)] - far)
                                        .cross(places.normal[static_cast<std::size_t>(i)])
                                        .transpose();
    Eigen::VectorXd d(500);
    for (double& value : d) value = random.normal(0.0, 0.004);
    d -= places.J * places.J.colPivHouseholderQr().solve(d);
    geometry::RigidTransform pose =
        Eigen::Translation3d(far) * randomPose(random, 0.05, 2.0) * Eigen::Translation3d(-far);
    const auto made = measured(places, d, 0.0, pose);
    const auto fit = align(made.points, patch, {});
    ASSERT_TRUE(fit.has_value()) << toText(fit.error());
    // A double there has steps of 1e-9 mm.
    EXPECT_LE(deviationError(made, patch, *fit, 0.0), 1e-8);
    EXPECT_LT(fit->condition, 1e5);
}

TEST(Alignment, RobustLossesLeaveOutliersAside) {
    for (const Loss loss : {Loss::Huber, Loss::Cauchy, Loss::Tukey}) {
        base::Random random(13);
        const Patch patch = benchmarkPatch();
        auto made = leastSquaresMeasurement(random, patch, 600, 0.0, 0.002, randomPose(random, 0.01, 0.5));
        for (std::size_t i = 0; i < 60; ++i) made.points[i] += Vector3(0, 0, 0.2);
        const auto plain = align(made.points, patch, {});
        const auto fit = align(made.points, patch, {.loss = loss});
        ASSERT_TRUE(plain && fit);
        const auto errorOf = [&](const AlignmentSummary& f) {
            double sum = 0.0;
            for (std::size_t i = 60; i < 600; ++i)
                sum += std::pow(
                    patch.closest(f.nominal_from_measured * made.points[i]).distance_mm - made.deviations[i], 2);
            return std::sqrt(sum / 540);
        };
        EXPECT_GT(errorOf(*plain), 0.01);
        EXPECT_LT(errorOf(*fit), loss == Loss::Huber ? 0.002 : 0.0005) << int(loss);
    }
}

TEST(Alignment, WeightsCountAsRepeats) {
    base::Random random(17);
    const Patch patch = benchmarkPatch();
    const auto made = leastSquaresMeasurement(random, patch, 100, 0.0, 0.003, randomPose(random, 0.01, 0.5));
    std::vector<double> weights(100, 1.0);
    auto repeated = made.points;
    for (std::size_t i = 0; i < 30; ++i) {
        weights[i] = 3.0;
        repeated.insert(repeated.end(), 2, made.points[i]);
    }
    AlignmentOptions options;
    options.weights = weights;
    const auto weighted = align(made.points, patch, options);
    const auto plain = align(repeated, patch, {});
    ASSERT_TRUE(weighted && plain);
    EXPECT_NEAR((weighted->nominal_from_measured.matrix() - plain->nominal_from_measured.matrix()).norm(), 0.0, 1e-8);
    options.weights[3] = -1.0;
    EXPECT_EQ(toText(align(made.points, patch, options).error()),
              "error: weights are one number per point, none negative [align.weights]\n");
}

TEST(Alignment, PointsBeyondTheEdgeDoNotPull) {
    base::Random random(19);
    const Patch patch = benchmarkPatch();
    auto made = leastSquaresMeasurement(random, patch, 400, 0.0, 0.002, randomPose(random, 0.001, 0.1));
    const std::size_t inside = made.points.size();
    // Along the edge u = 0, half a millimetre to five outside.
    for (int i = 0; i < 60; ++i)
        made.points.emplace_back(made.nominal_from_measured.inverse() *
                                 Vector3(patch.at(0.0, i / 60.0) + Vector3(0.0, random.uniform(0.5, 5.0), 0.0)));
    const auto fit = align(made.points, patch, {});
    ASSERT_TRUE(fit.has_value()) << toText(fit.error());
    EXPECT_EQ(fit->beyond_edge, 60U);
    made.points.resize(inside);
    EXPECT_LE(deviationError(made, patch, *fit, 0.0), 1e-3 * nanometre);
}

std::string errorText(std::span<const Vector3> points, const geometry::NominalShape& nominal,
                      const AlignmentOptions& options = {}) {
    const auto fit = align(points, nominal, options);
    return fit ? "" : toText(fit.error());
}

TEST(Alignment, SaysWhatIsNotDetermined) {
    base::Random random(23);
    std::vector<Vector3> flat;
    std::vector<Vector3> round;
    for (int i = 0; i < 50; ++i) {
        flat.emplace_back(random.uniform(-40, 40), random.uniform(-40, 40), random.normal(0.0, 0.001));
        round.push_back(Vector3(3, 4, 5) + randomVector(random, 20.0 + random.normal(0.0, 0.001)));
    }
    EXPECT_EQ(
        errorText(flat, Plane()),
        "error: the fit is not determined: the points leave 3 freedoms free (tx, ty, rz); measure where the surface "
        "faces other ways, or lock them: --lock tx,ty,rz [align.not-determined]\n");
    AlignmentOptions locked;
    locked.locked = {true, true, false, false, false, true};
    EXPECT_EQ(errorText(flat, Plane(), locked), "");
    EXPECT_EQ(
        errorText(round, Sphere({3, 4, 5}, 20.0)),
        "error: the fit is not determined: the points leave 3 freedoms free (rx, ry, rz); measure where the surface "
        "faces other ways, or lock them: --lock rx,ry,rz [align.not-determined]\n");
    EXPECT_EQ(errorText(std::span(flat).first(5), Plane()),
              "error: 5 points on the nominal cannot determine 6 free freedoms [align.too-few-points]\n");
    EXPECT_EQ(errorText({}, Plane()), "error: there are no points [align.too-few-points]\n");
    std::vector<Vector3> elsewhere;
    for (int i = 0; i < 20; ++i) elsewhere.emplace_back(5000.0 + i, 5000.0, 0.0);
    AlignmentOptions none;
    none.locked = {true, true, true, true, true, false};
    EXPECT_EQ(
        errorText(elsewhere, benchmarkPatch(), none),
        "error: all 20 points lie beyond the edges of the nominal: wrong nominal, wrong unit, or a start too far off "
        "[align.no-overlap]\n");
}

}  // namespace
}  // namespace cusp::inspect::test
