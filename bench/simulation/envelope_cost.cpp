// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What one exact-envelope evaluation of the benchmark surface costs, and how the cost grows with grid and path.
#include "benchmark_path.hpp"

#include <cusp/geometry/surface_file.hpp>
#include <cusp/simulation/surface_envelope.hpp>
#include <cusp/toolpath/cl_reader.hpp>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <numbers>
#include <sstream>
#include <string>

namespace {

using namespace cusp;

simulation::CutterPath pathOf(int passes, int points) {
    test_support::BenchmarkPath job;
    job.passes = passes;
    job.points_per_pass = points;
    job.lead_rad = 4.63 * std::numbers::pi / 180.0;
    std::istringstream text(test_support::benchmarkPathText(job));
    base::Diagnostics report;
    const auto file = toolpath::readToolPath(text, "benchmark.cls", {}, report).value();
    simulation::PathCollector collector("benchmark.cls", 1e-4, report);
    for (const auto& record : file.records) collector.take(record);
    return collector.finish();
}

double leastCpuSeconds(const simulation::CutterPath& path, const std::vector<geometry::SurfaceFace>& faces,
                       double spacing_mm, std::size_t& points) {
    double best = 1e9;
    for (int run = 0; run < 3; ++run) {
        const std::clock_t begin = std::clock();
        const auto envelope = simulation::surfaceEnvelope(path, faces, {spacing_mm, 0.5}).value();
        best = std::min(best, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
        points = envelope.points.size();
    }
    return best;
}

}  // namespace

int main() {
    const auto faces =
        geometry::readSurfaceFile(std::string(CUSP_SOURCE_DIR) + "/examples/benchmark/surface.toml").value();
    std::printf(
        "Exact envelope on the benchmark surface (D16 r3, lead 4.63 deg), CPU time of all threads, least of 3 runs\n");
    std::printf("%8s %8s %9s %9s %9s %12s\n", "passes", "points", "grid mm", "grid pts", "CPU ms", "ns/point");
    for (const int passes : {15, 30, 60})
        for (const double spacing : {0.5, 0.25, 0.125}) {
            std::size_t points = 0;
            const double seconds = leastCpuSeconds(pathOf(passes, 31), faces, spacing, points);
            std::printf("%8d %8d %9.3f %9zu %9.1f %12.0f\n", passes, 31, spacing, points, 1e3 * seconds,
                        1e9 * seconds / static_cast<double>(points));
        }
    return 0;
}
