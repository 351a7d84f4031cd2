// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Durations of the phases from the distance, then the phases.
#include <cusp/dynamics/s_curve.hpp>

#include <algorithm>
#include <cmath>

namespace cusp::dynamics {

namespace {

struct Phases {
    double jerk_s = 0.0;      ///< each of the four phases with jerk
    double constant_s = 0.0;  ///< at full acceleration, and again at full deceleration
    double cruise_s = 0.0;
};

/// The acceleration phase, jerk up and down included, covers half of (peak speed × its duration).
Phases phasesOf(double distance, const ScalarLimits& limits) {
    const auto& [v, a, j] = limits;
    Phases out;
    const bool reaches_acceleration = v * j >= a * a;
    out.jerk_s = reaches_acceleration ? a / j : std::sqrt(v / j);
    out.constant_s = reaches_acceleration ? v / a - a / j : 0.0;
    const double ramps = v * (2.0 * out.jerk_s + out.constant_s);
    if (distance >= ramps) {
        out.cruise_s = (distance - ramps) / v;
        return out;
    }
    const double largest_triangle = 2.0 * a * a * a / (j * j);
    if (!reaches_acceleration || distance <= largest_triangle) {
        out.jerk_s = std::cbrt(0.5 * distance / j);
        out.constant_s = 0.0;
        return out;
    }
    const double half = 0.5 * a / j;
    out.constant_s = -3.0 * half + std::sqrt(half * half + distance / a);
    return out;
}

}  // namespace

std::vector<StraightPhase> straightPhases(double distance, const ScalarLimits& limits) {
    const Phases phases = phasesOf(distance, limits);
    const double j = limits.jerk;
    const std::array<std::pair<double, double>, 7> plan = {{{phases.jerk_s, j},
                                                            {phases.constant_s, 0.0},
                                                            {phases.jerk_s, -j},
                                                            {phases.cruise_s, 0.0},
                                                            {phases.jerk_s, -j},
                                                            {phases.constant_s, 0.0},
                                                            {phases.jerk_s, j}}};
    std::vector<StraightPhase> out;
    double speed = 0.0;
    double acceleration = 0.0;
    for (const auto& [duration, jerk] : plan) {
        if (duration <= 0.0) continue;
        StraightPhase phase{{TimeLaw::Kind::ConstantJerk, speed, acceleration, jerk, duration}, 0.0};
        phase.length = phase.law.at(duration);
        out.push_back(phase);
        speed += duration * (acceleration + 0.5 * jerk * duration);
        acceleration += jerk * duration;
    }
    return out;
}

double straightTime(double distance, const ScalarLimits& limits) {
    const Phases phases = phasesOf(distance, limits);
    return 4.0 * phases.jerk_s + 2.0 * phases.constant_s + phases.cruise_s;
}

}  // namespace cusp::dynamics
