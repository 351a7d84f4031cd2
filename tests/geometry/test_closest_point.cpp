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

/// The same patch written with one degree more along u (Farin 2002, 5.1).
BezierPatch elevatedInU(const BezierPatch& patch) {
    const int n = patch.degreeU() + 1;
    std::vector<BezierPatch::Vector4> net;
    for (int i = 0; i <= n; ++i) {
        const double share = static_cast<double>(i) / n;
        for (int j = 0; j <= patch.degreeV(); ++j) {
            BezierPatch::Vector4 point = BezierPatch::Vector4::Zero();
            if (i > 0) point += share * patch.at(i - 1, j);
            if (i < n) point += (1.0 - share) * patch.at(i, j);
            point[3] = 1.0;
            net.push_back(point);
        }
    }
    return {n, patch.degreeV(), net, patch.origin()};
}

TEST(ClosestPoint, IsNeverFartherThanBruteForce) {
    base::Random random(seed);
    for (const HardSurface& hard : hardSurfaces()) {
        const ParametricSurface surface(hard.faces);
        for (int i = 0; i < 100; ++i) {
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

TEST(ClosestPoint, TheProofByReachAgreesWithTheSearchWithout) {
    // A degree above 3 keeps a patch off the quick way: the same surface, answered by the general search.
    base::Random random(seed);
    const SurfaceFace sheet = wavySheet(8, 100.0, 8.0, 3);
    std::vector<BezierPatch> elevated;
    for (const BezierPatch& patch : sheet.patches()) elevated.push_back(elevatedInU(patch));
    const ParametricSurface quick({sheet});
    const ParametricSurface general({SurfaceFace(sheet.breaksU(), sheet.breaksV(), elevated, Outward::DuCrossDv)});
    for (int i = 0; i < 20000; ++i) {
        const double u = random.uniform();
        const double v = random.uniform();
        const double offset = std::pow(10.0, random.uniform(-4.0, 1.3)) * (random.chance(0.5) ? 1.0 : -1.0);
        const Vector3 query = sheet.evaluate(u, v).position + offset * sheet.normal(u, v);
        const Footpoint a = quick.closest(query);
        const Footpoint b = general.closest(query);
        ASSERT_NEAR(a.distance_mm, b.distance_mm, 1e-10) << "query " << query.transpose() << ", seed " << seed;
        ASSERT_EQ(a.on_boundary, b.on_boundary) << "query " << query.transpose();
    }
}

TEST(ClosestPoint, CentresOfCurvatureAreAnsweredExactly) {
    const ParametricSurface sphere({sphereFace({1, 2, 3}, 12.5)});
    EXPECT_NEAR(sphere.closest({1, 2, 3}).distance_mm, -12.5, 1e-10);
    const ParametricSurface cylinder({cylinderFace(7.0, 40.0)});
    for (const double z : {0.0, 1e-3, 20.0, 33.3}) {
        const Footpoint foot = cylinder.closest({0, 0, z});
        EXPECT_NEAR(foot.distance_mm, -7.0, 1e-10);
        EXPECT_NEAR(foot.position.z(), z, 1e-4);  // where along the axis is decided by the square of the difference
    }
    const ParametricSurface torus({torusFace(20.0, 6.0)});
    EXPECT_NEAR(torus.closest({0, 20, 0}).distance_mm, -6.0, 1e-10);
    EXPECT_NEAR(torus.closest({0, 0, 0}).distance_mm, 14.0, 1e-10);
}

TEST(ClosestPoint, OnClosedQuadricsAndTorusAsInClosedForm) {
    base::Random random(seed);
    const ParametricSurface sphere({sphereFace({3, -2, 5}, 12.5)});
    const ParametricSurface torus({torusFace(20.0, 6.0)});
    for (int i = 0; i < 3000; ++i) {
        const Vector3 direction = randomDirection(random);
        const double r = random.uniform(0.0, 40.0);
        const Footpoint on_sphere = sphere.closest(Vector3(3, -2, 5) + r * direction);
        ASSERT_NEAR(on_sphere.distance_mm, r - 12.5, 1e-10);
        ASSERT_FALSE(on_sphere.on_boundary) << (r * direction).transpose();
        const Vector3 query(40.0 * (random.uniform() - 0.5), 60.0 * (random.uniform() - 0.5),
                            30.0 * (random.uniform() - 0.5));
        const double expected = std::hypot(std::hypot(query.x(), query.y()) - 20.0, query.z()) - 6.0;
        ASSERT_NEAR(torus.closest(query).distance_mm, expected, 1e-10) << query.transpose();
    }
}

TEST(ClosestPoint, PolesAreReachedFromEverySide) {
    const ParametricSurface sphere({sphereFace({0, 0, 0}, 10.0)});
    for (const double offset : {-3.0, -0.02, 0.0, 0.02, 5.0}) {
        for (const double aside : {0.0, 1e-9, 1e-5, 0.01}) {
            const Vector3 query(aside, 0.5 * aside, 10.0 + offset);
            const Footpoint foot = sphere.closest(query);
            EXPECT_NEAR(foot.distance_mm, query.norm() - 10.0, 1e-10);
            EXPECT_LE((foot.position - 10.0 * query.normalized()).norm(), 1e-6);
            EXPECT_GT(foot.normal.z(), 0.99);
        }
    }
}

TEST(ClosestPoint, SaysWhereAnOpenShapeEnds) {
    const ParametricSurface surface({benchmarkFace()});
    const SurfaceFace& face = surface.faces().front();
    const SurfacePoint edge = face.evaluate(0.0, 0.4);
    const Vector3 normal = face.normal(0.0, 0.4);
    const Vector3 outwards = edge.dv.normalized().cross(normal);  // in the tangent plane, away from the face
    const double side = outwards.dot(edge.du) < 0.0 ? 1.0 : -1.0;
    const Footpoint beyond = surface.closest(edge.position + 3.0 * side * outwards + 0.1 * normal);
    EXPECT_TRUE(beyond.on_boundary);
    EXPECT_NEAR(beyond.u, 0.0, 1e-12);
    EXPECT_NEAR(beyond.v, 0.4, 0.01);
    EXPECT_GT(beyond.distance_mm, 0.0);
    const Footpoint above = surface.closest(edge.position + 0.1 * normal);
    EXPECT_FALSE(above.on_boundary);
    EXPECT_NEAR(above.distance_mm, 0.1, 1e-12);
    const Footpoint corner = surface.closest(face.evaluate(0.0, 0.0).position + Vector3(-5, 5, 0));
    EXPECT_TRUE(corner.on_boundary);
    EXPECT_EQ(corner.u, 0.0);
    EXPECT_EQ(corner.v, 0.0);
}

TEST(ClosestPoint, SignAndBoundaryAtEdgesAndCornersOfAClosedShape) {
    base::Random random(seed);
    for (const HardSurface& hard : hardSurfaces()) {
        if (hard.name != "cube") continue;
        const ParametricSurface surface(hard.faces);
        for (int i = 0; i < 4000; ++i) {
            const Vector3 query(random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-20, 20));
            const Vector3 outside = (query.cwiseAbs() - Vector3::Constant(10.0)).cwiseMax(0.0);
            const double inside = (query.cwiseAbs() - Vector3::Constant(10.0)).maxCoeff();
            const double expected = inside < 0.0 ? inside : outside.norm();
            const Footpoint foot = surface.closest(query);
            ASSERT_NEAR(foot.distance_mm, expected, 1e-10) << query.transpose();
            ASSERT_FALSE(foot.on_boundary) << query.transpose();
        }
    }
}

TEST(ClosestPoint, WarmStartsChangeNothing) {
    base::Random random(seed);
    for (const HardSurface& hard : hardSurfaces()) {
        const ParametricSurface surface(hard.faces);
        std::vector<Vector3> queries;
        for (int i = 0; i < 200; ++i) queries.push_back(randomQuery(random, surface));
        std::vector<Footpoint> cold(queries.size());
        surface.closest(queries, cold, false);
        std::vector<Footpoint> right = cold;
        surface.closest(queries, right, true);
        std::vector<Footpoint> wrong(cold.rbegin(), cold.rend());  // starts that belong to other queries
        wrong[0].face = -1;
        wrong[1].face = 99;
        wrong[2].u = std::numeric_limits<double>::quiet_NaN();
        surface.closest(queries, wrong, true);
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const double rounding = 1e-10 + 1e-14 * queries[i].cwiseAbs().maxCoeff();
            EXPECT_NEAR(right[i].distance_mm, cold[i].distance_mm, rounding) << hard.name;
            EXPECT_NEAR(wrong[i].distance_mm, cold[i].distance_mm, rounding) << hard.name;
        }
    }
}

TEST(ClosestPoint, OneThreadAndManyGiveTheSameBits) {
    base::Random random(seed);
    const ParametricSurface surface({wavySheet(5, 50.0, 6.0, 11)});
    std::vector<Vector3> queries;
    for (int i = 0; i < 5000; ++i) queries.push_back(randomQuery(random, surface));
    std::vector<Footpoint> many(queries.size());
    surface.closest(queries, many, false);
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const Footpoint one = surface.closest(queries[i]);
        ASSERT_EQ(one.distance_mm, many[i].distance_mm);
        ASSERT_EQ(one.position, many[i].position);
        ASSERT_EQ(one.u, many[i].u);
        ASSERT_EQ(one.v, many[i].v);
    }
}

TEST(ClosestPoint, FarOffTheOriginLosesNothing) {
    base::Random random(seed);
    const Vector3 away(2e6, -3e6, 1e6);
    const SurfaceFace here = benchmarkFace();
    std::vector<BezierPatch> moved;
    for (const BezierPatch& patch : here.patches()) {
        moved.emplace_back(patch.degreeU(), patch.degreeV(), patch.net(), patch.origin() + away);
    }
    const ParametricSurface near({here});
    const ParametricSurface far({SurfaceFace(here.breaksU(), here.breaksV(), moved, Outward::DuCrossDv)});
    for (int i = 0; i < 2000; ++i) {
        const Vector3 query =
            away + here.evaluate(random.uniform(), random.uniform()).position + 0.02 * randomDirection(random);
        // The coordinates of the query are rounded to 5e-10 mm; what is left of them is answered without further loss.
        const Vector3 back = query - away;
        ASSERT_NEAR(far.closest(query).distance_mm, near.closest(back).distance_mm, 1e-9);
    }
}

}  // namespace
}  // namespace cusp::geometry::test
