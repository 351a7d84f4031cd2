// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Corners first, then edges, then the inside.
#include "triangle_point.hpp"

#include <algorithm>

namespace cusp::geometry::detail {
namespace {

using Kind = TriangleFeature::Kind;

/// The nearest point of three segments, for a triangle whose area is lost in rounding.
TrianglePoint nearestOnSides(const Vector3& query, const Vector3& a, const Vector3& b, const Vector3& c) {
    const Vector3* const corners[] = {&a, &b, &c};
    TrianglePoint best;
    double least = -1.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vector3& from = *corners[k];
        const Vector3 along = *corners[(k + 1) % 3] - from;
        const double squared = along.squaredNorm();
        const double t = squared > 0.0 ? std::clamp((query - from).dot(along) / squared, 0.0, 1.0) : 0.0;
        const double distance = (query - from - t * along).squaredNorm();
        if (least >= 0.0 && distance >= least) continue;
        least = distance;
        const double weights[3] = {k == 0 ? 1.0 - t : (k == 2 ? t : 0.0), k == 1 ? 1.0 - t : (k == 0 ? t : 0.0),
                                   k == 2 ? 1.0 - t : (k == 1 ? t : 0.0)};
        best.second = weights[1];
        best.third = weights[2];
        best.feature = t <= 0.0   ? TriangleFeature{Kind::Corner, k}
                       : t >= 1.0 ? TriangleFeature{Kind::Corner, (k + 1) % 3}
                                  : TriangleFeature{Kind::Edge, k};
    }
    return best;
}

}  // namespace

TrianglePoint nearestOnTriangle(const Vector3& query, const Vector3& a, const Vector3& b, const Vector3& c) {
    const Vector3 ab = b - a;
    const Vector3 ac = c - a;
    const Vector3 normal = ab.cross(ac);
    constexpr double smallest_sine = 1e-14;
    if (!(normal.squaredNorm() > smallest_sine * smallest_sine * ab.squaredNorm() * ac.squaredNorm())) {
        return nearestOnSides(query, a, b, c);
    }
    const double d1 = ab.dot(query - a);
    const double d2 = ac.dot(query - a);
    if (d1 <= 0.0 && d2 <= 0.0) return {0.0, 0.0, {Kind::Corner, 0}};
    const double d3 = ab.dot(query - b);
    const double d4 = ac.dot(query - b);
    if (d3 >= 0.0 && d4 <= d3) return {1.0, 0.0, {Kind::Corner, 1}};
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return {d1 / (d1 - d3), 0.0, {Kind::Edge, 0}};
    const double d5 = ab.dot(query - c);
    const double d6 = ac.dot(query - c);
    if (d6 >= 0.0 && d5 <= d6) return {0.0, 1.0, {Kind::Corner, 2}};
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return {0.0, d2 / (d2 - d6), {Kind::Edge, 2}};
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 >= d3 && d5 >= d6) {
        const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return {1.0 - t, t, {Kind::Edge, 1}};
    }
    const double sum = va + vb + vc;
    return {vb / sum, vc / sum, {Kind::Inside, 0}};
}

}  // namespace cusp::geometry::detail
