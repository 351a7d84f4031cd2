// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// First and second fundamental forms in an orthonormal tangent frame: symmetric 2×2 eigenvalues in closed form.
#include <cusp/geometry/surface_point.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace cusp::geometry {
namespace {

/// The tangent plane with orthonormal axes, and the second fundamental form in them.
struct TangentFrame {
    Vector3 e1;
    Vector3 e2;
    double b11 = 0.0;
    double b12 = 0.0;
    double b22 = 0.0;
};

TangentFrame tangentFrame(const SurfacePoint& point, const Vector3& normal) {
    TangentFrame frame;
    frame.e1 = point.du.normalized();
    frame.e2 = normal.cross(frame.e1);
    // Columns: du and dv in the frame. Their inverse takes the form from (du, dv) to (e1, e2).
    Eigen::Matrix2d jacobian;
    jacobian << point.du.dot(frame.e1), point.dv.dot(frame.e1), 0.0, point.dv.dot(frame.e2);
    const Eigen::Matrix2d inverse = jacobian.inverse();
    Eigen::Matrix2d form;
    form << normal.dot(point.duu), normal.dot(point.duv), normal.dot(point.duv), normal.dot(point.dvv);
    const Eigen::Matrix2d b = inverse.transpose() * form * inverse;
    frame.b11 = b(0, 0);
    frame.b12 = (b(0, 1) + b(1, 0)) / 2.0;
    frame.b22 = b(1, 1);
    return frame;
}

}  // namespace

Vector3 crossNormal(const SurfacePoint& point) {
    const Vector3 cross = point.du.cross(point.dv);
    const double size = cross.norm();
    const double size_u = point.du.norm();
    const double size_v = point.dv.norm();
    // Next to a pole one derivative is nothing but rounding, and so is the direction of the product.
    constexpr double smallest_ratio = 1e-9;
    constexpr double smallest_sine = 1e-12;
    if (!(std::min(size_u, size_v) > smallest_ratio * std::max(size_u, size_v)) ||
        !(size > smallest_sine * size_u * size_v)) {
        return Vector3::Zero();
    }
    return cross / size;
}

PrincipalCurvatures principalCurvatures(const SurfacePoint& point, const Vector3& normal) {
    const TangentFrame frame = tangentFrame(point, normal);
    const double mean = (frame.b11 + frame.b22) / 2.0;
    const double half_difference = (frame.b11 - frame.b22) / 2.0;
    const double spread = std::hypot(half_difference, frame.b12);
    const double angle = std::atan2(frame.b12, half_difference) / 2.0;
    PrincipalCurvatures out;
    out.smallest = mean - spread;
    out.largest = mean + spread;
    out.largest_direction = std::cos(angle) * frame.e1 + std::sin(angle) * frame.e2;
    out.smallest_direction = std::cos(angle) * frame.e2 - std::sin(angle) * frame.e1;
    return out;
}

double normalCurvature(const SurfacePoint& point, const Vector3& normal, const Vector3& direction) {
    const TangentFrame frame = tangentFrame(point, normal);
    const double x = direction.dot(frame.e1);
    const double y = direction.dot(frame.e2);
    return (frame.b11 * x * x + 2.0 * frame.b12 * x * y + frame.b22 * y * y) / (x * x + y * y);
}

}  // namespace cusp::geometry
