// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// On each face of a cell, a run of inside corners is cut off by one segment. Where two opposite corners are inside, each is cut
// off by itself: both cells at the face do the same, so that their segments are the same and the mesh is closed. The segments
// of a cell's faces link to polygons.
#include "cube_table.hpp"

#include <algorithm>
#include <optional>

namespace cusp::simulation {
namespace {

/// Corners of the six faces, counter-clockwise seen from outside the cell.
using Face = std::array<std::size_t, 4>;
constexpr std::array<Face, 6> faces{
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

std::uint8_t edgeBetween(std::size_t a, std::size_t b) {
    for (std::size_t edge = 0; edge < CubeTable::edges; ++edge) {
        const std::size_t from = CubeTable::cornerOf(edge);
        const std::size_t to = from + (std::size_t{1} << CubeTable::axisOf(edge));
        if ((from == a && to == b) || (from == b && to == a)) return static_cast<std::uint8_t>(edge);
    }
    return CubeTable::center;
}

bool onOneFace(std::uint8_t a, std::uint8_t b) {
    return std::any_of(faces.begin(), faces.end(), [&](const Face& face) {
        bool has_a = false;
        bool has_b = false;
        for (std::size_t i = 0; i < 4; ++i) {
            const std::uint8_t edge = edgeBetween(face[i], face[(i + 1) % 4]);
            has_a = has_a || edge == a;
            has_b = has_b || edge == b;
        }
        return has_a && has_b;
    });
}

/// A fan's first corner such that none of its inner edges lies on a face, where the next cell might have the same edge.
std::optional<std::size_t> fanCorner(const std::vector<std::uint8_t>& edges) {
    for (std::size_t first = 0; first < edges.size(); ++first) {
        bool free = true;
        for (std::size_t k = 2; k + 1 < edges.size(); ++k)
            free = free && !onOneFace(edges[first], edges[(first + k) % edges.size()]);
        if (free) return first;
    }
    return std::nullopt;
}

void triangulate(CubeTable::Polygon& polygon) {
    const auto& edges = polygon.edges;
    const std::size_t n = edges.size();
    if (const auto first = fanCorner(edges))
        for (std::size_t k = 1; k + 1 < n; ++k)
            polygon.triangles.push_back({edges[*first], edges[(*first + k) % n], edges[(*first + k + 1) % n]});
    else
        for (std::size_t k = 0; k < n; ++k)
            polygon.triangles.push_back({CubeTable::center, edges[k], edges[(k + 1) % n]});
}

/// Of each edge that a polygon comes to, the edge it goes to.
std::array<std::uint8_t, CubeTable::edges> linksOf(std::size_t inside) {
    std::array<std::uint8_t, CubeTable::edges> next{};
    next.fill(CubeTable::center);
    const auto isInside = [&](std::size_t corner) { return (inside >> corner & 1U) != 0; };
    for (const Face& face : faces)
        for (std::size_t i = 0; i < 4; ++i) {
            // A run of inside corners begins behind corner i.
            if (isInside(face[i]) || !isInside(face[(i + 1) % 4])) continue;
            std::size_t end = i + 1;
            while (isInside(face[(end + 1) % 4])) ++end;
            next[edgeBetween(face[i], face[(i + 1) % 4])] = edgeBetween(face[end % 4], face[(end + 1) % 4]);
        }
    return next;
}

}  // namespace

std::size_t CubeTable::cornerOf(std::size_t edge) {
    const std::size_t axis = axisOf(edge);
    return (edge & 1U) << (axis + 1) % 3 | (edge >> 1U & 1U) << (axis + 2) % 3;
}

CubeTable::CubeTable() {
    for (std::size_t inside = 0; inside < cells_.size(); ++inside) {
        auto next = linksOf(inside);
        for (std::size_t first = 0; first < edges; ++first) {
            Polygon polygon;
            for (std::size_t edge = first; next[edge] != center;) {
                polygon.edges.push_back(static_cast<std::uint8_t>(edge));
                const std::size_t to = next[edge];
                next[edge] = center;
                edge = to;
            }
            if (polygon.edges.empty()) continue;
            triangulate(polygon);
            cells_[inside].push_back(std::move(polygon));
        }
    }
}

}  // namespace cusp::simulation
