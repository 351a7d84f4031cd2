// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Marching cubes slab by slab: which nodes are inside by the rays along Z, where edges cross by the rays along them.
#include <cusp/simulation/stock_surface.hpp>

#include "cube_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cusp::simulation {

using geometry::TriangleMesh;
using geometry::Vector3;

namespace {

constexpr std::uint32_t no_vertex = static_cast<std::uint32_t>(-1);
/// Vertices stay this much of a cell away from its corners, so that none fall together when written as 32-bit floats.
constexpr double margin = 1e-3;

/// Every stride-th node and one more on each side, outside the stock: 0 … count + 1.
class Mesher {
public:
    Mesher(const Stock& stock, std::size_t stride) : stock_(stock), stride_(std::max<std::size_t>(1, stride)) {
        for (int axis = 0; axis < 3; ++axis) {
            count_[axis] = (stock.lattice().count[axis] - 1) / stride_ + 1;
            step_[axis] = stock.lattice().step_mm[axis] * static_cast<double>(stride_);
        }
    }

    [[nodiscard]] TriangleMesh run() {
        const std::size_t slab = (count_[1] + 2) * (count_[2] + 2);
        for (auto& nodes : inside_) nodes.assign(slab, 0);
        for (auto& vertices : vertices_) vertices.assign(slab, no_vertex);
        for (std::size_t i = 0; i <= count_[0]; ++i) {
            // Slabs i and i + 1; the second becomes the first.
            std::swap(inside_[0], inside_[1]);
            std::swap(vertices_[along_y], vertices_[along_y_next]);
            std::swap(vertices_[along_z], vertices_[along_z_next]);
            for (const auto kind : {along_x, along_y_next, along_z_next})
                std::fill(vertices_[kind].begin(), vertices_[kind].end(), no_vertex);
            fillInside(i + 1);
            for (std::size_t j = 0; j <= count_[1]; ++j)
                for (std::size_t k = 0; k <= count_[2]; ++k) cell(i, j, k);
        }
        return std::move(mesh_);
    }

private:
    enum Kind : std::size_t { along_x, along_y, along_y_next, along_z, along_z_next, kinds };

    [[nodiscard]] std::size_t at(std::size_t j, std::size_t k) const { return j * (count_[2] + 2) + k; }
    [[nodiscard]] double place(int axis, std::size_t i) const {
        const double first = stock_.lattice().node(axis, 0);
        return first + (static_cast<double>(i) - 1.0) * step_[axis];
    }

    void fillInside(std::size_t i) {
        auto& nodes = inside_[1];
        std::fill(nodes.begin(), nodes.end(), std::uint8_t{0});
        if (i == 0 || i > count_[0]) return;
        for (std::size_t j = 1; j <= count_[1]; ++j)
            for (const DexelSpan& span : stock_.ray(2, (i - 1) * stride_, (j - 1) * stride_)) {
                const double first = std::ceil((span.from_mm - place(2, 1)) / step_[2]);
                const double last = std::floor((span.to_mm - place(2, 1)) / step_[2]);
                const double top = static_cast<double>(count_[2]) - 1.0;
                for (double k = std::max(first, 0.0); k <= std::min(last, top); k += 1.0)
                    nodes[at(j, static_cast<std::size_t>(k) + 1)] = 1;
            }
    }

