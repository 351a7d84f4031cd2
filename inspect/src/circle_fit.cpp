// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Plane by eigenvectors, circle by Gauss–Newton from Kåsa's algebraic fit.
#include <cusp/inspect/circle_fit.hpp>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <cmath>
#include <vector>

namespace cusp::inspect {

using geometry::Vector3;

namespace {

using Eigen::Vector2d;

struct PlaneFrame {
    Vector3 origin;
    Vector3 e1;
    Vector3 e2;
    Vector3 normal;
    bool is_line = false;
    double rms_mm = 0.0;
};

PlaneFrame planeOf(std::span<const Vector3> points) {
    PlaneFrame out;
    const auto n = static_cast<double>(points.size());
    Vector3 shift = Vector3::Zero();
    for (const Vector3& p : points) shift += (p - points.front()) / n;
    out.origin = points.front() + shift;
    geometry::Matrix3 moments = geometry::Matrix3::Zero();
    for (const Vector3& p : points) moments += (p - out.origin) * (p - out.origin).transpose();
    const Eigen::SelfAdjointEigenSolver<geometry::Matrix3> eigen(moments);
    out.is_line = eigen.eigenvalues()[1] <= 1e-14 * eigen.eigenvalues()[2] || eigen.eigenvalues()[2] <= 0.0;
    out.normal = eigen.eigenvectors().col(0);
    Eigen::Index largest = 0;
    out.normal.cwiseAbs().maxCoeff(&largest);
    if (out.normal[largest] < 0.0) out.normal = -out.normal;
    out.e1 = eigen.eigenvectors().col(2);
    out.e2 = out.normal.cross(out.e1);
    double square_sum = 0.0;
    for (const Vector3& p : points) square_sum += std::pow((p - out.origin).dot(out.normal), 2);
    out.rms_mm = std::sqrt(square_sum / n);
    return out;
}

struct FlatCircle {
    Vector2d center = Vector2d::Zero();
    double radius = 0.0;
};

/// Kåsa 1976: x² + y² = 2ax + 2by + c is linear in a, b, c. Biased on short arcs, good enough to start from.
FlatCircle algebraicFit(const std::vector<Vector2d>& points) {
    Eigen::MatrixXd A(static_cast<Eigen::Index>(points.size()), 3);
    Eigen::VectorXd b(A.rows());
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
        const Vector2d& p = points[static_cast<std::size_t>(i)];
        A.row(i) << 2.0 * p.x(), 2.0 * p.y(), 1.0;
        b[i] = p.squaredNorm();
    }
    const Vector3 solution = A.colPivHouseholderQr().solve(b);
    const Vector2d center = solution.head<2>();
    return {center, std::sqrt(std::max(0.0, solution[2] + center.squaredNorm()))};
}

/// One step of Gauss–Newton on |p − center| − radius; its length is the answer.
double refine(const std::vector<Vector2d>& points, FlatCircle& circle) {
    Eigen::MatrixXd J(static_cast<Eigen::Index>(points.size()), 3);
    Eigen::VectorXd e(J.rows());
    for (Eigen::Index i = 0; i < J.rows(); ++i) {
        const Vector2d arm = points[static_cast<std::size_t>(i)] - circle.center;
        const double distance = std::max(arm.norm(), 1e-300);
        J.row(i) << -arm.x() / distance, -arm.y() / distance, -1.0;
        e[i] = distance - circle.radius;
    }
    const Vector3 step = J.colPivHouseholderQr().solve(-e);
    circle.center += step.head<2>();
    circle.radius += step[2];
    return step.norm();
}

double rmsOf(const std::vector<Vector2d>& points, const FlatCircle& circle) {
    double square_sum = 0.0;
    for (const Vector2d& p : points) square_sum += std::pow((p - circle.center).norm() - circle.radius, 2);
    return std::sqrt(square_sum / static_cast<double>(points.size()));
}

}  // namespace

base::Result<CircleFit> fitCircle(std::span<const Vector3> points) {
    if (points.size() < 3) return base::fail("circle.too-few-points", "a circle needs three points");
    const PlaneFrame plane = planeOf(points);
    if (plane.is_line)
        return base::fail("circle.not-determined", "the points lie on a line: no circle goes through them");
    std::vector<Vector2d> flat;
    for (const Vector3& p : points)
        flat.emplace_back((p - plane.origin).dot(plane.e1), (p - plane.origin).dot(plane.e2));
    FlatCircle circle = algebraicFit(flat);
    CircleFit out;
    constexpr int most_iterations = 200;
    const double tolerance = 1e-14;
    // The last steps only shake with rounding: done when they no longer shrink.
    double last_step = std::numeric_limits<double>::infinity();
    bool converged = false;
    while (out.iterations < most_iterations && !converged) {
        ++out.iterations;
        const double step = refine(flat, circle);
        converged = step <= tolerance * circle.radius || (step >= last_step && step <= 1e-11 * circle.radius);
        last_step = step;
    }
    if (!converged || !std::isfinite(circle.radius))
        return base::fail("circle.not-converged", "the circle fit did not converge: the points hardly bend");
    out.center = plane.origin + circle.center.x() * plane.e1 + circle.center.y() * plane.e2;
    out.normal = plane.normal;
    out.radius_mm = circle.radius;
    out.rms_radial_mm = rmsOf(flat, circle);
    out.rms_plane_mm = plane.rms_mm;
    return out;
}

}  // namespace cusp::inspect
