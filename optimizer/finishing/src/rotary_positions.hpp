// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The positions of the rotary axes along a path.
#pragma once

#include <cusp/kinematics/axis_planner.hpp>
#include <cusp/optimizer/finishing/machine_time.hpp>

#include <span>
#include <vector>

namespace cusp::finishing {

/// One for each move, branch and winding chosen over the whole path. Error `finishing.pose` as in `machineTime`.
[[nodiscard]] base::Result<std::vector<kinematics::PlannedAxes>> rotaryPositions(std::span<const TimedMove> moves,
                                                                                 const MachineSetting& setting);

}  // namespace cusp::finishing
