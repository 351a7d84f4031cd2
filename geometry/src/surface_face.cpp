// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A face evaluated through the patch its parameters fall into.
#include <cusp/geometry/surface_face.hpp>

#include <algorithm>
#include <cassert>
#include <utility>

namespace cusp::geometry {
namespace {

/// The span of strictly ascending breaks that holds t, and where in it.
struct Span {
    std::size_t index = 0;
    double local = 0.0;  ///< 0 … 1
    double width = 1.0;
};

Span findSpan(const std::vector<double>& breaks, double t) {
    const auto above = std::upper_bound(breaks.begin() + 1, breaks.end() - 1, t);
    Span span;
    span.index = static_cast<std::size_t>(above - breaks.begin()) - 1;
    span.width = breaks[span.index + 1] - breaks[span.index];
    span.local = std::clamp((t - breaks[span.index]) / span.width, 0.0, 1.0);
    return span;
}

double within(const std::vector<double>& breaks, std::size_t index, double local) {
    // The ends exactly: neighbours then agree on the break they share.
    if (local >= 1.0) return breaks[index + 1];
    return breaks[index] + local * (breaks[index + 1] - breaks[index]);
}

}  // namespace

SurfaceFace::SurfaceFace(std::vector<double> breaks_u, std::vector<double> breaks_v, std::vector<BezierPatch> patches,
                         Outward outward)
    : breaks_u_(std::move(breaks_u)), breaks_v_(std::move(breaks_v)), patches_(std::move(patches)), outward_(outward) {
    assert(breaks_u_.size() >= 2 && breaks_v_.size() >= 2);
    assert(patches_.size() == (breaks_u_.size() - 1) * (breaks_v_.size() - 1));
}

SurfacePoint SurfaceFace::evaluate(double u, double v) const {
    const Span in_u = findSpan(breaks_u_, u);
    const Span in_v = findSpan(breaks_v_, v);
    const BezierPatch& patch = patches_[in_u.index * (breaks_v_.size() - 1) + in_v.index];
    SurfacePoint point = patch.evaluate(in_u.local, in_v.local);
    point.du /= in_u.width;
    point.dv /= in_v.width;
    point.duu /= in_u.width * in_u.width;
    point.duv /= in_u.width * in_v.width;
    point.dvv /= in_v.width * in_v.width;
    return point;
}

Vector3 SurfaceFace::normal(double u, double v) const {
    Vector3 normal = crossNormal(evaluate(u, v));
    // Towards the middle of the face in growing steps, so that the first regular point is as near as can be.
    const double to_u = (breaks_u_.front() + breaks_u_.back()) / 2.0 - u;
    const double to_v = (breaks_v_.front() + breaks_v_.back()) / 2.0 - v;
    for (double step = 1e-9; normal.isZero() && step < 1.0; step *= 10.0) {
        normal = crossNormal(evaluate(u + step * to_u, v + step * to_v));
    }
    return outwardSign() * normal;
}

std::array<double, 2> SurfaceFace::faceParameters(std::size_t index, double s, double t) const {
    const std::size_t columns = breaks_v_.size() - 1;
    return {within(breaks_u_, index / columns, s), within(breaks_v_, index % columns, t)};
}

}  // namespace cusp::geometry
