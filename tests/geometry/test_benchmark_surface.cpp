// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The benchmark surface as it ships, against eq. 14 of the paper written out here.
#include <cusp/geometry/cad/nominal_file.hpp>
#include <cusp/geometry/parametric_surface.hpp>
#include <cusp/geometry/surface_file.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace cusp::geometry::test {
namespace {

const std::string example = CUSP_SOURCE_DIR "/examples/benchmark/surface.toml";

Vector3 equation14(double u, double v) {
    return {-94.4 + 88.9 * v + 5.6 * v * v, -131.3 * u + 28.1 * u * u,
            5.9 * (u * u * v * v + u * u * v) - 3.9 * v * v * u + 76.2 * u * u + 6.7 * v * v - 27.3 * u * v - 50.8 * u +
                25.0 * v + 12.1};
}

SurfaceFace shippedFace() {
    const auto faces = readSurfaceFile(example);
    if (!faces) throw std::runtime_error(base::toText(faces.error()));
    return faces->at(0);
}

TEST(BenchmarkSurface, IsEquation14) {
    const SurfaceFace face = shippedFace();
    for (int i = 0; i <= 20; ++i) {
        for (int j = 0; j <= 20; ++j) {
            const double u = i / 20.0;
            const double v = j / 20.0;
            EXPECT_LE((face.evaluate(u, v).position - equation14(u, v)).norm(), 1e-13) << u << " " << v;
        }
    }
}

TEST(BenchmarkSurface, DerivativesAreThoseOfEquation14) {
    const SurfaceFace face = shippedFace();
    for (const double u : {0.0, 0.3, 0.77, 1.0}) {
        for (const double v : {0.0, 0.21, 0.5, 1.0}) {
            const SurfacePoint p = face.evaluate(u, v);
            const Vector3 du(0, -131.3 + 56.2 * u, 11.8 * u * (v * v + v) - 3.9 * v * v + 152.4 * u - 27.3 * v - 50.8);
            const Vector3 dv(88.9 + 11.2 * v, 0, 5.9 * u * u * (2 * v + 1) - 7.8 * u * v + 13.4 * v - 27.3 * u + 25.0);
            const Vector3 duu(0, 56.2, 11.8 * (v * v + v) + 152.4);
            const Vector3 duv(0, 0, 11.8 * u * (2 * v + 1) - 7.8 * v - 27.3);
            const Vector3 dvv(11.2, 0, 11.8 * u * u - 7.8 * u + 13.4);
            EXPECT_LE((p.du - du).norm(), 1e-12);
            EXPECT_LE((p.dv - dv).norm(), 1e-12);
            EXPECT_LE((p.duu - duu).norm(), 1e-12);
            EXPECT_LE((p.duv - duv).norm(), 1e-12);
            EXPECT_LE((p.dvv - dvv).norm(), 1e-12);
        }
    }
}

TEST(BenchmarkSurface, IsConcaveSeenFromAboveAsThePaperCutsIt) {
    const SurfaceFace face = shippedFace();
    double smallest_radius_mm = 1e9;
    for (int i = 0; i <= 100; ++i) {
        for (int j = 0; j <= 100; ++j) {
            const Vector3 normal = face.normal(i / 100.0, j / 100.0);
            EXPECT_GT(normal.z(), 0.0);
            const PrincipalCurvatures k = principalCurvatures(face.evaluate(i / 100.0, j / 100.0), normal);
            EXPECT_GT(k.smallest, 0.0);
            smallest_radius_mm = std::min(smallest_radius_mm, 1.0 / k.largest);
        }
    }
    EXPECT_NEAR(smallest_radius_mm, 54.6, 0.05);
}

TEST(BenchmarkSurface, LoadsAsANominalShape) {
    const auto nominal = loadNominal(example);
    ASSERT_TRUE(nominal.has_value()) << base::toText(nominal.error());
    const SurfaceFace face = shippedFace();
    const Vector3 foot = equation14(0.4, 0.6);
    const Vector3 normal = face.normal(0.4, 0.6);
    for (const double offset : {-0.02, 0.0, 0.02, 1.0, 20.0}) {
        const Footpoint found = (*nominal)->closest(foot + offset * normal);
        EXPECT_NEAR(found.distance_mm, offset, 1e-12);
        EXPECT_NEAR(found.u, 0.4, 1e-12);
        EXPECT_NEAR(found.v, 0.6, 1e-12);
        EXPECT_FALSE(found.on_boundary);
        EXPECT_LE((found.normal - normal).norm(), 1e-12);
    }
}

}  // namespace
}  // namespace cusp::geometry::test
