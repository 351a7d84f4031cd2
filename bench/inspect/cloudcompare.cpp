// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Distances from the benchmark surface beside CloudCompare's cloud-to-mesh distances, in one run: time and error of both.
//
//   bench_cloudcompare [points]
#include <cusp/base/atomic_file.hpp>
#include <cusp/base/child_process.hpp>
#include <cusp/base/random.hpp>
#include <cusp/geometry/mesh_shape.hpp>
#include <cusp/geometry/parametric_surface.hpp>
#include <cusp/geometry/surface_file.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fmt/format.h>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vector>

namespace {

using cusp::geometry::Footpoint;
using cusp::geometry::MeshShape;
using cusp::geometry::ParametricSurface;
using cusp::geometry::Vector3;

constexpr std::uint64_t seed = 1;
/// 200 000 triangles.
constexpr std::uint32_t cells = 316;

double cpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

cusp::geometry::TriangleMesh meshOf(const cusp::geometry::SurfaceFace& face) {
    cusp::geometry::TriangleMesh out;
    for (std::uint32_t i = 0; i <= cells; ++i)
        for (std::uint32_t j = 0; j <= cells; ++j)
            out.vertices.push_back(
                face.evaluate(static_cast<double>(i) / cells, static_cast<double>(j) / cells).position);
    for (std::uint32_t i = 0; i < cells; ++i)
        for (std::uint32_t j = 0; j < cells; ++j) {
            const std::uint32_t a = (i * (cells + 1)) + j;
            const std::uint32_t b = a + cells + 1;
            out.triangles.push_back({a, b, b + 1});
            out.triangles.push_back({a, b + 1, a + 1});
        }
    return out;
}

struct Cloud {
    std::vector<Vector3> points;
    std::vector<double> offsets_mm;
};

/// Away from the edges, where a distance is along the normal.
Cloud cloudOf(const cusp::geometry::SurfaceFace& face, std::size_t count) {
    cusp::base::Random random(seed);
    Cloud out;
    for (std::size_t i = 0; i < count; ++i) {
        const double u = random.uniform(0.01, 0.99);
        const double v = random.uniform(0.01, 0.99);
        out.offsets_mm.push_back(random.uniform(-0.02, 0.02));
        out.points.emplace_back(face.evaluate(u, v).position + out.offsets_mm.back() * face.normal(u, v));
    }
    return out;
}

struct Figures {
    double us_per_point = 0.0;
    double mean_um = 0.0;
    double rms_um = 0.0;
    double largest_um = 0.0;
};

/// In size: which side is outside is not the question here.
Figures figuresOf(const std::vector<double>& distances_mm, const Cloud& cloud, double cpu_s) {
    Figures out;
    const auto n = static_cast<double>(distances_mm.size());
    for (std::size_t i = 0; i < distances_mm.size(); ++i) {
        const double error_um = 1e3 * (std::abs(distances_mm[i]) - std::abs(cloud.offsets_mm[i]));
        out.mean_um += error_um / n;
        out.rms_um += error_um * error_um / n;
        out.largest_um = std::max(out.largest_um, std::abs(error_um));
    }
    out.rms_um = std::sqrt(out.rms_um);
    out.us_per_point = 1e6 * cpu_s / n;
    return out;
}

Figures ours(const cusp::geometry::NominalShape& shape, const Cloud& cloud) {
    std::vector<Footpoint> feet(cloud.points.size());
    const double start = cpuSeconds();
    shape.closest(cloud.points, feet, false);
    const double cpu_s = cpuSeconds() - start;
    std::vector<double> distances;
    for (const Footpoint& foot : feet) distances.push_back(foot.distance_mm);
    return figuresOf(distances, cloud, cpu_s);
}

void write(const std::string& path, const std::string& text) {
    if (const auto done = cusp::base::writeWholeFile(path, text); !done) {
        std::fputs(cusp::base::toText(done.error()).c_str(), stderr);
        std::exit(1);
    }
}

std::string plyOf(const cusp::geometry::TriangleMesh& mesh) {
    std::string out = fmt::format(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        mesh.vertices.size(), mesh.triangles.size());
    for (const Vector3& p : mesh.vertices) out += fmt::format("{:.9f} {:.9f} {:.9f}\n", p.x(), p.y(), p.z());
    for (const auto& t : mesh.triangles) out += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
    return out;
}

/// CPU seconds of a run of CloudCompare over cloud and mesh; with `measure` also of the distances. Fewer than none: it is absent.
double cloudCompare(const std::string& folder, bool measure) {
    std::vector<std::string> words{"CloudCompare",         "-SILENT", "-AUTO_SAVE",        "OFF", "-O",
                                   folder + "/points.xyz", "-O",      folder + "/mesh.ply"};
    if (measure) words.emplace_back("-C2M_DIST");
    for (const char* word : {"-C_EXPORT_FMT", "ASC", "-PREC", "9", "-SEP", "SPACE", "-SAVE_CLOUDS", "FILE"})
        words.emplace_back(word);
    words.push_back(folder + (measure ? "/distances.asc" : "/loaded.asc"));
    const auto outcome = cusp::base::runProcess(words, {.wall_s = 600.0});
    if (!outcome) return -1.0;
    if (!outcome->succeeded()) {
        std::fprintf(stderr, "CloudCompare: %s\n%s\n", cusp::base::outcomeText(*outcome).c_str(),
                     outcome->output.c_str());
        std::exit(1);
    }
    return outcome->cpu_s;
}

std::vector<double> lastColumn(const std::string& path) {
    std::istringstream in(cusp::base::readWholeFile(path, std::size_t{1} << 30U).value_or(""));
    std::vector<double> out;
    for (std::string line; std::getline(in, line);)
        out.push_back(std::strtod(line.c_str() + line.rfind(' ') + 1, nullptr));
    return out;
}

void print(const char* name, const Figures& figures, double reference_us) {
    std::printf("%-34s %9.3f %9.4f %9.4f %9.4f %8.1f\n", name, figures.us_per_point, figures.mean_um, figures.rms_um,
                figures.largest_um, reference_us / figures.us_per_point);
}

}  // namespace

