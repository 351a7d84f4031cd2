// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Curves cut into Bézier pieces.
#include "blossom.hpp"

#include <cusp/geometry/bezier_patch.hpp>
#include <cusp/geometry/trim_edge.hpp>

#include <algorithm>

namespace cusp::geometry {

Vector3 CurvePieces::evaluate(double t) const {
    const auto above = std::upper_bound(breaks.begin() + 1, breaks.end() - 1, t);
    const auto i = static_cast<std::size_t>(above - breaks.begin()) - 1;
    return pieces[i].evaluate(std::clamp((t - breaks[i]) / (breaks[i + 1] - breaks[i]), 0.0, 1.0)).position;
}

base::Result<CurvePieces> toPieces(const BSplineCurveForm& form) {
    const auto degree = static_cast<std::size_t>(std::max(form.degree, 0));
    if (degree < 1 || degree > static_cast<std::size_t>(max_surface_degree) ||
        form.weights.size() != form.points.size()) {
        return base::fail("curve.form", "degree, points and weights make no curve");
    }
    if (auto ok = detail::checkKnots(form.knots, form.points.size(), degree, "knots", "curve.form"); !ok) {
        return base::fail(ok.error());
    }
    std::vector<Eigen::Vector4d> net;
    for (std::size_t i = 0; i < form.points.size(); ++i) {
        const double w = form.weights[i];
        if (!(w >= 1e-9 && w <= 1e9) || !form.points[i].allFinite() || form.points[i].cwiseAbs().maxCoeff() > 1e9) {
            return base::fail("curve.form", "a point or a weight is beyond what is possible");
        }
        net.emplace_back();
        net.back() << w * form.points[i], w;
    }
    CurvePieces out;
    out.breaks = detail::breaksOf(form.knots, form.points.size(), degree);
    for (std::size_t i = 0; i + 1 < out.breaks.size(); ++i) {
        out.pieces.emplace_back(detail::bezierSpan(net, form.knots, degree, out.breaks[i], out.breaks[i + 1]));
    }
    return out;
}

}  // namespace cusp::geometry
