// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A rational Bézier curve over [0, 1].
#pragma once

#include <cusp/geometry/frames.hpp>

#include <utility>
#include <vector>

namespace cusp::geometry {

/// Position and derivatives by the parameter.
struct CurvePoint {
    Vector3 position = Vector3::Zero();
    Vector3 first = Vector3::Zero();
    Vector3 second = Vector3::Zero();
};

/// C(t) = Σ Bᵢ(t) (wx, wy, wz)ᵢ / Σ Bᵢ(t) wᵢ with positive weights.
class BezierCurve {
public:
    using Vector4 = Eigen::Vector4d;

    /// `net` holds (wx, wy, wz, w): degree + 1 values, at least two.
    explicit BezierCurve(std::vector<Vector4> net) : net_(std::move(net)) {}

    [[nodiscard]] const std::vector<Vector4>& net() const { return net_; }
    [[nodiscard]] CurvePoint evaluate(double t) const;
    /// The halves, each over [0, 1] of its own (de Casteljau).
    [[nodiscard]] std::pair<BezierCurve, BezierCurve> split() const;
    /// The same curve with its coordinates taken about another origin.
    [[nodiscard]] BezierCurve about(const Vector3& origin) const;

private:
    std::vector<Vector4> net_;
};

}  // namespace cusp::geometry
