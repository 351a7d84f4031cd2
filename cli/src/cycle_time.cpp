// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Steps of a program as blocks for the look-ahead.
#include "cycle_time.hpp"

#include <cusp/base/units.hpp>
#include <cusp/dynamics/tool_path.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cusp::cli {

using dynamics::AxisVector;
using dynamics::PathBlock;
using dynamics::ToolPath;
using dynamics::ToolPosition;
using geometry::Vector3;
using kinematics::RotaryValues;

namespace {

/// Chords of arcs miss them by this much at most.
constexpr double arc_chord_mm = 0.0005;
constexpr double seconds_per_minute = 60.0;

AxisVector homeOf(const kinematics::Machine& machine) {
    AxisVector home{};
    for (std::size_t i = 0; i < 3; ++i) home[i] = machine.definition().linear.at(machine.linearNames()[i]).home_mm;
    for (std::size_t i = 0; i < machine.rotaryCount(); ++i) home[3 + i] = machine.rotaryHome()[i];
    return home;
}

}  // namespace

struct CycleTimeEstimate::State {
    State(const post::MachineFile& machine_file, const kinematics::Machine& machine_model, CycleTimeOptions chosen,
          post::NcSink& sink)
        : file(machine_file),
          machine(machine_model),
          options(std::move(chosen)),
          next(sink),
          axes(homeOf(machine)),
          planner(dynamics::limitsOf(machine), {}, [this](const AxisVector& at) { return path.placeOf(at); }) {
        result.from_setup = options.setup != nullptr && options.setup->findOffset(options.work_offset) != nullptr;
        if (result.from_setup) origin = geometry::toVector(options.setup->findOffset(options.work_offset)->origin_mm);
        setTool(options.tool_length_mm);
    }

    const post::MachineFile& file;
    const kinematics::Machine& machine;
    CycleTimeOptions options;
    post::NcSink& next;
    CycleTime result;
    Vector3 origin = Vector3::Zero();
    ToolPath path{machine, 0.0, Vector3::Zero()};
    AxisVector axes;
    dynamics::MotionPlanner planner;
    bool smooth = false;
    bool axis_programming = false;
    std::optional<geometry::RigidTransform> workpiece_from_plane;  ///< points are in a tilted plane
    double tool_length_mm = 0.0;
    double rpm = 0.0;
    post::HoleCycle hole;
    std::size_t moves = 0;
    bool lost = false;
    bool too_many = false;

    void setTool(double length_mm) {
        tool_length_mm = length_mm;
        path = ToolPath(machine, length_mm, origin);
    }
    /// The part lies where the offset is; the axes stand still meanwhile.
    void setOffset(const std::string& name) {
        const machine::WorkOffset* offset =
            options.setup != nullptr ? options.setup->findOffset(name.empty() ? options.work_offset : name) : nullptr;
        result.from_setup = result.from_setup && offset != nullptr;
        if (offset == nullptr) return;
        const Vector3 place = geometry::toVector(offset->origin_mm);
        if (place == origin) return;
        rest();
        origin = place;
        setTool(tool_length_mm);
    }

    [[nodiscard]] double feedOf(const toolpath::FeedRate& feed) const {
        return feed.unit == toolpath::FeedRate::Unit::MmPerS ? feed.value : feed.value * rpm / seconds_per_minute;
    }

    void run() {
        while (planner.ready())
            for (const auto& piece : planner.plan().committed) result.motion_s += piece.law.duration_s;
    }
    void rest() {
        planner.stop();
        run();
    }
    void add(std::optional<PathBlock> block, double feed_mm_per_s) {
        if (!block || !(feed_mm_per_s > 0.0)) {
            lost = true;
            return;
        }
        // A turn of the rotary axes is planned in parts, each as dear as a move.
        moves += std::max<std::size_t>(1, block->points.size() - 1);
        too_many = options.most_moves > 0 && moves > options.most_moves;
        block->feed_mm_per_s = feed_mm_per_s;
        block->exact_stop = !smooth;
        block->tolerance_mm = file.control.cycle832_tolerance_mm;
        block->orientation_tolerance_rad = file.control.cycle832_orientation_tolerance_rad;
        axes = block->points.back().axes;
        planner.add(*block);
        run();
    }
    void rapid(std::optional<PathBlock> block) { add(std::move(block), std::numeric_limits<double>::infinity()); }

