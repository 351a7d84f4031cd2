// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The closed forms of the upright ball, written for the compiler to take eight rays at a time.
//
// A ball (or, in the plane across the tool axis, a circle) of radius r whose centre runs from 0 by `way` meets a ray at s where
// |q + s·e − t·way|² = r² for some t. With q across e: the ray first meets the cylinder around the way at s = (−b − √(b² − ac))/a,
// a = 1 − (e·way)²/way², b = −(q·way)(e·way)/way², c = q² − r² − (q·way)²/way², at the time t = (q·way + s·e·way)/way². Where t
// lies outside the times that count, the ball at the nearest of them is met instead, or nothing is.
#include "upright_ball.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#define CUSP_INLINE inline __attribute__((always_inline))

namespace cusp::simulation {
namespace {

using Row = UprightBall::Row;
constexpr std::size_t lanes = UprightBall::lanes;

/// A ball or circle on its way, as the rays of one row have it in common.
struct Way {
    double square, along, share, a;
    bool lengthwise;  ///< along the rays

    CUSP_INLINE Way(double way_square, double way_along)
        : square(way_square), along(way_along), share(way_square > 0.0 ? 1.0 / way_square : 0.0) {
        constexpr double least = 1e-9;
        a = 1.0 - along * along * share;
        lengthwise = a <= least;
        if (lengthwise) a = 1.0;
    }
};

struct Lanes {
    Row across_square;  ///< q² − r²
    Row across_way;     ///< q·way
    Row first, last;    ///< the times that count; none where they are in the wrong order
};

/// One end of what is swept, at `s` by the cylinder; false where nothing is.
CUSP_INLINE bool meet(const Way& way, double q, double qw, double s, double first, double last, double sign,
                      double& end) {
    const double free = (qw + s * way.along) * way.share;
    double t = free < first ? first : free;
    t = t > last ? last : t;
    const double far = way.along * sign > 0.0 ? last : first;
    t = way.lengthwise ? far : t;
    const double shift = t * way.along;
    const double there = shift * shift - (q - 2.0 * t * qw + t * t * way.square);
    const double by_ball = shift + sign * std::sqrt(there > 0.0 ? there : 0.0);
    const bool between = (t == free) & !way.lengthwise;
    end = between ? s : by_ball;
    return between | (there >= 0.0);
}

/// Widens [from, to] by what is swept. `base`: where s is 0.
CUSP_INLINE void join(const Way& way, const Lanes& in, double base, Row& __restrict from, Row& __restrict to) {
    constexpr double none = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < lanes; ++i) {
        const double q = in.across_square[i];
        const double qw = in.across_way[i];
        const double b = -qw * way.along * way.share;
        const double c = q - qw * qw * way.share;
        const double inside = b * b - way.a * c;
        const double root = std::sqrt(inside > 0.0 ? inside : 0.0);
        const double first = in.first[i];
        const double last = in.last[i];
        const bool meets = ((inside >= 0.0) | way.lengthwise) & (first <= last);
        double low = 0.0;
        double high = 0.0;
        const bool enters = meet(way, q, qw, (-b - root) / way.a, first, last, -1.0, low);
        const bool leaves = meet(way, q, qw, (-b + root) / way.a, first, last, 1.0, high);
        const bool all = meets & enters & leaves;
        low = all ? base + low : none;
        high = all ? base + high : -none;
        from[i] = low < from[i] ? low : from[i];
        to[i] = high > to[i] ? high : to[i];
    }
}

/// Rays along the tool axis: into the ball from below, out at the top of the tool.
CUSP_INLINE void sweepAlong(const UprightBall& tool, int ray_axis, double u_mm, const Row& v_mm, Row& from, Row& to) {
    const auto k = static_cast<std::size_t>(ray_axis);
    const std::size_t u = (k + 1) % 3;
    const std::size_t v = (k + 2) % 3;
    const double wu = tool.way_mm[u];
    const double wv = tool.way_mm[v];
    const double wk = tool.way_mm[k];
    const double flat = wu * wu + wv * wv;
    const double pu = u_mm - tool.tip_mm[u];
    Lanes lane;
    for (std::size_t i = 0; i < lanes; ++i) {
        const double pv = v_mm[i] - tool.tip_mm[v];
        lane.across_square[i] = pu * pu + pv * pv - tool.radius_mm * tool.radius_mm;
        lane.across_way[i] = pu * wu + pv * wv;
        lane.first[i] = 0.0;
        lane.last[i] = 1.0;
    }
    join(Way(flat + wk * wk, wk), lane, tool.tip_mm[k] + tool.radius_mm, from, to);
    // The top is over the ray as long as the cylinder is.
    const double share = flat > 0.0 ? 1.0 / flat : 0.0;
    for (std::size_t i = 0; i < lanes; ++i) {
        const double under = lane.across_way[i] * lane.across_way[i] - flat * lane.across_square[i];
        const double root = std::sqrt(under > 0.0 ? under : 0.0);
        const double end = (lane.across_way[i] + (wk > 0.0 ? root : -root)) * share;
        double t = end < 0.0 ? 0.0 : end;
        t = t > 1.0 ? 1.0 : t;
        const double still = wk > 0.0 ? 1.0 : 0.0;
        t = flat > 0.0 ? t : still;
        const double top = tool.tip_mm[k] + tool.height_mm + t * wk;
        to[i] = (from[i] <= to[i]) & (top > to[i]) ? top : to[i];
    }
}

/// Rays across the tool axis: the ball, and the cylinder while it is as high as the ray.
CUSP_INLINE void sweepAcross(const UprightBall& tool, int ray_axis, double u_mm, const Row& v_mm, Row& from, Row& to) {
    const auto k = static_cast<std::size_t>(ray_axis);
    const std::size_t u = (k + 1) % 3;
    const std::size_t v = (k + 2) % 3;
    const auto up = static_cast<std::size_t>(tool.axis);
    const std::size_t side = up == u ? v : u;
    const double r = tool.radius_mm;
    const double wk = tool.way_mm[k];
    const double ws = tool.way_mm[side];
    const double wa = tool.way_mm[up];
    const double per_rise = wa != 0.0 ? 1.0 / wa : 0.0;
    constexpr double never = std::numeric_limits<double>::infinity();
    Lanes ball;
    Lanes tube;
    for (std::size_t i = 0; i < lanes; ++i) {
        const double pu = u_mm - tool.tip_mm[u];
        const double pv = v_mm[i] - tool.tip_mm[v];
        const double ps = up == u ? pv : pu;
        const double above = (up == u ? pu : pv) - r;  // the ball's equator
        ball.across_square[i] = ps * ps + above * above - r * r;
        ball.across_way[i] = ps * ws + above * wa;
        ball.first[i] = 0.0;
        ball.last[i] = 1.0;
        tube.across_square[i] = ps * ps - r * r;
        tube.across_way[i] = ps * ws;
        const double at_equator = above * per_rise;
        const double at_top = (above - (tool.height_mm - r)) * per_rise;
        const double early = at_equator < at_top ? at_equator : at_top;
        const double late = at_equator < at_top ? at_top : at_equator;
        const double level = (above >= 0.0) & (above <= tool.height_mm - r) ? 0.0 : never;
        const double first = wa != 0.0 ? early : level;
        const double last = wa != 0.0 ? late : 1.0;
        tube.first[i] = first > 0.0 ? first : 0.0;
        tube.last[i] = last < 1.0 ? last : 1.0;
    }
    join(Way(wk * wk + ws * ws + wa * wa, wk), ball, tool.tip_mm[k], from, to);
    join(Way(wk * wk + ws * ws, wk), tube, tool.tip_mm[k], from, to);
}

CUSP_INLINE void sweepAny(const UprightBall& tool, int ray_axis, double u_mm, const Row& v_mm, Row& from_mm,
                          Row& to_mm) {
    // Here, so that nothing else can lie in the same place.
    Row from;
    Row to;
    for (std::size_t i = 0; i < lanes; ++i) {
        from[i] = std::numeric_limits<double>::infinity();
        to[i] = -std::numeric_limits<double>::infinity();
    }
    const Row v = v_mm;
    if (ray_axis == tool.axis)
        sweepAlong(tool, ray_axis, u_mm, v, from, to);
    else
        sweepAcross(tool, ray_axis, u_mm, v, from, to);
    from_mm = from;
    to_mm = to;
}

#if defined(__x86_64__)
__attribute__((target("avx2"))) void sweepAvx2(const UprightBall& tool, int ray_axis, double u_mm, const Row& v_mm,
                                               Row& from, Row& to) {
    sweepAny(tool, ray_axis, u_mm, v_mm, from, to);
}
#endif

}  // namespace

void UprightBall::sweep(int ray_axis, double u_mm, const Row& v_mm, Row& from_mm, Row& to_mm) const {
#if defined(__x86_64__)
    static const bool wide = __builtin_cpu_supports("avx2") != 0;
    if (wide) return sweepAvx2(*this, ray_axis, u_mm, v_mm, from_mm, to_mm);
#endif
    sweepAny(*this, ray_axis, u_mm, v_mm, from_mm, to_mm);
}

}  // namespace cusp::simulation
