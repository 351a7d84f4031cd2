// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Order within a block: codes, feed and speed, transformation, tool, M functions that begin something, motion, M functions
// that end something (ISO 6983-1).
#include "executor.hpp"

#include "arc.hpp"

#include <cusp/base/units.hpp>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace cusp::post::reader {

namespace {

/// A rotary axis this close to zero is at zero.
constexpr double zero_rad = 1e-9;

bool has(const BlockContent& content, int m_function) {
    return std::find(content.m_functions.begin(), content.m_functions.end(), m_function) != content.m_functions.end();
}

}  // namespace

Executor::Executor(const MachineFile& machine, const ForwardChain& chain, ProgramSink& sink, base::Diagnostics& report)
    : machine_(machine), chain_(chain), sink_(sink), report_(report) {
    active_[group::motion] = "G1";
    active_[group::plane] = "G17";
    active_[group::units] = "G710";
    active_[group::dimension] = "G90";
    active_[group::feed] = "G94";
    active_[group::orientation_frame] = "ORIWKS";
    active_[group::orientation_path] = "ORIVECT";
    // Without rotary axes the tool axis is the spindle's, always.
    if (chain.rotaryCount() == 0) tool_axis_ = chain.toolAxis({});
}

bool Executor::isActive(int group, std::string_view code) const {
    return active_[static_cast<std::size_t>(group)] == code;
}

void Executor::error(std::string_view code, std::string message) {
    report_.error(code, std::move(message), block_->where);
}

double Executor::mmPerUnit() const {
    return isActive(group::units, "G70") || isActive(group::units, "G700") ? base::mm_per_inch : 1.0;
}

void Executor::forgetLinear() { position_.linear_mm = {}; }

MotionCode Executor::motionCode() const {
    const char digit = active_[group::motion][1];
    return digit == '0'   ? MotionCode::Rapid
           : digit == '1' ? MotionCode::Linear
           : digit == '2' ? MotionCode::ArcClockwise
                          : MotionCode::ArcCounterClockwise;
}

OrientationPath Executor::orientationPath() const {
    const bool linear = machine_.control.md21104_ori_ipo_with_g_code ? isActive(group::orientation_path, "ORIAXES")
                                                                     : isActive(group::orientation_frame, "ORIMKS");
    return linear ? OrientationPath::RotaryLinear : OrientationPath::GreatCircle;
}

void Executor::run(const Block& block, const BlockContent& content, bool in_subprogram) {
    block_ = &block;
    in_subprogram_ = in_subprogram;
    returned_ = false;
    place_ = {block.where.line, block.number};
    applyCodes(content);
    if (content.message) sink_.event(place_, OperatorMessage{*content.message});
    if (content.high_speed) sink_.event(place_, HighSpeedSetting{*content.high_speed});
    if (content.dwell) return dwell(content);
    applyFeedAndSpeed(content);
    if (content.transformation) applyTransformation(*content.transformation);
    applyTool(content);
    applyEarlyFunctions(content);
    move(content);
    applyLateFunctions(content);
}

void Executor::applyCodes(const BlockContent& content) {
    for (const GroupCode& code : content.codes) {
        auto& active = active_[static_cast<std::size_t>(code.group)];
        if (!code.modal || active == code.name) continue;
        active = code.name;
        if (code.group == group::work_offset) {
            state_.work_offset = std::string(code.name);
            forgetLinear();
        }
        // Another kind of feed needs a new F (PM12, G93, G94, G95).
        if (code.group == group::feed) {
            state_.feed.mode = code.name == "G93"   ? Feed::Mode::InverseTime
                               : code.name == "G95" ? Feed::Mode::PerRevolution
                                                    : Feed::Mode::PerMinute;
            state_.feed.value.reset();
        }
    }
}

void Executor::applyFeedAndSpeed(const BlockContent& content) {
    if (content.feed) {
        // G70 leaves the feed in the basic system, G700 takes it along.
        const bool inch = isActive(group::units, "G700") && state_.feed.mode != Feed::Mode::InverseTime;
        if (*content.feed > 0.0)
            state_.feed.value = *content.feed * (inch ? base::mm_per_inch : 1.0);
        else
            error("nc.feed", "F must be greater than 0");
    } else if (state_.feed.mode == Feed::Mode::InverseTime)
        state_.feed.value.reset();  // G93: every block needs its own
    if (!content.speed) return;
    if (*content.speed >= 0.0)
        state_.spindle_rpm = *content.speed;
    else
        error("nc.speed", "S must not be negative");
}

void Executor::applyTransformation(bool on) {
    if (on && chain_.rotaryCount() == 0)
        return error("nc.no-orientation", "TRAORI needs rotary axes; this machine has none");
    if (on != transformation_) {
        forgetLinear();
        sink_.event(place_, TransformationSwitch{on});
    }
    transformation_ = on;
}

