// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Where the tool is between the ends of a block, as the control interpolates.
#pragma once

#include <cusp/post/reader/executed_program.hpp>
#include <cusp/post/reader/forward_chain.hpp>

namespace cusp::post::reader {

/// Pose at `fraction` in [0, 1] of a motion whose two poses are known: the tip on its line or arc, or where
/// linear and rotary axes running together take it (`joint_linear`); the tool axis as
/// `orientation_path` says, or on the great circle when rotary values are not known.
[[nodiscard]] ToolPose poseAt(const ExecutedMotion& motion, const ForwardChain& chain, double fraction);

/// Bounds on the second derivatives of `poseAt` by the fraction, mm and rad: a sampled way cannot leave the chords of its
/// samples, 1/n apart, by more than an eighth of them by n².
struct Bend {
    double tip_mm = 0.0;
    double axis_rad = 0.0;
};
[[nodiscard]] Bend bendOf(const ExecutedMotion& motion, const ForwardChain& chain);

/// Largest travel of any rotary axis in the block, rad; 0 where values are not known.
[[nodiscard]] double rotaryTravel(const ExecutedMotion& motion);

}  // namespace cusp::post::reader
