// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Where a block takes the axes.
#include "block_preparation.hpp"

#include <cusp/post/reader/move_sampler.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace cusp::comm {

using dynamics::AxisVector;
using dynamics::PathBlock;
using dynamics::ToolPosition;
using kinematics::RotaryValues;
namespace nc = post::reader;

namespace {

constexpr double seconds_per_minute = 60.0;
constexpr double arc_chord_mm = 0.0005;
constexpr double travel_slack_mm = 1e-6;
constexpr double travel_slack_rad = 1e-8;
/// A vector printed with six decimals misses what the axes reach by that much.
constexpr double vector_rounding_rad = 1e-5;

geometry::Vector3 toEigen(const nc::Vector3& v) { return {v.x, v.y, v.z}; }

std::size_t arcParts(const nc::Arc& arc) {
    const double radius = std::max({arc.start_radius_mm, arc.end_radius_mm, 1e-9});
    const double step = 2.0 * std::acos(std::clamp(1.0 - arc_chord_mm / radius, -1.0, 1.0));
    return std::max<std::size_t>(2, static_cast<std::size_t>(std::ceil(std::abs(arc.sweep_rad) / step)));
}

/// "0.01" of CYCLE832; 0 when it is no plain number.
double numberOf(const std::string& text) {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    return end != text.c_str() && std::isfinite(value) ? value : 0.0;
}

}  // namespace

BlockPreparation::BlockPreparation(const post::MachineFile& file, const kinematics::Machine& machine,
                                   const ControlOptions& options)
    : file_(file), machine_(machine), options_(options), chain_(file.machine) {}

void BlockPreparation::begin(const AxisVector& axes) {
    items_.clear();
    axes_ = axes;
    alarm_.reset();
    smoothing_ = false;
    tolerance_mm_ = file_.control.cycle832_tolerance_mm;
    orientation_tolerance_rad_ = file_.control.cycle832_orientation_tolerance_rad;
    placement_ = {options_.tool_length_mm, options_.wcs_origin_mm};
    if (options_.setup != nullptr) placement_ = {};
}

dynamics::ToolPath BlockPreparation::toolPath() const {
    return {machine_, placement_.tool_length_mm, placement_.origin_mm};
}

void BlockPreparation::refuse(int number, std::size_t line, std::string text) {
    if (!alarm_) alarm_ = Alarm{number, line, std::move(text)};
}

void BlockPreparation::motion(const nc::ExecutedMotion& motion) {
    if (alarm_) return;
    if (motion.state->compensation != nc::RadiusCompensation::Off)
        return refuse(alarm::program, motion.place.line, "cutter radius compensation (G41, G42) is not run here");
    if (!place(motion)) return;
    auto block = path(motion);
    if (!block) return refuse(alarm::not_reached, motion.place.line, "the axes cannot bring the tool there");
    if (!withinTravel(*block, motion.place.line)) return;
    block->id = motion.place.line;
    block->feed_mm_per_s = feedOf(motion, *block);
    if (!(block->feed_mm_per_s > 0.0))
        return refuse(alarm::no_feed, motion.place.line, "no feed: F, or the spindle's speed under G95, is zero");
    block->exact_stop = !smoothing_ && motion.state->exact_stop;
    block->tolerance_mm = motion.state->contour_tolerance_mm.value_or(tolerance_mm_);
    block->orientation_tolerance_rad = motion.state->orientation_tolerance_rad.value_or(orientation_tolerance_rad_);
    axes_ = block->points.back().axes;
    items_.emplace_back(*std::move(block));
}

/// D0 takes the tool out of the reckoning; with a setup there is no tool before the first call either. A block in machine
/// coordinates needs to know neither.
bool BlockPreparation::place(const nc::ExecutedMotion& motion) {
    ToolPlacement now = placement_;
    const bool without_tool = motion.state->cutting_edge == 0;
    if (options_.setup == nullptr) {
        now.tool_length_mm = without_tool ? 0.0 : options_.tool_length_mm;
    } else if (!motion.machine_coordinates) {
        if (!without_tool && !motion.state->tool.empty() && !motion.placement.tool_length_mm) {
            refuse(alarm::no_tool_length, motion.place.line,
                   fmt::format("the setup does not say how long tool {} is", motion.state->tool));
            return false;
        }
        if (!motion.placement.origin_mm) {
            refuse(alarm::no_work_offset, motion.place.line,
                   motion.state->work_offset.empty()
                       ? std::string("no work offset is active (G54 …)")
                       : fmt::format("the setup does not say where {} lies", motion.state->work_offset));
            return false;
        }
        now = {motion.placement.tool_length_mm.value_or(0.0), toEigen(*motion.placement.origin_mm)};
    }
    if (now == placement_) return true;
    placement_ = now;
    items_.emplace_back(RestEvent{RestEvent::Kind::Placement, motion.place.line, 0.0, placement_});
    return true;
}

