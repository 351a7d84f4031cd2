// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The drop-cutter against closed forms, and against a search that only knows how far a point is from the cutter.
#include "cutters.hpp"

#include <cusp/base/random.hpp>
#include <cusp/geometry/mesh_shape.hpp>
#include <cusp/geometry/parametric_surface.hpp>
#include <cusp/geometry/surface_file.hpp>
#include <cusp/optimizer/tilt/drop_cutter.hpp>
#include <cusp/simulation/cutter_body.hpp>

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace cusp {
namespace {

using geometry::Cutter;
using geometry::TriangleMesh;
using geometry::Vector3;
using test_support::NamedCutter;
using tilt::MeshDrop;

double tipOn(const TriangleMesh& mesh, const Cutter& cutter, double x, double y) {
    const auto drop = MeshDrop::make(mesh, cutter);
    EXPECT_TRUE(drop.has_value());
    const auto contact = drop->drop(x, y);
    EXPECT_TRUE(contact.has_value());
    return contact ? contact->tip_z_mm : std::numeric_limits<double>::quiet_NaN();
}

/// A large square on the plane z = slope · x.
TriangleMesh plane(double slope) {
    constexpr double half = 100.0;
    TriangleMesh mesh;
    for (const double y : {-half, half})
        for (const double x : {-half, half}) mesh.vertices.emplace_back(x, y, slope * x);
    mesh.triangles = {{0, 1, 3}, {0, 3, 2}};
    return mesh;
}

/// A roof along Y: the ridge at x = 0, z = 0 rising by `rise` a mm along Y, both sides falling steeply.
TriangleMesh roof(double rise) {
    constexpr double half = 100.0;
    constexpr double fall = 500.0;
    TriangleMesh mesh;
    for (const double y : {-half, half})
        for (const double x : {-1.0, 0.0, 1.0}) mesh.vertices.emplace_back(x, y, rise * y - fall * std::abs(x));
    mesh.triangles = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}};
    return mesh;
}

TEST(DropCutterClosedForm, BallOnPlane) {
    for (const double slope : {0.0, 0.3, 1.0, 5.0})
        EXPECT_NEAR(tipOn(plane(slope), test_support::ballCutter(10.0), 1.0, 2.0),
                    slope * 1.0 + 5.0 * std::sqrt(1.0 + slope * slope) - 5.0, 1e-9);
}

TEST(DropCutterClosedForm, FlatOnPlane) {
    for (const double slope : {0.0, 0.3, 1.0, 5.0})
        EXPECT_NEAR(tipOn(plane(slope), test_support::flatCutter(10.0), 1.0, 2.0), slope * 1.0 + 5.0 * slope, 1e-9);
}

TEST(DropCutterClosedForm, TorusOnPlane) {
    for (const double slope : {0.1, 0.3, 1.0, 5.0})
        EXPECT_NEAR(tipOn(plane(slope), test_support::toroidalCutter(10.0, 2.0), 1.0, 2.0),
                    slope * 1.0 + 3.0 * slope + 2.0 * (std::sqrt(1.0 + slope * slope) - 1.0), 1e-9);
}

TEST(DropCutterClosedForm, BallAcrossRidge) {
    // The ball beside the ridge by 3 mm touches it where a circle of radius √(5² − 3²) would.
    for (const double rise : {0.0, 0.5, 2.0})
        EXPECT_NEAR(tipOn(roof(rise), test_support::ballCutter(10.0), 3.0, 4.0),
                    rise * 4.0 + 4.0 * std::sqrt(1.0 + rise * rise) - 5.0, 1e-9);
}

TEST(DropCutterClosedForm, FlatAcrossRidge) {
    EXPECT_NEAR(tipOn(roof(0.5), test_support::flatCutter(10.0), 3.0, 4.0), 0.5 * (4.0 + 4.0), 1e-9);
}

TEST(DropCutterClosedForm, TorusOnLevelRidge) {
    // 4 mm aside, the corner's centre 3 mm from the axis: one mm out on an arc of 2 mm.
    EXPECT_NEAR(tipOn(roof(0.0), test_support::toroidalCutter(10.0, 2.0), 4.0, 0.0), std::sqrt(3.0) - 2.0, 1e-9);
    EXPECT_NEAR(tipOn(roof(0.0), test_support::toroidalCutter(10.0, 2.0), 2.0, 0.0), 0.0, 1e-12);
}

