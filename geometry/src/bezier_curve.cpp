// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Evaluation in the Bernstein basis, halving by de Casteljau.
#include "bernstein.hpp"

#include <cusp/geometry/bezier_curve.hpp>

namespace cusp::geometry {

CurvePoint BezierCurve::evaluate(double t) const {
    const detail::BernsteinBasis basis(static_cast<int>(net_.size()) - 1, t);
    Vector4 value = Vector4::Zero();
    Vector4 first = Vector4::Zero();
    Vector4 second = Vector4::Zero();
    for (std::size_t i = 0; i < net_.size(); ++i) {
        value += basis.value[i] * net_[i];
        first += basis.first[i] * net_[i];
        second += basis.second[i] * net_[i];
    }
    const double w = 1.0 / value[3];
    CurvePoint out;
    out.position = value.head<3>() * w;
    out.first = (first.head<3>() - first[3] * out.position) * w;
    out.second = (second.head<3>() - 2.0 * first[3] * out.first - second[3] * out.position) * w;
    return out;
}

std::pair<BezierCurve, BezierCurve> BezierCurve::split() const {
    std::vector<Vector4> left = net_;
    std::vector<Vector4> right = net_;
    const std::size_t last = net_.size() - 1;
    for (std::size_t level = 1; level <= last; ++level) {
        for (std::size_t i = last; i >= level; --i) left[i] = 0.5 * (left[i - 1] + left[i]);
        right[last - level] = left[last];
    }
    return {BezierCurve(std::move(left)), BezierCurve(std::move(right))};
}

BezierCurve BezierCurve::about(const Vector3& origin) const {
    std::vector<Vector4> net = net_;
    for (Vector4& point : net) point.head<3>() -= point[3] * origin;
    return BezierCurve(std::move(net));
}

}  // namespace cusp::geometry
