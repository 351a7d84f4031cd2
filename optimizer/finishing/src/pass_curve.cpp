// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Curves on a face, interpolated in its parameters.
#include <cusp/optimizer/finishing/pass_curve.hpp>

#include <algorithm>
#include <cmath>

namespace cusp::finishing {

namespace {

FaceParameters combine(double a, const FaceParameters& p, double b, const FaceParameters& q) {
    return {a * p[0] + b * q[0], a * p[1] + b * q[1]};
}

}  // namespace

PassCurve::PassCurve(const geometry::SurfaceFace& face, std::uint32_t face_index, std::vector<FaceParameters> samples,
                     std::uint32_t lane)
    : face_(&face), face_index_(face_index), samples_(std::move(samples)), lane_(lane) {}

/// Per step between samples: the parabola through three neighbours.
FaceParameters PassCurve::slopeOf(std::size_t sample) const {
    const std::size_t last = samples_.size() - 1;
    const auto& s = samples_;
    if (last == 1) return combine(1.0, s[1], -1.0, s[0]);
    if (sample == 0) return combine(2.0, combine(1.0, s[1], -1.0, s[0]), -0.5, combine(1.0, s[2], -1.0, s[0]));
    if (sample == last)
        return combine(2.0, combine(1.0, s[last], -1.0, s[last - 1]), -0.5, combine(1.0, s[last], -1.0, s[last - 2]));
    return combine(0.5, s[sample + 1], -0.5, s[sample - 1]);
}

PassCurve::Place PassCurve::placeAt(double t) const {
    const double last = static_cast<double>(samples_.size() - 1);
    const double along = std::clamp(t, 0.0, 1.0) * last;
    const auto i = std::min(static_cast<std::size_t>(along), samples_.size() - 2);
    const double x = along - static_cast<double>(i);
    const FaceParameters chord = combine(1.0, samples_[i + 1], -1.0, samples_[i]);
    const FaceParameters first = slopeOf(i);
    const FaceParameters second = slopeOf(i + 1);
    Place place;
    for (std::size_t k = 0; k < 2; ++k) {
        const double a = first[k] + second[k] - 2.0 * chord[k];
        const double b = 3.0 * chord[k] - 2.0 * first[k] - second[k];
        place.uv[k] = samples_[i][k] + x * (first[k] + x * (b + x * a));
        place.slope[k] = (first[k] + x * (2.0 * b + 3.0 * x * a)) * last;
    }
    return place;
}

FaceParameters PassCurve::parameters(double t) const { return placeAt(t).uv; }

Vector3 PassCurve::position(double t) const {
    const FaceParameters uv = placeAt(t).uv;
    return face_->evaluate(uv[0], uv[1]).position;
}

PassPoint PassCurve::at(double t) const {
    constexpr double nudge = 1e-4;  // off a pole, where the feed or the normal has no direction
    for (const double moved : {t, t < 0.5 ? t + nudge : t - nudge}) {
        const Place place = placeAt(moved);
        PassPoint out;
        out.uv = place.uv;
        out.surface = face_->evaluate(place.uv[0], place.uv[1]);
        Vector3 normal = face_->outwardSign() * geometry::crossNormal(out.surface);
        if (normal.squaredNorm() < 0.5) normal = face_->normal(place.uv[0], place.uv[1]);
        const Vector3 feed = place.slope[0] * out.surface.du + place.slope[1] * out.surface.dv;
        const Vector3 across = feed - feed.dot(normal) * normal;
        const bool regular = normal.squaredNorm() > 0.5 && across.norm() > 1e-9;
        if (!regular && moved == t) continue;
        out.frame = regular ? feedFrame(normal, feed) : FeedFrame{};
        if (moved != t) out.surface = face_->evaluate(placeAt(t).uv[0], placeAt(t).uv[1]);
        return out;
    }
    return {};
}

double PassCurve::length(int parts) const {
    double sum = 0.0;
    Vector3 before = position(0.0);
    for (int i = 1; i <= parts; ++i) {
        const Vector3 here = position(static_cast<double>(i) / parts);
        sum += (here - before).norm();
        before = here;
    }
    return sum;
}

void PassCurve::reverse() { std::reverse(samples_.begin(), samples_.end()); }

}  // namespace cusp::finishing
