// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The squared distance from the origin to a patch as a quotient of Bernstein polynomials, and what its coefficients tell.
#pragma once

#include <cusp/geometry/bezier_patch.hpp>

#include <cstddef>
#include <utility>

namespace cusp::geometry::detail {

struct DistancePolynomial {
    double least_squared_mm2 = 0.0;  ///< nothing of the patch is nearer to the origin of its net
    double bend_u = 0.0;  ///< how far the bound may be off, by the direction in which halving helps; 0 below rounding
    double bend_v = 0.0;  ///< likewise

    explicit DistancePolynomial(const BezierPatch& patch);

    /// Parameters of the least coefficient: a good place to look for the minimum.
    [[nodiscard]] std::pair<double, double> likelyPlace() const { return {place_u_, place_v_}; }

private:
    double place_u_ = 0.5;
    double place_v_ = 0.5;
};

}  // namespace cusp::geometry::detail