TEST(DropCutterClosedForm, AllOnOneVertex) {
    TriangleMesh spike;
    spike.vertices = {Vector3(0, 0, 0), Vector3(0.01, 0, -900), Vector3(0, 0.01, -900)};
    spike.triangles = {{0, 1, 2}};
    for (const NamedCutter& one : test_support::cuttersOfEveryShape()) {
        const auto body = simulation::CutterBody::make(one.cutter);
        const double tip = tipOn(spike, one.cutter, 1.2, -0.5);
        EXPECT_NEAR(body->at(std::hypot(1.2, 0.5), -tip).distance_mm, 0.0, 1e-9) << one.name;
    }
}

TEST(DropCutter, PassesBeside) {
    const auto drop = MeshDrop::make(roof(0.0), test_support::ballCutter(10.0));
    EXPECT_FALSE(drop->drop(6.5, 0.0).has_value());
    EXPECT_TRUE(drop->drop(5.9, 0.0).has_value());
}

TEST(DropCutter, RefusesWhatItCannotUse) {
    Cutter impossible = test_support::ballCutter(10.0);
    impossible.corner_radius_mm = 9.0;
    EXPECT_EQ(MeshDrop::make(plane(0.0), impossible).error().front().code, "simulation.cutter");
    EXPECT_EQ(MeshDrop::make({}, test_support::ballCutter(10.0)).error().front().code, "tilt.empty-mesh");
    const geometry::MeshShape shape(plane(0.0));
    EXPECT_EQ(tilt::BallDrop::make(shape, test_support::flatCutter(10.0)).error().front().code, "tilt.not-a-ball");
}

/// Least distance of a triangle to the cutter standing at (x, y, tip): convex over the triangle, hence two nested golden
/// sections find it.
double leastDistance(const simulation::CutterBody& body, const std::array<Vector3, 3>& corner, const Vector3& tip) {
    const auto distance = [&](double u, double v) {
        const Vector3 p = corner[0] + u * (corner[1] - corner[0]) + v * (corner[2] - corner[0]) - tip;
        return body.at(std::hypot(p.x(), p.y()), p.z()).distance_mm;
    };
    const auto least = [](double low, double high, const auto& value) {
        constexpr double part = 0.6180339887498949;
        double a = high - part * (high - low);
        double b = low + part * (high - low);
        double at_a = value(a);
        double at_b = value(b);
        for (int i = 0; i < 60; ++i) {
            if (at_a < at_b) {
                high = b;
                b = a;
                at_b = at_a;
                a = high - part * (high - low);
                at_a = value(a);
            } else {
                low = a;
                a = b;
                at_a = at_b;
                b = low + part * (high - low);
                at_b = value(b);
            }
        }
        return std::min({at_a, at_b, value(low), value(high)});
    };
    return least(0.0, 1.0, [&](double u) { return least(0.0, 1.0 - u, [&](double v) { return distance(u, v); }); });
}

TEST(DropCutterBruteForce, RandomTrianglesTouchAndAreNotCut) {
    constexpr std::uint64_t seed = 20260101;
    constexpr int scenes = 120;
    base::Random random(seed);
    const auto cutters = test_support::cuttersOfEveryShape();
    for (int scene = 0; scene < scenes; ++scene) {
        TriangleMesh mesh;
        constexpr std::uint32_t triangles = 6;
        for (std::uint32_t i = 0; i < triangles; ++i) {
            const Vector3 center(random.uniform(-8, 8), random.uniform(-8, 8), random.uniform(-3, 3));
            for (int k = 0; k < 3; ++k)
                mesh.vertices.push_back(center +
                                        Vector3(random.uniform(-6, 6), random.uniform(-6, 6), random.uniform(-6, 6)));
            mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        }
        const NamedCutter& one = cutters[static_cast<std::size_t>(scene) % cutters.size()];
        const auto body = simulation::CutterBody::make(one.cutter);
        const auto drop = MeshDrop::make(mesh, one.cutter);
        const double x = random.uniform(-6, 6);
        const double y = random.uniform(-6, 6);
        const auto contact = drop->drop(x, y);
        if (!contact) continue;
        const Vector3 tip(x, y, contact->tip_z_mm);
        double least = std::numeric_limits<double>::infinity();
        for (const auto& t : mesh.triangles)
            least = std::min(
                least, leastDistance(*body, {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}, tip));
        EXPECT_NEAR(least, 0.0, 1e-7) << one.name << ", scene " << scene << ", seed " << seed;
        const Vector3 touched = contact->contact_mm - tip;
        EXPECT_NEAR(body->at(std::hypot(touched.x(), touched.y()), touched.z()).distance_mm, 0.0, 1e-9) << one.name;
    }
}

