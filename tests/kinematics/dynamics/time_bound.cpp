// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Backward pass: from which squared speeds the end can be reached; forward pass: the largest of them that can be had.
#include "time_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cusp::dynamics::test {

namespace {

struct Station {
    double s = 0.0;
    AxisVector slope{};
    AxisVector bend{};
    double largest = 0.0;
};

/// Derivatives by differences of the curve itself.
Station stationAt(const MotionPiece& piece, double u, const AxisLimits& limits, double feed) {
    const double h = 1e-3 * piece.curve.length;
    const double x = std::clamp(u * piece.curve.length, h, piece.curve.length - h);
    const AxisVector a = piece.curve.at(x - h);
    const AxisVector b = piece.curve.at(x);
    const AxisVector c = piece.curve.at(x + h);
    Station out;
    out.s = piece.path_mm + u * piece.curve.length;
    out.largest = feed * feed;
    for (std::size_t i = 0; i < limits.count; ++i) {
        out.slope[i] = (c[i] - a[i]) / (2.0 * h);
        out.bend[i] = (c[i] - 2.0 * b[i] + a[i]) / (h * h);
        if (std::abs(out.slope[i]) > 1e-9)
            out.largest = std::min(out.largest, std::pow(limits.velocity[i] / out.slope[i], 2));
    }
    return out;
}

/// The range of path acceleration at squared speed b: |bend b + slope u| <= limit for every axis. Empty when low > high.
std::pair<double, double> accelerations(const Station& at, double b, const AxisLimits& limits) {
    double low = -std::numeric_limits<double>::infinity();
    double high = -low;
    for (std::size_t i = 0; i < limits.count; ++i) {
        const double slope = std::abs(at.slope[i]);
        if (slope < 1e-9) continue;
        const double middle = -at.bend[i] * b / at.slope[i];
        low = std::max(low, middle - limits.acceleration[i] / slope);
        high = std::min(high, middle + limits.acceleration[i] / slope);
    }
    return {low, high};
}

/// Largest b at `at` from which some acceleration leads over `ds` to at most `next`; what can be done with b can be done
/// with less, so bisection finds it.
double controllable(const Station& at, double next, double ds, const AxisLimits& limits) {
    const auto fits = [&](double b) {
        const auto [low, high] = accelerations(at, b, limits);
        return low <= high && b + 2.0 * ds * low <= next;
    };
    double good = 0.0;
    double bad = at.largest;
    if (fits(bad)) return bad;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (good + bad);
        (fits(middle) ? good : bad) = middle;
    }
    return good;
}

}  // namespace

double leastTime(const std::vector<MotionPiece>& pieces, const AxisLimits& limits, double feed_mm_per_s,
                 int points_per_piece) {
    std::vector<Station> stations;
    for (const MotionPiece& piece : pieces)
        for (int k = 0; k < points_per_piece; ++k)
            stations.push_back(stationAt(piece, static_cast<double>(k) / points_per_piece, limits, feed_mm_per_s));
    stations.push_back(stationAt(pieces.back(), 1.0, limits, feed_mm_per_s));
    std::vector<double> b(stations.size(), 0.0);
    for (std::size_t i = stations.size() - 1; i-- > 0;)
        b[i] = controllable(stations[i], b[i + 1], stations[i + 1].s - stations[i].s, limits);
    b[0] = 0.0;
    double time = 0.0;
    for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
        const double ds = stations[i + 1].s - stations[i].s;
        const double high = accelerations(stations[i], b[i], limits).second;
        b[i + 1] = std::min(b[i + 1], std::max(0.0, b[i] + 2.0 * ds * high));
        time += 2.0 * ds / (std::sqrt(b[i]) + std::sqrt(b[i + 1]));
    }
    return time;
}

}  // namespace cusp::dynamics::test
