// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// How far from a cell one may stand on a surface normal so that no other point of the whole shape can be nearer: a bound
// computed once, after which a single stationary point is proof.
#pragma once

#include "box_tree.hpp"
#include "patch_cells.hpp"

#include <cusp/geometry/surface_face.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace cusp::geometry::detail {

/// How far beyond its cell a foot may lie and still be covered by the cell's reach, in half widths from its middle.
inline constexpr double reach_scope = 2.0;

/// Where a patch lies in the shape.
struct PatchPlace {
    std::size_t face = 0;
    std::size_t row = 0;     ///< of the face's grid of patches, along u
    std::size_t column = 0;  ///< along v
};

/// Reaches of cells. Federer's formula (1959, 4.18): the foot x of a query at distance d on the normal n is the nearest
/// point if d ≤ |y − x|² / (2 |n·(y − x)|) for all y of the shape.
class ReachFinder {
public:
    /// Cells of one patch are consecutive in `cells`, patches of one face consecutive in `places`, in the order of the face.
    ReachFinder(std::span<const SurfaceFace> faces, std::span<const PatchPlace> places,
                std::span<const PatchCell> cells, const BoxTree& tree, std::span<const Eigen::AlignedBox3d> boxes);

    /// For every foot within `reach_scope` of the cell and on its patch; mm, 0 when nothing can be promised.
    [[nodiscard]] double reachOf(std::size_t cell) const;

private:
    struct Window;
    [[nodiscard]] Window windowAround(std::size_t cell, double half_widths) const;
    /// Cells that touch the window; those wholly inside it.
    [[nodiscard]] std::vector<std::size_t> cellsTouching(const Window& window) const;
    [[nodiscard]] std::vector<std::size_t> cellsInside(const Window& window, std::vector<std::size_t> touching) const;
    /// Holds every foot within `reach_scope` of the cell.
    [[nodiscard]] Eigen::AlignedBox3d scopeBox(std::size_t cell, const std::vector<std::size_t>& touching) const;
    [[nodiscard]] double curvatureReach(std::size_t cell, const std::vector<std::size_t>& touching) const;
    [[nodiscard]] double distanceToOthers(const Eigen::AlignedBox3d& box, const std::vector<std::size_t>& inside) const;
    [[nodiscard]] ParameterBox faceBoxOf(std::size_t cell) const;

    std::span<const SurfaceFace> faces_;
    std::span<const PatchPlace> places_;
    std::span<const PatchCell> cells_;
    const BoxTree& tree_;
    std::span<const Eigen::AlignedBox3d> boxes_;
    std::vector<ParameterBox> face_boxes_;     ///< of each cell, in the parameters of its face
    std::vector<std::size_t> first_cell_;      ///< of each patch, and the end
    std::vector<std::size_t> first_patch_;     ///< of each face
    std::vector<std::vector<bool>> smooth_u_;  ///< of each face: is the break between rows i and i + 1 smooth?
    std::vector<std::vector<bool>> smooth_v_;
};

}  // namespace cusp::geometry::detail
