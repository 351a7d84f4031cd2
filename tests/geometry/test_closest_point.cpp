// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The nearest point against brute force, closed forms and itself: hard surfaces, hard queries, any start, any thread.
#include "hard_surfaces.hpp"

#include <cusp/base/random.hpp>
#include <cusp/geometry/parametric_surface.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace cusp::geometry::test {
namespace {

constexpr std::uint64_t seed = 20170901;

Vector3 randomDirection(base::Random& random) {
    return Vector3(random.normal(), random.normal(), random.normal()).normalized();
}

/// Near the surface, around it, far from it.
Vector3 randomQuery(base::Random& random, const ParametricSurface& surface) {
    const Eigen::AlignedBox3d box = surface.bounds();
    const double size = box.diagonal().norm();
    if (random.chance(0.5)) {
        const SurfaceFace& face = surface.faces()[random.below(surface.faces().size())];
        const double u = random.uniform(face.breaksU().front(), face.breaksU().back());
        const double v = random.uniform(face.breaksV().front(), face.breaksV().back());
        const double scale = std::pow(10.0, random.uniform(-4.0, 0.0)) * size / 5.0;
        return face.evaluate(u, v).position + scale * randomDirection(random);
    }
    const double reach = random.chance(0.2) ? 5.0 : 0.7;
    return box.center() + reach * size * random.uniform() * randomDirection(random);
}

/// What every answer must fulfil by itself.
void expectConsistent(const ParametricSurface& surface, const Vector3& query, const Footpoint& foot,
                      const std::string& name) {
    const SurfaceFace& face = surface.faces().at(static_cast<std::size_t>(foot.face));
    const double far = query.cwiseAbs().maxCoeff();
    EXPECT_LE((face.evaluate(foot.u, foot.v).position - foot.position).norm(), 1e-11 + 1e-14 * far) << name;
    EXPECT_NEAR((query - foot.position).norm(), std::abs(foot.distance_mm), 1e-11 + 1e-14 * far) << name;
    EXPECT_NEAR(foot.normal.norm(), 1.0, 1e-12) << name;
}

TEST(ClosestPoint, IsNeverFartherThanBruteForce) {
    base::Random random(seed);
    for (const HardSurface& hard : hardSurfaces()) {
        const ParametricSurface surface(hard.faces);
        for (int i = 0; i < 150; ++i) {
            const Vector3 query = randomQuery(random, surface);
            const Footpoint foot = surface.closest(query);
            expectConsistent(surface, query, foot, hard.name);
            const double brute = bruteForceDistance(hard.faces, query);
            const double rounding = 1e-14 * query.cwiseAbs().maxCoeff();
            ASSERT_LE(std::abs(foot.distance_mm), brute + 1e-9 + rounding)
                << hard.name << ", query " << query.transpose() << ", seed " << seed;
            // The brute force stops at steps of 1e-12 of the parameters.
            ASSERT_GE(std::abs(foot.distance_mm), brute - 1e-6)
                << hard.name << ", query " << query.transpose() << ", seed " << seed;
        }
    }
}

}  // namespace
}  // namespace cusp::geometry::test
