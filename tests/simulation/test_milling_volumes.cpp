// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Removed volumes against closed forms, their order of convergence, and what they must not depend on.
#include "milling_scenes.hpp"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

namespace {

using namespace cusp;
using namespace cusp::simulation;
using namespace cusp::test_support;
using geometry::Vector3;

constexpr double pi = std::numbers::pi;
const Vector3 up = Vector3::UnitZ();

double removedAt(const Eigen::AlignedBox3d& box, double resolution, const std::vector<ToolMove>& moves,
                 const geometry::Cutter& cutter) {
    Stock stock = blockOf(box, resolution);
    const double before = stock.volume();
    const MillingReport report = millWith(stock, moves, cutterOnly(cutter));
    EXPECT_NEAR(before - stock.volume(), report.removed_volume_mm3, 1e-6 * before);
    return report.removed_volume_mm3;
}

/// The error over shifted boxes, root mean square, must fall with the resolution by `order` at least, and end below `last`.
void expectOrder(const std::vector<ToolMove>& moves, const geometry::Cutter& cutter, double exact, double order,
                 double last) {
    std::vector<double> errors;
    for (const double resolution : {1.0, 0.5, 0.25}) {
        double sum = 0.0;
        constexpr int shifts = 5;
        for (int i = 0; i < shifts; ++i) {
            const double d = 0.137 * resolution * i;
            const double removed =
                removedAt(boxOf(-20 - d, -12 - 0.7 * d, -10 - 0.3 * d, 20, 12, 0), resolution, moves, cutter);
            sum += std::pow(removed / exact - 1.0, 2) / shifts;
        }
        errors.push_back(std::sqrt(sum));
    }
    const double measured = std::log2(errors.front() / errors.back()) / 2.0;
    ::testing::Test::RecordProperty("order", std::to_string(measured));
    EXPECT_GE(measured, order) << errors[0] << ' ' << errors[1] << ' ' << errors[2];
    EXPECT_LE(errors.back(), last);
}

TEST(MillingVolume, BallSlotWithRoundEnds) {
    // Half a cylinder's segment along the way, half a ball's cap at each end.
    const double r = 5.0;
    const double depth = 3.0;
    const double half_angle = std::acos(1.0 - depth / r);
    const double segment = r * r * (half_angle - std::sin(half_angle) * std::cos(half_angle));
    const double cap = pi * depth * depth * (3.0 * r - depth) / 3.0;
    expectOrder({move(Vector3(-10, 1.3, -depth), Vector3(9, 1.3, -depth), up)}, ballCutter(2.0 * r),
                19.0 * segment + cap, 0.7, 6e-3);
}

TEST(MillingVolume, FlatSlotWithRoundEnds) {
    const double r = 4.0;
    const double depth = 3.1;
    expectOrder({move(Vector3(-10, -1.3, -depth), Vector3(9, -1.3, -depth), up)}, toroidalCutter(2.0 * r, 1e-9),
                depth * (19.0 * 2.0 * r + pi * r * r), 0.7, 3e-2);
}

TEST(MillingVolume, ToroidalSlotWithRoundEnds) {
    // Depth below the corner's height: a rounded rectangle's lower part, swept and turned (Pappus).
    const double radius = 5.0;
    const double corner = 2.0;
    const double e = radius - corner;
    const double depth = 4.0;
    const double section = 2.0 * (e * corner + pi * corner * corner / 4.0) + 2.0 * radius * (depth - corner);
    const double quarter = pi * corner * corner / 4.0;
    const double turned = pi * e * e * corner + 2.0 * pi * quarter * (e + 4.0 * corner / (3.0 * pi)) +
                          pi * radius * radius * (depth - corner);
    expectOrder({move(Vector3(-10, 0.4, -depth), Vector3(9, 0.4, -depth), up)}, toroidalCutter(2.0 * radius, corner),
                19.0 * section + turned, 0.7, 3e-2);
}

TEST(MillingVolume, BallPlunge) {
    const double r = 5.0;
    const double depth = 8.0;
    const double exact = 2.0 / 3.0 * pi * r * r * r + pi * r * r * (depth - r);
    expectOrder({move(Vector3(2.2, 1.1, 5), Vector3(2.2, 1.1, -depth), up)}, ballCutter(2.0 * r), exact, 0.7, 6e-3);
}

TEST(MillingVolume, InclinedCylinderPlunge) {
    // Along its own inclined axis, out of the bottom: a cylinder's length in the block is depth / cos.
    const double r = 3.0;
    const double lean = 0.4;
    const Vector3 axis(std::sin(lean), 0.0, std::cos(lean));
    expectOrder({move(40.0 * axis - 5 * up, -20.0 * axis - 5 * up, axis)}, toroidalCutter(2.0 * r, 1e-9, 60.0),
                pi * r * r * 10.0 / std::cos(lean), 0.7, 3e-2);
}

TEST(MillingVolume, InclinedRampOfHalfABall) {
    const double r = 2.5;
    const Vector3 from(-9, -4, -7);
    const Vector3 to(8, 5, -4);
    const double length = (to - from).norm();
    const auto cutter = ballCutter(2.0 * r, r);
    const Vector3 way = (to - from) / length;
    // The half ball, and the way times its shadow across the way: half a disc and half an ellipse.
    const double shadow = 0.5 * pi * r * r * (1.0 + std::abs(way.z()));
    expectOrder({move(from, to, up)}, cutter, 2.0 / 3.0 * pi * r * r * r + length * shadow, 0.7, 6e-3);
}

}  // namespace
