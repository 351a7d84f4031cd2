// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Control points on the path, and Bernstein points out of them.
#include "path_spline.hpp"

#include <algorithm>

namespace cusp::dynamics {

namespace {

AxisVector mix(const AxisVector& a, const AxisVector& b, double u) {
    AxisVector out;
    for (std::size_t i = 0; i < max_axes; ++i) out[i] = (1.0 - u) * a[i] + u * b[i];
    return out;
}

/// Blossoming (Ramshaw 1987): `t` are the six knots about the span [t[2], t[3]], `d` its four control points.
AxisCurve bernstein(const double* t, const AxisVector* d) {
    AxisCurve out;
    out.length = t[3] - t[2];
    out.points[1] = mix(d[1], d[2], (t[2] - t[1]) / (t[4] - t[1]));
    out.points[2] = mix(d[1], d[2], (t[3] - t[1]) / (t[4] - t[1]));
    const AxisVector before = mix(d[0], d[1], (t[2] - t[0]) / (t[3] - t[0]));
    const AxisVector after = mix(d[2], d[3], (t[3] - t[2]) / (t[5] - t[2]));
    out.points[0] = mix(before, out.points[1], (t[2] - t[1]) / (t[3] - t[1]));
    out.points[3] = mix(out.points[2], after, (t[3] - t[2]) / (t[4] - t[2]));
    return out;
}

}  // namespace

PathSpline::PathSpline(const Polyline& path, std::vector<double> knots) : knots_(std::move(knots)) {
    const std::size_t spans = knots_.size() - 3;
    knots_.push_back(knots_.back());
    knots_.push_back(knots_.back());
    std::vector<AxisVector> control(knots_.size() - 2);
    for (std::size_t i = 0; i < control.size(); ++i)
        control[i] = path.at((knots_[i] + knots_[i + 1] + knots_[i + 2]) / 3.0).axes;
    curves_.reserve(spans);
    for (std::size_t span = 0; span < spans; ++span)
        curves_.push_back(bernstein(knots_.data() + span, control.data() + span));
}

std::size_t PathSpline::spanAt(double s) const {
    const auto begin = knots_.begin() + 2;
    const auto index = static_cast<std::size_t>(std::upper_bound(begin, knots_.end() - 2, s) - begin);
    return std::clamp<std::size_t>(index, 1, spans()) - 1;
}

}  // namespace cusp::dynamics
