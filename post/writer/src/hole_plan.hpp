// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// From a CYCLE statement and a hole's location to a drilling cycle with absolute heights.
#pragma once

#include <cusp/post/writer/nc_program.hpp>
#include <cusp/toolpath/cl_record.hpp>

#include <optional>
#include <string>
#include <tl/expected.hpp>

namespace cusp::post {

/// The cycle for one hole, whose location and axis are those of the frame it is programmed in. `spindle` and `feed` are what
/// holds at the hole; `tap_pitch_mm` is the pitch of a thread whose cycle has no feed of its own. The error is the sentence
/// to report: a hole that is not along Z, a cycle without clearance, feed or peck, a thread without spindle speed.
[[nodiscard]] tl::expected<HoleCycle, std::string>
planHole(const toolpath::CycleStart& cycle, const toolpath::CutterLocation& hole, const Spindle& spindle,
         const std::optional<toolpath::FeedRate>& feed, const std::optional<double>& tap_pitch_mm = {});

/// Whether a tool axis is that of a hole along Z, to within a CL file's seventh decimal.
[[nodiscard]] bool alongZ(const geometry::Vector3& axis);

}  // namespace cusp::post