    void cell(std::size_t i, std::size_t j, std::size_t k) {
        std::uint8_t inside = 0;
        for (std::size_t corner = 0; corner < 8; ++corner) {
            const std::size_t node = at(j + (corner >> 1U & 1U), k + (corner >> 2U));
            if (inside_[corner & 1U][node] != 0) inside = static_cast<std::uint8_t>(inside | 1U << corner);
        }
        if (inside == 0 || inside == 255) return;
        for (const CubeTable::Polygon& polygon : table_.of(inside)) {
            std::array<std::uint32_t, CubeTable::edges + 1> vertex{};
            Vector3 middle = Vector3::Zero();
            for (const std::uint8_t edge : polygon.edges) {
                vertex[edge] = crossing(edge, {i, j, k}, inside);
                middle += mesh_.vertices[vertex[edge]] / static_cast<double>(polygon.edges.size());
            }
            if (polygon.triangles.front()[0] == CubeTable::center) {
                vertex[CubeTable::center] = static_cast<std::uint32_t>(mesh_.vertices.size());
                mesh_.vertices.push_back(middle);
            }
            for (const CubeTable::Triangle& t : polygon.triangles)
                mesh_.triangles.push_back({vertex[t[0]], vertex[t[1]], vertex[t[2]]});
        }
    }

    /// The vertex on an edge of a cell, made when it is first asked for.
    std::uint32_t crossing(std::size_t edge, const std::array<std::size_t, 3>& cell, std::uint8_t inside) {
        const std::size_t corner = CubeTable::cornerOf(edge);
        const std::array<std::size_t, 3> node{cell[0] + (corner & 1U), cell[1] + (corner >> 1U & 1U),
                                              cell[2] + (corner >> 2U)};
        const int axis = static_cast<int>(CubeTable::axisOf(edge));
        const bool next_slab = node[0] > cell[0];
        const Kind kind = axis == 0   ? along_x
                          : axis == 1 ? (next_slab ? along_y_next : along_y)
                                      : (next_slab ? along_z_next : along_z);
        std::uint32_t& vertex = vertices_[kind][at(node[1], node[2])];
        if (vertex != no_vertex) return vertex;
        vertex = static_cast<std::uint32_t>(mesh_.vertices.size());
        Vector3 position;
        for (int k = 0; k < 3; ++k) position[k] = place(k, node[static_cast<std::size_t>(k)]);
        const bool leaves = (inside >> corner & 1U) != 0;
        position[axis] = endOfSpan(axis, node, leaves, position[axis]);
        mesh_.vertices.push_back(position);
        return vertex;
    }

    /// Where on an edge from `low` upwards the material ends (`leaves`) or begins, as the ray along it says; the middle when it
    /// disagrees with the rays along Z.
    [[nodiscard]] double endOfSpan(int axis, const std::array<std::size_t, 3>& node, bool leaves, double low) const {
        const double high = low + step_[axis];
        const std::size_t u = node[static_cast<std::size_t>((axis + 1) % 3)];
        const std::size_t v = node[static_cast<std::size_t>((axis + 2) % 3)];
        double found = 0.5 * (low + high);
        for (const DexelSpan& span : stock_.ray(axis, (u - 1) * stride_, (v - 1) * stride_)) {
            const double end = leaves ? span.to_mm : span.from_mm;
            if (end < low || end > high) continue;
            found = end;
            if (leaves) break;  // the first way out; the last way in
        }
        return std::clamp(found, low + margin * step_[axis], high - margin * step_[axis]);
    }

    const Stock& stock_;
    std::size_t stride_;
    PerAxis<std::size_t> count_;
    Vector3 step_ = Vector3::Zero();
    CubeTable table_;
    TriangleMesh mesh_;
    std::array<std::vector<std::uint8_t>, 2> inside_;
    std::array<std::vector<std::uint32_t>, kinds> vertices_;
};

}  // namespace

TriangleMesh surfaceMesh(const Stock& stock, std::size_t stride) { return Mesher(stock, stride).run(); }

double enclosedVolume(const TriangleMesh& mesh) {
    if (mesh.vertices.empty()) return 0.0;
    const Vector3 origin = mesh.vertices.front();
    double volume = 0.0;
    for (const auto& t : mesh.triangles)
        volume +=
            (mesh.vertices[t[0]] - origin).dot((mesh.vertices[t[1]] - origin).cross(mesh.vertices[t[2]] - origin));
    return volume / 6.0;
}

}  // namespace cusp::simulation
