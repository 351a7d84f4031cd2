// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Cubics on the smoother side of every interval, cut where they turn.
#include "texture/texture_curve.hpp"

#include <algorithm>
#include <cmath>

namespace cusp::inspect {

namespace {

/// First sample of the stencil of interval i, chosen by the smaller divided difference at each widening.
std::size_t stencilStart(std::span<const double> z, std::size_t i) {
    const std::size_t last = z.size() - 1;
    const auto second = [z](std::size_t k) { return std::abs(z[k] - 2.0 * z[k + 1] + z[k + 2]); };
    const auto third = [z](std::size_t k) { return std::abs(z[k + 3] - 3.0 * z[k + 2] + 3.0 * z[k + 1] - z[k]); };
    std::size_t start = i;
    if (i > 0 && (i + 2 > last || second(i - 1) < second(i))) start = i - 1;
    if (start > 0 && (start + 3 > last || third(start - 1) < third(start))) --start;
    return start;
}

/// Coefficients of 1, s, s², s³ with s = 0 at sample `i`, through the samples from `start` on (Newton's form, expanded).
std::array<double, 4> cubicThrough(std::span<const double> z, std::size_t start, std::size_t i) {
    const std::size_t points = std::min<std::size_t>(4, z.size() - start);
    std::array<double, 4> difference{};
    for (std::size_t k = 0; k < points; ++k) difference[k] = z[start + k];
    for (std::size_t order = 1; order < points; ++order)
        for (std::size_t k = points - 1; k >= order; --k)
            difference[k] = (difference[k] - difference[k - 1]) / static_cast<double>(order);
    const double shift = static_cast<double>(i) - static_cast<double>(start);  // s + shift counts from `start`
    std::array<double, 4> out{};
    std::array<double, 4> product{1.0, 0.0, 0.0, 0.0};  // of (s + shift − j)
    for (std::size_t k = 0; k < points; ++k) {
        for (std::size_t power = 0; power < 4; ++power) out[power] += difference[k] * product[power];
        const double root = shift - static_cast<double>(k);
        for (std::size_t power = 3; power > 0; --power) product[power] = product[power] * root + product[power - 1];
        product[0] *= root;
    }
    // The curve meets its samples exactly, whatever rounding does to the rest.
    out[0] = z[i];
    return out;
}

/// Places in (0, 1), ascending, where the cubic turns.
std::vector<double> turningPoints(const std::array<double, 4>& c) {
    const double a = 3.0 * c[3];
    const double b = 2.0 * c[2];
    std::vector<double> out;
    const auto keep = [&out](double s) {
        if (s > 0.0 && s < 1.0) out.push_back(s);
    };
    const double discriminant = b * b - 4.0 * a * c[1];
    if (a == 0.0) {
        if (b != 0.0) keep(-c[1] / b);
    } else if (discriminant > 0.0) {
        const double q = -0.5 * (b + std::copysign(std::sqrt(discriminant), b));
        keep(q / a);
        if (q != 0.0) keep(c[1] / q);
    }
    std::sort(out.begin(), out.end());
    return out;
}

}  // namespace

TextureCurve::TextureCurve(std::span<const double> heights) : highest_(heights[0]), lowest_(heights[0]) {
    coefficients_.reserve(heights.size() - 1);
    pieces_.reserve(heights.size() + heights.size() / 8);
    for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
        coefficients_.push_back(cubicThrough(heights, stencilStart(heights, i), i));
        addPieces(i, heights[i + 1]);
    }
    for (const Piece& piece : pieces_) {
        highest_ = std::max({highest_, piece.z_from, piece.z_to});
        lowest_ = std::min({lowest_, piece.z_from, piece.z_to});
    }
}

void TextureCurve::addPieces(std::size_t interval, double z_end) {
    double from = 0.0;
    double z_from = height(interval, from);
    std::vector<double> ends = turningPoints(coefficients_[interval]);
    ends.push_back(1.0);
    for (const double to : ends) {
        // The next interval begins at exactly this height: no crossing falls between two of them.
        const double z_to = to == 1.0 ? z_end : height(interval, to);
        pieces_.push_back({interval, from, to, z_from, z_to});
        from = to;
        z_from = z_to;
    }
}

double TextureCurve::height(std::size_t interval, double local) const {
    const auto& c = coefficients_[interval];
    return c[0] + local * (c[1] + local * (c[2] + local * c[3]));
}

double TextureCurve::slope(std::size_t interval, double local) const {
    const auto& c = coefficients_[interval];
    return c[1] + local * (2.0 * c[2] + local * 3.0 * c[3]);
}

double TextureCurve::crossing(const Piece& piece, double level) const {
    double low = piece.from;
    double high = piece.to;
    const bool rises = piece.z_to > piece.z_from;
    double at = low + (high - low) * (level - piece.z_from) / (piece.z_to - piece.z_from);
    // Newton's steps, kept within the bracket by bisection.
    constexpr int most_steps = 60;
    for (int step = 0; step < most_steps; ++step) {
        const double z = height(piece.interval, at) - level;
        if (z == 0.0) break;
        ((z < 0.0) == rises ? low : high) = at;
        const double newton = at - z / slope(piece.interval, at);
        const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
        if (std::abs(next - at) <= 1e-16 * (1.0 + std::abs(at))) break;
        at = next;
    }
    return std::clamp(at, piece.from, piece.to);
}

double TextureCurve::meanOverPart(std::size_t interval, double from, double to,
                                  const std::function<double(double, double)>& f) const {
    // Gauss–Legendre, 7 points: exact to degree 13, so for z⁴ of a cubic (Abramowitz, Stegun, table 25.4).
    constexpr std::array nodes{0.0, 0.405845151377397166906606412077, 0.741531185599394439863864773281,
                               0.949107912342758524526189684048};
    constexpr std::array weights{0.417959183673469387755102040816, 0.381830050505118944950369775489,
                                 0.279705391489276667901467771424, 0.129484966168869693270611432679};
    const double middle = 0.5 * (from + to);
    const double half = 0.5 * (to - from);
    const auto value = [&](double local) { return f(height(interval, local), slope(interval, local)); };
    double sum = weights[0] * value(middle);
    for (std::size_t k = 1; k < nodes.size(); ++k)
        sum += weights[k] * (value(middle - half * nodes[k]) + value(middle + half * nodes[k]));
    return half * sum;
}

double TextureCurve::mean(const std::function<double(double, double)>& f, double level) const {
    double sum = 0.0;
    for (const Piece& piece : pieces_) {
        if ((piece.z_from < level) != (piece.z_to < level)) {
            const double at = crossing(piece, level);
            sum += meanOverPart(piece.interval, piece.from, at, f) + meanOverPart(piece.interval, at, piece.to, f);
        } else {
            sum += meanOverPart(piece.interval, piece.from, piece.to, f);
        }
    }
    return sum / length();
}

double TextureCurve::materialRatio(double level) const {
    double above = 0.0;
    for (const Piece& piece : pieces_) {
        const bool begins_above = piece.z_from >= level;
        const bool ends_above = piece.z_to >= level;
        if (begins_above && ends_above)
            above += piece.to - piece.from;
        else if (begins_above)
            above += crossing(piece, level) - piece.from;
        else if (ends_above)
            above += piece.to - crossing(piece, level);
    }
    return above / length();
}

double TextureCurve::levelAtRatio(double ratio) const {
    double low = lowest_;
    double high = highest_;
    constexpr int halvings = 60;
    for (int i = 0; i < halvings && high > low; ++i) {
        const double middle = 0.5 * (low + high);
        (materialRatio(middle) > ratio ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace cusp::inspect
