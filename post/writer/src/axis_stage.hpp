// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The first half of planning a program: records wait until the branch planner has decided their rotary positions.
#pragma once

#include <cusp/kinematics/axis_planner.hpp>
#include <cusp/toolpath/cl_record.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace cusp::post {

/// A record and what was decided of it. Nearly all of a long file are straight motions: those stand in place.
struct PlannedRecord {
    toolpath::LinearMotion motion;
    kinematics::PlannedAxes axes;  ///< meaningless for a record without a location
    std::uint32_t line = 0;
    bool hole_ahead = false;  ///< a straight motion, behind which the tool drills before it turns or is changed
    std::unique_ptr<toolpath::ClRecord> other;  ///< any other statement
};

/// Shares nothing with the second half, so that both can run at once.
class AxisStage {
public:
    /// `machine` must outlive this.
    AxisStage(const kinematics::Machine& machine, kinematics::PlannerOptions options);

    void take(const toolpath::ClRecord& record);
    /// No more records: all that wait are decided.
    void finish() { axes_.finish(); }
    /// The next record in order, once it is decided.
    [[nodiscard]] bool next(PlannedRecord& out);

    [[nodiscard]] const kinematics::AxisPlanner& axes() const { return axes_; }

private:
    struct Waiting {
        toolpath::LinearMotion motion;
        std::unique_ptr<toolpath::ClRecord> other;
        std::uint32_t line = 0;
        bool located = false;  ///< waits for rotary positions
        bool hole_ahead = false;
    };
    void lookForHoles(const toolpath::ClStatement& statement);
    void beginRun(const geometry::Vector3& axis);
    void forget();

    kinematics::AxisPlanner axes_;
    std::vector<Waiting> waiting_;
    std::size_t first_ = 0;  ///< of `waiting_`; those before it were handed out
    bool at_home_ = true;    ///< the next location is reached from home, not cut to
    // Motions with one tool axis, not yet known to lead to a hole: from here on in `waiting_`.
    std::size_t run_begin_ = 0;
    geometry::Vector3 run_axis_ = geometry::Vector3::Zero();
};

}  // namespace cusp::post
