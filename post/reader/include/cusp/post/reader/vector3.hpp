// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The witness's own vectors: it computes with nothing the writer computes with.
#pragma once

#include <cmath>

namespace cusp::post::reader {

struct Vector3 {
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;

    friend constexpr Vector3 operator+(const Vector3& a, const Vector3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
    friend constexpr Vector3 operator-(const Vector3& a, const Vector3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
    friend constexpr Vector3 operator*(double s, const Vector3& v) { return {s * v.x, s * v.y, s * v.z}; }
};

[[nodiscard]] constexpr double dot(const Vector3& a, const Vector3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
[[nodiscard]] constexpr Vector3 cross(const Vector3& a, const Vector3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] inline double norm(const Vector3& v) { return std::sqrt(dot(v, v)); }
/// Angle in [0, π], accurate at both ends.
[[nodiscard]] inline double angleBetween(const Vector3& a, const Vector3& b) {
    return std::atan2(norm(cross(a, b)), dot(a, b));
}
/// `v` turned about the unit vector `axis` by `angle_rad`, right-handed (Rodrigues).
[[nodiscard]] Vector3 rotated(const Vector3& v, const Vector3& axis, double angle_rad);
/// The unit vector at `fraction` of the way from `a` to `b` (unit) on the great circle through both. When they are
/// opposite, the circle is not determined: the point is then undefined but still of unit length.
[[nodiscard]] Vector3 onGreatCircle(const Vector3& a, const Vector3& b, double fraction);

}  // namespace cusp::post::reader