int main(int argc, char** argv) {
    const std::size_t points = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 500000;
    const auto faces =
        cusp::geometry::readSurfaceFile(std::string(CUSP_SOURCE_DIR) + "/examples/benchmark/surface.toml").value();
    const auto mesh = meshOf(faces.front());
    const Cloud cloud = cloudOf(faces.front(), points);

    const auto folder = std::filesystem::temp_directory_path() / ("cusp_cloudcompare_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    std::string text;
    for (const Vector3& p : cloud.points) text += fmt::format("{:.9f} {:.9f} {:.9f}\n", p.x(), p.y(), p.z());
    write((folder / "points.xyz").string(), text);
    write((folder / "mesh.ply").string(), plyOf(mesh));
    ::setenv("QT_QPA_PLATFORM", "offscreen", 1);
    // Reading and writing files is in both runs, so that their difference is the distances.
    const double loading_s = cloudCompare(folder.string(), false);
    Figures theirs;
    if (loading_s >= 0.0) {
        const double cpu_s = cloudCompare(folder.string(), true) - loading_s;
        const auto distances = lastColumn((folder / "distances.asc").string());
        if (distances.size() != points) {
            std::fprintf(stderr, "CloudCompare wrote %zu distances of %zu\n", distances.size(), points);
            return 1;
        }
        theirs = figuresOf(distances, cloud, cpu_s);
    }
    std::filesystem::remove_all(folder);

    std::printf("%zu points within 0.02 mm of the benchmark surface; CPU µs per point, errors of |distance| in µm\n",
                points);
    std::printf("%-34s %9s %9s %9s %9s %8s\n", "", "µs", "mean", "rms", "largest", "ratio");
    if (loading_s < 0.0)
        std::printf("skipped: CloudCompare is not installed (scripts/deps.sh bench)\n");
    else
        print("CloudCompare, 200 000 triangles", theirs, theirs.us_per_point);
    print("cusp, the same triangles", ours(MeshShape(mesh), cloud), theirs.us_per_point);
    print("cusp, the surface itself", ours(ParametricSurface(faces), cloud), theirs.us_per_point);
    return 0;
}
