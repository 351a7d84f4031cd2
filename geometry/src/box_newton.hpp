// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Newton's method for the nearest point of a patch over a rectangle of its parameters.
#pragma once

#include <cusp/geometry/bezier_patch.hpp>

namespace cusp::geometry::detail {

struct ParameterBox {
    double low_u = 0.0;
    double high_u = 1.0;
    double low_v = 0.0;
    double high_v = 1.0;

    [[nodiscard]] double middleU() const { return 0.5 * (low_u + high_u); }
    [[nodiscard]] double middleV() const { return 0.5 * (low_v + high_v); }
};

/// A point of a patch that may be the nearest one.
struct PatchFoot {
    double u = 0.0;
    double v = 0.0;
    double squared_mm2 = 0.0;  ///< to the query
    SurfacePoint point;        ///< relative to the origin of the patch
    bool converged = false;    ///< no step within the box leads nearer
};

/// Starts at (u, v), stays in the box, never ends farther than it started. `query` is relative to the origin of the
/// patch. Where the squared distance is convex over the box, a converged foot is its only minimum there.
[[nodiscard]] PatchFoot newtonInBox(const BezierPatch& patch, const ParameterBox& box, const Vector3& query, double u,
                                    double v);

}  // namespace cusp::geometry::detail
