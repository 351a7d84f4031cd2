// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The mesh of what is left, its volume, its deviation from a nominal, and its agreement with the exact envelope.
#include "benchmark_path.hpp"
#include "milling_scenes.hpp"

#include <cusp/base/random.hpp>
#include <cusp/geometry/mesh_shape.hpp>
#include <cusp/geometry/parametric_surface.hpp>
#include <cusp/simulation/stock_surface.hpp>
#include <cusp/toolpath/cl_reader.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

namespace {

using namespace cusp;
using namespace cusp::simulation;
using namespace cusp::test_support;
using geometry::Vector3;

constexpr double pi = std::numbers::pi;
const Vector3 up = Vector3::UnitZ();

TEST(StockMesh, IsClosedWhateverWasCut) {
    base::Random random(91);
    for (int trial = 0; trial < 8; ++trial) {
        SCOPED_TRACE(trial);
        Stock stock = blockOf(boxOf(-10, -10, -8, 10, 10, 0), trial % 2 == 0 ? 0.8 : 0.45);
        std::vector<ToolMove> moves;
        for (int i = 0; i < 25; ++i) {
            const Vector3 from(random.uniform(-12, 12), random.uniform(-12, 12), random.uniform(-9, 1));
            ToolMove m = move(from, from + 5.0 * Vector3(random.normal(), random.normal(), random.normal()), up);
            m.from.axis = Vector3(random.normal(), random.normal(), random.normal()).normalized();
            m.to.axis = (m.from.axis + 0.2 * Vector3(random.normal(), random.normal(), random.normal())).normalized();
            moves.push_back(m);
        }
        millWith(stock, moves, cutterOnly(ballCutter(2.0)));
        for (const std::size_t stride : {1U, 2U, 3U}) {
            const geometry::TriangleMesh mesh = surfaceMesh(stock, stride);
            const geometry::MeshEdges edges = geometry::checkEdges(mesh);
            ASSERT_EQ(edges.open, 0U);
            ASSERT_EQ(edges.reversed, 0U);
            ASSERT_EQ(edges.crowded, 0U);
            ASSERT_NEAR(enclosedVolume(mesh), stock.volume(), 0.15 * static_cast<double>(stride) * stock.volume());
        }
    }
}

/// Of what a block's mesh loses, over shifted blocks: the error's root mean square and how it falls.
void expectSecondOrder(const ToolMove& m, const geometry::Cutter& cutter, double exact, double last) {
    std::vector<double> errors;
    for (const double resolution : {1.0, 0.5, 0.25}) {
        double sum = 0.0;
        constexpr int shifts = 4;
        for (int i = 0; i < shifts; ++i) {
            const double d = 0.137 * resolution * i;
            Stock stock = blockOf(boxOf(-20 - d, -12 - 0.7 * d, -12 - 0.3 * d, 20, 12, 0), resolution);
            const double before = enclosedVolume(surfaceMesh(stock));
            millWith(stock, {m}, cutterOnly(cutter));
            sum += std::pow((before - enclosedVolume(surfaceMesh(stock))) / exact - 1.0, 2) / shifts;
        }
        errors.push_back(std::sqrt(sum));
    }
    const double order = std::log2(errors.front() / errors.back()) / 2.0;
    EXPECT_GE(order, 1.6) << errors[0] << ' ' << errors[1] << ' ' << errors[2];
    EXPECT_LE(errors.back(), last) << errors[0] << ' ' << errors[1] << ' ' << errors[2];
}

TEST(StockMesh, VolumeOfABallSlotIsOfSecondOrder) {
    const double r = 5.0;
    const double depth = 3.0;
    const double half_angle = std::acos(1.0 - depth / r);
    const double segment = r * r * (half_angle - std::sin(half_angle) * std::cos(half_angle));
    expectSecondOrder(move(Vector3(-10, 1.3, -depth), Vector3(9, 1.3, -depth), up), ballCutter(2.0 * r),
                      19.0 * segment + pi * depth * depth * (3.0 * r - depth) / 3.0, 2e-3);
}

TEST(StockMesh, VolumeOfAToroidalSlotIsOfSecondOrder) {
    const double corner = 2.0;
    const double e = 3.0;
    const double depth = 4.0;
    const double quarter = pi * corner * corner / 4.0;
    const double section = 2.0 * (e * corner + quarter) + 2.0 * (e + corner) * (depth - corner);
    const double turned = pi * e * e * corner + 2.0 * pi * quarter * (e + 4.0 * corner / (3.0 * pi)) +
                          pi * (e + corner) * (e + corner) * (depth - corner);
    expectSecondOrder(move(Vector3(-10, 0.4, -depth), Vector3(9, 0.4, -depth), up), toroidalCutter(10.0, corner),
                      19.0 * section + turned, 3e-3);
}

TEST(StockMesh, VolumeOfAFlatPlungeIsOfSecondOrder) {
    const double r = 4.0;
    expectSecondOrder(move(Vector3(0.3, 0.7, 5), Vector3(0.3, 0.7, -6.3), up), toroidalCutter(2.0 * r, 0.0),
                      6.3 * pi * r * r, 4e-3);
}

TEST(StockDeviation, ScallopsOfABallOnAPlane) {
    // Slots 1 mm apart with a ball D8, cusps on rays: a cusp is r − √(r² − ¼) high; 0.02 mm too deep.
    std::vector<ToolMove> moves;
    for (int i = -8; i <= 8; ++i)
        moves.push_back(move(Vector3(-20, i + 0.05, -5.02), Vector3(20, i + 0.05, -5.02), up));
    Stock stock = blockOf(boxOf(-10, -6, -10, 10, 6, 0), 0.1);
    millWith(stock, moves, cutterOnly(ballCutter(8.0)));
    geometry::TriangleMesh plane;
    plane.vertices = {Vector3(-30, -30, -5), Vector3(30, -30, -5), Vector3(30, 30, -5), Vector3(-30, 30, -5)};
    plane.triangles = {{0, 1, 2}, {0, 2, 3}};
    const StockDeviation found = stockDeviation(stock, geometry::MeshShape(plane), 0.005, 1);
    const double cusp = 4.0 - std::sqrt(16.0 - 0.25) - 0.02;
    EXPECT_NEAR(found.summary.overcut_max_mm, 0.02, 1e-3);
    EXPECT_LE(found.summary.overcut_max_mm, 0.02 + 1e-6);
    EXPECT_NEAR(found.summary.undercut_max_mm, cusp, 2e-3);
    double area = 0.0;
    for (const DeviationPoint& point : found.points) area += point.area_mm2;
    EXPECT_NEAR(area, 20.0 * 12.0, 0.03 * 240.0);
}

TEST(StockDeviation, AgreesWithTheExactEnvelope) {
    BenchmarkPath job;
    job.passes = 12;
    job.points_per_pass = 21;
    job.lead_rad = 4.63 * pi / 180.0;
    std::istringstream text(benchmarkPathText(job));
    base::Diagnostics report;
    const auto file = toolpath::readToolPath(text, "benchmark.cls", {}, report).value();
    PathCollector collector("benchmark.cls", 1e-4, report);
    for (const auto& record : file.records) collector.take(record);
    const CutterPath path = collector.finish();
    const geometry::ParametricSurface nominal(benchmarkFaces());

    Eigen::AlignedBox3d box = nominal.bounds();
    box.min().z() -= 5.0;
    box.max().z() += 1.0;
    Stock stock = blockOf(box, 1.0);
    std::vector<ToolAssembly> tools;
    for (const auto& cutter : path.cutters) tools.push_back(cutterOnly(cutter));
    ASSERT_TRUE(mill(stock, path.moves, tools, {.sweep_tolerance_mm = 1e-4, .progress = {}}));
    const StockDeviation simulated = stockDeviation(stock, nominal, 0.01);
    SurfaceGrid grid;
    std::vector<double> seen;
    for (const DeviationPoint& point : simulated.points) {
        const geometry::Footpoint foot = nominal.closest(point.position);
        if (std::abs(point.deviation_mm) > 0.4) continue;
        GridPoint at;
        at.position = foot.position;
        at.normal = foot.normal;
        grid.tiles.push_back({grid.points.size(), 1, foot.position, 0.0});
        grid.points.push_back(at);
        seen.push_back(point.deviation_mm);
    }
    ASSERT_GT(seen.size(), 2000U);
    const auto envelope = surfaceEnvelope(path, grid, {0.25, 0.5}).value();
    for (std::size_t i = 0; i < seen.size(); ++i) ASSERT_NEAR(envelope.points[i].deviation_mm, seen[i], 1.5e-4);
}

}  // namespace
