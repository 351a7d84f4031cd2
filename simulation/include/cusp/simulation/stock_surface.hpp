// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What is left of a stock: its surface as a closed mesh, and its deviation from a nominal shape.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/closest_point.hpp>
#include <cusp/geometry/triangle_mesh.hpp>
#include <cusp/simulation/stock.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cusp::simulation {

/// The surface as a mesh that is closed whatever was cut (geometry::checkEdges): marching cubes over every `stride`-th node,
/// its vertices where the rays end. Between rays it is straight: edges of the part are cut off by up to half a cell.
[[nodiscard]] geometry::TriangleMesh surfaceMesh(const Stock& stock, std::size_t stride = 1);

/// Enclosed by a closed mesh, by the divergence theorem. Of a stock's surface mesh it is within O(h²) of the volume.
[[nodiscard]] double enclosedVolume(const geometry::TriangleMesh& mesh);

/// An end of a span that a move cut, measured against the nominal.
struct DeviationPoint {
    geometry::Vector3 position = geometry::Vector3::Zero();
    double deviation_mm = 0.0;               ///< along the nominal's outward normal: < 0 overcut, > 0 material left
    double area_mm2 = 0.0;                   ///< that the point stands for
    std::uint32_t move = DexelSpan::no_cut;  ///< as the stock came
};

struct DeviationSummary {
    std::size_t points = 0;        ///< cut by moves, and beside the nominal (its nearest point is no edge of it)
    double overcut_max_mm = 0.0;   ///< > 0
    double undercut_max_mm = 0.0;  ///< > 0
    double mean_mm = 0.0;          ///< by area
    double within_tolerance_percent = 0.0;  ///< by area
    double uncut_max_mm = 0.0;              ///< farthest outside the nominal that the stock's own surface is left
    std::size_t deepest = 0;                ///< index of the largest overcut
    std::size_t highest = 0;                ///< of the largest undercut
};

struct StockDeviation {
    std::vector<DeviationPoint> points;
    DeviationSummary summary;
};

/// Every `stride`-th ray of each direction. The points are where the tool left the surface, exact as the cuts are; points
/// whose nearest point on an open nominal is its edge are left out.
[[nodiscard]] StockDeviation stockDeviation(const Stock& stock, const geometry::NominalShape& nominal,
                                            double tolerance_mm, std::size_t stride = 1);

}  // namespace cusp::simulation
