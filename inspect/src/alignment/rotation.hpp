// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Rotation vectors: to and from matrices, and how a small change of one turns a frame.
#pragma once

#include <cusp/geometry/frames.hpp>

namespace cusp::inspect {

/// [v]× with [v]×·w = v × w.
[[nodiscard]] geometry::Matrix3 crossMatrix(const geometry::Vector3& v);
/// Rodrigues' formula; exact to rounding for small angles as well.
[[nodiscard]] geometry::Matrix3 rotationFromVector(const geometry::Vector3& rotation_vector_rad);
/// The vector of a rotation matrix, its length in [0, π]; accurate near 0.
[[nodiscard]] geometry::Vector3 vectorFromRotation(const geometry::Matrix3& rotation);
/// Left Jacobian J of SO(3): exp(ρ + dρ) = exp(J·dρ)·exp(ρ) to first order.
[[nodiscard]] geometry::Matrix3 leftJacobian(const geometry::Vector3& rotation_vector_rad);

}  // namespace cusp::inspect
