// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Drop-cutter on 100 000 triangles with jittered vertices: cutter locations a second on one core, beside OpenCAMLib's.
#include <cusp/base/random.hpp>
#include <cusp/optimizer/tilt/drop_cutter.hpp>
#include <cusp/toolpath/tool_library.hpp>

#include <cmath>
#include <cstdio>
#include <ctime>

namespace {

using cusp::geometry::TriangleMesh;
using cusp::toolpath::Tool;

constexpr double side_mm = 100.0;

/// 224 × 224 cells of two triangles over 100 × 100 mm: 100 352.
TriangleMesh jittered(std::uint64_t seed) {
    constexpr int cells = 224;
    cusp::base::Random random(seed);
    TriangleMesh mesh;
    const double step = side_mm / cells;
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i) {
            const double x = (i + random.uniform(-0.3, 0.3)) * step;
            const double y = (j + random.uniform(-0.3, 0.3)) * step;
            mesh.vertices.emplace_back(x, y, 8.0 * std::sin(0.08 * x) * std::cos(0.06 * y));
        }
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const auto at = static_cast<std::uint32_t>(j * (cells + 1) + i);
            const auto up = at + cells + 1;
            mesh.triangles.push_back({at, at + 1, up + 1});
            mesh.triangles.push_back({at, up + 1, up});
        }
    return mesh;
}

Tool millOf(Tool::Shape shape, double corner_mm, double taper_rad) {
    Tool tool;
    tool.shape = shape;
    tool.diameter_mm = 16.0;
    if (corner_mm > 0.0) tool.corner_radius_mm = corner_mm;
    if (taper_rad > 0.0) tool.taper_rad = taper_rad;
    tool.cutting_height_mm = 40.0;
    return tool;
}

double cpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

int main() {
    constexpr std::uint64_t seed = 1;
    const TriangleMesh mesh = jittered(seed);
    std::printf(
        "drop-cutter, %zu triangles, vertices jittered by 30 %% of the cell, D16, 100 x 100 mm, seed %llu, one core\n",
        mesh.triangles.size(), static_cast<unsigned long long>(seed));
    std::printf("%-12s %14s %18s %8s\n", "cutter", "CL/s (CPU)", "OpenCAMLib CL/s *", "ratio");
    struct Row {
        const char* name;
        Tool tool;
        double open_cam_lib;
    };
    const Row rows[] = {{"ball", millOf(Tool::Shape::Ball, 0.0, 0.0), 450.0},
                        {"flat", millOf(Tool::Shape::Flat, 0.0, 0.0), 590.0},
                        {"toroidal r3", millOf(Tool::Shape::Toroidal, 3.0, 0.0), 200.0},
                        {"tapered 10", millOf(Tool::Shape::Tapered, 2.0, 0.17453292519943295), 0.0}};
    double checksum = 0.0;
    for (const Row& row : rows) {
        const auto drop = cusp::tilt::MeshDrop::make(mesh, row.tool.cutter());
        if (!drop) return 1;
        constexpr int lines = 60;
        constexpr int points = 400;
        const double start = cpuSeconds();
        for (int j = 0; j < lines; ++j) {
            std::uint32_t hint = cusp::tilt::DropContact::no_place;
            for (int i = 0; i < points; ++i)
                if (const auto contact = drop->drop((i + 0.5) * side_mm / points, (j + 0.5) * side_mm / lines, hint)) {
                    checksum += contact->tip_z_mm;
                    hint = contact->place;
                }
        }
        const double rate = lines * points / (cpuSeconds() - start);
        if (row.open_cam_lib > 0.0)
            std::printf("%-12s %14.0f %18.0f %8.0f\n", row.name, rate, row.open_cam_lib, rate / row.open_cam_lib);
        else
            std::printf("%-12s %14.0f %18s %8s\n", row.name, rate, "-", "-");
    }
    std::printf(
        "* measured before on the same class of machine and the same kind of mesh, not in this run (checksum %.6f)\n",
        checksum);
    return 0;
}
