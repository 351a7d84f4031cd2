// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The benchmark surface as a real STEP and a real IGES file, against the surface file that ships.
#include <cusp/base/random.hpp>
#include <cusp/geometry/cad/cad_file.hpp>
#include <cusp/geometry/surface_file.hpp>

#include <gtest/gtest.h>

#include <filesystem>

namespace cusp::geometry::test {
namespace {

TEST(RealFiles, StepAndIgesAreTheBenchmarkSurface) {
    const std::string folder = CUSP_SHARED_DATA "/cmm";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no real STEP and IGES files: " << folder << " is not there";
    const auto faces = readSurfaceFile(CUSP_SOURCE_DIR "/examples/benchmark/surface.toml");
    ASSERT_TRUE(faces.has_value());
    const ParametricSurface printed(*faces);
    CadOptions options;
    options.reader = CUSP_CAD_READER_PATH;
    for (const char* name : {"/eq14_surface.step", "/eq14_surface.igs"}) {
        base::Diagnostics report;
        const auto shape = readCadFile(folder + name, report, options);
        ASSERT_TRUE(shape.has_value()) << base::toText(shape.error());
        EXPECT_EQ(shape->trimmedFaces(), 0U);
        base::Random random(1);
        for (int i = 0; i < 2000; ++i) {
            const double offset = random.uniform(-2.0, 2.0);
            const double u = random.uniform();
            const double v = random.uniform();
            const Vector3 query = faces->front().evaluate(u, v).position + offset * faces->front().normal(u, v);
            const Footpoint foot = shape->closest(query);
            ASSERT_NEAR(std::abs(foot.distance_mm), std::abs(offset), 1e-10);
            ASSERT_LE((foot.position - printed.closest(query).position).norm(), 1e-10);
        }
    }
}

}  // namespace
}  // namespace cusp::geometry::test
