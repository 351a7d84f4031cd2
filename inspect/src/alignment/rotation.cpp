// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Formulas of SO(3), with their series where a quotient would lose digits.
#include "alignment/rotation.hpp"

#include <cmath>

namespace cusp::inspect {

using geometry::Matrix3;
using geometry::Vector3;

namespace {

constexpr double small_angle = 1e-4;  ///< below, the third term of the series is under the rounding

/// (1 − cos a)/a²
double versineRatio(double a) {
    if (a < small_angle) return 0.5 - a * a / 24.0;
    const double s = std::sin(0.5 * a) / (0.5 * a);
    return 0.5 * s * s;
}

double sineRatio(double a) { return a < small_angle ? 1.0 - a * a / 6.0 : std::sin(a) / a; }

/// (a − sin a)/a³; below 0.1 by its series, where the difference would cancel
double thirdRatio(double a) {
    const double a2 = a * a;
    if (a < 0.1) return 1.0 / 6.0 - a2 / 120.0 + a2 * a2 / 5040.0 - a2 * a2 * a2 / 362880.0;
    return (a - std::sin(a)) / (a2 * a);
}

}  // namespace

Matrix3 crossMatrix(const Vector3& v) {
    Matrix3 out;
    out << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
    return out;
}

Matrix3 rotationFromVector(const Vector3& rotation_vector_rad) {
    const double a = rotation_vector_rad.norm();
    const Matrix3 K = crossMatrix(rotation_vector_rad);
    return Matrix3::Identity() + sineRatio(a) * K + versineRatio(a) * K * K;
}

Vector3 vectorFromRotation(const Matrix3& rotation) {
    // The quaternion keeps digits at small angles, where the trace of the matrix has none.
    const Eigen::Quaterniond q(rotation);
    const double sine = q.vec().norm();
    if (sine == 0.0) return Vector3::Zero();
    const double angle = 2.0 * std::atan2(sine, std::abs(q.w()));
    return (q.w() < 0.0 ? -angle : angle) / sine * q.vec();
}

Matrix3 leftJacobian(const Vector3& rotation_vector_rad) {
    const double a = rotation_vector_rad.norm();
    const Matrix3 K = crossMatrix(rotation_vector_rad);
    return Matrix3::Identity() + versineRatio(a) * K + thirdRatio(a) * K * K;
}

}  // namespace cusp::inspect
