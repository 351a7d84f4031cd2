// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What the axes can do: positions of all axes as one vector, and their limits of velocity, acceleration and jerk.
#pragma once

#include <cusp/kinematics/machine.hpp>

#include <array>
#include <cstddef>

namespace cusp::dynamics {

inline constexpr std::size_t max_axes = 5;

/// One value per axis: linear axes in mm, then rotary ones in rad, each in chain order; unused places are zero.
using AxisVector = std::array<double, max_axes>;

/// Largest magnitudes, in mm or rad, per s, s² and s³. All are above zero for the first `count` axes.
struct AxisLimits {
    std::size_t count = 3;
    AxisVector velocity{};
    AxisVector acceleration{};
    AxisVector jerk{};
};

[[nodiscard]] AxisLimits limitsOf(const kinematics::Machine& machine);

[[nodiscard]] inline AxisVector axisVector(const kinematics::AxisValues& values) {
    return {values.linear_mm.x(), values.linear_mm.y(), values.linear_mm.z(), values.rotary_rad[0],
            values.rotary_rad[1]};
}
[[nodiscard]] inline kinematics::AxisValues axisValues(const AxisVector& axes) {
    return {{axes[0], axes[1], axes[2]}, {axes[3], axes[4]}};
}

}  // namespace cusp::dynamics
