// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Bounds of derivatives from differences of control points, and convexity from those.
//
// A derivative of S = N/w (N taken about the centre, so that S vanishes there) is a sum of products of N, w and their
// derivatives, each of which lies in the hull of its control values. Deviations from the centre follow term by term.
#include "patch_bounds.hpp"

#include "homogeneous_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cusp::geometry::detail {
namespace {

using Vector4 = BezierPatch::Vector4;

/// Of a homogeneous derivative: the largest size and the largest deviation from the centre, of its spatial part and weight.
struct Extent {
    Vector4 center;
    double space = 0.0;
    double weight = 0.0;
    double space_deviation = 0.0;
    double weight_deviation = 0.0;

    explicit Extent(const Vector4& at_center) : center(at_center) {}
    void take(const Vector4& control) {
        space = std::max(space, control.head<3>().norm());
        weight = std::max(weight, std::abs(control[3]));
        space_deviation = std::max(space_deviation, (control - center).head<3>().norm());
        weight_deviation = std::max(weight_deviation, std::abs(control[3] - center[3]));
    }
};

/// Over a net that is centred on the origin.
struct NetBounds {
    Extent value;
    Extent u;
    Extent v;
    Extent uu;
    Extent uv;
    Extent vv;
    double inverse_weight = 0.0;  ///< largest 1/w
    double inverse_weight_deviation = 0.0;
    double radius_mm = 0.0;

