// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The forms in which surfaces are written down, and their exact conversion to Bézier patches.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/surface_face.hpp>

#include <array>
#include <vector>

namespace cusp::geometry {

/// S(u, v) = Σ cᵢⱼ uⁱ vʲ over a rectangle of parameters, mm.
struct PolynomialForm {
    std::vector<std::vector<Vector3>> coefficients;  ///< [i][j], rows of one length
    std::array<double, 2> u_range{0.0, 1.0};
    std::array<double, 2> v_range{0.0, 1.0};
};

/// A non-uniform rational B-spline (Piegl & Tiller 1997, ch. 4). Knots need not be clamped; the domain is
/// [t_p, t_n] of each direction with degree p and n control points.
struct BSplineForm {
    int degree_u = 0;
    int degree_v = 0;
    std::vector<double> knots_u;
    std::vector<double> knots_v;
    std::vector<std::vector<Vector3>> points;  ///< [i][j], i along u; rows of one length
    std::vector<std::vector<double>> weights;  ///< likewise; empty when all are 1
};

/// A single rational Bézier patch over [0, 1]².
struct BezierForm {
    std::vector<std::vector<Vector3>> points;  ///< [i][j], i along u; rows of one length
    std::vector<std::vector<double>> weights;  ///< likewise; empty when all are 1
};

/// Errors, each with the key of the surface file it speaks of in `Location::key`: `surface.shape` (a net that is no
/// rectangle), `surface.degree`, `surface.knots`, `surface.weights`, `surface.range`, `surface.not-finite`,
/// `surface.degenerate` (no area).
[[nodiscard]] base::Result<SurfaceFace> toFace(const PolynomialForm& form, Outward outward);
[[nodiscard]] base::Result<SurfaceFace> toFace(const BezierForm& form, Outward outward);
[[nodiscard]] base::Result<SurfaceFace> toFace(const BSplineForm& form, Outward outward);

}  // namespace cusp::geometry
