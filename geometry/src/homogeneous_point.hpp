// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A point of a patch before the division by its weight.
#pragma once

#include <cusp/geometry/bezier_patch.hpp>

namespace cusp::geometry::detail {

/// (wx, wy, wz, w) about the origin of the patch, with derivatives.
struct HomogeneousPoint {
    using Vector4 = BezierPatch::Vector4;
    Vector4 value = Vector4::Zero();
    Vector4 du = Vector4::Zero();
    Vector4 dv = Vector4::Zero();
    Vector4 duu = Vector4::Zero();
    Vector4 duv = Vector4::Zero();
    Vector4 dvv = Vector4::Zero();
};

[[nodiscard]] HomogeneousPoint homogeneousPoint(const BezierPatch& patch, double u, double v);

}  // namespace cusp::geometry::detail
