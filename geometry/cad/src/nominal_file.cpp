// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Which reader a file is for, by the ending of its name.
#include <cusp/geometry/cad/nominal_file.hpp>
#include <cusp/geometry/mesh_file.hpp>
#include <cusp/geometry/mesh_shape.hpp>
#include <cusp/geometry/parametric_surface.hpp>
#include <cusp/geometry/surface_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace cusp::geometry {
namespace {

std::string endingOf(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return ending;
}

}  // namespace

base::Result<std::unique_ptr<NominalShape>> loadNominal(const std::string& path, base::Diagnostics& report) {
    const std::string ending = endingOf(path);
    if (ending == ".toml") {
        auto faces = readSurfaceFile(path);
        if (!faces) return base::fail(std::move(faces).error());
        return std::make_unique<ParametricSurface>(*std::move(faces));
    }
    if (ending == ".stl" || ending == ".ply") {
        auto mesh = readMeshFile(path, report);
        if (!mesh) return base::fail(std::move(mesh).error());
        return std::make_unique<MeshShape>(*std::move(mesh));
    }
    base::Location where;
    where.file = path;
    return base::fail(
        "nominal.unknown-format",
        fmt::format("'{}' is no ending of a nominal shape; .toml (surface), .stl and .ply (mesh) are", ending), where);
}

base::Result<std::unique_ptr<NominalShape>> loadNominal(const std::string& path) {
    base::Diagnostics report;
    return loadNominal(path, report);
}

}  // namespace cusp::geometry
