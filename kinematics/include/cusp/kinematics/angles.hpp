// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Angles on the circle: wrapping to one turn and back.
#pragma once

#include <cmath>
#include <numbers>

namespace cusp::kinematics {

inline constexpr double turn_rad = 2.0 * std::numbers::pi;

/// The same angle in (−π, π].
[[nodiscard]] inline double wrapAngle(double angle_rad) {
    if (angle_rad > -std::numbers::pi && angle_rad <= std::numbers::pi) return angle_rad;
    // Within a turn and a half, the usual case, one subtraction gives what remainder would.
    if (std::abs(angle_rad) < 3.0 * std::numbers::pi) {
        const double near = angle_rad > 0.0 ? angle_rad - turn_rad : angle_rad + turn_rad;
        return near <= -std::numbers::pi ? std::numbers::pi : near;
    }
    const double wrapped = std::remainder(angle_rad, turn_rad);
    return wrapped <= -std::numbers::pi ? std::numbers::pi : wrapped;
}

}  // namespace cusp::kinematics
