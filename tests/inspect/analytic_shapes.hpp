// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Nominal shapes with closest points of their own, so that what is tested does not lean on the surfaces of geometry.
#pragma once

#include <cusp/base/random.hpp>
#include <cusp/geometry/closest_point.hpp>

#include <array>
#include <cmath>
#include <vector>

namespace cusp::inspect::test {

using geometry::Footpoint;
using geometry::Vector3;

/// Answers batches by single questions.
class SingleShape : public geometry::NominalShape {
public:
    using NominalShape::closest;
    void closest(std::span<const Vector3> queries, std::span<Footpoint> footpoints, bool /*warm*/) const override {
        for (std::size_t i = 0; i < queries.size(); ++i) footpoints[i] = closest(queries[i]);
    }
};

/// The plane z = 0, endless.
class Plane : public SingleShape {
public:
    using SingleShape::closest;
    Footpoint closest(const Vector3& q) const override {
        Footpoint out;
        out.position = {q.x(), q.y(), 0.0};
        out.normal = Vector3::UnitZ();
        out.distance_mm = q.z();
        return out;
    }
    Eigen::AlignedBox3d bounds() const override { return {Vector3(-50, -50, 0), Vector3(50, 50, 0)}; }
};

class Sphere : public SingleShape {
public:
    Sphere(const Vector3& center, double radius_mm) : center_(center), radius_mm_(radius_mm) {}
    using SingleShape::closest;
    Footpoint closest(const Vector3& q) const override {
        Footpoint out;
        out.normal = (q - center_).normalized();
        out.position = center_ + radius_mm_ * out.normal;
        out.distance_mm = (q - center_).norm() - radius_mm_;
        return out;
    }
    Eigen::AlignedBox3d bounds() const override {
        return {center_ - Vector3::Constant(radius_mm_), center_ + Vector3::Constant(radius_mm_)};
    }

private:
    Vector3 center_;
    double radius_mm_;
};

/// A patch x_k(u,v) = Σ c[k][i][j]·uⁱ·vʲ over the unit square, degree 2 each; the normal is ± the cross product of the
/// derivatives. Closest points by projected Newton from the best of a grid and from the best of each edge.
class Patch : public SingleShape {
public:
    using Coefficients = std::array<std::array<std::array<double, 3>, 3>, 3>;
    Patch(const Coefficients& c, double side, const Vector3& offset = Vector3::Zero())
        : c_(c), side_(side), offset_(offset) {
        for (int i = 0; i <= cells; ++i)
            for (int j = 0; j <= cells; ++j) {
                grid_.push_back(at(i / double(cells), j / double(cells)));
                box_.extend(grid_.back());
            }
    }

    Vector3 at(double u, double v) const { return evaluate(u, v).p; }
    Vector3 normalAt(double u, double v) const {
        const Local l = evaluate(u, v);
        return side_ * l.pu.cross(l.pv).normalized();
    }

    using SingleShape::closest;
    Footpoint closest(const Vector3& q) const override {
        std::size_t best = 0;
        for (std::size_t i = 1; i < grid_.size(); ++i)
            if ((grid_[i] - q).squaredNorm() < (grid_[best] - q).squaredNorm()) best = i;
        const std::size_t row = best / (cells + 1);
        double u = double(row) / cells;
        double v = double(best % (cells + 1)) / cells;
        newton(q, u, v);
        Footpoint out;
        out.position = at(u, v);
        out.normal = normalAt(u, v);
        out.u = u;
        out.v = v;
        const Vector3 away = q - out.position;
        const double along = away.dot(out.normal);
        out.on_boundary = (u <= 0 || u >= 1 || v <= 0 || v >= 1) && away.cross(out.normal).norm() > 1e-9;
        out.distance_mm = std::copysign(away.norm(), along);
        return out;
    }
    Eigen::AlignedBox3d bounds() const override { return box_; }

private:
    static constexpr int cells = 8;
    struct Local {
        Vector3 p, pu, pv, puu, puv, pvv;
    };

