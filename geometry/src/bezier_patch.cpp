// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Evaluation in the Bernstein basis, halving by de Casteljau.
#include "bernstein.hpp"
#include "homogeneous_point.hpp"

#include <cusp/geometry/bezier_patch.hpp>

#include <algorithm>
#include <cassert>

namespace cusp::geometry {
namespace {

using Vector4 = BezierPatch::Vector4;

SurfacePoint polynomialPoint(const detail::HomogeneousPoint& h) {
    return {h.value.head<3>(), h.du.head<3>(), h.dv.head<3>(), h.duu.head<3>(), h.duv.head<3>(), h.dvv.head<3>()};
}

/// Quotient rule; Piegl & Tiller 1997, eq. 4.20.
SurfacePoint rationalPoint(const detail::HomogeneousPoint& h) {
    const double w = 1.0 / h.value[3];
    SurfacePoint s;
    s.position = h.value.head<3>() * w;
    s.du = (h.du.head<3>() - h.du[3] * s.position) * w;
    s.dv = (h.dv.head<3>() - h.dv[3] * s.position) * w;
    s.duu = (h.duu.head<3>() - 2.0 * h.du[3] * s.du - h.duu[3] * s.position) * w;
    s.duv = (h.duv.head<3>() - h.du[3] * s.dv - h.dv[3] * s.du - h.duv[3] * s.position) * w;
    s.dvv = (h.dvv.head<3>() - 2.0 * h.dv[3] * s.dv - h.dvv[3] * s.position) * w;
    return s;
}

/// Halves `count` values that lie `stride` apart, in place to the left half; the right half goes to `right`.
void halve(Vector4* left, Vector4* right, std::size_t count, std::size_t stride) {
    const std::size_t last = count - 1;
    right[last * stride] = left[last * stride];
    for (std::size_t level = 1; level <= last; ++level) {
        for (std::size_t i = last; i >= level; --i) {
            left[i * stride] = 0.5 * (left[(i - 1) * stride] + left[i * stride]);
        }
        right[(last - level) * stride] = left[last * stride];
    }
}

}  // namespace

detail::HomogeneousPoint detail::homogeneousPoint(const BezierPatch& patch, double u, double v) {
    const BernsteinBasis in_u(patch.degreeU(), u);
    const BernsteinBasis in_v(patch.degreeV(), v);
    const Vector4* point = patch.net().data();
    HomogeneousPoint out;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(patch.degreeU()); ++i) {
        Vector4 row = Vector4::Zero();
        Vector4 row_dv = Vector4::Zero();
        Vector4 row_dvv = Vector4::Zero();
        for (std::size_t j = 0; j <= static_cast<std::size_t>(patch.degreeV()); ++j, ++point) {
            row += in_v.value[j] * *point;
            row_dv += in_v.first[j] * *point;
            row_dvv += in_v.second[j] * *point;
        }
        out.value += in_u.value[i] * row;
        out.du += in_u.first[i] * row;
        out.duu += in_u.second[i] * row;
        out.dv += in_u.value[i] * row_dv;
        out.duv += in_u.first[i] * row_dv;
        out.dvv += in_u.value[i] * row_dvv;
    }
    return out;
}

BezierPatch::BezierPatch(int degree_u, int degree_v, std::vector<Vector4> net, const Vector3& origin)
    : degree_u_(degree_u), degree_v_(degree_v), net_(std::move(net)), origin_(origin) {
    assert(degree_u >= 0 && degree_u <= max_surface_degree && degree_v >= 0 && degree_v <= max_surface_degree);
    assert(net_.size() == static_cast<std::size_t>((degree_u + 1) * (degree_v + 1)));
    rational_ = std::any_of(net_.begin(), net_.end(), [](const Vector4& p) { return p[3] != 1.0; });
}

SurfacePoint BezierPatch::evaluateLocal(double u, double v) const {
    const detail::HomogeneousPoint h = detail::homogeneousPoint(*this, u, v);
    return rational_ ? rationalPoint(h) : polynomialPoint(h);
}

SurfacePoint BezierPatch::evaluate(double u, double v) const {
    SurfacePoint point = evaluateLocal(u, v);
    point.position += origin_;
    return point;
}

std::pair<BezierPatch, BezierPatch> BezierPatch::splitU() const {
    BezierPatch left = *this;
    BezierPatch right = *this;
    const auto row = static_cast<std::size_t>(degree_v_ + 1);
    for (std::size_t j = 0; j < row; ++j) {
        halve(&left.net_[j], &right.net_[j], static_cast<std::size_t>(degree_u_ + 1), row);
    }
    return {std::move(left), std::move(right)};
}

std::pair<BezierPatch, BezierPatch> BezierPatch::splitV() const {
    BezierPatch left = *this;
    BezierPatch right = *this;
    const auto row = static_cast<std::size_t>(degree_v_ + 1);
    for (std::size_t i = 0; i <= static_cast<std::size_t>(degree_u_); ++i) {
        halve(&left.net_[i * row], &right.net_[i * row], row, 1);
    }
    return {std::move(left), std::move(right)};
}

BezierPatch BezierPatch::about(const Vector3& origin) const {
    BezierPatch out = *this;
    const Vector3 shift = origin_ - origin;
    for (Vector4& point : out.net_) {
        point.head<3>() += point[3] * shift;
    }
    out.origin_ = origin;
    return out;
}

}  // namespace cusp::geometry
