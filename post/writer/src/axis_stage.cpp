// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Records in, records with rotary positions out, in the same order.
#include "axis_stage.hpp"

#include <algorithm>
#include <utility>

namespace cusp::post {

using toolpath::ClRecord;
using toolpath::MotionKind;

namespace {

/// Tool axes this close are one.
constexpr double same_axis = 1e-6;

/// Where a statement sends the tool; none for a statement that does not move it.
const toolpath::CutterLocation* locationOf(const toolpath::ClStatement& statement) {
    if (const auto* motion = std::get_if<toolpath::LinearMotion>(&statement)) return &motion->location;
    if (const auto* arc = std::get_if<toolpath::ArcMotion>(&statement)) return &arc->end;
    if (const auto* hole = std::get_if<toolpath::HoleLocation>(&statement)) return &hole->location;
    return nullptr;
}

bool isCut(const toolpath::ClStatement& statement) {
    const auto* motion = std::get_if<toolpath::LinearMotion>(&statement);
    return motion != nullptr ? motion->kind == MotionKind::Feed
                             : std::holds_alternative<toolpath::ArcMotion>(statement);
}

}  // namespace

AxisStage::AxisStage(const kinematics::Machine& machine, kinematics::PlannerOptions options)
    : axes_(machine, std::move(options)) {}

void AxisStage::take(const ClRecord& record) {
    const auto& statement = record.statement;
    const auto* motion = std::get_if<toolpath::LinearMotion>(&statement);
    const toolpath::CutterLocation* location = motion != nullptr ? &motion->location : locationOf(statement);
    Waiting& item = waiting_.emplace_back();
    item.line = record.line;
    item.located = location != nullptr;
    if (motion != nullptr) {
        item.motion = *motion;
        // A motion with another tool axis begins another run.
        if ((location->axis - run_axis_).squaredNorm() > same_axis * same_axis) beginRun(location->axis);
    } else {
        item.other = std::make_unique<ClRecord>(record);
        if (std::holds_alternative<toolpath::ToolCall>(statement) ||
            std::holds_alternative<toolpath::HomeReturn>(statement))
            at_home_ = true;
        lookForHoles(statement);
    }
    if (location == nullptr) return;
    const bool from_home = std::exchange(at_home_, false);
    axes_.push({location->axis, record.line, isCut(statement) && !from_home});
}

void AxisStage::beginRun(const geometry::Vector3& axis) {
    run_begin_ = waiting_.size() - 1;
    run_axis_ = axis;
}

/// Whether motions lead to a hole with the tool axis they have, and the tool stays the same: then they belong to the plane
/// of the hole. Looks no further than the branch planner has.
void AxisStage::lookForHoles(const toolpath::ClStatement& statement) {
    const auto* hole = std::get_if<toolpath::HoleLocation>(&statement);
    if (hole != nullptr && (hole->location.axis - run_axis_).squaredNorm() <= same_axis * same_axis)
        for (std::size_t i = std::max(run_begin_, first_); i < waiting_.size(); ++i) waiting_[i].hole_ahead = true;
    if (hole != nullptr || std::holds_alternative<toolpath::ToolCall>(statement) ||
        std::holds_alternative<toolpath::OperationStart>(statement))
        beginRun(geometry::Vector3::Zero());
}

bool AxisStage::next(PlannedRecord& out) {
    if (first_ == waiting_.size()) return false;
    Waiting& item = waiting_[first_];
    if (item.located && !axes_.pop(out.axes)) {
        forget();
        return false;
    }
    out.motion = item.motion;
    out.line = item.line;
    out.hole_ahead = item.hole_ahead;
    out.other = std::move(item.other);
    ++first_;
    return true;
}

/// What was handed out, now and then: the branch planner decides many at once.
void AxisStage::forget() {
    constexpr std::size_t worth_moving = 4096;
    if (first_ < worth_moving || 2 * first_ < waiting_.size()) return;
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(first_));
    run_begin_ -= std::min(run_begin_, first_);
    first_ = 0;
}

}  // namespace cusp::post
