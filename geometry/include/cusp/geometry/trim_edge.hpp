// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The edges at which faces are trimmed, and which faces meet there.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/bezier_curve.hpp>

#include <cstddef>
#include <vector>

namespace cusp::geometry {

/// A rational B-spline curve; of a curve in the parameters of a face, x is u, y is v and z is 0.
struct BSplineCurveForm {
    int degree = 1;
    std::vector<double> knots;
    std::vector<Vector3> points;
    std::vector<double> weights;  ///< one for each point
};

/// A curve as Bézier pieces, piece i over [breaks[i], breaks[i + 1]].
struct CurvePieces {
    std::vector<double> breaks;
    std::vector<BezierCurve> pieces;

    /// Parameters outside the breaks count as the nearest end.
    [[nodiscard]] Vector3 evaluate(double t) const;
};

/// Errors: `curve.form` when degree, knots, points and weights do not make a curve.
[[nodiscard]] base::Result<CurvePieces> toPieces(const BSplineCurveForm& form);

/// A face that ends at an edge, and the edge in the parameters of the face.
struct EdgeUse {
    std::size_t face = 0;
    CurvePieces parameters;
};

/// An edge in space (mm) and its uses, all by the same parameter. Without pieces it is a point: a pole, which only closes the
/// outline of its face. Of a face, the region of parameters is inside that a ray leaves through an odd number of its edges.
struct TrimEdge {
    CurvePieces curve;
    std::vector<EdgeUse> uses;
};

}  // namespace cusp::geometry