    NetBounds(const BezierPatch& net, const HomogeneousPoint& center)
        : value(center.value), u(center.du), v(center.dv), uu(center.duu), uv(center.duv), vv(center.dvv) {
        const int p = net.degreeU();
        const int q = net.degreeV();
        for (int i = 0; i <= p; ++i) {
            for (int j = 0; j <= q; ++j) {
                const Vector4& point = net.at(i, j);
                inverse_weight = std::max(inverse_weight, 1.0 / point[3]);
                radius_mm = std::max(radius_mm, point.head<3>().norm() / point[3]);
                value.take(point);
                if (i < p) u.take(p * (net.at(i + 1, j) - point));
                if (j < q) v.take(q * (net.at(i, j + 1) - point));
                if (i + 1 < p) uu.take(p * (p - 1.0) * (net.at(i + 2, j) - 2.0 * net.at(i + 1, j) + point));
                if (j + 1 < q) vv.take(q * (q - 1.0) * (net.at(i, j + 2) - 2.0 * net.at(i, j + 1) + point));
                if (i < p && j < q) {
                    uv.take(static_cast<double>(p) * q *
                            (net.at(i + 1, j + 1) - net.at(i + 1, j) - net.at(i, j + 1) + point));
                }
            }
        }
        inverse_weight_deviation = inverse_weight * value.weight_deviation / center.value[3];
    }
};

/// Of w_a S_b / w (a weight's derivative times a derivative of S): largest size and deviation.
struct Product {
    double largest;
    double deviation;
};

Product mixedTerm(const NetBounds& b, const Extent& weight_derivative, double length, double length_deviation) {
    const double largest = weight_derivative.weight * length;
    return {largest * b.inverse_weight,
            (weight_derivative.weight_deviation * length + weight_derivative.weight * length_deviation) *
                    b.inverse_weight +
                largest * b.inverse_weight_deviation};
}

/// S_ab = N_ab/w − w_a S_b/w − w_b S_a/w − w_ab S/w.
SecondDerivative secondDerivative(const NetBounds& b, const Extent& n, const Product& first, const Product& second,
                                  const Vector3& at_center) {
    const double last = n.weight * b.radius_mm * b.inverse_weight;
    const double deviation = n.space_deviation * b.inverse_weight +
                             n.center.head<3>().norm() * b.inverse_weight_deviation + first.deviation +
                             second.deviation + last;
    // Terms that cancel at the centre still do so nearby; their sizes do not.
    const double largest =
        std::min(n.space * b.inverse_weight + first.largest + second.largest + last, at_center.norm() + deviation);
    return {at_center, largest, deviation};
}

void boundDerivatives(const NetBounds& b, const SurfacePoint& center, PatchBounds& out) {
    out.length_u_mm = b.inverse_weight * (b.u.space + b.u.weight * b.radius_mm);
    out.length_v_mm = b.inverse_weight * (b.v.space + b.v.weight * b.radius_mm);
    // First with the trivial deviation of du and dv; what follows for the second derivatives gives a better one.
    double deviation_u = 2.0 * out.length_u_mm;
    double deviation_v = 2.0 * out.length_v_mm;
    for (int round = 0; round < 3; ++round) {
        const Product u_u = mixedTerm(b, b.u, out.length_u_mm, deviation_u);
        const Product u_v = mixedTerm(b, b.u, out.length_v_mm, deviation_v);
        const Product v_u = mixedTerm(b, b.v, out.length_u_mm, deviation_u);
        const Product v_v = mixedTerm(b, b.v, out.length_v_mm, deviation_v);
        out.duu = secondDerivative(b, b.uu, u_u, u_u, center.duu);
        out.duv = secondDerivative(b, b.uv, u_v, v_u, center.duv);
        out.dvv = secondDerivative(b, b.vv, v_v, v_v, center.dvv);
        // The corners lie half a width from the centre each way.
        deviation_u = std::min(deviation_u, 0.5 * (out.duu.largest + out.duv.largest));
        deviation_v = std::min(deviation_v, 0.5 * (out.duv.largest + out.dvv.largest));
    }
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

bool PatchBounds::isConvexFor(const Vector3& query) const {
    // The Hessian is JᵀJ + r·S″ with r = S − query. Each entry: its value at the centre, less what it may deviate.
    const Vector3 r = center - query;
    const double distance = r.norm();
    const double u = du.norm();
    const double v = dv.norm();
    const double e_u = 0.5 * (duu.largest + duv.largest);
    const double e_v = 0.5 * (duv.largest + dvv.largest);
    // Along its axes the piece is thin in one direction at least, and long pieces bend across their length.
    const Vector3 extent = low.cwiseAbs().cwiseMax(high.cwiseAbs());
    const auto bent = [&](const SecondDerivative& s) {
        return (axes * s.center).cwiseAbs().dot(extent) + (radius_mm + distance) * s.deviation;
    };
    const double least_uu = u * u + r.dot(duu.center) - (2.0 * u + e_u) * e_u - bent(duu);
    const double least_vv = v * v + r.dot(dvv.center) - (2.0 * v + e_v) * e_v - bent(dvv);
    const double most_uv = std::abs(du.dot(dv) + r.dot(duv.center)) + u * e_v + v * e_u + e_u * e_v + bent(duv);
    // A little less than the bound, so that rounding cannot matter.
    constexpr double margin = 0.999;
    return least_uu > 0.0 && least_vv > 0.0 && most_uv * most_uv < margin * least_uu * least_vv;
}

PatchBounds boundPatch(const BezierPatch& patch) {
    PatchBounds out{};
    const SurfacePoint center = patch.evaluateLocal(0.5, 0.5);
    const BezierPatch net = patch.about(patch.origin() + center.position);
    const NetBounds b(net, homogeneousPoint(net, 0.5, 0.5));
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
    boundDerivatives(b, center, out);
    const double size_u = center.du.norm();
    const double size_v = center.dv.norm();
    out.bend_u = out.bend_v = std::numeric_limits<double>::infinity();
    if (size_u > 0.0 && size_v > 0.0) {
        out.bend_u = 0.5 * std::hypot(out.duu.largest / size_u, out.duv.largest / size_v);
        out.bend_v = 0.5 * std::hypot(out.duv.largest / size_u, out.dvv.largest / size_v);
    }
    return out;
}

}  // namespace cusp::geometry::detail
