// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Which reader a file is for, by the ending of its name.
#include "file_ending.hpp"

#include <cusp/geometry/cad/cad_file.hpp>
#include <cusp/geometry/cad/nominal_file.hpp>
#include <cusp/geometry/mesh_file.hpp>
#include <cusp/geometry/mesh_shape.hpp>
#include <cusp/geometry/parametric_surface.hpp>
#include <cusp/geometry/surface_file.hpp>

#include <fmt/format.h>

#include <utility>

namespace cusp::geometry {
base::Result<std::unique_ptr<NominalShape>> loadNominal(const std::string& path, base::Diagnostics& report) {
    const std::string ending = detail::endingOf(path);
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
    if (ending == ".step" || ending == ".stp" || ending == ".iges" || ending == ".igs") {
        auto shape = readCadFile(path, report);
        if (!shape) return base::fail(std::move(shape).error());
        return std::make_unique<ParametricSurface>(*std::move(shape));
    }
    base::Location where;
    where.file = path;
    return base::fail(
        "nominal.unknown-format",
        fmt::format(
            "'{}' is no ending of a nominal shape; .toml (surface), .step, .stp, .iges and .igs (CAD), .stl and .ply (mesh) are",
            ending),
        where);
}

base::Result<std::unique_ptr<NominalShape>> loadNominal(const std::string& path) {
    base::Diagnostics report;
    return loadNominal(path, report);
}

}  // namespace cusp::geometry