RotaryValues BlockPreparation::programmedRotary(const nc::ExecutedMotion& motion) const {
    RotaryValues out{axes_[3], axes_[4]};
    for (std::size_t i = 0; i < machine_.rotaryCount(); ++i)
        if (motion.end.rotary_rad[i]) out[i] = *motion.end.rotary_rad[i];
    return out;
}

std::optional<PathBlock> BlockPreparation::path(const nc::ExecutedMotion& motion) {
    if (motion.machine_coordinates ||
        (!motion.transformation && !motion.arc && !(motion.start_pose && motion.end_pose)))
        return axisPath(motion);
    return tipPath(motion);
}

/// Positions of axes: those of the machine (SUPA), or shifted so that they are the tip while the rotary axes are at zero.
PathBlock BlockPreparation::axisPath(const nc::ExecutedMotion& motion) {
    AxisVector target = axes_;
    const RotaryValues rotary = programmedRotary(motion);
    target[3] = rotary[0];
    target[4] = rotary[1];
    AxisVector upright = axes_;
    upright[3] = upright[4] = 0.0;
    geometry::Vector3 programmed = toolPath().placeOf(upright).tip_mm;
    bool moved = motion.joint_linear && motion.start_pose && motion.end_pose;
    if (moved) programmed = toEigen(motion.path_end_mm);
    for (std::size_t i = 0; i < 3 && !moved; ++i) {
        if (!motion.end.linear_mm[i] || motion.end.linear_mm[i] == motion.start.linear_mm[i]) continue;
        if (motion.machine_coordinates)
            target[i] = *motion.end.linear_mm[i];
        else
            programmed[static_cast<Eigen::Index>(i)] = *motion.end.linear_mm[i];
    }
    if (!motion.machine_coordinates)
        if (const auto point = toolPath().at({programmed, {}}))
            for (std::size_t i = 0; i < 3; ++i) target[i] = point->axes[i];
    return toolPath().axesLine(axes_, target);
}

std::optional<RotaryValues> BlockPreparation::rotaryFor(const nc::Vector3& axis, const RotaryValues& near) const {
    const kinematics::AxisSolutions solutions = machine_.solveAxis(toEigen(axis), vector_rounding_rad);
    if (solutions.miss_rad > vector_rounding_rad) return std::nullopt;
    std::optional<RotaryValues> best;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t branch = 0; branch < solutions.count; ++branch) {
        RotaryValues values = solutions.branch[branch];
        if (solutions.pole) values[0] = near[0];
        double way = 0.0;
        for (std::size_t i = 0; i < machine_.rotaryCount(); ++i) {
            constexpr double turn = 2.0 * std::numbers::pi;
            values[i] = near[i] + std::remainder(values[i] - near[i], turn);
            if (machine_.rotaryRange(i).excess(values[i]) > travel_slack_rad)
                for (const double winding : machine_.windings(i, values[i])) values[i] = winding;
            way = std::max(way, std::abs(values[i] - near[i]));
        }
        if (way >= least) continue;
        least = way;
        best = values;
    }
    return best;
}

/// The tip where the program takes it, and the tool axis as the program says: rotary axes linearly, or on the great circle.
std::optional<PathBlock> BlockPreparation::tipPath(const nc::ExecutedMotion& motion) {
    const dynamics::ToolPath tool = toolPath();
    const geometry::Vector3 start = tool.placeOf(axes_).tip_mm;
    geometry::Vector3 end = start;
    if (motion.end_pose)
        end = toEigen(motion.end_pose->tip_mm);
    else
        for (std::size_t i = 0; i < 3; ++i)
            if (motion.end.linear_mm[i]) end[static_cast<Eigen::Index>(i)] = *motion.end.linear_mm[i];
    const bool both = motion.start_pose && motion.end_pose;
    if (motion.joint_linear && both) return axisPath(motion);
    const RotaryValues from{axes_[3], axes_[4]};
    RotaryValues to = programmedRotary(motion);
    if (motion.vector_programmed) {
        if (!motion.end_pose) return std::nullopt;
        const auto reached = rotaryFor(motion.end_pose->axis, from);
        if (!reached) return std::nullopt;
        to = *reached;
    }
    const bool circle =
        both && (motion.vector_programmed || motion.orientation_path == nc::OrientationPath::GreatCircle);
    std::size_t parts = dynamics::partsOf(from, to);
    if (motion.arc) parts = std::max(parts, arcParts(*motion.arc));
    PathBlock block;
    RotaryValues rotary = from;
    for (std::size_t k = 0; k <= parts; ++k) {
        const double u = static_cast<double>(k) / static_cast<double>(parts);
        ToolPosition position{(1.0 - u) * start + u * end, {}};
        for (std::size_t i = 0; i < 2; ++i) position.rotary_rad[i] = std::lerp(from[i], to[i], u);
        if (both && motion.arc) position.tip_mm = toEigen(nc::poseAt(motion, chain_, u).tip_mm);
        if (circle && k > 0 && k < parts) {
            const auto reached = rotaryFor(nc::poseAt(motion, chain_, u).axis, rotary);
            if (!reached) return std::nullopt;
            position.rotary_rad = *reached;
        }
        rotary = position.rotary_rad;
        const auto point = tool.at(position);
        if (!point) return std::nullopt;
        block.points.push_back(*point);
    }
    block.points.front().axes = axes_;
    return block;
}

