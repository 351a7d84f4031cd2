// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Programmable frames, swivelled planes, and drilling cycles in them.
#include "executor.hpp"

#include <cusp/base/units.hpp>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cusp::post::reader {

namespace {

constexpr double same_height_mm = 1e-9;

SpindleTurn turnOf(double m_function) {
    return m_function == 3.0   ? SpindleTurn::Clockwise
           : m_function == 4.0 ? SpindleTurn::CounterClockwise
                               : SpindleTurn::Off;
}

}  // namespace

/// TRANS and ROT replace the programmable frame, ATRANS and AROT go on from it. ROT with several angles turns about Z, then
/// the new Y, then the new X (RPY, MD10600 as delivered; PM12, ROT).
void Executor::programFrame(const BlockContent& content) {
    const FrameCommand command = *content.frame;
    const bool turns = command == FrameCommand::Rot || command == FrameCommand::ARot;
    const bool adds = command == FrameCommand::ATrans || command == FrameCommand::ARot;
    if (content.movesRotary()) return error("nc.unsupported", "a frame that shifts a rotary axis is not interpreted");
    if (content.hasVector() || content.hasArcWords() || content.dwell || content.cycle)
        return error("nc.syntax", "a frame stands in a block of its own");
    std::array<double, 3> values{};
    for (std::size_t i = 0; i < 3; ++i) {
        if (!content.linear[i]) continue;
        if (content.linear[i]->mode != AxisTarget::Mode::Modal)
            return error("nc.syntax", "a frame takes plain values, without AC or IC");
        values[i] = content.linear[i]->value;
    }
    if (content.plane_angle_deg && (!turns || content.movesLinear()))
        return error("nc.syntax", "RPL stands alone behind ROT or AROT");
    if (adds && !content.movesLinear() && !content.plane_angle_deg)
        return error("nc.syntax", "ATRANS and AROT need values");
    Frame change;
    if (content.plane_angle_deg)
        change = turnedAbout(normalOf(active_[group::plane]), base::radFromDeg(*content.plane_angle_deg));
    else if (turns)
        change = turnedAbout(2, base::radFromDeg(values[2])) * turnedAbout(1, base::radFromDeg(values[1])) *
                 turnedAbout(0, base::radFromDeg(values[0]));
    else
        change = shifted(mmPerUnit() * Vector3{values[0], values[1], values[2]});
    changeFrames(swivel_frame_, adds ? programmed_frame_ * change : change);
}

/// The tool stays where it is: its coordinates change.
void Executor::changeFrames(const Frame& swivel, const Frame& programmed) {
    const Frame before = frame();
    swivel_frame_ = swivel;
    programmed_frame_ = programmed;
    auto& at = position_.linear_mm;
    if (!at[0] || !at[1] || !at[2]) return forgetLinear();
    const Vector3 now = frame().inverse(before.point({*at[0], *at[1], *at[2]}));
    at = {now.x, now.y, now.z};
    frame_changed_ = {true, true, true};
}

void Executor::swivel(const Swivel& swivel) {
    if (swivel.clear) {
        const bool was_swivelled = swivelled_;
        swivelled_ = false;
        if (!swivel_frame_.isIdentity() || !programmed_frame_.isIdentity()) changeFrames({}, {});
        if (was_swivelled) forgetLinear();
        return;
    }
    const auto vector = [&](const std::array<double, 3>& v) { return mmPerUnit() * Vector3{v[0], v[1], v[2]}; };
    Frame plane = shifted(vector(swivel.before));
    for (std::size_t turn = 0; turn < 3; ++turn)
        plane = plane * turnedAbout(swivel.order[turn], base::radFromDeg(swivel.angles_deg[turn]));
    plane = plane * shifted(vector(swivel.after));
    changeFrames(swivel.additive ? swivel_frame_ * plane : plane, {});
    if (!swivel.moves) return;
    // Where the rotary axes go is the control's choice; that the tool then stands along the plane's normal is not.
    forgetLinear();
    position_.rotary_rad = {};
    const Frame turned = frame();
    const std::size_t normal = normalOf(active_[group::plane]);
    tool_axis_ = normal == 0 ? turned.x : normal == 1 ? turned.y : turned.z;
    swivelled_ = true;
}

