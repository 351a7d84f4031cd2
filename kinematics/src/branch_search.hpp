// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Finds rotary positions by grid and Newton from forward kinematics alone: the witness of the closed form.
#pragma once

#include <cusp/kinematics/machine.hpp>

#include <vector>

namespace cusp::kinematics {

/// Every rotary position (modulo full turns) that gives `axis`, found by searching. Not meant for the pole, where there
/// is a continuum of them.
[[nodiscard]] std::vector<RotaryValues> searchBranches(const Machine& machine, const Vector3& axis);

/// The largest difference of two positions modulo full turns.
[[nodiscard]] double distanceModuloTurns(const RotaryValues& a, const RotaryValues& b);

}  // namespace cusp::kinematics
