// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Edges by sorting, equal vertices by sorting: the same result for the same mesh, whatever the hash of the day.
#include <cusp/geometry/triangle_mesh.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

namespace cusp::geometry {
namespace {

struct HalfEdge {
    std::uint32_t low;
    std::uint32_t high;
    bool ascending;  ///< the triangle runs from `low` to `high`
};

bool lessByCoordinates(const Vector3& a, const Vector3& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

}  // namespace

MeshEdges checkEdges(const TriangleMesh& mesh) {
    std::vector<HalfEdge> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (const TriangleMesh::Triangle& t : mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = t[k];
            const std::uint32_t to = t[(k + 1) % 3];
            edges.push_back({std::min(from, to), std::max(from, to), from < to});
        }
    }
    std::sort(edges.begin(), edges.end(),
              [](const HalfEdge& a, const HalfEdge& b) { return std::pair(a.low, a.high) < std::pair(b.low, b.high); });
    MeshEdges out;
    for (std::size_t i = 0; i < edges.size();) {
        std::size_t end = i;
        std::size_t ascending = 0;
        for (; end < edges.size() && edges[end].low == edges[i].low && edges[end].high == edges[i].high; ++end) {
            if (edges[end].ascending) ++ascending;
        }
        const std::size_t count = end - i;
        if (count == 1) ++out.open;
        if (count > 2) ++out.crowded;
        if (count == 2 && ascending != 1) ++out.reversed;
        i = end;
    }
    return out;
}

TriangleMesh welded(const TriangleMesh& mesh, std::size_t& collapsed) {
    std::vector<std::uint32_t> order(mesh.vertices.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        if (lessByCoordinates(mesh.vertices[a], mesh.vertices[b])) return true;
        return !lessByCoordinates(mesh.vertices[b], mesh.vertices[a]) && a < b;
    });
    // The first of equal vertices stands for all, and vertices keep the order of the file.
    std::vector<std::uint32_t> stands_for(mesh.vertices.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && mesh.vertices[order[i]] == mesh.vertices[order[i - 1]];
        stands_for[order[i]] = same ? stands_for[order[i - 1]] : order[i];
    }
    TriangleMesh out;
    std::vector<std::uint32_t> renumbered(mesh.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
        if (stands_for[i] == i) {
            renumbered[i] = static_cast<std::uint32_t>(out.vertices.size());
            out.vertices.push_back(mesh.vertices[i]);
        } else {
            renumbered[i] = renumbered[stands_for[i]];
        }
    }
    collapsed = 0;
    for (const TriangleMesh::Triangle& t : mesh.triangles) {
        const TriangleMesh::Triangle n{renumbered[t[0]], renumbered[t[1]], renumbered[t[2]]};
        if (n[0] == n[1] || n[1] == n[2] || n[2] == n[0]) {
            ++collapsed;
        } else {
            out.triangles.push_back(n);
        }
    }
    return out;
}

}  // namespace cusp::geometry
