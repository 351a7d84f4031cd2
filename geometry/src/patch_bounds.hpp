// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What the control net of a piece of a patch guarantees about every point of it: where it lies, how far its derivatives vary,
// and for which queries the distance to it is a convex function of the parameters.
#pragma once

#include <cusp/geometry/bezier_patch.hpp>

namespace cusp::geometry::detail {

/// A second derivative over the piece: its value at the centre, and bounds. Per width of the piece squared, mm.
struct SecondDerivative {
    Vector3 center;
    double largest;    ///< nowhere larger
    double deviation;  ///< nowhere farther from the value at the centre
};

/// Bounds over a whole patch, in the coordinates of its net. Lengths in mm.
struct PatchBounds {
    Vector3 center;  ///< S(1/2, 1/2)
    Vector3 du;      ///< there, per width of the piece
    Vector3 dv;      ///< likewise
    SecondDerivative duu;
    SecondDerivative duv;
    SecondDerivative dvv;
    Matrix3 axes;        ///< rows: along du, across it in the tangent plane, the normal at the centre
    Vector3 low;         ///< the piece lies within low … high of `axes · (S − center)`
    Vector3 high;        ///< likewise
    double radius_mm;    ///< the piece lies within this distance of the centre
    double length_u_mm;  ///< no curve v = const of the piece is longer
    double length_v_mm;  ///< likewise
    double bend_u;       ///< by how much du and dv vary from the centre along u, relative to their size there
    double bend_v;       ///< likewise along v

    /// A lower bound of the squared distance from the query to the piece.
    [[nodiscard]] double squaredDistance(const Vector3& query) const {
        const Vector3 local = axes * (query - center);
        const Vector3 outside = (low - local).cwiseMax(local - high).cwiseMax(0.0);
        return outside.squaredNorm();
    }

    /// Whether ½ |S(u, v) − query|² is proved to be strictly convex over the piece: it then has one minimum there, and
    /// Newton's method finds it.
    [[nodiscard]] bool isConvexFor(const Vector3& query) const;
};

[[nodiscard]] PatchBounds boundPatch(const BezierPatch& patch);

}  // namespace cusp::geometry::detail
