// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Power basis to Bernstein basis, B-spline to Bézier by blossoming; what must hold of a form is checked first.
#include "bernstein.hpp"
#include "blossom.hpp"

#include <cusp/geometry/surface_forms.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

namespace cusp::geometry {
namespace {

using Vector4 = BezierPatch::Vector4;
using Net = std::vector<std::vector<Vector4>>;

tl::unexpected<base::Diagnostics> failAt(const char* key, const char* code, std::string message) {
    base::Location where;
    where.key = key;
    return base::fail(code, std::move(message), std::move(where));
}

template <class Row>
bool isRectangle(const std::vector<Row>& rows) {
    return !rows.empty() && !rows.front().empty() &&
           std::all_of(rows.begin(), rows.end(), [&](const Row& row) { return row.size() == rows.front().size(); });
}

base::Result<void> checkNet(const std::vector<std::vector<Vector3>>& points, const char* key) {
    if (!isRectangle(points)) {
        return failAt(key, "surface.shape", "the rows must be there and have one length");
    }
    constexpr std::size_t most = 1'000'000;
    if (points.size() * points.front().size() > most) {
        return failAt(key, "surface.shape", fmt::format("more than {} points", most));
    }
    for (const auto& row : points) {
        for (const Vector3& point : row) {
            // Squares of what is larger would leave the range of a double.
            constexpr double largest_mm = 1e9;
            if (!point.allFinite() || point.cwiseAbs().maxCoeff() > largest_mm) {
                return failAt(key, "surface.not-finite", "a coordinate is not a number or beyond 1e9 mm");
            }
        }
    }
    return {};
}

base::Result<void> checkDegree(std::size_t degree, const char* key) {
    if (degree < 1 || degree > static_cast<std::size_t>(max_surface_degree)) {
        return failAt(key, "surface.degree",
                      fmt::format("the degree is {}; it must be 1 to {}", degree, max_surface_degree));
    }
    return {};
}

/// Points and weights as homogeneous coordinates about `origin`.
base::Result<Net> homogeneousNet(const std::vector<std::vector<Vector3>>& points,
                                 const std::vector<std::vector<double>>& weights, const Vector3& origin) {
    if (!weights.empty() &&
        (!isRectangle(weights) || weights.size() != points.size() || weights.front().size() != points.front().size())) {
        return failAt("weights", "surface.shape", "there must be one weight for each point");
    }
    Net net(points.size());
    const double common = weights.empty() ? 1.0 : weights.front().front();
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t j = 0; j < points[i].size(); ++j) {
            const double w = weights.empty() ? 1.0 : weights[i][j];
            if (!(w >= 1e-9 && w <= 1e9)) {
                return failAt("weights", "surface.weights",
                              fmt::format("weight [{}][{}] is {:g}; it must be 1e-9 to 1e9", i, j, w));
            }
            Vector4 point;
            point << w / common * (points[i][j] - origin), w / common;
            net[i].push_back(point);
        }
    }
    return net;
}

/// Equal weights are no weights: rounding must not make a polynomial patch a rational one.
void dropEqualWeights(Net& net, const std::vector<std::vector<double>>& weights) {
    const double first = weights.empty() ? 1.0 : weights.front().front();
    for (const auto& row : weights) {
        if (std::any_of(row.begin(), row.end(), [&](double w) { return w != first; })) return;
    }
    for (auto& row : net) {
        for (Vector4& point : row) point[3] = 1.0;
    }
}

Vector3 middleOf(const std::vector<std::vector<Vector3>>& points) {
    Eigen::AlignedBox3d box;
    for (const auto& row : points) {
        for (const Vector3& point : row) box.extend(point);
    }
    return box.center();
}

/// A face has area if its normal exists somewhere off its lines of symmetry.
base::Result<SurfaceFace> withArea(SurfaceFace face, const char* key) {
    const double from_u = face.breaksU().front();
    const double from_v = face.breaksV().front();
    const double span_u = face.breaksU().back() - from_u;
    const double span_v = face.breaksV().back() - from_v;
    for (const double s : {0.37, 0.61, 0.13, 0.89}) {
        for (const double t : {0.41, 0.71, 0.17, 0.83}) {
            if (!crossNormal(face.evaluate(from_u + s * span_u, from_v + t * span_v)).isZero()) return face;
        }
    }
    return failAt(key, "surface.degenerate", "the surface is a line or a point: it has no area");
}

/// Power coefficients over `range` to Bernstein coefficients over [0, 1] (Farin 2002, 5.8), in place.
void powerToBernstein(std::vector<Vector4>& c, const std::array<double, 2>& range) {
    const std::size_t n = c.size() - 1;
    // t → range[0] + t · width, by Horner's scheme on the polynomial's coefficients.
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t i = n; i > k; --i) c[i - 1] += range[0] * c[i];
    }
    double scale = 1.0;
    for (std::size_t i = 0; i <= n; ++i, scale *= range[1] - range[0]) c[i] *= scale;
    std::vector<Vector4> b(n + 1, Vector4::Zero());
    for (std::size_t i = 0; i <= n; ++i) {
        for (std::size_t k = 0; k <= i; ++k) b[i] += detail::binomial(i, k) / detail::binomial(n, k) * c[k];
    }
    c = std::move(b);
}

template <class Change>
void changeColumns(Net& net, Change change) {
    for (std::size_t j = 0; j < net.front().size(); ++j) {
        std::vector<Vector4> column;
        for (const auto& row : net) column.push_back(row[j]);
        change(column);
        for (std::size_t i = 0; i < net.size(); ++i) net[i][j] = column[i];
    }
}

