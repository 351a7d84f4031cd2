// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What a machine makes of a tilted path: whether its axes reach it, how far they turn, how long it takes.
#pragma once

#include <cusp/kinematics/machine.hpp>
#include <cusp/optimizer/tilt/tilted_path.hpp>

#include <array>
#include <cstddef>
#include <span>

namespace cusp::tilt {

/// A machine with the tool in it and the part on it. The machine must outlive this.
struct MachinePlace {
    const kinematics::Machine* machine = nullptr;
    double tool_length_mm = 100.0;  ///< gauge point to tip
    geometry::Vector3 origin_mm =
        geometry::Vector3::Zero();  ///< of the part's frame in the machine frame, all axes at zero
};

struct AxisMotion {
    /// How far the axes would have to go beyond their ends: of every axis in its own unit (deg, mm), added, mean over the
    /// locations. 0: within the machine's range.
    double range_excess = 0.0;
    std::size_t locations_beyond = 0;
    std::size_t rewinds = 0;                    ///< times a limit would force the tool off the part to unwind
    std::array<double, 2> rotary_travel_rad{};  ///< of each rotary axis, in chain order
    double time_s = 0.0;                        ///< see `axisMotion`
    /// Seconds: `time_s`, and what the rotary axes would take for their travel alone at full speed, one after the other. The
    /// smaller, the more harmonious the movement (the paper's third fitness).
    double harmony_s = 0.0;
    std::vector<kinematics::RotaryValues> rotary_rad;  ///< at every location
};

/// Of the rotary axes alone, in deg, mean over the poses: by how much the tool axes lie beyond what they reach.
[[nodiscard]] double rotaryExcess(const kinematics::Machine& machine, std::span<const toolpath::CutterLocation> poses);

/// Branches and windings are those of the axis planner (least time of the rotary axes over the whole path).
///
/// Time by a local bound, cheap enough to ask for every candidate: a move takes as long as its feed and the speed of each
/// axis demand; where the velocity of an axis changes from one move to the next faster than acceleration and jerk allow,
/// the moves beside the change are slowed down until they do (time scaled by λ divides accelerations by λ² and jerks by λ³).
[[nodiscard]] AxisMotion axisMotion(const MachinePlace& place, const StartPath& path,
                                    std::span<const toolpath::CutterLocation> poses);

/// Time of the whole path by the look-ahead of `cusp::dynamics`, within velocity, acceleration and jerk of every axis, corners
/// rounded within `tolerance_mm`. Empty where the linear axes cannot follow.
[[nodiscard]] std::optional<double> machiningTime(const MachinePlace& place, const StartPath& path,
                                                  std::span<const toolpath::CutterLocation> poses,
                                                  const AxisMotion& motion, double tolerance_mm = 0.01);

}  // namespace cusp::tilt
