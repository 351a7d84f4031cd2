// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Meshes from STL and PLY files, text or binary.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/triangle_mesh.hpp>

#include <string>
#include <string_view>

namespace cusp::geometry {

/// The formats do not know units; coordinates count as mm. Vertices with equal coordinates become one. Orientation is that of
/// the corners; normals in the file are not used.
///
/// Warnings go to `report`: `mesh.open`, `mesh.crowded`, `mesh.reversed` (see MeshEdges), `mesh.collapsed`.
/// Errors, with line (text) or byte (binary): `mesh.format`, `mesh.truncated`, `mesh.number`, `mesh.index`, `mesh.empty`,
/// `mesh.too-large`.
[[nodiscard]] base::Result<TriangleMesh> readStl(std::string_view bytes, const std::string& file_name,
                                                 base::Diagnostics& report);
/// PLY 1.0: the elements `vertex` (x, y, z) and `face` (a list vertex_indices or vertex_index); polygons are cut into fans.
[[nodiscard]] base::Result<TriangleMesh> readPly(std::string_view bytes, const std::string& file_name,
                                                 base::Diagnostics& report);
/// Whole file; `.stl` or `.ply` by the ending of its name. Further errors: those of `readWholeFile`.
[[nodiscard]] base::Result<TriangleMesh> readMeshFile(const std::string& path, base::Diagnostics& report);

}  // namespace cusp::geometry