double BlockPreparation::feedOf(const nc::ExecutedMotion& motion, const PathBlock& block) const {
    if (motion.code == nc::MotionCode::Rapid) return std::numeric_limits<double>::infinity();
    const nc::Feed& feed = motion.state->feed;
    const double value = feed.value.value_or(0.0);
    double per_minute = value;
    if (feed.mode == nc::Feed::Mode::PerRevolution) per_minute = value * motion.state->spindle_rpm;
    if (feed.mode == nc::Feed::Mode::InverseTime) {
        double way = 0.0;
        for (std::size_t k = 1; k < block.points.size(); ++k)
            way += (block.points[k].tool.tip_mm - block.points[k - 1].tool.tip_mm).norm();
        per_minute = value * way;
    }
    return per_minute / seconds_per_minute * std::max(1.0, override_);
}

bool BlockPreparation::withinTravel(const PathBlock& block, std::size_t line) {
    for (const dynamics::PathPoint& point : block.points) {
        for (std::size_t i = 0; i < 3; ++i)
            if (machine_.linearRange(i).excess(point.axes[i]) > travel_slack_mm) {
                refuse(alarm::software_limit, line,
                       fmt::format("axis {} would go to {:.3f} mm, beyond its software limit ({:.6g} to {:.6g} mm)",
                                   machine_.linearNames()[i], point.axes[i], machine_.linearRange(i).min,
                                   machine_.linearRange(i).max));
                return false;
            }
        for (std::size_t i = 0; i < machine_.rotaryCount(); ++i)
            if (machine_.rotaryRange(i).excess(point.axes[3 + i]) > travel_slack_rad) {
                constexpr double deg = 180.0 / std::numbers::pi;
                refuse(alarm::software_limit, line,
                       fmt::format("axis {} would go to {:.3f}°, beyond its software limit ({:.6g}° to {:.6g}°)",
                                   machine_.rotaryNames()[i], point.axes[3 + i] * deg,
                                   machine_.rotaryRange(i).min * deg, machine_.rotaryRange(i).max * deg));
                return false;
            }
    }
    return true;
}

void BlockPreparation::event(const nc::BlockPlace& place, const nc::ExecutedEvent& event) {
    if (alarm_) return;
    const auto rest = [&](RestEvent::Kind kind, double seconds = 0.0) {
        items_.emplace_back(RestEvent{kind, place.line, seconds, placement_});
    };
    if (std::holds_alternative<nc::ToolChange>(event)) rest(RestEvent::Kind::Placement);
    if (const auto* dwell = std::get_if<nc::DwellTime>(&event))
        rest(RestEvent::Kind::Dwell, dwell->seconds.value_or(0.0));
    if (const auto* stop = std::get_if<nc::MachineStop>(&event))
        rest(stop->optional ? RestEvent::Kind::OptionalStop : RestEvent::Kind::Stop);
    if (std::holds_alternative<nc::ProgramEnd>(event)) rest(RestEvent::Kind::End);
    if (const auto* setting = std::get_if<nc::HighSpeedSetting>(&event)) {
        smoothing_ = !setting->arguments.empty();
        const auto argument = [&](std::size_t i) {
            return i < setting->arguments.size() ? numberOf(setting->arguments[i]) : 0.0;
        };
        tolerance_mm_ = argument(0);
        // The form up to software 4.4 has no third argument of that meaning.
        const bool with_orientation = file_.control.cycle832 == post::ControlDefinition::Cycle832::From45;
        orientation_tolerance_rad_ = with_orientation && argument(2) > 0.0
                                         ? argument(2) * std::numbers::pi / 180.0
                                         : file_.control.cycle832_orientation_tolerance_rad;
    }
}

}  // namespace cusp::comm
