// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Arcs as circular blocks or chords, against the circle's own equation.
#include "arc_steps.hpp"

#include <gtest/gtest.h>
#include <numbers>
#include <random>

namespace cusp::post {
namespace {

using geometry::Vector3;
using toolpath::ArcMotion;

constexpr double pi = std::numbers::pi;

ArcMotion arcAbout(const Vector3& normal, const Vector3& center, const Vector3& end) {
    ArcMotion arc;
    arc.end = {end, Vector3::UnitZ()};
    arc.center_mm = center;
    arc.normal = normal;
    arc.radius_mm = (end - center).norm();
    return arc;
}

TEST(ArcSteps, SweepFollowsTheNormal) {
    const Vector3 start(10, 0, 0);
    const Vector3 end(0, 10, 0);
    EXPECT_NEAR(arcSweep(arcAbout(Vector3::UnitZ(), Vector3::Zero(), end), start), pi / 2, 1e-15);
    EXPECT_NEAR(arcSweep(arcAbout(-Vector3::UnitZ(), Vector3::Zero(), end), start), 3 * pi / 2, 1e-15);
    ArcMotion full = arcAbout(Vector3::UnitZ(), Vector3::Zero(), start);
    full.full_circle = true;
    EXPECT_DOUBLE_EQ(arcSweep(full, start), 2 * pi);
}

TEST(ArcSteps, AboutZIsOneCircularBlock) {
    const auto steps = arcSteps(arcAbout(-Vector3::UnitZ(), Vector3(1, 2, 5), Vector3(1, 12, 7)), Vector3(11, 2, 5),
                                Eigen::Affine3d::Identity(), {}, {}, 0.005);
    ASSERT_EQ(steps.size(), 1U);
    const auto& arc = std::get<ArcMove>(steps[0]);
    EXPECT_TRUE(arc.clockwise);
    EXPECT_EQ(arc.end_mm, Vector3(1, 12, 7));
    EXPECT_EQ(arc.center_from_start_mm, Vector3(-10, 0, 0));
}

TEST(ArcSteps, ChordsStayWithinToleranceAndAreAsFewAsCanBe) {
    constexpr unsigned seed = 11;
    RecordProperty("seed", static_cast<int>(seed));
    std::mt19937_64 engine(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::uniform_real_distribution<double> radii(0.5, 400.0);
    for (int i = 0; i < 300; ++i) {
        const Vector3 normal = Vector3(unit(engine), unit(engine), unit(engine)).normalized();
        const Vector3 out = normal.unitOrthogonal();
        const double radius = radii(engine);
        const double sweep = (unit(engine) + 1.0) * (pi - 0.01) + 0.01;
        const Vector3 center(unit(engine) * 100, unit(engine) * 100, unit(engine) * 100);
        const Vector3 rise = normal * unit(engine) * 20;
        const Vector3 end = center + radius * (out * std::cos(sweep) + normal.cross(out) * std::sin(sweep)) + rise;
        const double tolerance = 0.005;
        const auto steps = arcSteps(arcAbout(normal, center, end), center + radius * out, Eigen::Affine3d::Identity(),
                                    {}, {}, tolerance);
        Vector3 from = center + radius * out;
        double worst = 0.0;
        for (const NcItem& step : steps) {
            const Vector3 to = std::get<Move>(step).point_mm;
            const Vector3 middle = (from + to) / 2.0 - center;
            worst = std::max(worst, radius - (middle - normal * normal.dot(middle)).norm());
            const Vector3 corner = to - center;
            EXPECT_NEAR((corner - normal * normal.dot(corner)).norm(), radius, 1e-9 * radius);
            from = to;
        }
        EXPECT_EQ(from, end);
        EXPECT_LE(worst, tolerance * (1 + 1e-9)) << "radius " << radius << ", sweep " << sweep;
        // One chord fewer would be too coarse.
        const double coarser = sweep / static_cast<double>(steps.size() - 1);
        if (steps.size() > 1) {
            EXPECT_GT(radius * (1 - std::cos(coarser / 2)), tolerance);
        }
    }
}

}  // namespace
}  // namespace cusp::post
