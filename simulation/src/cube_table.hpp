// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Marching cubes without a typed-in table: how the surface runs through a cell, from which of its corners are inside.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cusp::simulation {

/// Corner c of a cell is at (c & 1, c >> 1 & 1, c >> 2 & 1). Edge e runs along axis e / 4 from the corner whose two other
/// coordinates are the bits of e % 4 (first the next axis, then the one after).
class CubeTable {
public:
    static constexpr std::size_t edges = 12;
    static constexpr std::uint8_t center = 12;  ///< a vertex of the cell's own, amid a polygon's

    using Triangle = std::array<std::uint8_t, 3>;
    struct Polygon {
        std::vector<std::uint8_t> edges;  ///< whose crossings are its corners, counter-clockwise seen from outside
        std::vector<Triangle> triangles;  ///< of those edges, or of `center`
    };

    CubeTable();
    [[nodiscard]] const std::vector<Polygon>& of(std::uint8_t inside) const { return cells_[inside]; }

    /// The corner an edge begins at.
    [[nodiscard]] static std::size_t cornerOf(std::size_t edge);
    [[nodiscard]] static std::size_t axisOf(std::size_t edge) { return edge / 4; }

private:
    std::array<std::vector<Polygon>, 256> cells_;
};

}  // namespace cusp::simulation