void Executor::warnOfTurnedFrame(const ExecutedMotion& motion) {
    if (turned_frame_reported_ || motion.machine_coordinates || !transformation_ || !frame().turned()) return;
    turned_frame_reported_ = true;
    report_.warning(
        "nc.turned-frame",
        "rotary axes are programmed while a frame is turned; they are read as axis positions, which the frame "
        "does not turn",
        block_->where);
}

void Executor::runCycle(const CycleCall& cycle) {
    const std::size_t axis = normalOf(active_[group::plane]);
    const SpindleTurn turn_before = state_.spindle;
    ModalSnapshot state = state_;
    for (const CycleStep& step : cycle.steps) {
        using Kind = CycleStep::Kind;
        if (step.kind == Kind::SpindleTurn) state.spindle = turnOf(step.value);
        if (step.kind == Kind::DwellSeconds) sink_.event(place_, DwellTime{step.value, std::nullopt});
        if (step.kind == Kind::DwellRevolutions) sink_.event(place_, DwellTime{std::nullopt, step.value});
        if (step.kind == Kind::SpindleReverse)
            state.spindle = state.spindle == SpindleTurn::Clockwise          ? SpindleTurn::CounterClockwise
                            : state.spindle == SpindleTurn::CounterClockwise ? SpindleTurn::Clockwise
                                                                             : SpindleTurn::Off;
        if (step.kind == Kind::SpindleRestore) state.spindle = step.value == 0.0 ? turn_before : turnOf(step.value);
        if (step.kind == Kind::Rapid || step.kind == Kind::Feed || step.kind == Kind::Aside)
            runCycleStep(step, axis, state);
    }
    state_.spindle = state.spindle;
}

void Executor::runCycleStep(const CycleStep& step, std::size_t axis, ModalSnapshot& state) {
    auto target = position_.linear_mm;
    if (step.kind == CycleStep::Kind::Aside) {
        const std::array<double, 3> by = {step.first, step.second, step.up};
        for (std::size_t i = 0; i < 3; ++i) {
            auto& coordinate = target[(axis + 1 + i) % 3];
            if (coordinate) coordinate = *coordinate + by[i] * mmPerUnit();
        }
    } else
        target[axis] = step.value * mmPerUnit();
    const auto& height = position_.linear_mm[axis];
    if (step.kind != CycleStep::Kind::Aside && height && std::abs(*height - *target[axis]) < same_height_mm) return;
    ExecutedMotion motion;
    motion.place = place_;
    motion.code = step.kind == CycleStep::Kind::Feed ? MotionCode::Linear : MotionCode::Rapid;
    motion.transformation = transformation_;
    motion.orientation_path = orientationPath();
    motion.in_cycle = true;
    motion.start = position_;
    motion.start_pose = pose(position_);
    position_.linear_mm = target;
    frame_changed_[axis] = false;
    motion.end = position_;
    motion.end_pose = pose(position_);
    placePath(motion);
    state.feed = state_.feed;
    state.spindle_rpm = step.speed_rpm.value_or(state_.spindle_rpm);
    if (step.pitch)
        state.feed = {Feed::Mode::PerMinute, *step.pitch * mmPerUnit() * state.spindle_rpm};
    else if (step.feed)
        state.feed.value = *step.feed * mmPerUnit();
    else if (state.feed.value)
        state.feed.value = *state.feed.value * step.feed_factor;
    if (motion.code == MotionCode::Linear && !state.feed.value && !feed_missing_reported_) {
        feed_missing_reported_ = true;
        error("nc.no-feed", "a feed motion without feed: no F has been programmed for the active feed type");
    }
    hand(motion, state);
}

}  // namespace cusp::post::reader
