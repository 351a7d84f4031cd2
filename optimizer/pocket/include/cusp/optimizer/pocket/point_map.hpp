// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The points a tool has to visit, and which of them are neighbours (Mitić 2023, section 2.2, fig. 6).
#pragma once

#include <cusp/optimizer/pocket/pocket_area.hpp>

#include <cstdint>
#include <vector>

namespace cusp::pocket {

/// A grid at the radial depth of cut over the allowed region, and points on its boundary, the contour offset by half the
/// diameter. Points whose tool touches no material are peripheral: the tool may be there from the start.
struct PointMap {
    double spacing_mm = 0.0;
    std::vector<Point> points;
    std::vector<bool> on_contour;
    std::vector<bool> peripheral;
    std::vector<double> wall_mm;   ///< distance to the boundary of the allowed region
    std::vector<double> depth_mm;  ///< inside the stock: distance to its edge; outside below zero
    /// The set K of the paper: up to 24 nearest, joined by a line that stays allowed (eq. 13, 14).
    std::vector<std::vector<std::uint32_t>> neighbours;
};

inline constexpr std::size_t most_neighbours = 24;

/// Errors: `pocket.too-many-points` above `most_points`, with the radial depth that would do.
[[nodiscard]] base::Result<PointMap> pointMap(const PocketArea& area, double spacing_mm, std::size_t most_points);

}  // namespace cusp::pocket
