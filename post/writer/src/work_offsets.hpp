// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Which settable frame each programming frame of the CL file becomes.
#pragma once

#include <cusp/geometry/frames.hpp>
#include <cusp/post/writer/program_planner.hpp>

#include <optional>
#include <string>
#include <vector>

namespace cusp::post {

/// The settable frame behind `name`: G54 … G57, G505 … G599. Empty behind the last, and behind G500.
[[nodiscard]] std::string nextSettableFrame(const std::string& name);

/// Frames get offsets in the order they come in: those of `names`, then the ones behind the last of these. A frame that comes
/// again has its offset already. A path without frames runs in the first.
class WorkOffsets {
public:
    explicit WorkOffsets(std::vector<std::string> names) : names_(std::move(names)) {}

    /// The offset of a frame; empty when there are none left.
    [[nodiscard]] std::string take(const geometry::RigidTransform& part_from_programming, std::uint32_t line);
    [[nodiscard]] const std::string& first() const { return names_.front(); }
    [[nodiscard]] const std::vector<UsedWorkOffset>& used() const { return used_; }

private:
    std::vector<std::string> names_;  ///< at least one
    std::vector<UsedWorkOffset> used_;
};

}  // namespace cusp::post
