// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What the rotary axes do while the tool axis goes along a great circle: how far they turn, and where branches meet.
#pragma once

#include <cusp/kinematics/machine.hpp>

#include <cstddef>

namespace cusp::kinematics {

/// The unit axis at `fraction` of the great circle from one unit axis to another. Between opposite axes, where there are
/// many circles, it takes one.
[[nodiscard]] Vector3 onGreatCircle(const Vector3& from, const Vector3& to, double fraction);

/// How far the rotary axes turn when they follow the great circle from one axis to another on one branch (README.md,
/// "Following"). Exact, whatever the length of the way; meaningless when either end is the pole, where the first axis is
/// free.
[[nodiscard]] RotaryValues followStep(const AxisSolutions& from, const AxisSolutions& to, std::size_t branch);

/// Where on a great circle the branches come nearest to each other.
struct BranchMeeting {
    double gap_rad = 0.0;  ///< `Machine::branchGap` there
    double fraction = 0.0;
};
[[nodiscard]] BranchMeeting nearestMeeting(const Machine& machine, const Vector3& from, const Vector3& to);

/// The largest angle between the tool axis of rotary axes that turn linearly from one position to another and the great
/// circle between the axes of its ends, both taken at the same fraction of the way, sampled densely.
[[nodiscard]] double linearTurnDeviation(const Machine& machine, const RotaryValues& from, const RotaryValues& to);

}  // namespace cusp::kinematics
