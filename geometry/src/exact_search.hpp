// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The nearest point of a piece of a patch without any assumption: branch and bound on the squared distance as a
// Bernstein polynomial.
#pragma once

#include "box_newton.hpp"

#include <cusp/geometry/bezier_patch.hpp>

#include <cstdint>
#include <functional>

namespace cusp::geometry::detail {

/// The distance of what the search returns exceeds the least one by no more than this.
inline constexpr double search_tolerance_mm = 1e-11;

/// How much of a box of parameters belongs to a trimmed face.
enum class Coverage : std::uint8_t { Outside, Partly, Wholly };

/// A piece this small at an edge is left to the search along the edge: a stationary point this near to it is nearer to the
/// query by no more than 1e-12 mm² / (2 · distance).
inline constexpr double edge_width_mm = 1e-6;

/// What the caller of a search decides.
struct SearchRules {
    /// Takes a foot better than the limit and returns the new limit: its squared distance, or the old limit if it does not
    /// count, as outside of a trimmed face.
    std::function<double(const PatchFoot&)> take;
    /// How much of a box counts; empty when all does.
    std::function<Coverage(const ParameterBox&)> coverage;
};

/// Looks for the least distance over the box (dyadic corners) below `limit_squared`. `query` is relative to the origin of the
/// patch.
void searchExactly(const BezierPatch& patch, const ParameterBox& box, const Vector3& query, double limit_squared,
                   const SearchRules& rules);

}  // namespace cusp::geometry::detail
