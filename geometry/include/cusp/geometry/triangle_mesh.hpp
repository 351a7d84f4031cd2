// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Triangles that share vertices, and whether they close a volume.
#pragma once

#include <cusp/geometry/frames.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cusp::geometry {

/// Vertices in mm. A triangle names three different vertices, counter-clockwise seen from outside the material.
struct TriangleMesh {
    using Triangle = std::array<std::uint32_t, 3>;
    std::vector<Vector3> vertices;
    std::vector<Triangle> triangles;
};

/// How the edges of a mesh join its triangles. In a mesh that closes a volume each edge joins two triangles, which run along
/// it in opposite directions.
struct MeshEdges {
    std::size_t open = 0;      ///< of one triangle only
    std::size_t crowded = 0;   ///< of more than two
    std::size_t reversed = 0;  ///< of two triangles that run along it in the same direction: one is inside out

    [[nodiscard]] bool isClosed() const { return open == 0 && crowded == 0 && reversed == 0; }
};

[[nodiscard]] MeshEdges checkEdges(const TriangleMesh& mesh);

/// The same triangles over vertices no two of which have the same coordinates; triangles that name one of them twice are
/// gone, and counted in `collapsed`.
[[nodiscard]] TriangleMesh welded(const TriangleMesh& mesh, std::size_t& collapsed);

}  // namespace cusp::geometry
