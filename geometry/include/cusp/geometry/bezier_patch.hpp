// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A rational Bézier patch over the unit square: what every parametric surface of the house is made of.
#pragma once

#include <cusp/geometry/frames.hpp>
#include <cusp/geometry/surface_point.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace cusp::geometry {

/// Highest degree of a patch; CAD systems stop at 25.
inline constexpr int max_surface_degree = 25;

/// S(u, v) = origin + Σ Bᵢ(u) Bⱼ(v) (wx, wy, wz)ᵢⱼ / Σ Bᵢ(u) Bⱼ(v) wᵢⱼ on [0, 1]² (Farin 2002, ch. 13). All weights are
/// positive, so the patch lies in the convex hull of its control points. Lengths in mm.
class BezierPatch {
public:
    using Vector4 = Eigen::Vector4d;

    /// `net` holds (wx, wy, wz, w) relative to `origin`, v running faster: (degree_u + 1) · (degree_v + 1) values.
    BezierPatch(int degree_u, int degree_v, std::vector<Vector4> net, const Vector3& origin);

    [[nodiscard]] int degreeU() const { return degree_u_; }
    [[nodiscard]] int degreeV() const { return degree_v_; }
    /// False when all weights are 1.
    [[nodiscard]] bool isRational() const { return rational_; }
    [[nodiscard]] const Vector3& origin() const { return origin_; }
    [[nodiscard]] const std::vector<Vector4>& net() const { return net_; }
    /// Homogeneous control point, relative to the origin.
    [[nodiscard]] const Vector4& at(int i, int j) const {
        return net_[static_cast<std::size_t>(i) * static_cast<std::size_t>(degree_v_ + 1) +
                    static_cast<std::size_t>(j)];
    }

    /// Position and derivatives in the frame of the shape.
    [[nodiscard]] SurfacePoint evaluate(double u, double v) const;
    /// The same relative to the origin of the patch: no digits are lost far from the origin of the frame.
    [[nodiscard]] SurfacePoint evaluateLocal(double u, double v) const;

    /// The two halves at u (or v) = 1/2, each over [0, 1]² of its own (de Casteljau).
    [[nodiscard]] std::pair<BezierPatch, BezierPatch> splitU() const;
    [[nodiscard]] std::pair<BezierPatch, BezierPatch> splitV() const;
    /// The same patch with its coordinates taken about another origin.
    [[nodiscard]] BezierPatch about(const Vector3& origin) const;

private:
    int degree_u_;
    int degree_v_;
    bool rational_ = false;
    std::vector<Vector4> net_;
    Vector3 origin_;
};

}  // namespace cusp::geometry
