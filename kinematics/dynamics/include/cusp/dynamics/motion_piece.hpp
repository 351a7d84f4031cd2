// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A piece of planned motion: a cubic curve in axis space, and when the machine is where on it.
#pragma once

#include <cusp/dynamics/axis_limits.hpp>

#include <array>
#include <cstdint>

namespace cusp::dynamics {

/// A cubic curve over x in [0, length] by its Bernstein points.
struct AxisCurve {
    std::array<AxisVector, 4> points{};
    double length = 0.0;

    [[nodiscard]] AxisVector at(double x) const;
};

/// Where on its curve a piece is after t seconds: x(0) = 0, x'(0) = speed, x''(0) = acceleration, and then either a
/// constant jerk x''' = rate, or a squared speed that is quadratic in x, which is x'' = acceleration + rate · x.
struct TimeLaw {
    enum class Kind : std::uint8_t { ConstantJerk, QuadraticSpeed };
    Kind kind = Kind::ConstantJerk;
    double speed = 0.0;
    double acceleration = 0.0;
    double rate = 0.0;
    double duration_s = 0.0;

    [[nodiscard]] double at(double t) const;
};

/// The law with squared speed b(x) = b0 (1−u)² + 2 b1 u (1−u) + b2 u², u = x / length; all three must be above zero.
[[nodiscard]] TimeLaw quadraticSpeedLaw(const std::array<double, 3>& squared_speed, double length);

struct MotionPiece {
    AxisCurve curve;
    TimeLaw law;
    std::uint64_t block = 0;  ///< id of the block in which the piece starts
    double path_mm = 0.0;     ///< path length at its start, from the start of its run

    [[nodiscard]] AxisVector at(double t) const { return curve.at(law.at(t)); }
};

}  // namespace cusp::dynamics
