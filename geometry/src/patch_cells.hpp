// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Patches cut into cells that bend little: over most of them the distance to a near point is convex.
#pragma once

#include "box_newton.hpp"
#include "patch_bounds.hpp"

#include <cusp/geometry/bezier_patch.hpp>

#include <cstdint>
#include <vector>

namespace cusp::geometry::detail {

struct PatchCell {
    std::uint32_t patch = 0;
    ParameterBox box;
    PatchBounds bounds;
    Eigen::AlignedBox3d hull;  ///< of its control points
};

/// Cells that together cover the patch, appended to `cells`. Where a patch does not become flat (a pole), cutting ends at
/// a fixed depth, and the exact search takes over.
void cutIntoCells(const BezierPatch& patch, std::uint32_t index, std::vector<PatchCell>& cells);

/// The part of the patch over a box whose corners are dyadic fractions, as a patch of its own.
[[nodiscard]] BezierPatch partOf(const BezierPatch& patch, const ParameterBox& box);

}  // namespace cusp::geometry::detail