BezierPatch patchOf(const Net& net, const Vector3& origin) {
    std::vector<Vector4> flat;
    for (const auto& row : net) flat.insert(flat.end(), row.begin(), row.end());
    return {static_cast<int>(net.size()) - 1, static_cast<int>(net.front().size()) - 1, std::move(flat), origin};
}

base::Result<void> checkRange(const std::array<double, 2>& range, const char* key) {
    if (!(range[0] < range[1]) || !(std::abs(range[0]) <= 1e9 && std::abs(range[1]) <= 1e9)) {
        return failAt(key, "surface.range", "the range must be two ascending numbers");
    }
    return {};
}

}  // namespace

base::Result<SurfaceFace> toFace(const PolynomialForm& form, Outward outward) {
    if (auto ok = checkNet(form.coefficients, "z_mm"); !ok) return base::fail(ok.error());
    if (auto ok = checkRange(form.u_range, "u_range"); !ok) return base::fail(ok.error());
    if (auto ok = checkRange(form.v_range, "v_range"); !ok) return base::fail(ok.error());
    // A coordinate that does not depend on a parameter still lies on a patch of degree 1.
    const std::size_t rows = std::max<std::size_t>(form.coefficients.size(), 2);
    const std::size_t columns = std::max<std::size_t>(form.coefficients.front().size(), 2);
    if (auto ok = checkDegree(rows - 1, "z_mm"); !ok) return base::fail(ok.error());
    if (auto ok = checkDegree(columns - 1, "z_mm"); !ok) return base::fail(ok.error());
    Net net(rows, std::vector<Vector4>(columns, Vector4::Zero()));
    for (std::size_t i = 0; i < form.coefficients.size(); ++i) {
        for (std::size_t j = 0; j < form.coefficients[i].size(); ++j) {
            net[i][j].head<3>() = form.coefficients[i][j];
        }
    }
    // The constant term is the origin.
    const Vector3 origin = form.coefficients[0][0];
    net[0][0].setZero();
    for (auto& row : net) powerToBernstein(row, form.v_range);
    changeColumns(net, [&](std::vector<Vector4>& column) { powerToBernstein(column, form.u_range); });
    for (auto& row : net) {
        for (Vector4& point : row) point[3] = 1.0;
    }
    return withArea(
        {{form.u_range[0], form.u_range[1]}, {form.v_range[0], form.v_range[1]}, {patchOf(net, origin)}, outward},
        "z_mm");
}

base::Result<SurfaceFace> toFace(const BezierForm& form, Outward outward) {
    if (auto ok = checkNet(form.points, "points_mm"); !ok) return base::fail(ok.error());
    if (auto ok = checkDegree(form.points.size() - 1, "points_mm"); !ok) return base::fail(ok.error());
    if (auto ok = checkDegree(form.points.front().size() - 1, "points_mm"); !ok) return base::fail(ok.error());
    const Vector3 origin = middleOf(form.points);
    const auto net = homogeneousNet(form.points, form.weights, origin);
    if (!net) return base::fail(net.error());
    return withArea({{0.0, 1.0}, {0.0, 1.0}, {patchOf(*net, origin)}, outward}, "points_mm");
}

base::Result<SurfaceFace> toFace(const BSplineForm& form, Outward outward) {
    if (auto ok = checkNet(form.points, "points_mm"); !ok) return base::fail(ok.error());
    const std::size_t count_u = form.points.size();
    const std::size_t count_v = form.points.front().size();
    const auto degree_u = static_cast<std::size_t>(std::max(form.degree_u, 0));
    const auto degree_v = static_cast<std::size_t>(std::max(form.degree_v, 0));
    if (auto ok = checkDegree(degree_u, "degree_u"); !ok) return base::fail(ok.error());
    if (auto ok = checkDegree(degree_v, "degree_v"); !ok) return base::fail(ok.error());
    if (auto ok = detail::checkKnots(form.knots_u, count_u, degree_u, "knots_u", "surface.knots"); !ok)
        return base::fail(ok.error());
    if (auto ok = detail::checkKnots(form.knots_v, count_v, degree_v, "knots_v", "surface.knots"); !ok)
        return base::fail(ok.error());
    const Vector3 origin = middleOf(form.points);
    const auto net = homogeneousNet(form.points, form.weights, origin);
    if (!net) return base::fail(net.error());

    const std::vector<double> breaks_u = detail::breaksOf(form.knots_u, count_u, degree_u);
    const std::vector<double> breaks_v = detail::breaksOf(form.knots_v, count_v, degree_v);
    std::vector<BezierPatch> patches;
    for (std::size_t m = 0; m + 1 < breaks_u.size(); ++m) {
        Net strip(degree_u + 1, std::vector<Vector4>(count_v));
        for (std::size_t j = 0; j < count_v; ++j) {
            std::vector<Vector4> column;
            for (const auto& row : *net) column.push_back(row[j]);
            const auto span = detail::bezierSpan(column, form.knots_u, degree_u, breaks_u[m], breaks_u[m + 1]);
            for (std::size_t i = 0; i <= degree_u; ++i) strip[i][j] = span[i];
        }
        for (std::size_t n = 0; n + 1 < breaks_v.size(); ++n) {
            Net patch;
            for (const auto& row : strip) {
                patch.push_back(detail::bezierSpan(row, form.knots_v, degree_v, breaks_v[n], breaks_v[n + 1]));
            }
            dropEqualWeights(patch, form.weights);
            patches.push_back(patchOf(patch, origin));
        }
    }
    return withArea({breaks_u, breaks_v, std::move(patches), outward}, "points_mm");
}

}  // namespace cusp::geometry
