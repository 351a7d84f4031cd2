// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Inside is where a ray meets the outline an odd number of times. The ray is turned out of the directions in which outlines
// like to run; a Bézier piece counts by its ends unless the ray starts within its hull.
#include "trim_region.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cusp::geometry::detail {
namespace {

const double cosine = std::cos(0.7236);
const double sine = std::sin(0.7236);
/// A piece whose hull holds the start of the ray is halved down to this, relative to the rectangle: rounding of the parameters.
constexpr double smallest_piece = 1e-13;
/// Outlines this near the border, relative to the rectangle, run along it.
constexpr double on_border = 1e-7;

template <class Take>
void overPoints(const BezierCurve& curve, Take take) {
    for (const BezierCurve::Vector4& p : curve.net()) take(p[0] / p[3], p[1] / p[3]);
}

bool runsAlongBorder(const SurfaceFace& face, const BezierCurve& piece) {
    const auto side = [&](const std::vector<double>& breaks, bool of_u, double at) {
        bool all = true;
        overPoints(piece, [&](double u, double v) {
            all = all && std::abs((of_u ? u : v) - at) <= on_border * (breaks.back() - breaks.front());
        });
        return all;
    };
    return side(face.breaksU(), true, face.breaksU().front()) || side(face.breaksU(), true, face.breaksU().back()) ||
           side(face.breaksV(), false, face.breaksV().front()) || side(face.breaksV(), false, face.breaksV().back());
}

}  // namespace

TrimRegion::TrimRegion(const SurfaceFace& face, const std::vector<const CurvePieces*>& outlines)
    : low_u_(face.breaksU().front()),
      low_v_(face.breaksV().front()),
      scale_u_(1.0 / (face.breaksU().back() - low_u_)),
      scale_v_(1.0 / (face.breaksV().back() - low_v_)) {
    bool whole = true;
    for (const CurvePieces* outline : outlines) {
        for (const BezierCurve& piece : outline->pieces) whole = whole && runsAlongBorder(face, piece);
    }
    if (whole) return;
    for (const CurvePieces* outline : outlines) {
        for (const BezierCurve& piece : outline->pieces) {
            addCrossing(piece);
            outlines_.push_back(withExtent(piece));
        }
    }
}

Vector3 TrimRegion::turned(double u, double v) const {
    const double x = (u - low_u_) * scale_u_;
    const double y = (v - low_v_) * scale_v_;
    return {cosine * x - sine * y, sine * x + cosine * y, 0.0};
}

TrimRegion::Crossing TrimRegion::withExtent(BezierCurve curve) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Crossing out{std::move(curve), infinity, -infinity, infinity, -infinity};
    overPoints(out.curve, [&](double x, double y) {
        out.low_x = std::min(out.low_x, x);
        out.high_x = std::max(out.high_x, x);
        out.low_y = std::min(out.low_y, y);
        out.high_y = std::max(out.high_y, y);
    });
    return out;
}

void TrimRegion::addCrossing(const BezierCurve& piece) {
    std::vector<BezierCurve::Vector4> net = piece.net();
    for (BezierCurve::Vector4& p : net) p.head<3>() = p[3] * turned(p[0] / p[3], p[1] / p[3]);
    crossings_.push_back(withExtent(BezierCurve(std::move(net))));
}

bool TrimRegion::isCrossed(const Crossing& crossing, double x, double y) {
    if (y < crossing.low_y || y > crossing.high_y || x > crossing.high_x) return false;
    const bool tiny = crossing.high_x - crossing.low_x + crossing.high_y - crossing.low_y < smallest_piece;
    if (x < crossing.low_x || tiny) {
        const BezierCurve::Vector4& from = crossing.curve.net().front();
        const BezierCurve::Vector4& to = crossing.curve.net().back();
        return (from[1] / from[3] > y) != (to[1] / to[3] > y);
    }
    auto [left, right] = crossing.curve.split();
    return isCrossed(withExtent(std::move(left)), x, y) != isCrossed(withExtent(std::move(right)), x, y);
}

bool TrimRegion::contains(double u, double v) const {
    if (isWhole()) return true;
    const Vector3 point = turned(u, v);
    bool inside = false;
    for (const Crossing& crossing : crossings_) {
        if (isCrossed(crossing, point.x(), point.y())) inside = !inside;
    }
    return inside;
}

bool TrimRegion::touches(const Crossing& outline, const ParameterBox& box) const {
    if (outline.low_x > box.high_u || outline.high_x < box.low_u || outline.low_y > box.high_v ||
        outline.high_y < box.low_v) {
        return false;
    }
    const double width = (outline.high_x - outline.low_x) * scale_u_;
    const double height = (outline.high_y - outline.low_y) * scale_v_;
    const bool small =
        width <= 0.25 * (box.high_u - box.low_u) * scale_u_ && height <= 0.25 * (box.high_v - box.low_v) * scale_v_;
    if (small || width + height < smallest_piece) return true;
    auto [left, right] = outline.curve.split();
    return touches(withExtent(std::move(left)), box) || touches(withExtent(std::move(right)), box);
}

bool TrimRegion::mayCross(const ParameterBox& box) const {
    // A little wider: the outlines of a file are as exact as its tolerance.
    const double slack_u = 1e-10 / scale_u_;
    const double slack_v = 1e-10 / scale_v_;
    const ParameterBox wide{box.low_u - slack_u, box.high_u + slack_u, box.low_v - slack_v, box.high_v + slack_v};
    return std::any_of(outlines_.begin(), outlines_.end(), [&](const Crossing& o) { return touches(o, wide); });
}

}  // namespace cusp::geometry::detail
