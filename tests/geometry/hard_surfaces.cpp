// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Control nets of the hard surfaces, and the brute force.
#include "hard_surfaces.hpp"

#include <cusp/base/random.hpp>
#include <cusp/geometry/surface_forms.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace cusp::geometry::test {
namespace {

/// A full circle as a rational quadratic of four quarters: nine points (x, y) of the unit circle's square, with weights.
constexpr std::array<std::array<double, 2>, 9> circle_points{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}}};
const double half_root = std::numbers::sqrt2 / 2.0;
const std::vector<double> circle_knots{0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};

double circleWeight(std::size_t i) { return i % 2 == 0 ? 1.0 : half_root; }

/// A profile (radius, height, weight) turned about Z; u runs along the circle.
BSplineForm turned(const std::vector<std::array<double, 3>>& profile, int degree, std::vector<double> knots,
                   const Vector3& center) {
    BSplineForm form;
    form.degree_u = 2;
    form.degree_v = degree;
    form.knots_u = circle_knots;
    form.knots_v = std::move(knots);
    for (std::size_t i = 0; i < circle_points.size(); ++i) {
        form.points.emplace_back();
        form.weights.emplace_back();
        for (const auto& [radius, height, weight] : profile) {
            form.points.back().push_back(center +
                                         Vector3(radius * circle_points[i][0], radius * circle_points[i][1], height));
            form.weights.back().push_back(weight * circleWeight(i));
        }
    }
    return form;
}

BezierForm net(std::vector<std::vector<Vector3>> points) { return {std::move(points), {}}; }

SurfaceFace faceOf(const base::Result<SurfaceFace>& face) { return face.value(); }

/// A sheet that goes out, turns over itself and comes back 2 mm above.
SurfaceFace foldedSheet() {
    BezierForm form;
    for (const auto& [x, z] : std::array<std::array<double, 2>, 4>{{{0, 0}, {60, 0.5}, {60, 1.5}, {0, 2}}}) {
        form.points.push_back({Vector3(x, 0, z), Vector3(x + 2, 15, z + 1), Vector3(x, 30, z)});
    }
    return faceOf(toFace(form, Outward::DuCrossDv));
}

SurfaceFace nearlyFlatSheet() {
    return faceOf(toFace(net({{{0, 0, 0}, {50, 0, 1e-5}, {100, 0, 0}},
                              {{0, 50, 2e-5}, {50, 50, -1e-5}, {100, 50, 0}},
                              {{0, 100, 0}, {50, 100, 0}, {100, 100, 1e-5}}}),
                         Outward::DvCrossDu));
}

/// A cone's tip region as a polynomial patch whose edge u = 0 is one point.
SurfaceFace degenerateFan() {
    return faceOf(toFace(net({{{0, 0, 10}, {0, 0, 10}, {0, 0, 10}},
                              {{8, 0, 7}, {8, 8, 7}, {0, 8, 7}},
                              {{20, 0, 0}, {20, 20, 1}, {0, 20, 0}}}),
                         Outward::DuCrossDv));
}

/// Six bilinear faces of a cube of 20 mm, outward normals by construction.
std::vector<SurfaceFace> cube() {
    std::vector<SurfaceFace> faces;
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            Vector3 n = Vector3::Zero();
            Vector3 a = Vector3::Zero();
            Vector3 b = Vector3::Zero();
            n[axis] = 10.0 * side;
            a[(axis + 1) % 3] = 10.0;
            b[(axis + 2) % 3] = 10.0;
            faces.push_back(faceOf(toFace(net({{n - a - b, n - a + b}, {n + a - b, n + a + b}}),
                                          side > 0 ? Outward::DuCrossDv : Outward::DvCrossDu)));
        }
    }
    return faces;
}

double distanceAt(const SurfaceFace& face, double u, double v, const Vector3& query) {
    return (face.evaluate(u, v).position - query).norm();
}

/// Pattern search (Hooke & Jeeves 1961) from a grid point: tries the eight neighbours at a step that shrinks.
double refine(const SurfaceFace& face, double u, double v, double step_u, double step_v, const Vector3& query) {
    double best = distanceAt(face, u, v, query);
    const auto clamp_u = [&](double x) { return std::clamp(x, face.breaksU().front(), face.breaksU().back()); };
    const auto clamp_v = [&](double x) { return std::clamp(x, face.breaksV().front(), face.breaksV().back()); };
    while (step_u > 1e-12 * (face.breaksU().back() - face.breaksU().front())) {
        double next_u = u;
        double next_v = v;
        for (int i = -1; i <= 1; ++i) {
            for (int j = -1; j <= 1; ++j) {
                const double try_u = clamp_u(u + i * step_u);
                const double try_v = clamp_v(v + j * step_v);
                const double distance = distanceAt(face, try_u, try_v, query);
                if (distance < best) {
                    best = distance;
                    next_u = try_u;
                    next_v = try_v;
                }
            }
        }
        if (next_u == u && next_v == v) {
            step_u *= 0.5;
            step_v *= 0.5;
        }
        u = next_u;
        v = next_v;
    }
    return best;
}

}  // namespace

