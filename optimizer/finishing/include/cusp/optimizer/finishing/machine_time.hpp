// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// How long a path takes on a machine, and how far its axes go.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/kinematics/machine.hpp>
#include <cusp/optimizer/finishing/finishing_path.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cusp::finishing {

/// A machine with what of its control and its setup decides how long a path takes.
struct MachineSetting {
    const kinematics::Machine* machine = nullptr;
    double tool_length_mm = 150.0;              ///< tip to gauge point
    Vector3 origin_mm = Vector3::Zero();        ///< of the part in the machine frame, all axes at zero
    double tolerance_mm = 0.01;                 ///< how far the control may round corners (CTOL)
    double orientation_tolerance_rad = 1.7e-3;  ///< … of the tool axis (OTOL)
    double block_time_s = 0.0;                  ///< the least a block takes the control; 0: nothing is known of it
};

/// A move with the feed that holds for it; infinite where it is rapid.
struct TimedMove {
    toolpath::CutterLocation to;
    double feed_mm_per_s = 0.0;
    std::uint32_t line = 0;  ///< of the CL file; 0 where there is none
};

struct MachineTime {
    double total_s = 0.0;  ///< from the first location to the last, at rest at both
    std::size_t stops = 0;
    std::size_t blocks = 0;
    std::size_t slowed_by_blocks = 0;  ///< blocks whose feed the block time limits
    std::array<double, 2> rotary_travel_rad{};
    double tip_length_mm = 0.0;
};

/// Rotary positions by the planner of kinematics, motion by the look-ahead of dynamics.
/// Errors: `finishing.pose` names the first location the machine cannot take (with its CL line, what is out of reach and what
/// to change); `finishing.no-moves`.
[[nodiscard]] base::Result<MachineTime> machineTime(std::span<const TimedMove> moves, const MachineSetting& setting);

[[nodiscard]] std::vector<TimedMove> timedMoves(const FinishingPath& path);

}  // namespace cusp::finishing