void Executor::applyTool(const BlockContent& content) {
    if (content.tool) preselected_tool_ = *content.tool;
    if (has(content, 6)) {
        state_.tool = preselected_tool_;
        state_.cutting_edge = 1;  // MD20270 $MC_CUTTING_EDGE_DEFAULT, as Siemens delivers it
        forgetLinear();
        // Every tool change stops the spindle and the coolant; what the machine builder switches on again is not relied on.
        state_.spindle = SpindleTurn::Off;
        state_.mist = state_.flood = false;
        sink_.event(place_, ToolChange{state_.tool});
    }
    if (!content.cutting_edge) return;
    const double edge = *content.cutting_edge;
    if (edge < 0.0 || edge > 9999.0 || edge != std::floor(edge))
        return error("nc.tool", "D takes a whole number from 0");
    const int number = static_cast<int>(edge);
    if (state_.cutting_edge == number) return;
    state_.cutting_edge = number;
    forgetLinear();
}

void Executor::applyEarlyFunctions(const BlockContent& content) {
    for (const int turn : {3, 4})
        if (has(content, turn)) {
            state_.spindle = turn == 3 ? SpindleTurn::Clockwise : SpindleTurn::CounterClockwise;
            sink_.event(place_, SpindleStart{state_.spindle, state_.spindle_rpm});
        }
    if (!has(content, 7) && !has(content, 8)) return;
    state_.mist = state_.mist || has(content, 7);
    state_.flood = state_.flood || has(content, 8);
    sink_.event(place_, CoolantChange{state_.mist, state_.flood});
}

void Executor::applyLateFunctions(const BlockContent& content) {
    if (has(content, 5)) {
        state_.spindle = SpindleTurn::Off;
        sink_.event(place_, SpindleStop{});
    }
    if (has(content, 9)) {
        state_.mist = state_.flood = false;
        sink_.event(place_, CoolantChange{});
    }
    for (const int stop : {0, 1})
        if (has(content, stop)) sink_.event(place_, MachineStop{stop == 1});
    for (const int end : {2, 17, 30})
        if (has(content, end) && in_subprogram_)
            returned_ = true;
        else if (has(content, end)) {
            ended_ = true;
            sink_.event(place_, ProgramEnd{end});
        }
}

void Executor::dwell(const BlockContent& content) {
    if (content.movesLinear() || content.movesRotary() || content.hasVector())
        return error("nc.dwell", "G4 cannot stand in a block that moves an axis");
    if (content.feed.has_value() == content.speed.has_value())
        return error("nc.dwell", "G4 needs either F (seconds) or S (revolutions)");
    sink_.event(place_, DwellTime{content.feed, content.speed});
    applyLateFunctions(content);
}

bool Executor::checkMotion(const BlockContent& content, bool is_arc, bool moves) {
    if (!is_arc && content.hasArcWords()) {
        error("nc.arc", "I, J, K, CR and TURN belong to G2 and G3");
        return false;
    }
    if (moves && !isActive(group::motion, "G0") && !state_.feed.value && !feed_missing_reported_) {
        feed_missing_reported_ = true;
        error("nc.no-feed", "a feed motion without feed: no F has been programmed for the active feed type");
    }
    if (content.hasVector() && (!transformation_ || content.movesRotary())) {
        error("nc.vector", transformation_ ? "A3, B3, C3 and rotary axes exclude each other in a block"
                                           : "A3, B3, C3 have a meaning under TRAORI only");
        return false;
    }
    return true;
}

void Executor::move(const BlockContent& content) {
    ExecutedMotion motion;
    motion.code = motionCode();
    const bool is_arc = motion.code == MotionCode::ArcClockwise || motion.code == MotionCode::ArcCounterClockwise;
    const bool moves =
        content.movesLinear() || content.movesRotary() || content.hasVector() || (is_arc && content.hasArcWords());
    if (!checkMotion(content, is_arc, moves) || !moves) return;
    motion.place = place_;
    motion.transformation = transformation_;
    motion.vector_programmed = content.hasVector();
    motion.orientation_path = orientationPath();
    motion.machine_coordinates = std::any_of(content.codes.begin(), content.codes.end(), [](const GroupCode& code) {
        return code.group == group::frame_suppression;
    });
    motion.start = position_;
    motion.start_pose = motion.machine_coordinates ? std::nullopt : pose(position_);
    if (!applyTargets(content, motion) || !applyVector(content)) return forgetLinear();
    motion.end.rotary_rad = position_.rotary_rad;
    if (!motion.machine_coordinates) {
        if (transformation_) requireRotary();
        motion.end_pose = pose(position_);
        if (is_arc && !addArc(content, motion)) return;
    } else if (is_arc)
        return error("nc.arc", "an arc in machine coordinates is not interpreted");
    motion.state = &state_;
    ++motions_;
    sink_.motion(motion);
}

