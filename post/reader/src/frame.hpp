// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Coordinate frames of the program: where the coordinates of a block lie in the frame of the work offset.
#pragma once

#include <cusp/post/reader/vector3.hpp>

#include <cstddef>
#include <string_view>

namespace cusp::post::reader {

/// `outer_from_inner`: columns are the inner frame's axes, seen from the outer one.
struct Frame {
    Vector3 x{1.0, 0.0, 0.0};
    Vector3 y{0.0, 1.0, 0.0};
    Vector3 z{0.0, 0.0, 1.0};
    Vector3 origin_mm;

    [[nodiscard]] Vector3 direction(const Vector3& v) const { return v.x * x + v.y * y + v.z * z; }
    [[nodiscard]] Vector3 point(const Vector3& p) const { return origin_mm + direction(p); }
    /// From the outer frame to the inner one.
    [[nodiscard]] Vector3 inverse(const Vector3& p) const {
        const Vector3 v = p - origin_mm;
        return {dot(v, x), dot(v, y), dot(v, z)};
    }
    [[nodiscard]] Frame operator*(const Frame& inner) const {
        return {direction(inner.x), direction(inner.y), direction(inner.z), point(inner.origin_mm)};
    }
    [[nodiscard]] bool turned() const { return norm(x - Vector3{1, 0, 0}) + norm(y - Vector3{0, 1, 0}) > 1e-12; }
    [[nodiscard]] bool isIdentity() const { return !turned() && norm(origin_mm) == 0.0; }
};

[[nodiscard]] Frame shifted(const Vector3& by_mm);
/// About a coordinate axis (0 X, 1 Y, 2 Z), right-handed.
[[nodiscard]] Frame turnedAbout(std::size_t axis, double angle_rad);

/// The axis perpendicular to G17, G18, G19.
[[nodiscard]] std::size_t normalOf(std::string_view plane);

}  // namespace cusp::post::reader
