// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Acceleration and jerk along a cubic path as Bernstein polynomials: what holds for their coefficients holds everywhere.
//
// With q the axis' position over x, b = x'²: q'' in time = q_xx b + q_x b_x / 2, a cubic in x, and q''' in time =
// √b (q_xxx b + 3/2 q_xx b_x + 1/2 q_x b_xx), √b times a quadratic.
#include "speed_rows.hpp"

#include <algorithm>
#include <cmath>

namespace cusp::dynamics {

namespace {

/// Derivatives of one axis over a span.
struct Shape {
    Triple d{};                 ///< q_x, quadratic
    std::array<double, 2> e{};  ///< q_xx, linear
    double f = 0.0;             ///< q_xxx
};

Shape shapeOf(const AxisCurve& curve, std::size_t axis) {
    Shape shape;
    for (std::size_t k = 0; k < 3; ++k)
        shape.d[k] = 3.0 * (curve.points[k + 1][axis] - curve.points[k][axis]) / curve.length;
    for (std::size_t k = 0; k < 2; ++k) shape.e[k] = 2.0 * (shape.d[k + 1] - shape.d[k]) / curve.length;
    shape.f = (shape.e[1] - shape.e[0]) / curve.length;
    return shape;
}

double largestSlope(const Shape& shape) {
    return std::max({std::abs(shape.d[0]), std::abs(shape.d[1]), std::abs(shape.d[2])});
}

/// Coefficients of acceleration over the Bernstein coefficients of b; g0, g1 stand for b_x / 2.
std::array<Triple, 4> accelerationOf(const Shape& q, double h) {
    const auto& [d0, d1, d2] = q.d;
    const auto& [e0, e1] = q.e;
    const auto of = [h](const Triple& b, double g0, double g1) {
        return Triple{b[0] - g0 / h, b[1] + (g0 - g1) / h, b[2] + g1 / h};
    };
    return {of({e0, 0.0, 0.0}, d0, 0.0), of({e1 / 3.0, 2.0 * e0 / 3.0, 0.0}, 2.0 * d1 / 3.0, d0 / 3.0),
            of({0.0, 2.0 * e1 / 3.0, e0 / 3.0}, d2 / 3.0, 2.0 * d1 / 3.0), of({0.0, 0.0, e1}, 0.0, d2)};
}

/// The same for jerk without its factor √b.
std::array<Triple, 3> jerkOf(const Shape& q, double h) {
    const std::array<std::array<double, 2>, 3> bend = {
        {{3.0 * q.e[0], 0.0}, {1.5 * q.e[1], 1.5 * q.e[0]}, {0.0, 3.0 * q.e[1]}}};
    std::array<Triple, 3> out{};
    for (std::size_t k = 0; k < 3; ++k) {
        const double g0 = bend[k][0] - q.d[k] / h;
        const double g1 = bend[k][1] + q.d[k] / h;
        out[k] = {-g0 / h, (g0 - g1) / h, g1 / h};
        out[k][k] += q.f;
    }
    return out;
}

/// At the border of a span that begins or ends at rest, b_x = 4/3 b / its length; so b = share · c of the span beside it.
double borderShare(double h, double rest) { return 1.0 / (1.0 + 2.0 * h / (3.0 * rest)); }

}  // namespace

SpeedRows::SpeedRows(const SpeedProblem& problem) {
    map(problem);
    for (std::size_t span = 0; span < problem.spans.size(); ++span) {
        addSpeed(problem, span);
        for (std::size_t axis = 0; axis < problem.limits.count; ++axis) addAxis(problem, span, axis);
    }
}

void SpeedRows::map(const SpeedProblem& problem) {
    const std::size_t n = problem.spans.size();
    maps_.resize(n);
    const auto length = [&](std::size_t span) { return problem.spans[span].length; };
    for (std::size_t j = 0; j < n; ++j) {
        maps_[j].of_c[1][1] = 1.0;
        if (j + 1 == n) {
            maps_[j].of_c[2][1] = borderShare(length(j), problem.end_rest.length);
            continue;
        }
        const double w = length(j) / (length(j) + length(j + 1));
        maps_[j].of_c[2] = {0.0, 1.0 - w, w};
        maps_[j + 1].of_c[0] = {1.0 - w, w, 0.0};
    }
    if (problem.start_rest)
        maps_[0].of_c[0][1] = borderShare(length(0), problem.start_rest->length);
    else
        maps_[0].constant[0] = problem.start_squared_speed;
}

SpanSpeed SpeedRows::speedOf(std::size_t span, const std::vector<double>& c) const {
    const Map& m = maps_[span];
    const Triple local = {span > 0 ? c[span - 1] : 0.0, c[span], span + 1 < c.size() ? c[span + 1] : 0.0};
    SpanSpeed out{};
    for (std::size_t k = 0; k < 3; ++k)
        out[k] = m.constant[k] + m.of_c[k][0] * local[0] + m.of_c[k][1] * local[1] + m.of_c[k][2] * local[2];
    return out;
}

/// Each span's own coefficient, and the values at the borders between spans with the smaller of two limits.
void SpeedRows::addSpeed(const SpeedProblem& problem, std::size_t span) {
    const auto limit = [&](std::size_t j) {
        double largest = problem.largest[j];
        for (std::size_t axis = 0; axis < problem.limits.count; ++axis) {
            const double slope = largestSlope(shapeOf(problem.spans[j], axis));
            if (slope > 0.0)
                largest =
                    std::min(largest, problem.limits.velocity[axis] * problem.limits.velocity[axis] / (slope * slope));
        }
        return largest;
    };
    const std::size_t n = problem.spans.size();
    const double own = limit(span);
    if (span > 0 || problem.start_rest) linear_.push_back({span, {0.0, 1.0 / own, 0.0}, 1.0});
    const double after =
        span + 1 < n ? limit(span + 1) : largestAfterRest(problem.end_rest, problem.limits, problem.end_largest);
    addLinear(span, {0.0, 0.0, 1.0}, std::min(own, after));
    if (span == 0 && problem.start_rest)
        addLinear(0, {1.0, 0.0, 0.0},
                  std::min(own, largestAfterRest(*problem.start_rest, problem.limits, problem.start_largest)));
}

void SpeedRows::addLinear(std::size_t span, const Triple& of_b, double limit) {
    const Map& m = maps_[span];
    SpeedRow row{span, {}, 1.0};
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t i = 0; i < 3; ++i) row.a[i] += of_b[k] * m.of_c[k][i] / limit;
        row.bound -= of_b[k] * m.constant[k] / limit;
    }
    linear_.push_back(row);
}

