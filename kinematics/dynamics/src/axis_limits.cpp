// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Limits out of the machine file, in the order of the axis vector.
#include <cusp/dynamics/axis_limits.hpp>

namespace cusp::dynamics {

AxisLimits limitsOf(const kinematics::Machine& machine) {
    AxisLimits limits;
    limits.count = 3 + machine.rotaryCount();
    for (std::size_t i = 0; i < 3; ++i) {
        const machine::LinearAxis& axis = machine.definition().linear.at(machine.linearNames()[i]);
        limits.velocity[i] = axis.max_velocity_mm_per_s;
        limits.acceleration[i] = axis.max_acceleration_mm_per_s2;
        limits.jerk[i] = axis.max_jerk_mm_per_s3;
    }
    for (std::size_t i = 0; i < machine.rotaryCount(); ++i) {
        const machine::RotaryAxis& axis = machine.definition().rotary.at(machine.rotaryNames()[i]);
        limits.velocity[3 + i] = axis.max_velocity_rad_per_s;
        limits.acceleration[3 + i] = axis.max_acceleration_rad_per_s2;
        limits.jerk[3 + i] = axis.max_jerk_rad_per_s3;
    }
    return limits;
}

}  // namespace cusp::dynamics
