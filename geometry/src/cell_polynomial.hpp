// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A cell of a patch in the power basis about its centre: the fastest form to evaluate, and on a small cell an accurate one,
// since the coefficients fall off quickly.
#pragma once

#include <cusp/geometry/bezier_patch.hpp>

#include <array>
#include <cstddef>

namespace cusp::geometry::detail {

/// Highest degree in each direction; patches above it take the general way.
inline constexpr int fast_degree = 3;

/// A vector that the compiler keeps in two registers of two doubles each, as every x86-64 and ARM64 has them.
struct Lanes {
    using Pair [[gnu::vector_size(2 * sizeof(double))]] = double;
    Pair xy{};
    Pair z{};  ///< its second double holds a weight, or nothing

    Lanes& operator+=(const Lanes& b) {
        xy += b.xy;
        z += b.z;
        return *this;
    }
    friend Lanes operator+(Lanes a, const Lanes& b) { return a += b; }
    friend Lanes operator-(const Lanes& a, const Lanes& b) { return {a.xy - b.xy, a.z - b.z}; }
    friend Lanes operator*(const Lanes& a, double k) { return {a.xy * k, a.z * k}; }
    [[nodiscard]] double weight() const { return z[1]; }
};

struct LanePoint {
    Lanes position;
    Lanes ds;
    Lanes dt;
    Lanes dss;
    Lanes dst;
    Lanes dtt;
};

/// (N, w)(s, t) = Σ cᵢⱼ sⁱ tʲ and S = N/w, where the cell is |s|, |t| ≤ 1.
class CellPolynomial {
public:
    /// Whether the degree of the patch is low enough.
    [[nodiscard]] static bool canHold(const BezierPatch& patch) {
        return patch.degreeU() <= fast_degree && patch.degreeV() <= fast_degree;
    }
    /// `part` is the cell as a patch of its own; it must be one that can be held.
    explicit CellPolynomial(const BezierPatch& part);
    CellPolynomial() = default;

    [[nodiscard]] LanePoint evaluate(double s, double t) const {
        LanePoint p = degree_ <= 2 ? evaluateAs<2>(s, t) : evaluateAs<3>(s, t);
        if (rational_) divide(p);
        return p;
    }

private:
    static constexpr std::size_t size = fast_degree + 1;
    template <std::size_t degree>
    [[nodiscard]] LanePoint evaluateAs(double s, double t) const;
    static void divide(LanePoint& p);

    std::array<std::array<Lanes, size>, size> coefficients_{};
    int degree_ = fast_degree;
    bool rational_ = false;
};

[[nodiscard]] inline double dot(const Lanes& a, const Lanes& b) {
    const Lanes::Pair xy = a.xy * b.xy;
    return xy[0] + xy[1] + a.z[0] * b.z[0];
}
[[nodiscard]] inline Vector3 toVector(const Lanes& a) { return {a.xy[0], a.xy[1], a.z[0]}; }
[[nodiscard]] inline Lanes toLanes(const Vector3& a) { return {Lanes::Pair{a.x(), a.y()}, Lanes::Pair{a.z(), 0.0}}; }

template <std::size_t degree>
LanePoint CellPolynomial::evaluateAs(double s, double t) const {
    // Each row by Horner's scheme in t, the rows by Horner's scheme in s, derivatives along with them.
    LanePoint p{};
    for (std::size_t i = degree + 1; i-- > 0;) {
        Lanes value{};
        Lanes first{};
        Lanes second{};
        for (std::size_t j = degree + 1; j-- > 0;) {
            if (j + 2 <= degree) second = second * t + first;
            if (j + 1 <= degree) first = first * t + value;
            value = value * t + coefficients_[i][j];
        }
        if (i + 2 <= degree) p.dss = p.dss * s + p.ds;
        if (i + 1 <= degree) {
            p.ds = p.ds * s + p.position;
            p.dst = p.dst * s + p.dt;
        }
        p.position = p.position * s + value;
        p.dt = p.dt * s + first;
        p.dtt = p.dtt * s + second;
    }
    // Horner gives the second derivatives halved.
    p.dss += p.dss;
    p.dtt += p.dtt;
    return p;
}

/// Quotient rule; Piegl & Tiller 1997, eq. 4.20.
inline void CellPolynomial::divide(LanePoint& p) {
    const double inverse = 1.0 / p.position.weight();
    const double w_s = p.ds.weight();
    const double w_t = p.dt.weight();
    p.position = p.position * inverse;
    p.ds = (p.ds - p.position * w_s) * inverse;
    p.dt = (p.dt - p.position * w_t) * inverse;
    p.dss = (p.dss - p.ds * (2.0 * w_s) - p.position * p.dss.weight()) * inverse;
    p.dst = (p.dst - p.dt * w_s - p.ds * w_t - p.position * p.dst.weight()) * inverse;
    p.dtt = (p.dtt - p.dt * (2.0 * w_t) - p.position * p.dtt.weight()) * inverse;
}

}  // namespace cusp::geometry::detail
