// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Writes the files of a simulation side by side and lets them appear together.
#include "simulate_page.hpp"
#include "simulate_run.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/number_text.hpp>

#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

namespace cusp::cli {
namespace {

constexpr double most_mesh_triangles = 4e6;

template <class Value>
void appendBytes(std::string& out, Value value) {
    char bytes[sizeof(Value)];
    std::memcpy(bytes, &value, sizeof(Value));
    out.append(bytes, sizeof(Value));
}

/// PLY 1.0, binary, little-endian as every machine cusp runs on.
std::string plyOf(const geometry::TriangleMesh& mesh) {
    std::string out = fmt::format("ply\nformat binary_little_endian 1.0\ncomment made by cusp; coordinates in mm\n"
                                  "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
                                  "element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
                                  mesh.vertices.size(), mesh.triangles.size());
    for (const geometry::Vector3& v : mesh.vertices)
        for (int k = 0; k < 3; ++k) appendBytes(out, v[k]);
    for (const auto& t : mesh.triangles) {
        out += '\3';
        for (const std::uint32_t corner : t) appendBytes(out, corner);
    }
    return out;
}

/// Finer than the page's; as fine as the rays unless that is millions of triangles.
std::string stockPly(const SimulateResult& done) {
    const simulation::DexelLattice& lattice = done.after.lattice();
    double triangles = 0.0;
    for (int axis = 0; axis < 3; ++axis)
        triangles += 4.0 * static_cast<double>(lattice.count[(axis + 1) % 3]) *
                     static_cast<double>(lattice.count[(axis + 2) % 3]);
    std::size_t stride = 1;
    while (triangles / static_cast<double>(stride * stride) > most_mesh_triangles) ++stride;
    return plyOf(simulation::surfaceMesh(done.after, stride));
}

std::string movesCsv(const SimulateInput& input, const SimulateResult& done) {
    std::string out = "move,line,kind,length_mm,removed_mm3,axial_engagement_mm,radial_engagement_mm\n";
    for (std::size_t i = 0; i < input.path.moves.size(); ++i) {
        const simulation::ToolMove& move = input.path.moves[i];
        const simulation::MoveEngagement& e = done.milling.moves[i];
        out += fmt::format(
            "{},{},{},{},{},{},{}\n", i, move.line, move.kind == toolpath::MotionKind::Rapid ? "rapid" : "feed",
            base::formatShortest((move.to.tip_mm - move.from.tip_mm).norm()), base::formatShortest(e.volume_mm3),
            base::formatShortest(e.axial_mm), base::formatShortest(e.radial_mm));
    }
    return out;
}

std::string deviationsCsv(const SimulateInput& input, const SimulateResult& done) {
    std::string out = "x_mm,y_mm,z_mm,deviation_mm,area_mm2,move,line\n";
    for (const simulation::DeviationPoint& point : done.deviation->points) {
        for (const double value :
             {point.position.x(), point.position.y(), point.position.z(), point.deviation_mm, point.area_mm2})
            out += base::formatShortest(value) + ",";
        out += fmt::format("{},{}\n", point.move, input.path.moves[point.move].line);
    }
    return out;
}

}  // namespace

base::Result<void> writeSimulation(const SimulateFlags& flags, const SimulateInput& input, const SimulateResult& done) {
    std::error_code error;
    std::filesystem::create_directories(flags.output, error);
    if (error) return base::fail("io.open", fmt::format("{}: {}", flags.output, error.message()));
    const SimulateMeshes meshes = meshesOf(input, done);
    std::vector<base::AtomicFile> files;
    const auto write = [&](const char* name, const std::string& bytes) -> base::Result<void> {
        auto file = base::AtomicFile::create((std::filesystem::path(flags.output) / name).string());
        if (!file) return base::fail(file.error());
        files.push_back(*std::move(file));
        return files.back().write(bytes);
    };
    const auto page = simulatePage(flags, input, done, meshes);
    if (!page) return base::fail(page.error());
    const auto summary = base::jsonText(simulateSummary(flags, input, done));
    if (!summary) return base::fail(summary.error());
    std::vector<std::pair<const char*, std::string>> outputs;
    outputs.emplace_back("simulation.html", *page);
    outputs.emplace_back("summary.json", *summary);
    outputs.emplace_back("stock.ply", stockPly(done));
    outputs.emplace_back("moves.csv", movesCsv(input, done));
    outputs.emplace_back("before.png", simulatePng(flags, done, meshes, SimulatePicture::Before));
    outputs.emplace_back("after.png", simulatePng(flags, done, meshes, SimulatePicture::After));
    if (done.deviation) {
        outputs.emplace_back("deviations.csv", deviationsCsv(input, done));
        outputs.emplace_back("deviation.png", simulatePng(flags, done, meshes, SimulatePicture::Deviation));
    }
    for (const auto& [name, bytes] : outputs)
        if (const auto ok = write(name, bytes); !ok) return ok;
    for (base::AtomicFile& file : files)
        if (const auto ok = file.commit(); !ok) return ok;
    return {};
}

}  // namespace cusp::cli
