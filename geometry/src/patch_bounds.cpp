// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Bounds of derivatives from differences of control points; convexity of the squared distance from those.
//
// With r = S − query, the Hessian of ½|r|² is JᵀJ + r·S″ (J = [du dv]). Scaled to unit columns at the centre, J = J₀ + E:
// its smallest singular value is at least σ − ε with σ² = 1 − |cos(du, dv)| and ε bounding E. With κ bounding the scaled
// S″, the Hessian is positive definite wherever (σ − ε)² > |r| κ; and |r| ≤ |query − centre| + radius.
#include "patch_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cusp::geometry::detail {
namespace {

using Vector4 = BezierPatch::Vector4;

/// Largest size of a homogeneous derivative: of its spatial part and of its weight.
struct Largest {
    double space = 0.0;
    double weight = 0.0;

    void take(const Vector4& difference, double factor) {
        space = std::max(space, factor * difference.head<3>().norm());
        weight = std::max(weight, factor * std::abs(difference[3]));
    }
};

struct NetBounds {
    Largest u;
    Largest v;
    Largest uu;
    Largest uv;
    Largest vv;
    double smallest_weight = std::numeric_limits<double>::infinity();
    double radius_mm = 0.0;
};

/// Over a net that is centred on the origin.
NetBounds boundNet(const BezierPatch& net) {
    NetBounds out;
    const int p = net.degreeU();
    const int q = net.degreeV();
    for (int i = 0; i <= p; ++i) {
        for (int j = 0; j <= q; ++j) {
            const Vector4& point = net.at(i, j);
            out.smallest_weight = std::min(out.smallest_weight, point[3]);
            out.radius_mm = std::max(out.radius_mm, point.head<3>().norm() / point[3]);
            if (i < p) out.u.take(net.at(i + 1, j) - point, p);
            if (j < q) out.v.take(net.at(i, j + 1) - point, q);
            if (i + 1 < p) out.uu.take(net.at(i + 2, j) - 2.0 * net.at(i + 1, j) + point, p * (p - 1.0));
            if (j + 1 < q) out.vv.take(net.at(i, j + 2) - 2.0 * net.at(i, j + 1) + point, q * (q - 1.0));
            if (i < p && j < q) {
                const Vector4 twist = net.at(i + 1, j + 1) - net.at(i + 1, j) - net.at(i, j + 1) + point;
                out.uv.take(twist, p * static_cast<double>(q));
            }
        }
    }
    return out;
}

Matrix3 axesOf(const SurfacePoint& center) {
    Matrix3 axes = Matrix3::Identity();
    const Vector3 normal = crossNormal(center);
    if (!normal.isZero()) {
        axes.row(0) = center.du.normalized();
        axes.row(1) = normal.cross(center.du.normalized());
        axes.row(2) = normal;
    }
    return axes;
}

}  // namespace

PatchBounds boundPatch(const BezierPatch& patch) {
    const SurfacePoint center = patch.evaluateLocal(0.5, 0.5);
    const BezierPatch net = patch.about(patch.origin() + center.position);
    const NetBounds b = boundNet(net);
    const double w = 1.0 / b.smallest_weight;

    PatchBounds out{};
    out.center = center.position;
    out.du = center.du;
    out.dv = center.dv;
    out.radius_mm = b.radius_mm;
    out.axes = axesOf(center);
    out.low.setConstant(std::numeric_limits<double>::infinity());
    out.high = -out.low;
    for (const Vector4& point : net.net()) {
        const Vector3 local = out.axes * (point.head<3>() / point[3]);
        out.low = out.low.cwiseMin(local);
        out.high = out.high.cwiseMax(local);
    }
    // Quotient rule with |S − centre| ≤ radius.
    out.length_u_mm = w * (b.u.space + b.u.weight * b.radius_mm);
    out.length_v_mm = w * (b.v.space + b.v.weight * b.radius_mm);
    const double uu = w * (b.uu.space + 2.0 * b.u.weight * out.length_u_mm + b.uu.weight * b.radius_mm);
    const double vv = w * (b.vv.space + 2.0 * b.v.weight * out.length_v_mm + b.vv.weight * b.radius_mm);
    const double uv =
        w * (b.uv.space + b.u.weight * out.length_v_mm + b.v.weight * out.length_u_mm + b.uv.weight * b.radius_mm);

    out.duu_mm = uu;
    out.duv_mm = uv;
    out.dvv_mm = vv;

    const double size_u = center.du.norm();
    const double size_v = center.dv.norm();
    out.convex_reach_mm = -1.0;
    out.bend_u = out.bend_v = std::numeric_limits<double>::infinity();
    if (!(size_u > 0.0 && size_v > 0.0)) return out;
    out.bend_u = 0.5 * std::hypot(uu / size_u, uv / size_v);
    out.bend_v = 0.5 * std::hypot(uv / size_u, vv / size_v);
    const double bend = out.bend_u + out.bend_v;
    const double sigma = std::sqrt(std::max(0.0, 1.0 - std::abs(center.du.dot(center.dv)) / (size_u * size_v)));
    if (!(sigma > bend)) return out;
    const double mixed = uv / (size_u * size_v);
    const double kappa = std::max(uu / (size_u * size_u), vv / (size_v * size_v)) + mixed;
    // A little less than the bound, so that rounding cannot matter.
    constexpr double margin = 0.999;
    out.convex_reach_mm = margin * (sigma - bend) * (sigma - bend) / kappa - out.radius_mm;
    return out;
}

}  // namespace cusp::geometry::detail