    [[nodiscard]] ToolPosition here() const { return {path.placeOf(axes).tip_mm, {axes[3], axes[4]}}; }
    [[nodiscard]] Vector3 tipOf(const Vector3& point_mm) const {
        return workpiece_from_plane ? Vector3(*workpiece_from_plane * point_mm) : point_mm;
    }
    /// All axes at a programmed point.
    [[nodiscard]] std::optional<AxisVector> axesAt(const Vector3& point_mm, const RotaryValues& rotary_rad) const {
        const auto at = path.at({tipOf(point_mm), axis_programming ? RotaryValues{} : rotary_rad});
        if (!at) return std::nullopt;
        AxisVector out = at->axes;
        out[3] = rotary_rad[0];
        out[4] = rotary_rad[1];
        return out;
    }
    [[nodiscard]] std::optional<PathBlock> moveTo(const Vector3& point_mm, const RotaryValues& rotary_rad) const {
        if (!axis_programming) return path.line(here(), {tipOf(point_mm), rotary_rad});
        const auto target = axesAt(point_mm, rotary_rad);
        return target ? std::optional(path.axesLine(axes, *target)) : std::nullopt;
    }
    [[nodiscard]] Vector3 programmedHere() const {
        if (workpiece_from_plane) return workpiece_from_plane->inverse() * here().tip_mm;
        if (!axis_programming) return here().tip_mm;
        AxisVector upright = axes;
        upright[3] = upright[4] = 0.0;
        return path.placeOf(upright).tip_mm;
    }