void SpeedRows::addAxis(const SpeedProblem& problem, std::size_t span, std::size_t axis) {
    const double h = problem.spans[span].length;
    const Shape shape = shapeOf(problem.spans[span], axis);
    const double acceleration = problem.limits.acceleration[axis];
    const auto accelerations = accelerationOf(shape, h);
    // Both q_xx and b_x are continuous: the last coefficient is the first of the next span.
    const std::size_t first = span == 0 && !problem.start_rest ? 1 : 0;
    const std::size_t last = span + 1 == problem.spans.size() ? 4 : 3;
    for (std::size_t k = first; k < last; ++k) {
        addLinear(span, accelerations[k], acceleration);
        addLinear(span, accelerations[k], -acceleration);
    }
    const auto jerks = jerkOf(shape, h);
    const Map& m = maps_[span];
    for (std::size_t k = 0; k < 3; ++k) {
        JerkRow row;
        row.span = span;
        row.limit = problem.limits.jerk[axis];
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t l = 0; l < 3; ++l) row.r[i] += jerks[k][l] * m.of_c[l][i];
            row.constant += jerks[k][i] * m.constant[i];
        }
        row.b = m.of_c[k];
        row.b_constant = m.constant[k];
        jerk_.push_back(row);
    }
}

}  // namespace cusp::dynamics
