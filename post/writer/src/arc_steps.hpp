// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// How an arc of the CL file is driven: as one circular block where the control can, else as straight moves.
#pragma once

#include <cusp/post/writer/nc_program.hpp>
#include <cusp/toolpath/cl_record.hpp>

#include <vector>

namespace cusp::post {

/// Steps from `start_mm` along `arc`, the rotary axes at `rotary_rad` all the way, programmed in the frame that
/// `programmed_from_workpiece` leads to. An arc about its ±Z is one ArcMove; any other becomes the fewest straight moves
/// whose chords stay within `chord_tolerance_mm` of it (sagitta r·(1 − cos(Δ/2)), equal angles). `start_mm` must lie on the
/// arc (the CL reader checks that).
[[nodiscard]] std::vector<NcItem> arcSteps(const toolpath::ArcMotion& arc, const geometry::Vector3& start_mm,
                                           const Eigen::Affine3d& programmed_from_workpiece,
                                           const RotaryValues& rotary_rad, const toolpath::FeedRate& feed,
                                           double chord_tolerance_mm);

/// Angle the arc turns by, in (0, 2π].
[[nodiscard]] double arcSweep(const toolpath::ArcMotion& arc, const geometry::Vector3& start_mm);

/// Of the way along the arc, its rise included.
[[nodiscard]] double arcLength(const toolpath::ArcMotion& arc, const geometry::Vector3& start_mm);

}  // namespace cusp::post
