// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The nearest point of a piece of a patch without any assumption: branch and bound on the squared distance as a
// Bernstein polynomial.
#pragma once

#include "box_newton.hpp"

#include <cusp/geometry/bezier_patch.hpp>

#include <functional>

namespace cusp::geometry::detail {

/// The distance of what the search returns exceeds the least one by no more than this.
inline constexpr double search_tolerance_mm = 1e-11;

/// Looks for the least distance over the box (dyadic corners) below `limit_squared` and calls `take` with every better foot
/// it meets, which returns the new limit: the foot's squared distance, or the old limit if the foot does not count (it lies
/// outside a trimmed face). `query` is relative to the origin of the patch.
void searchExactly(const BezierPatch& patch, const ParameterBox& box, const Vector3& query, double limit_squared,
                   const std::function<double(const PatchFoot&)>& take);

}  // namespace cusp::geometry::detail
