// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Order within a block: codes, feed and speed, transformation, tool, M functions that begin something, motion, M functions
// that end something (ISO 6983-1).
#include "executor.hpp"

#include <cusp/base/units.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>

namespace cusp::post::reader {

namespace {

bool has(const BlockContent& content, int m_function) {
    return std::find(content.m_functions.begin(), content.m_functions.end(), m_function) != content.m_functions.end();
}

}  // namespace

Executor::Executor(const MachineFile& machine, const ForwardChain& chain, const MachineSetup& setup, ProgramSink& sink,
                   base::Diagnostics& report)
    : machine_(machine), chain_(chain), setup_(setup), sink_(sink), report_(report) {
    active_[group::motion] = "G1";
    active_[group::plane] = "G17";
    active_[group::units] = "G710";
    active_[group::dimension] = "G90";
    active_[group::feed] = "G94";
    active_[group::orientation_frame] = "ORIWKS";
    active_[group::orientation_path] = "ORIVECT";
    // Without rotary axes the tool axis is the spindle's, always.
    if (chain.rotaryCount() == 0) tool_axis_ = chain.toolAxis({});
    place();
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

/// What the setup says of the tool and the work offset at hand. With D0 the length of the tool is not in the program's
/// positions.
void Executor::place() {
    placement_ = {};
    if (state_.cutting_edge != 0) placement_.tool_length_mm = setup_.tool_length_mm;
    if (setup_.wcs_origin_mm)
        placement_.origin_mm = {(*setup_.wcs_origin_mm)[0], (*setup_.wcs_origin_mm)[1], (*setup_.wcs_origin_mm)[2]};
    if (setup_.definition == nullptr) return;
    if (!placement_.origin_mm)
        if (const auto* offset = setup_.definition->findOffset(state_.work_offset))
            placement_.origin_mm = {offset->origin_mm[0], offset->origin_mm[1], offset->origin_mm[2]};
    if (placement_.tool_length_mm || state_.cutting_edge == 0 || state_.tool.empty()) return;
    const bool number = state_.tool.find_first_not_of("0123456789") == std::string::npos;
    placement_.tool_length_mm = number
                                    ? setup_.definition->toolLength(std::strtoll(state_.tool.c_str(), nullptr, 10), {})
                                    : setup_.definition->toolLength(std::nullopt, state_.tool);
}

void Executor::forgetLinear() {
    position_.linear_mm = {};
    frame_changed_ = {};
}

MotionCode Executor::motionCode() const {
    const char digit = active_[group::motion][1];  // of CIP, which has no sense of its own, an I
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
    applySmoothing(content);
    if (content.message) sink_.event(place_, OperatorMessage{*content.message});
    if (content.high_speed) sink_.event(place_, HighSpeedSetting{*content.high_speed});
    if (content.frame) return programFrame(content);
    if (content.swivel) return swivel(*content.swivel);
    if (content.dwell) return dwell(content);
    applyFeedAndSpeed(content);
    if (content.transformation) applyTransformation(*content.transformation);
    applyTool(content);
    applyEarlyFunctions(content);
    if (content.modal_call)
        modal_cycle_ = content.cycle;
    else if (content.cycle)
        runCycle(*content.cycle);
    move(content);
    if (modal_cycle_ && !content.modal_call && content.movesLinear()) runCycle(*modal_cycle_);
    applyLateFunctions(content);
}

void Executor::applySmoothing(const BlockContent& content) {
    const std::string_view path = active_[static_cast<std::size_t>(group::path)];
    const bool once = std::any_of(content.codes.begin(), content.codes.end(),
                                  [](const GroupCode& code) { return code.name == "G9"; });
    state_.exact_stop = once || path.empty() || path == "G60";
    if (content.contour_tolerance) state_.contour_tolerance_mm = *content.contour_tolerance * mmPerUnit();
    if (content.orientation_tolerance_deg)
        state_.orientation_tolerance_rad = base::radFromDeg(*content.orientation_tolerance_deg);
}

void Executor::applyCodes(const BlockContent& content) {
    for (const GroupCode& code : content.codes) {
        auto& active = active_[static_cast<std::size_t>(code.group)];
        if (!code.modal || active == code.name) continue;
        active = code.name;
        if (code.group == group::plane) state_.plane = code.name;
        if (code.group == group::compensation)
            state_.compensation = code.name == "G41"   ? RadiusCompensation::Left
                                  : code.name == "G42" ? RadiusCompensation::Right
                                                       : RadiusCompensation::Off;
        if (code.group == group::work_offset) {
            state_.work_offset = std::string(code.name);
            place();
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
        place();
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
    place();
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

}  // namespace cusp::post::reader
