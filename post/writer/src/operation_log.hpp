// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Keeps the books of each operation: tool, extents, feeds, lengths.
#pragma once

#include <cusp/post/writer/program_planner.hpp>

#include <string>
#include <vector>

namespace cusp::post {

class OperationLog {
public:
    void begin(const std::string& name, std::uint32_t line);
    /// What the following motions run with; a new record when it differs and the one at hand has motions.
    void setTool(const ChangeTool* tool, const std::optional<geometry::Cutter>& cutter);
    void setPlace(const std::string& work_offset, bool tilted_plane);

    /// `length_mm` from where the tool stood; 0 when it came from home.
    void motion(const geometry::Vector3& tip_mm, toolpath::MotionKind kind, double length_mm,
                const toolpath::FeedRate& feed, double speed_rpm);
    /// `bottom_mm` is what the tip reaches.
    void hole(const geometry::Vector3& bottom_mm, double speed_rpm);

    [[nodiscard]] std::vector<OperationRecord> take() { return std::move(records_); }

private:
    OperationRecord& current();
    void reach(const geometry::Vector3& tip_mm, double speed_rpm);
    void split();

    std::vector<OperationRecord> records_;
};

}  // namespace cusp::post