/// A wavy sheet of triangles, with vertices out of line so that no two drops are alike.
TriangleMesh sheet(int cells, std::uint64_t seed) {
    base::Random random(seed);
    TriangleMesh mesh;
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i) {
            const double x = i + random.uniform(-0.3, 0.3);
            const double y = j + random.uniform(-0.3, 0.3);
            mesh.vertices.emplace_back(x, y, 2.0 * std::sin(0.5 * x) * std::cos(0.4 * y));
        }
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const auto at = static_cast<std::uint32_t>(j * (cells + 1) + i);
            const auto up = at + static_cast<std::uint32_t>(cells) + 1;
            mesh.triangles.push_back({at, at + 1, up + 1});
            mesh.triangles.push_back({at, up + 1, up});
        }
    return mesh;
}

TEST(DropCutter, TheTreeLeavesNothingOut) {
    constexpr std::uint64_t seed = 7;
    const TriangleMesh mesh = sheet(24, seed);
    base::Random random(seed);
    for (const NamedCutter& one : test_support::cuttersOfEveryShape()) {
        const auto whole = MeshDrop::make(mesh, one.cutter);
        std::uint32_t hint = tilt::DropContact::no_place;
        for (int i = 0; i < 40; ++i) {
            const double x = random.uniform(-2.0, 26.0);
            const double y = random.uniform(-2.0, 26.0);
            double highest = -std::numeric_limits<double>::infinity();
            for (const auto& triangle : mesh.triangles) {
                TriangleMesh alone;
                for (const auto corner : triangle) alone.vertices.push_back(mesh.vertices[corner]);
                alone.triangles = {{0, 1, 2}};
                if (const auto contact = MeshDrop::make(alone, one.cutter)->drop(x, y))
                    highest = std::max(highest, contact->tip_z_mm);
            }
            const auto contact = whole->drop(x, y, hint);
            ASSERT_EQ(contact.has_value(), std::isfinite(highest)) << one.name;
            if (!contact) continue;
            EXPECT_NEAR(contact->tip_z_mm, highest, 1e-10) << one.name << " at " << x << ", " << y;
            hint = contact->place;
        }
    }
}

TEST(BallDrop, AgreesWithTriangles) {
    constexpr std::uint64_t seed = 11;
    const TriangleMesh mesh = sheet(24, seed);
    const geometry::MeshShape shape(mesh);
    const Cutter ball = test_support::ballCutter(4.0);
    const auto exact = MeshDrop::make(mesh, ball);
    const auto stepped = tilt::BallDrop::make(shape, ball);
    base::Random random(seed);
    for (int i = 0; i < 200; ++i) {
        const double x = random.uniform(1.0, 23.0);
        const double y = random.uniform(1.0, 23.0);
        EXPECT_NEAR(stepped->drop(x, y)->tip_z_mm, exact->drop(x, y)->tip_z_mm, 1e-6);
    }
}

TEST(BallDrop, OnTheBenchmarkSurface) {
    // Where the ball stands its centre is a radius from the surface: held by another route, a grid over the parameters.
    const auto faces = geometry::readSurfaceFile(CUSP_SOURCE_DIR "/examples/benchmark/surface.toml");
    ASSERT_TRUE(faces.has_value());
    const geometry::ParametricSurface surface(*faces);
    const auto drop = tilt::BallDrop::make(surface, test_support::ballCutter(12.0));
    for (const double x : {-80.0, -50.0, -20.0})
        for (const double y : {-90.0, -60.0, -25.0}) {
            const auto contact = drop->drop(x, y);
            ASSERT_TRUE(contact.has_value());
            const Vector3 center(x, y, contact->tip_z_mm + 6.0);
            double nearest = std::numeric_limits<double>::infinity();
            constexpr int cells = 600;
            for (int i = 0; i <= cells; ++i)
                for (int j = 0; j <= cells; ++j)
                    nearest = std::min(
                        nearest, ((*faces)[0].evaluate(i / double{cells}, j / double{cells}).position - center).norm());
            EXPECT_GE(nearest, 6.0 - 1e-6);
            EXPECT_LE(nearest, 6.0 + 2e-3);  // the grid's own spacing: 0.17²/(2·6)
            EXPECT_NEAR((contact->contact_mm - center).norm(), 6.0, 1e-6);
        }
}

}  // namespace
}  // namespace cusp