    void see(const post::GoHome&) {
        const AxisVector home = homeOf(machine);
        AxisVector lifted = axes;
        for (std::size_t i = 0; i < 3; ++i)
            if (machine.linearNames()[i] == file.control.retract_axis) lifted[i] = home[i];
        rapid(path.axesLine(axes, lifted));
        rest();
        rapid(path.axesLine(axes, home));
        rest();
    }
    void see(const post::ChangeTool& tool) {
        rest();
        const auto known = options.setup ? options.setup->toolLength(tool.number, tool.name) : std::nullopt;
        result.from_setup = result.from_setup && known;
        setTool(known.value_or(options.tool_length_mm));
    }
    void see(const post::Smoothing& item) { smooth = item.on; }
    void see(const post::Spindle& item) { rpm = item.speed_rpm; }
    void see(const post::PositionRotary& item) {
        rapid(path.axesLine(axes, {axes[0], axes[1], axes[2], item.rotary_rad[0], item.rotary_rad[1]}));
    }
    void see(const post::TipProgramming& item) {
        axis_programming = false;
        workpiece_from_plane.reset();
        if (item.on) setOffset(item.work_offset);
    }
    void see(const post::SelectWorkOffset& item) { setOffset(item.name); }
    void see(const post::TiltedPlane& item) {
        axis_programming = false;
        see(post::PositionRotary{item.rotary_rad});
        workpiece_from_plane = item.workpieceFromPlane();
    }
    void see(const post::PlaneOff&) { workpiece_from_plane.reset(); }
    void see(const post::AxisProgramming& item) {
        rest();
        workpiece_from_plane.reset();
        axis_programming = true;
        origin = item.wcs_origin_mm;
        setTool(item.tool_length_mm);
    }
    void see(const post::Approach& item) {
        rapid(moveTo({item.point_mm.x(), item.point_mm.y(), programmedHere().z()}, item.rotary_rad));
        go(item.point_mm, item.rotary_rad, item.kind, item.feed);
    }
    void see(const post::Move& item) {
        if (item.moves_per_min > 0.0) {
            auto block = moveTo(item.point_mm, item.rotary_rad);
            const double way =
                block ? (block->points.back().tool.tip_mm - block->points.front().tool.tip_mm).norm() : 0.0;
            if (way > 0.0) return add(std::move(block), way * item.moves_per_min / seconds_per_minute);
            return rapid(std::move(block));
        }
        go(item.point_mm, item.rotary_rad, item.kind, item.feed);
    }
    void go(const Vector3& point_mm, const RotaryValues& rotary_rad, toolpath::MotionKind kind,
            const toolpath::FeedRate& feed) {
        auto block = moveTo(point_mm, rotary_rad);
        if (kind == toolpath::MotionKind::Rapid) return rapid(std::move(block));
        add(std::move(block), feedOf(feed));
    }
    /// The rotary axes stand still.
    void see(const post::ArcMove& item) {
        const Vector3 start = programmedHere();
        const Vector3 center = start + item.center_from_start_mm;
        const double from = std::atan2(start.y() - center.y(), start.x() - center.x());
        const double to = std::atan2(item.end_mm.y() - center.y(), item.end_mm.x() - center.x());
        constexpr double full_turn = 2.0 * std::numbers::pi;
        double sweep = item.clockwise ? from - to : to - from;
        sweep -= full_turn * std::floor(sweep / full_turn);
        if (sweep < 1e-12) sweep = full_turn;
        const double radius = std::hypot(item.center_from_start_mm.x(), item.center_from_start_mm.y());
        const double chord = 2.0 * std::acos(std::clamp(1.0 - arc_chord_mm / std::max(radius, 1e-9), -1.0, 1.0));
        PathBlock block;
        const auto parts = std::max<std::size_t>(2, static_cast<std::size_t>(std::ceil(sweep / chord)));
        for (std::size_t k = 0; k <= parts; ++k) {
            const double u = static_cast<double>(k) / static_cast<double>(parts);
            const double angle = from + (item.clockwise ? -u : u) * sweep;
            const auto at = axesAt({center.x() + radius * std::cos(angle), center.y() + radius * std::sin(angle),
                                    std::lerp(start.z(), item.end_mm.z(), u)},
                                   item.rotary_rad);
            if (!at) {
                lost = true;
                return;
            }
            block.points.push_back(path.at(*at));
        }
        add(std::move(block), feedOf(item.feed));
    }
    void see(const post::HoleCycle& item) { hole = item; }
    /// Pecks as one stroke.
    void see(const post::HolePosition& item) {
        const auto at = [&](double z) { return moveTo({item.x_mm, item.y_mm, z}, item.rotary_rad); };
        rapid(at(programmedHere().z()));
        rapid(at(hole.surface_z_mm + hole.clearance_mm));
        add(at(hole.surface_z_mm - hole.depth_mm), feedOf(hole.feed));
        rest();
        result.dwell_s += hole.dwell_s;
        rapid(at(hole.retract_z_mm));
    }
    void see(const post::Pause& item) {
        rest();
        result.dwell_s += item.seconds;
    }
    void see(const post::Stop&) { rest(); }

    // No motion; each named, so that a new kind of step cannot go unseen.
    void see(const post::Comment&) {}
    void see(const post::Literal&) {}
    void see(const post::RadiusCompensation&) {}
    void see(const post::ModalStart&) {}
    void see(const post::ScreenMessage&) {}
    void see(const post::Coolant&) {}
    void see(const post::HoleCycleOff&) {}
};

CycleTimeEstimate::CycleTimeEstimate(const post::MachineFile& file, const kinematics::Machine& machine,
                                     CycleTimeOptions options, post::NcSink& next)
    : state_(std::make_unique<State>(file, machine, std::move(options), next)) {}

CycleTimeEstimate::~CycleTimeEstimate() = default;

void CycleTimeEstimate::step(const post::NcStep& step) {
    if (!state_->lost && !state_->too_many) std::visit([this](const auto& item) { state_->see(item); }, step.item);
    state_->next.step(step);
}

std::optional<CycleTime> CycleTimeEstimate::finish() {
    if (state_->lost || state_->too_many) return std::nullopt;
    state_->rest();
    state_->result.planning = state_->planner.summary();
    return state_->result;
}

bool CycleTimeEstimate::tooManyMoves() const { return state_->too_many; }

}  // namespace cusp::cli
