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

/// The cycle for one hole. `spindle` and `feed` are what holds at the hole. The error is the sentence to report: a hole
/// that is not along Z, a cycle without clearance, feed or peck, a thread without spindle speed.
[[nodiscard]] tl::expected<HoleCycle, std::string> planHole(const toolpath::CycleStart& cycle,
                                                            const toolpath::CutterLocation& hole,
                                                            const Spindle& spindle,
                                                            const std::optional<toolpath::FeedRate>& feed);

}  // namespace cusp::post
