// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// One record at a time, the last one growing.
#include "operation_log.hpp"

#include <cusp/base/units.hpp>

#include <algorithm>

namespace cusp::post {

using toolpath::FeedRate;
using toolpath::MotionKind;

OperationRecord& OperationLog::current() {
    if (records_.empty()) records_.emplace_back();
    return records_.back();
}

/// What is known of the operation goes on in a record of its own.
void OperationLog::split() {
    OperationRecord& now = current();
    if (now.locations == 0) return;
    OperationRecord next;
    next.name = now.name;
    next.line = now.line;
    next.tool_number = now.tool_number;
    next.tool_name = now.tool_name;
    next.cutter = now.cutter;
    next.work_offset = now.work_offset;
    records_.push_back(std::move(next));
}

void OperationLog::begin(const std::string& name, std::uint32_t line) {
    split();
    current().name = name;
    current().line = line;
}

void OperationLog::setTool(const ChangeTool* tool, const std::optional<geometry::Cutter>& cutter) {
    split();
    if (tool != nullptr) {
        current().tool_number = tool->number;
        current().tool_name = tool->name;
    }
    current().cutter = cutter;
}

void OperationLog::setPlace(const std::string& work_offset, bool tilted_plane) {
    if (current().work_offset != work_offset || current().tilted_plane != tilted_plane) split();
    current().work_offset = work_offset;
    current().tilted_plane = tilted_plane;
}

void OperationLog::reach(const geometry::Vector3& tip_mm, double speed_rpm) {
    OperationRecord& now = current();
    const bool first = now.locations++ == 0;
    now.low_mm = first ? tip_mm : geometry::Vector3(now.low_mm.cwiseMin(tip_mm));
    now.high_mm = first ? tip_mm : geometry::Vector3(now.high_mm.cwiseMax(tip_mm));
    now.speed_rpm = std::max(now.speed_rpm, speed_rpm);
}

void OperationLog::motion(const geometry::Vector3& tip_mm, MotionKind kind, double length_mm, const FeedRate& feed,
                          double speed_rpm) {
    reach(tip_mm, speed_rpm);
    OperationRecord& now = current();
    if (kind == MotionKind::Rapid) {
        now.rapid_length_mm += length_mm;
        return;
    }
    const double feed_mm_per_s = feed.unit == FeedRate::Unit::MmPerRev ? feed.value * speed_rpm / 60.0 : feed.value;
    now.feed_length_mm += length_mm;
    if (feed_mm_per_s <= 0.0) return;
    now.feed_time_s += length_mm / feed_mm_per_s;
    const double per_min = base::mmPerMinFromMmPerS(feed_mm_per_s);
    now.least_feed = now.greatest_feed == 0.0 ? per_min : std::min(now.least_feed, per_min);
    now.greatest_feed = std::max(now.greatest_feed, per_min);
}

void OperationLog::hole(const geometry::Vector3& bottom_mm, double speed_rpm) {
    reach(bottom_mm, speed_rpm);
    ++current().holes;
}

}  // namespace cusp::post