std::optional<double> Executor::reach(const AxisTarget& target, const std::optional<double>& now, double scale,
                                      std::string_view axis, bool endless) {
    using Mode = AxisTarget::Mode;
    const double value = target.value * scale;
    const bool incremental =
        target.mode == Mode::Incremental || (target.mode == Mode::Modal && isActive(group::dimension, "G91"));
    if (target.mode == Mode::Absolute || (target.mode == Mode::Modal && !incremental)) return value;
    if (target.mode == Mode::ShortestWay && !endless) {
        error("nc.unsupported", fmt::format("{}=DC(…) is for endless rotary axes", axis));
        return std::nullopt;
    }
    if (!now) {
        error("nc.position-unknown",
              fmt::format("{} is to move from where it is, but the program has not said where that is", axis));
        return std::nullopt;
    }
    return incremental ? *now + value : *now + std::remainder(value - *now, 2.0 * std::numbers::pi);
}

bool Executor::applyTargets(const BlockContent& content, ExecutedMotion& motion) {
    static constexpr std::array<std::string_view, 3> names = {"X", "Y", "Z"};
    bool good = true;
    const auto apply = [&](const std::optional<AxisTarget>& target, std::optional<double>& slot, double scale,
                           std::string_view name, bool endless) {
        if (!target) return;
        slot = reach(*target, slot, scale, name, endless);
        good = good && slot.has_value();
    };
    for (std::size_t i = 0; i < 3; ++i) apply(content.linear[i], position_.linear_mm[i], mmPerUnit(), names[i], false);
    for (std::size_t i = 0; i < chain_.rotaryCount(); ++i)
        apply(content.rotary[i], position_.rotary_rad[i], base::radFromDeg(1.0), chain_.rotaryName(i),
              chain_.rotaryAxis(i).winding == machine::RotaryAxis::Winding::Endless);
    if (content.movesRotary()) tool_axis_ = axisFromRotary(position_);
    motion.end = position_;
    if (!motion.machine_coordinates) return good;
    // Where a machine position lies in the work offset's frame is the control's knowledge, not the program's.
    motion.start.linear_mm = {};
    for (std::size_t i = 0; i < 3; ++i)
        if (content.linear[i])
            position_.linear_mm[i].reset();
        else
            motion.end.linear_mm[i].reset();
    return good;
}

bool Executor::applyVector(const BlockContent& content) {
    if (!content.hasVector()) return true;
    const Vector3 programmed{content.vector[0].value_or(0.0), content.vector[1].value_or(0.0),
                             content.vector[2].value_or(0.0)};
    const double length = norm(programmed);
    if (length == 0.0 || !std::isfinite(length)) {
        error("nc.vector", "A3, B3, C3 describe no direction");
        return false;
    }
    tool_axis_ = (1.0 / length) * programmed;
    position_.rotary_rad = {};
    return true;
}

bool Executor::addArc(const BlockContent& content, ExecutedMotion& motion) {
    std::string problem = "where it starts is not known from the program";
    const auto known = [](const AxisPositions& at) { return at.linear_mm[0] && at.linear_mm[1] && at.linear_mm[2]; };
    if (known(motion.start) && known(motion.end)) {
        ArcRequest request;
        request.start_mm = {*motion.start.linear_mm[0], *motion.start.linear_mm[1], *motion.start.linear_mm[2]};
        request.end_mm = {*motion.end.linear_mm[0], *motion.end.linear_mm[1], *motion.end.linear_mm[2]};
        request.plane = active_[group::plane];
        request.clockwise = motion.code == MotionCode::ArcClockwise;
        request.mm_per_unit = mmPerUnit();
        motion.arc = makeArc(content, request, problem);
    }
    if (motion.arc) return true;
    error("nc.arc", "the arc cannot be run: " + problem);
    return false;
}

void Executor::requireRotary() {
    if (tool_axis_ || rotary_missing_reported_) return;
    rotary_missing_reported_ = true;
    for (std::size_t i = 0; i < chain_.rotaryCount(); ++i)
        if (!position_.rotary_rad[i])
            return error(
                "nc.rotary-unknown",
                fmt::format("TRAORI is active but no block has said where rotary axis {} is", chain_.rotaryName(i)));
}

std::optional<Vector3> Executor::axisFromRotary(const AxisPositions& position) const {
    RotaryValues values{};
    for (std::size_t i = 0; i < chain_.rotaryCount(); ++i) {
        if (!position.rotary_rad[i]) return std::nullopt;
        values[i] = *position.rotary_rad[i];
    }
    return chain_.toolAxis(values);
}

bool Executor::rotaryAtZero(const AxisPositions& position) const {
    for (std::size_t i = 0; i < chain_.rotaryCount(); ++i)
        if (!position.rotary_rad[i] || std::abs(*position.rotary_rad[i]) > zero_rad) return false;
    return true;
}

/// Without TRAORI the programmed point is the tip only while every rotary axis is at zero: elsewhere the pivot and the
/// tool length come in, which the program does not tell.
std::optional<ToolPose> Executor::pose(const AxisPositions& position) const {
    const auto& at = position.linear_mm;
    if (!at[0] || !at[1] || !at[2] || !tool_axis_) return std::nullopt;
    if (!transformation_ && !rotaryAtZero(position)) return std::nullopt;
    return ToolPose{{*at[0], *at[1], *at[2]}, *tool_axis_};
}

}  // namespace cusp::post::reader
