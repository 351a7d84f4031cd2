// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// CL records become straight moves.
#include <cusp/simulation/tool_move.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace cusp::simulation {

using geometry::Vector3;
using toolpath::CutterLocation;
using toolpath::MotionKind;

PathCollector::PathCollector(std::string file, double chord_tolerance_mm, base::Diagnostics& report)
    : file_(std::move(file)), chord_tolerance_mm_(chord_tolerance_mm), report_(report) {}

void PathCollector::take(const toolpath::ClRecord& record) {
    const auto& statement = record.statement;
    if (const auto* motion = std::get_if<toolpath::LinearMotion>(&statement))
        moveTo(motion->location, motion->kind, record.line);
    else if (const auto* arc = std::get_if<toolpath::ArcMotion>(&statement))
        turn(*arc, record.line);
    else if (const auto* hole = std::get_if<toolpath::HoleLocation>(&statement))
        drill(hole->location, record.line);
    else if (const auto* cycle = std::get_if<toolpath::CycleStart>(&statement))
        cycle_ = *cycle;
    else if (const auto* frame = std::get_if<toolpath::ProgrammingFrame>(&statement))
        part_from_programming_ = frame->part_from_programming;
    else if (const auto* tool = std::get_if<toolpath::ToolCall>(&statement))
        call(*tool);
    else if (const auto* start = std::get_if<toolpath::StartPosition>(&statement)) {
        at_ = start->location;
        placed_ = true;
    } else if (std::holds_alternative<toolpath::HomeReturn>(statement))
        placed_ = false;  // from where the file does not say
}

CutterLocation PathCollector::inPart(const CutterLocation& location) const {
    return {part_from_programming_ * location.tip_mm, part_from_programming_.linear() * location.axis};
}

void PathCollector::call(const toolpath::ToolCall& tool) {
    placed_ = false;  // the change happens away from the part
    told_ = false;
    const toolpath::Tool* known = tool_;
    if (known == nullptr && library_ != nullptr && tool.number) known = library_->findNumber(*tool.number);
    if (known == nullptr && library_ != nullptr) known = library_->findName(tool.name);
    shaped_ = known != nullptr || tool.cutter.has_value();
    if (!shaped_) return;
    path_.cutters.push_back(known != nullptr ? known->cutter() : *tool.cutter);
    path_.tools.push_back(known);
}

void PathCollector::moveTo(const CutterLocation& location, MotionKind kind, std::uint32_t line) {
    ++path_.locations;
    if (!shaped_ && tool_ != nullptr) {
        // A file that calls no tool at all.
        path_.cutters.push_back(tool_->cutter());
        path_.tools.push_back(tool_);
        shaped_ = true;
    }
    if (!shaped_) {
        if (!told_)
            report_.error("simulation.no-cutter",
                          "the tool moves here, and the CL file has not told its shape (CUTTER, TLDATA)",
                          {file_, line, {}, {}});
        told_ = true;
    } else if (placed_) {
        path_.moves.push_back(
            {inPart(at_), inPart(location), kind, line, static_cast<std::uint32_t>(path_.cutters.size() - 1)});
    }
    at_ = location;
    placed_ = true;
}

void PathCollector::turn(const toolpath::ArcMotion& arc, std::uint32_t line) {
    const Vector3 out = at_.tip_mm - arc.center_mm;
    const Vector3 end_out = arc.end.tip_mm - arc.center_mm;
    const double rise = end_out.dot(arc.normal) - out.dot(arc.normal);
    double sweep =
        std::atan2(arc.normal.dot(out.cross(end_out)), out.dot(end_out - end_out.dot(arc.normal) * arc.normal));
    if (sweep <= 0.0 || arc.full_circle)
        sweep = arc.full_circle ? 2.0 * std::numbers::pi : sweep + 2.0 * std::numbers::pi;
    // The sagitta of a chord is R (1 − cos(Δ/2)).
    const double step = 2.0 * std::acos(std::clamp(1.0 - chord_tolerance_mm_ / arc.radius_mm, 0.0, 1.0));
    const int chords = std::max(1, static_cast<int>(std::ceil(sweep / std::max(step, 1e-4))));
    const std::size_t before = path_.locations;
    for (int i = 1; i < chords; ++i) {
        const double part = static_cast<double>(i) / chords;
        const Vector3 tip =
            arc.center_mm + Eigen::AngleAxisd(part * sweep, arc.normal) * out + part * rise * arc.normal;
        moveTo({tip, arc.end.axis}, MotionKind::Feed, line);
    }
    moveTo(arc.end, MotionKind::Feed, line);
    path_.locations = before + 1;
}

void PathCollector::drill(const CutterLocation& location, std::uint32_t line) {
    const double above = cycle_.clearance_mm.value_or(0.0);
    const double out = cycle_.retract_mm.value_or(above);
    const std::size_t before = path_.locations;
    moveTo({location.tip_mm + above * location.axis, location.axis}, MotionKind::Rapid, line);
    moveTo({location.tip_mm - cycle_.depth_mm * location.axis, location.axis}, MotionKind::Feed, line);
    moveTo({location.tip_mm + out * location.axis, location.axis}, MotionKind::Rapid, line);
    path_.locations = before + 1;
}

}  // namespace cusp::simulation
