// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The nearest point of a curve: branch and bound on the squared distance as a Bernstein polynomial, with Newton's method for
// the last digits.
#pragma once

#include <cusp/geometry/bezier_curve.hpp>

namespace cusp::geometry::detail {

struct CurveFoot {
    double t = 0.0;
    double squared_mm2 = 0.0;
    Vector3 position;
};

/// Improves `foot` (whose squared distance is the limit) by what is nearer on the curve; true when something was.
bool searchCurve(const BezierCurve& curve, const Vector3& query, CurveFoot& foot);

}  // namespace cusp::geometry::detail