    Local evaluate(double u, double v) const {
        Local l;
        const std::array<double, 3> U{1, u, u * u}, u_slope{0, 1, 2 * u}, V{1, v, v * v}, v_slope{0, 1, 2 * v};
        for (std::size_t k = 0; k < 3; ++k) {
            const auto row = static_cast<Eigen::Index>(k);
            std::array<double, 6> s{};
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t j = 0; j < 3; ++j) {
                    const double c = c_[k][i][j];
                    s[0] += c * U[i] * V[j];
                    s[1] += c * u_slope[i] * V[j];
                    s[2] += c * U[i] * v_slope[j];
                    s[3] += i == 2 ? 2 * c * V[j] : 0;
                    s[4] += c * u_slope[i] * v_slope[j];
                    s[5] += j == 2 ? 2 * c * U[i] : 0;
                }
            l.p[row] = s[0] + offset_[row];
            l.pu[row] = s[1];
            l.pv[row] = s[2];
            l.puu[row] = s[3];
            l.puv[row] = s[4];
            l.pvv[row] = s[5];
        }
        return l;
    }

    void newton(const Vector3& q, double& u, double& v) const {
        for (int n = 0; n < 60; ++n) {
            const Local l = evaluate(u, v);
            const Vector3 r = l.p - q;
            Eigen::Vector2d g(r.dot(l.pu), r.dot(l.pv));
            Eigen::Matrix2d H;
            H << l.pu.dot(l.pu) + r.dot(l.puu), l.pu.dot(l.pv) + r.dot(l.puv), 0, l.pv.dot(l.pv) + r.dot(l.pvv);
            H(1, 0) = H(0, 1);
            if (H.determinant() <= 0 || H(0, 0) <= 0)
                H << l.pu.dot(l.pu), l.pu.dot(l.pv), l.pu.dot(l.pv), l.pv.dot(l.pv);
            // A parameter held at its bound by the gradient does not move.
            const bool hold_u = (u <= 0 && g[0] > 0) || (u >= 1 && g[0] < 0);
            const bool hold_v = (v <= 0 && g[1] > 0) || (v >= 1 && g[1] < 0);
            Eigen::Vector2d step = Eigen::Vector2d::Zero();
            if (!hold_u && !hold_v) step = -H.inverse() * g;
            if (hold_u && !hold_v) step[1] = -g[1] / H(1, 1);
            if (hold_v && !hold_u) step[0] = -g[0] / H(0, 0);
            const double u_next = std::clamp(u + step[0], 0.0, 1.0);
            const double v_next = std::clamp(v + step[1], 0.0, 1.0);
            const bool done = std::abs(u_next - u) + std::abs(v_next - v) < 1e-16;
            u = u_next;
            v = v_next;
            if (done) break;
        }
    }

    Coefficients c_;
    double side_;
    Vector3 offset_;
    std::vector<Vector3> grid_;
    Eigen::AlignedBox3d box_;
};

/// Fountas 2017 eq. 14: the outside is up.
inline Patch benchmarkPatch(const Vector3& offset = Vector3::Zero()) {
    Patch::Coefficients c{};
    c[0][0] = {-94.4, 88.9, 5.6};
    c[1][1][0] = -131.3;
    c[1][2][0] = 28.1;
    c[2][0] = {12.1, 25.0, 6.7};
    c[2][1] = {-50.8, -27.3, -3.9};
    c[2][2] = {76.2, 5.9, 5.9};
    return {c, 1.0, offset};
}

/// Another patch for every seed: a bent plate of 60 to 160 mm with a saddle or a bowl of up to 20 mm on it.
inline Patch randomPatch(base::Random& random) {
    Patch::Coefficients c{};
    const double a = random.uniform(60, 160);
    const double b = random.uniform(60, 160);
    c[0][1][0] = a;
    c[1][0][1] = b;
    for (auto& row : c[2])
        for (double& value : row) value = random.uniform(-20, 20);
    // Enough bend in both directions that the surface cannot slide along itself.
    c[2][2][0] += std::copysign(15.0, c[2][2][0]);
    c[2][0][2] += std::copysign(15.0, c[2][0][2]);
    c[2][2][2] *= 0.5;
    return {c, 1.0};
}

}  // namespace cusp::inspect::test
