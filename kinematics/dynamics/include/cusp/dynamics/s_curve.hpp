// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The fastest straight move from rest to rest: seven phases of constant jerk, in closed form.
#pragma once

#include <cusp/dynamics/motion_piece.hpp>

#include <vector>

namespace cusp::dynamics {

struct ScalarLimits {
    double velocity = 0.0;
    double acceleration = 0.0;
    double jerk = 0.0;
};

/// Up to seven phases along a distance above zero, none of zero duration; the time laws of one after the other, each from its own
/// x = 0. `length` of a phase is its law at its end.
struct StraightPhase {
    TimeLaw law;
    double length = 0.0;
};
[[nodiscard]] std::vector<StraightPhase> straightPhases(double distance, const ScalarLimits& limits);

/// Duration of that move, s.
[[nodiscard]] double straightTime(double distance, const ScalarLimits& limits);

}  // namespace cusp::dynamics
