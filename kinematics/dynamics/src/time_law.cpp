// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Closed forms of motion along a piece.
#include <cusp/dynamics/motion_piece.hpp>

#include <algorithm>
#include <cmath>

namespace cusp::dynamics {

namespace {

/// Below this the series is exact to the last digit, and the closed form divides nothing by nothing.
constexpr double series_angle = 0.03;

/// x'' = a + k x from x = 0 with x' = v: hyperbolic, circular, or their common series.
double exponentialWay(double v, double a, double k, double t) {
    const double k_tt = k * t * t;
    if (std::abs(k_tt) < series_angle * series_angle)
        return t *
               (v * (1.0 + k_tt / 6.0 * (1.0 + k_tt / 20.0)) + 0.5 * a * t * (1.0 + k_tt / 12.0 * (1.0 + k_tt / 30.0)));
    const double omega = std::sqrt(std::abs(k));
    if (k > 0.0) {
        const double half = std::sinh(0.5 * omega * t);
        return v / omega * std::sinh(omega * t) + 2.0 * a / k * half * half;
    }
    const double half = std::sin(0.5 * omega * t);
    return v / omega * std::sin(omega * t) - 2.0 * a / k * half * half;
}

double exponentialSpeed(double v, double a, double k, double x) {
    return std::sqrt(std::max(0.0, v * v + 2.0 * a * x + k * x * x));
}

}  // namespace

AxisVector AxisCurve::at(double x) const {
    const double u = length > 0.0 ? std::clamp(x / length, 0.0, 1.0) : 0.0;
    const double w = 1.0 - u;
    const double w0 = w * w * w;
    const double w1 = 3.0 * w * w * u;
    const double w2 = 3.0 * w * u * u;
    const double w3 = u * u * u;
    AxisVector out;
    for (std::size_t i = 0; i < max_axes; ++i)
        out[i] = w0 * points[0][i] + w1 * points[1][i] + w2 * points[2][i] + w3 * points[3][i];
    return out;
}

double TimeLaw::at(double t) const {
    if (kind == Kind::ConstantJerk) return t * (speed + t * (0.5 * acceleration + t * rate / 6.0));
    return exponentialWay(speed, acceleration, rate, t);
}

TimeLaw quadraticSpeedLaw(const std::array<double, 3>& squared_speed, double length) {
    const auto& b = squared_speed;
    TimeLaw law;
    law.kind = TimeLaw::Kind::QuadraticSpeed;
    law.speed = std::sqrt(b[0]);
    law.acceleration = (b[1] - b[0]) / length;
    law.rate = (b[0] - 2.0 * b[1] + b[2]) / (length * length);
    // Newton's method on x(t) = length, which is monotone because the speed does not vanish.
    double t = length *
               (1.0 / law.speed + 4.0 / std::sqrt(0.25 * b[0] + 0.5 * b[1] + 0.25 * b[2]) + 1.0 / std::sqrt(b[2])) /
               6.0;
    for (int i = 0; i < 30; ++i) {
        const double x = exponentialWay(law.speed, law.acceleration, law.rate, t);
        const double slope = std::max(exponentialSpeed(law.speed, law.acceleration, law.rate, x), 1e-3 * law.speed);
        const double step = (x - length) / slope;
        t = std::max(0.5 * t, t - step);
        if (std::abs(step) < 1e-15 * t) break;
    }
    law.duration_s = t;
    return law;
}

}  // namespace cusp::dynamics
