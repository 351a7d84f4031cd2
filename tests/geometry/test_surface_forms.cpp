// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Conversion to Bézier patches against evaluation by other routes: Horner, Cox-de Boor, derivatives by differences.
#include <cusp/base/random.hpp>
#include <cusp/geometry/surface_forms.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace cusp::geometry::test {
namespace {

constexpr std::uint64_t seed = 5;

Vector3 randomPoint(base::Random& random, double size) {
    return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// N_{i,p}(t) by the recurrence (Piegl & Tiller 1997, eq. 2.5); the last span is closed on the right.
double coxDeBoor(const std::vector<double>& knots, std::size_t i, std::size_t degree, double t, double last) {
    if (degree == 0) {
        return knots[i] <= t && (t < knots[i + 1] || (t == last && knots[i] < last && knots[i + 1] >= last)) ? 1.0
                                                                                                             : 0.0;
    }
    double out = 0.0;
    if (knots[i + degree] > knots[i]) {
        out += (t - knots[i]) / (knots[i + degree] - knots[i]) * coxDeBoor(knots, i, degree - 1, t, last);
    }
    if (knots[i + degree + 1] > knots[i + 1]) {
        out += (knots[i + degree + 1] - t) / (knots[i + degree + 1] - knots[i + 1]) *
               coxDeBoor(knots, i + 1, degree - 1, t, last);
    }
    return out;
}

TEST(SurfaceForms, PolynomialOverAnyRange) {
    base::Random random(seed);
    PolynomialForm form;
    form.u_range = {-1.5, 2.0};
    form.v_range = {0.25, 0.75};
    form.coefficients.assign(4, std::vector<Vector3>(3));
    for (auto& row : form.coefficients) {
        for (Vector3& c : row) c = randomPoint(random, 3.0);
    }
    const auto face = toFace(form, Outward::DuCrossDv);
    ASSERT_TRUE(face.has_value()) << base::toText(face.error());
    for (int k = 0; k < 200; ++k) {
        const double u = random.uniform(-1.5, 2.0);
        const double v = random.uniform(0.25, 0.75);
        Vector3 expected = Vector3::Zero();
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = 0; j < 3; ++j) {
                expected +=
                    form.coefficients[i][j] * std::pow(u, static_cast<double>(i)) * std::pow(v, static_cast<double>(j));
            }
        }
        EXPECT_LE((face->evaluate(u, v).position - expected).norm(), 1e-12);
    }
}

BSplineForm randomSpline(base::Random& random, bool rational) {
    BSplineForm form;
    form.degree_u = 3;
    form.degree_v = 2;
    form.knots_u = {0, 0, 0, 0, 0.3, 0.3, 0.7, 1, 1, 1, 1};
    form.knots_v = {-2, -1, 0, 1, 2.5, 3, 4, 7};  // not clamped: the domain is 0 … 3
    for (int i = 0; i < 7; ++i) {
        form.points.emplace_back();
        if (rational) form.weights.emplace_back();
        for (int j = 0; j < 5; ++j) {
            form.points.back().push_back(Vector3(1e4 + 10.0 * i, 8.0 * j, 0.0) + randomPoint(random, 3.0));
            if (rational) form.weights.back().push_back(random.uniform(0.3, 3.0));
        }
    }
    return form;
}

Vector3 evaluateSpline(const BSplineForm& form, double u, double v) {
    Vector3 sum = Vector3::Zero();
    double weight = 0.0;
    for (std::size_t i = 0; i < form.points.size(); ++i) {
        for (std::size_t j = 0; j < form.points[i].size(); ++j) {
            const double w = (form.weights.empty() ? 1.0 : form.weights[i][j]) * coxDeBoor(form.knots_u, i, 3, u, 1.0) *
                             coxDeBoor(form.knots_v, j, 2, v, 3.0);
            sum += w * form.points[i][j];
            weight += w;
        }
    }
    return sum / weight;
}

TEST(SurfaceForms, BSplinesClampedOrNotRationalOrNot) {
    base::Random random(seed);
    for (const bool rational : {false, true}) {
        const BSplineForm form = randomSpline(random, rational);
        const auto face = toFace(form, Outward::DuCrossDv);
        ASSERT_TRUE(face.has_value()) << base::toText(face.error());
        EXPECT_EQ(face->breaksU(), (std::vector<double>{0, 0.3, 0.7, 1}));
        EXPECT_EQ(face->breaksV(), (std::vector<double>{0, 1, 2.5, 3}));
        EXPECT_EQ(face->patches().front().isRational(), rational);
        for (int k = 0; k < 300; ++k) {
            const double u = k == 0 ? 1.0 : k == 1 ? 0.3 : random.uniform();
            const double v = k == 0 ? 3.0 : k == 1 ? 2.5 : random.uniform(0.0, 3.0);
            EXPECT_LE((face->evaluate(u, v).position - evaluateSpline(form, u, v)).norm(), 1e-11) << u << " " << v;
        }
    }
}

TEST(SurfaceForms, DerivativesAgreeWithDifferences) {
    base::Random random(seed);
    const auto face = toFace(randomSpline(random, true), Outward::DuCrossDv);
    ASSERT_TRUE(face.has_value());
    constexpr double h = 1e-5;
    for (int k = 0; k < 100; ++k) {
        const double u = 0.3 + 0.4 * random.uniform(0.01, 0.99);
        const double v = 1.0 + 1.5 * random.uniform(0.01, 0.99);
        const SurfacePoint p = face->evaluate(u, v);
        const SurfacePoint east = face->evaluate(u + h, v);
        const SurfacePoint west = face->evaluate(u - h, v);
        const SurfacePoint north = face->evaluate(u, v + h);
        const SurfacePoint south = face->evaluate(u, v - h);
        EXPECT_LE(((east.position - west.position) / (2 * h) - p.du).norm(), 1e-5 * p.du.norm());
        EXPECT_LE(((north.position - south.position) / (2 * h) - p.dv).norm(), 1e-5 * p.dv.norm());
        EXPECT_LE(((east.du - west.du) / (2 * h) - p.duu).norm(), 1e-5 * (1.0 + p.duu.norm()));
        EXPECT_LE(((east.dv - west.dv) / (2 * h) - p.duv).norm(), 1e-5 * (1.0 + p.duv.norm()));
        EXPECT_LE(((north.dv - south.dv) / (2 * h) - p.dvv).norm(), 1e-5 * (1.0 + p.dvv.norm()));
    }
}

}  // namespace
}  // namespace cusp::geometry::test
