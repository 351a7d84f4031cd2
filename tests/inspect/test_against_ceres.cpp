// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Ceres as witness: another solver, derivatives by differences, the same minimum.
#include "made_measurement.hpp"

#include <ceres/ceres.h>
#include <gtest/gtest.h>

namespace cusp::inspect::test {
namespace {

/// The pose of six numbers: rotation vector and translation about the nominal's origin.
geometry::RigidTransform poseOf(const double* p) {
    geometry::RigidTransform out = geometry::RigidTransform::Identity();
    const Vector3 r(p[3], p[4], p[5]);
    if (r.norm() > 0) out.linear() = Eigen::AngleAxisd(r.norm(), r.normalized()).toRotationMatrix();
    out.translation() = Vector3(p[0], p[1], p[2]);
    return out;
}

struct Distance {
    const Patch* patch;
    Vector3 point;
    double offset_mm;
    bool operator()(const double* p, double* residual) const {
        *residual = patch->closest(poseOf(p) * point).distance_mm - offset_mm;
        return true;
    }
};

double costOf(const Patch& patch, const MadeMeasurement& made, double radius_mm, const geometry::RigidTransform& pose) {
    double sum = 0.0;
    for (const Vector3& p : made.points) sum += std::pow(patch.closest(pose * p).distance_mm - radius_mm, 2);
    return sum;
}

std::array<double, 6> ceresFit(const Patch& patch, const MadeMeasurement& made, double radius_mm,
                               const std::array<bool, 6>& locked, Loss loss, double scale_mm) {
    std::array<double, 6> p{};
    ceres::Problem problem;
    for (const Vector3& point : made.points) {
        ceres::LossFunction* function = nullptr;
        if (loss == Loss::Huber) function = new ceres::HuberLoss(scale_mm);
        if (loss == Loss::Cauchy) function = new ceres::CauchyLoss(scale_mm);
        if (loss == Loss::Tukey) function = new ceres::TukeyLoss(scale_mm);
        problem.AddResidualBlock(
            new ceres::NumericDiffCostFunction<Distance, ceres::CENTRAL, 1, 6>(new Distance{&patch, point, radius_mm}),
            function, p.data());
    }
    std::vector<int> constant;
    for (int i = 0; i < 6; ++i)
        if (locked.at(static_cast<std::size_t>(i))) constant.push_back(i);
    if (constant.size() == 6) return p;
    if (!constant.empty()) problem.SetManifold(p.data(), new ceres::SubsetManifold(6, constant));
    ceres::Solver::Options options;
    options.function_tolerance = 1e-16;
    options.gradient_tolerance = 1e-16;
    options.parameter_tolerance = 1e-14;
    options.max_num_iterations = 200;
    options.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    return p;
}

TEST(AgainstCeres, AnyFreedomsLocked) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        SCOPED_TRACE(seed);
        base::Random random(seed);
        const Patch patch = seed % 2 == 0 ? benchmarkPatch() : randomPatch(random);
        const double radius_mm = random.uniform(0.0, 2.0);
        const auto made = leastSquaresMeasurement(random, patch, 80, radius_mm, 0.01, randomPose(random, 0.003, 0.05));
        AlignmentOptions options;
        options.offset_mm = radius_mm;
        for (bool& lock : options.locked) lock = random.chance(0.4);
        const auto fit = align(made.points, patch, options);
        ASSERT_TRUE(fit.has_value()) << toText(fit.error());
        const auto p = ceresFit(patch, made, radius_mm, options.locked, Loss::Squared, 1.0);
        const double ours = costOf(patch, made, radius_mm, fit->nominal_from_measured);
        const double theirs = costOf(patch, made, radius_mm, poseOf(p.data()));
        EXPECT_LE(ours, theirs * (1.0 + 1e-9));
        EXPECT_NEAR(ours / theirs, 1.0, 1e-5);
        for (int i = 0; i < 3; ++i) {
            EXPECT_NEAR(fit->translation_mm[i], p.at(static_cast<std::size_t>(i)), 2e-4);
            EXPECT_NEAR(fit->rotation_vector_rad[i], p.at(static_cast<std::size_t>(i) + 3), 2e-6);
        }
    }
}

TEST(AgainstCeres, RobustLosses) {
    for (const Loss loss : {Loss::Huber, Loss::Cauchy, Loss::Tukey}) {
        base::Random random(31);
        const Patch patch = benchmarkPatch();
        auto made = leastSquaresMeasurement(random, patch, 120, 0.0, 0.003, randomPose(random, 0.002, 0.02));
        for (std::size_t i = 0; i < 8; ++i) made.points[i].z() += 0.05;
        AlignmentOptions options;
        options.loss = loss;
        options.loss_scale_mm = 0.01;
        const auto fit = align(made.points, patch, options);
        ASSERT_TRUE(fit.has_value()) << toText(fit.error());
        const auto p = ceresFit(patch, made, 0.0, options.locked, loss, options.loss_scale_mm);
        for (const Vector3& point : made.points) {
            const double ours = patch.closest(fit->nominal_from_measured * point).distance_mm;
            EXPECT_NEAR(ours, patch.closest(poseOf(p.data()) * point).distance_mm, 2e-6) << int(loss);
        }
    }
}

}  // namespace
}  // namespace cusp::inspect::test
