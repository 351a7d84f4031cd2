// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Whether a point of a face is left by its edges is asked of the nearest point of the shape.
#include "pass_trim.hpp"

#include <cmath>

namespace cusp::finishing {

namespace {

constexpr int looks = 256;
constexpr double on_shape_mm = 1e-6;
constexpr double end_share = 1e-6;

bool isOn(const PassCurve& pass, const geometry::ParametricSurface& shape, double t) {
    const Vector3 point = pass.position(t);
    return std::abs(shape.closest(point).distance_mm) <= on_shape_mm;
}

double endBetween(const PassCurve& pass, const geometry::ParametricSurface& shape, double on, double off) {
    while (std::abs(on - off) > end_share) {
        const double middle = (on + off) / 2.0;
        (isOn(pass, shape, middle) ? on : off) = middle;
    }
    return on;
}

PassCurve piece(const PassCurve& pass, double from, double to) {
    constexpr int samples = 33;
    std::vector<FaceParameters> out;
    for (int i = 0; i < samples; ++i)
        out.push_back(pass.parameters(std::lerp(from, to, static_cast<double>(i) / (samples - 1))));
    return {pass.face(), pass.faceIndex(), std::move(out), pass.lane()};
}

}  // namespace

void trimPass(const PassCurve& pass, const geometry::ParametricSurface& shape, std::vector<PassCurve>& out) {
    bool before = false;
    double start = 0.0;
    for (int i = 0; i <= looks + 1; ++i) {
        const double t = static_cast<double>(i) / looks;
        const bool on = i <= looks && isOn(pass, shape, t);
        if (on && !before) start = i == 0 ? 0.0 : endBetween(pass, shape, t, t - 1.0 / looks);
        if (!on && before) {
            const double last = t - 1.0 / looks;
            const double end = i > looks ? 1.0 : endBetween(pass, shape, last, t);
            if (end - start > 1.0 / looks) out.push_back(piece(pass, start, end));
        }
        before = on;
    }
}

}  // namespace cusp::finishing
