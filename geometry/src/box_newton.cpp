// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Each step minimises the quadratic model over the box exactly, and is halved while it does not lead nearer.
#include "box_newton.hpp"

#include <algorithm>
#include <cmath>

namespace cusp::geometry::detail {
namespace {

/// ½ xᵀHx + gᵀx for a step x = (du, dv).
struct Model {
    double g_u;
    double g_v;
    double h_uu;
    double h_uv;
    double h_vv;

    [[nodiscard]] double at(double du, double dv) const {
        return g_u * du + g_v * dv + 0.5 * (h_uu * du * du + 2.0 * h_uv * du * dv + h_vv * dv * dv);
    }
};

Model modelAt(const SurfacePoint& s, const Vector3& r) {
    Model m{r.dot(s.du), r.dot(s.dv), s.du.squaredNorm() + r.dot(s.duu), s.du.dot(s.dv) + r.dot(s.duv),
            s.dv.squaredNorm() + r.dot(s.dvv)};
    // Gauss-Newton where the full model has no minimum.
    if (!(m.h_uu > 0.0 && m.h_vv > 0.0 && m.h_uu * m.h_vv > m.h_uv * m.h_uv)) {
        m.h_uu = s.du.squaredNorm();
        m.h_uv = s.du.dot(s.dv);
        m.h_vv = s.dv.squaredNorm();
        const double damping = 1e-9 * (m.h_uu + m.h_vv);
        m.h_uu += damping;
        m.h_vv += damping;
    }
    return m;
}

struct Step {
    double u = 0.0;
    double v = 0.0;
};

/// The minimum of the model with u (or v, when `swap`) held at `fixed`.
Step alongEdge(const Model& m, bool swap, double fixed, double low, double high) {
    const double h = swap ? m.h_uu : m.h_vv;
    const double g = (swap ? m.g_u : m.g_v) + m.h_uv * fixed;
    const double free = h > 0.0 ? std::clamp(-g / h, low, high) : (g > 0.0 ? low : high);
    return swap ? Step{free, fixed} : Step{fixed, free};
}

/// The minimum of a convex quadratic over a rectangle lies inside, or on one of the four edges.
Step minimize(const Model& m, const ParameterBox& room) {
    const double determinant = m.h_uu * m.h_vv - m.h_uv * m.h_uv;
    const Step inside{(m.h_uv * m.g_v - m.h_vv * m.g_u) / determinant, (m.h_uv * m.g_u - m.h_uu * m.g_v) / determinant};
    if (inside.u >= room.low_u && inside.u <= room.high_u && inside.v >= room.low_v && inside.v <= room.high_v) {
        return inside;
    }
    Step best;
    double least = 0.0;  // staying is one of the choices
    for (const Step& step : {alongEdge(m, false, room.low_u, room.low_v, room.high_v),
                             alongEdge(m, false, room.high_u, room.low_v, room.high_v),
                             alongEdge(m, true, room.low_v, room.low_u, room.high_u),
                             alongEdge(m, true, room.high_v, room.low_u, room.high_u)}) {
        const double value = m.at(step.u, step.v);
        if (value < least) {
            least = value;
            best = step;
        }
    }
    return best;
}

PatchFoot footAt(const BezierPatch& patch, const Vector3& query, double u, double v) {
    PatchFoot foot;
    foot.u = u;
    foot.v = v;
    foot.point = patch.evaluateLocal(u, v);
    foot.squared_mm2 = (foot.point.position - query).squaredNorm();
    return foot;
}

}  // namespace

PatchFoot newtonInBox(const BezierPatch& patch, const ParameterBox& box, const Vector3& query, double u, double v) {
    constexpr int most_steps = 50;
    PatchFoot foot = footAt(patch, query, std::clamp(u, box.low_u, box.high_u), std::clamp(v, box.low_v, box.high_v));
    for (int i = 0; i < most_steps; ++i) {
        const Vector3 r = foot.point.position - query;
        const Model model = modelAt(foot.point, r);
        const Step step =
            minimize(model, {box.low_u - foot.u, box.high_u - foot.u, box.low_v - foot.v, box.high_v - foot.v});
        const double length_mm = (step.u * foot.point.du + step.v * foot.point.dv).norm();
        // Rounding of the coordinates sets a floor to what a step can improve, and a higher one to what the squared distance
        // can tell apart.
        const double size_mm = foot.point.position.cwiseAbs().maxCoeff() + std::sqrt(foot.squared_mm2);
        const double floor_mm = 1e-10 + 1e-14 * size_mm;
        const double noise_mm2 = 1e-15 * size_mm * std::sqrt(foot.squared_mm2);
        PatchFoot next;
        double fraction = 1.0;
        for (;; fraction *= 0.5) {
            next = footAt(patch, query, std::clamp(foot.u + fraction * step.u, box.low_u, box.high_u),
                          std::clamp(foot.v + fraction * step.v, box.low_v, box.high_v));
            if (next.squared_mm2 <= foot.squared_mm2 + noise_mm2) break;
            if (fraction * length_mm <= floor_mm) {
                foot.converged = true;
                return foot;
            }
        }
        foot = next;
        if (fraction * length_mm <= floor_mm) {
            foot.converged = true;
            return foot;
        }
    }
    return foot;
}

}  // namespace cusp::geometry::detail
