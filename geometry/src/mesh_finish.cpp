// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// From the triangles of a file to a mesh that can be measured against.
#include "mesh_finish.hpp"

#include <fmt/format.h>

namespace cusp::geometry::detail {
namespace {

void warnOfEdges(const MeshEdges& edges, const base::Location& where, base::Diagnostics& report) {
    if (edges.open > 0) {
        report.warning("mesh.open",
                       fmt::format("the mesh is not closed: {} edges belong to one triangle only", edges.open), where);
    }
    if (edges.crowded > 0) {
        report.warning("mesh.crowded", fmt::format("{} edges belong to more than two triangles", edges.crowded), where);
    }
    if (edges.reversed > 0) {
        report.warning("mesh.reversed",
                       fmt::format("at {} edges one of the two triangles is inside out: signs of distances near them "
                                   "are not reliable",
                                   edges.reversed),
                       where);
    }
}

}  // namespace

base::Result<TriangleMesh> finishMesh(const TriangleMesh& mesh, const std::string& file_name,
                                      base::Diagnostics& report) {
    base::Location where;
    where.file = file_name;
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        // Eigen's maximum may pass over what is no number.
        if (!mesh.vertices[i].allFinite() || mesh.vertices[i].cwiseAbs().maxCoeff() > largest_coordinate_mm) {
            return base::fail("mesh.number", fmt::format("vertex {}: a coordinate is not a number or beyond 1e9 mm", i),
                              where);
        }
    }
    std::size_t collapsed = 0;
    TriangleMesh out = welded(mesh, collapsed);
    if (out.triangles.empty()) return base::fail("mesh.empty", "there is no triangle in the mesh", where);
    if (collapsed > 0) {
        report.warning("mesh.collapsed", fmt::format("{} triangles with two equal corners are left out", collapsed),
                       where);
    }
    warnOfEdges(checkEdges(out), where, report);
    return out;
}

}  // namespace cusp::geometry::detail