SurfaceFace benchmarkFace() {
    return faceOf(toFace(net({{{-94.4, 0, 12.1}, {-49.95, 0, 24.6}, {0.1, 0, 43.8}},
                              {{-94.4, -65.65, -13.3}, {-49.95, -65.65, -7.625}, {0.1, -65.65, 2.8}},
                              {{-94.4, -103.2, 37.5}, {-49.95, -103.2, 39.3}, {0.1, -103.2, 49.8}}}),
                         Outward::DuCrossDv));
}

SurfaceFace sphereFace(const Vector3& center, double radius_mm) {
    const double r = radius_mm;
    return faceOf(toFace(turned({{0, -r, 1}, {r, -r, half_root}, {r, 0, 1}, {r, r, half_root}, {0, r, 1}}, 2,
                                {0, 0, 0, 1, 1, 2, 2, 2}, center),
                         Outward::DuCrossDv));
}

SurfaceFace cylinderFace(double radius_mm, double height_mm) {
    return faceOf(toFace(turned({{radius_mm, 0, 1}, {radius_mm, height_mm, 1}}, 1, {0, 0, 1, 1}, Vector3::Zero()),
                         Outward::DuCrossDv));
}

SurfaceFace torusFace(double major_mm, double minor_mm) {
    std::vector<std::array<double, 3>> profile;
    for (std::size_t i = 0; i < circle_points.size(); ++i) {
        profile.push_back({major_mm + minor_mm * circle_points[i][0], minor_mm * circle_points[i][1], circleWeight(i)});
    }
    return faceOf(toFace(turned(profile, 2, circle_knots, Vector3::Zero()), Outward::DuCrossDv));
}

SurfaceFace wavySheet(int patches, double side_mm, double height_mm, std::uint64_t seed) {
    base::Random random(seed);
    BSplineForm form;
    form.degree_u = form.degree_v = 3;
    const int count = patches + 3;
    for (int i = 0; i < count + 4; ++i) {
        form.knots_u.push_back(std::clamp((i - 3.0) / patches, 0.0, 1.0));
    }
    form.knots_v = form.knots_u;
    for (int i = 0; i < count; ++i) {
        form.points.emplace_back();
        for (int j = 0; j < count; ++j) {
            form.points.back().emplace_back(side_mm * i / (count - 1), side_mm * j / (count - 1),
                                            random.uniform(-height_mm, height_mm));
        }
    }
    return faceOf(toFace(form, Outward::DuCrossDv));
}

std::vector<HardSurface> hardSurfaces() {
    std::vector<HardSurface> out;
    out.push_back({"benchmark", {benchmarkFace()}});
    out.push_back({"folded", {foldedSheet()}});
    out.push_back({"nearly flat", {nearlyFlatSheet()}});
    out.push_back({"fan with a pole", {degenerateFan()}});
    out.push_back({"sphere", {sphereFace({3, -2, 5}, 12.5)}});
    out.push_back({"cylinder", {cylinderFace(7.0, 40.0)}});
    out.push_back({"torus", {torusFace(20.0, 6.0)}});
    out.push_back({"wavy sheet", {wavySheet(6, 60.0, 12.0, 7)}});
    out.push_back({"cube", cube()});
    out.push_back({"two spheres", {sphereFace({0, 0, 0}, 5.0), sphereFace({12, 0, 0}, 6.0)}});
    out.push_back({"far off", {sphereFace({1e5, -2e5, 3e5}, 8.0)}});
    return out;
}

double bruteForceDistance(const std::vector<SurfaceFace>& faces, const Vector3& query) {
    constexpr int grid = 60;
    constexpr double slack = 1.5;  // grid points within this factor of the best are refined
    struct Start {
        const SurfaceFace* face;
        double u;
        double v;
        double distance;
    };
    std::vector<Start> starts;
    double least = std::numeric_limits<double>::infinity();
    double spacing = 0.0;
    for (const SurfaceFace& face : faces) {
        const double step_u = (face.breaksU().back() - face.breaksU().front()) / grid;
        const double step_v = (face.breaksV().back() - face.breaksV().front()) / grid;
        for (int i = 0; i <= grid; ++i) {
            for (int j = 0; j <= grid; ++j) {
                const double u = face.breaksU().front() + i * step_u;
                const double v = face.breaksV().front() + j * step_v;
                const SurfacePoint point = face.evaluate(u, v);
                spacing = std::max({spacing, point.du.norm() * step_u, point.dv.norm() * step_v});
                starts.push_back({&face, u, v, (point.position - query).norm()});
                least = std::min(least, starts.back().distance);
            }
        }
    }
    // No point of the surface is farther than about a spacing from the grid.
    std::erase_if(starts, [&](const Start& s) { return s.distance > least + slack * spacing; });
    std::sort(starts.begin(), starts.end(), [](const Start& a, const Start& b) { return a.distance < b.distance; });
    // Neighbours lead to the same minimum: a start per few grid cells is enough.
    constexpr std::size_t most_starts = 60;
    const std::size_t stride = std::max<std::size_t>(1, starts.size() / most_starts);
    double best = least;
    for (std::size_t i = 0; i < starts.size(); i += stride) {
        const Start& s = starts[i];
        const double step_u = (s.face->breaksU().back() - s.face->breaksU().front()) / grid;
        const double step_v = (s.face->breaksV().back() - s.face->breaksV().front()) / grid;
        best = std::min(best, refine(*s.face, s.u, s.v, step_u, step_v, query));
    }
    return best;
}

}  // namespace cusp::geometry::test
