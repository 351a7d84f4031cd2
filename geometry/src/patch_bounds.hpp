// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What the control net of a piece of a patch guarantees about every point of it: where it lies, and near which queries the
// distance to it is a convex function of the parameters.
#pragma once

#include <cusp/geometry/bezier_patch.hpp>

namespace cusp::geometry::detail {

/// Bounds over a whole patch, in the coordinates of its net. Lengths in mm.
struct PatchBounds {
    Vector3 center;      ///< S(1/2, 1/2)
    Vector3 du;          ///< there, per width of the piece
    Vector3 dv;          ///< likewise
    Matrix3 axes;        ///< rows: along du, across it in the tangent plane, the normal at the centre
    Vector3 low;         ///< the piece lies within low … high of `axes · (S − center)`
    Vector3 high;        ///< likewise
    double radius_mm;    ///< the piece lies within this distance of the centre
    double length_u_mm;  ///< no curve v = const of the piece is longer
    double length_v_mm;  ///< likewise
    double duu_mm;       ///< no second derivative of the piece is larger, per width squared
    double duv_mm;       ///< likewise
    double dvv_mm;       ///< likewise
    /// For a query nearer to the centre than this, ½ |S(u, v) − query|² is strictly convex over the piece: it has one
    /// minimum there and Newton's method finds it. Not above zero where that cannot be promised.
    double convex_reach_mm;
    double bend_u;  ///< by how much du and dv vary from the centre along u, relative to their size there
    double bend_v;  ///< likewise along v

    /// A lower bound of the squared distance from the query to the piece.
    [[nodiscard]] double squaredDistance(const Vector3& query) const {
        const Vector3 local = axes * (query - center);
        const Vector3 outside = (low - local).cwiseMax(local - high).cwiseMax(0.0);
        return outside.squaredNorm();
    }
};

[[nodiscard]] PatchBounds boundPatch(const BezierPatch& patch);

}  // namespace cusp::geometry::detail
