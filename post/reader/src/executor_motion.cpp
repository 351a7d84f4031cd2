// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Motion blocks: from words to where the tool goes.
#include "executor.hpp"

#include <cusp/base/units.hpp>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace cusp::post::reader {

namespace {

/// A rotary axis this close to zero is at zero.
constexpr double zero_rad = 1e-9;
/// As exactly as printed rotary positions stand the tool across the plane.
constexpr double across_rad = 1e-6;

}  // namespace

bool Executor::checkMotion(const BlockContent& content, bool is_arc, bool moves) {
    if (!is_arc && content.hasArcWords()) {
        error("nc.arc", "I, J, K, CR, AR and TURN belong to G2 and G3");
        return false;
    }
    if (moves && !isActive(group::motion, "G0") && !state_.feed.value && !feed_missing_reported_) {
        feed_missing_reported_ = true;
        error("nc.no-feed", "a feed motion without feed: no F has been programmed for the active feed type");
    }
    if (content.hasVector() && (!transformation_ || content.movesRotary())) {
        const std::string_view words = content.hasAngles() ? "A2, B2, C2" : "A3, B3, C3";
        error("nc.vector", transformation_ ? fmt::format("{} and rotary axes exclude each other in a block", words)
                                           : fmt::format("{} have a meaning under TRAORI only", words));
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
    if (is_arc && !endArcByAngle(content)) return forgetLinear();
    if (is_arc && !motion.machine_coordinates) motion.end.linear_mm = position_.linear_mm;
    motion.end.rotary_rad = position_.rotary_rad;
    if (!motion.machine_coordinates) {
        if (transformation_) requireRotary();
        motion.end_pose = pose(position_);
        placePath(motion);
        if (is_arc && !addArc(content, motion)) return;
        if (!checkCompensation(motion)) return;
    } else if (is_arc)
        return error("nc.arc", "an arc in machine coordinates is not interpreted");
    hand(motion, state_);
}

/// G41 and G42 act in the plane. With the tool leaning against it, where the edge goes is for 3D compensation to say.
bool Executor::checkCompensation(const ExecutedMotion& motion) {
    if (state_.compensation == RadiusCompensation::Off || !motion.end_pose) return true;
    const Frame turned = frame();
    const std::size_t normal = normalOf(active_[group::plane]);
    const Vector3 across = normal == 0 ? turned.x : normal == 1 ? turned.y : turned.z;
    if (angleBetween(across, motion.end_pose->axis) < across_rad) return true;
    error("nc.unsupported", "cutter radius compensation with the tool leaning against the plane is not interpreted");
    return false;
}

void Executor::hand(ExecutedMotion& motion, const ModalSnapshot& state) {
    motion.state = &state;
    motion.placement = placement_;
    ++motions_;
    sink_.motion(motion);
}

void Executor::placePath(ExecutedMotion& motion) const {
    if (!motion.start_pose || !motion.end_pose) return;
    motion.path_start_mm = basePoint(motion.start);
    motion.path_end_mm = basePoint(motion.end);
    motion.joint_linear = !transformation_ && !swivelled_ && !(rotaryAtZero(motion.start) && rotaryAtZero(motion.end));
    if (motion.joint_linear) motion.orientation_path = OrientationPath::RotaryLinear;
}

Vector3 Executor::basePoint(const AxisPositions& position) const {
    const auto& at = position.linear_mm;
    return frame().point({*at[0], *at[1], *at[2]});
}

bool Executor::isIncremental(const AxisTarget& target) const {
    using Mode = AxisTarget::Mode;
    return target.mode == Mode::Incremental || (target.mode == Mode::Modal && isActive(group::dimension, "G91"));
}

std::optional<double> Executor::reach(const AxisTarget& target, const std::optional<double>& now, double scale,
                                      std::string_view axis, bool endless) {
    using Mode = AxisTarget::Mode;
    const double value = target.value * scale;
    const bool incremental = isIncremental(target);
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
    for (std::size_t i = 0; i < 3; ++i) {
        if (frame_changed_[i] && content.linear[i] && isIncremental(*content.linear[i])) {
            error("nc.position-unknown",
                  fmt::format("{} is to move by a distance after a change of frame: whether the change counts is the "
                              "machine's setting (SD42440)",
                              names[i]));
            good = false;
        }
        if (content.linear[i]) frame_changed_[i] = false;
        apply(content.linear[i], position_.linear_mm[i], mmPerUnit(), names[i], false);
    }
    for (std::size_t i = 0; i < chain_.rotaryCount(); ++i)
        apply(content.rotary[i], position_.rotary_rad[i], base::radFromDeg(1.0), chain_.rotaryName(i),
              chain_.rotaryAxis(i).winding == machine::RotaryAxis::Winding::Endless);
    if (content.movesRotary()) {
        tool_axis_ = axisFromRotary(position_);
        swivelled_ = false;
        warnOfTurnedFrame(motion);
    }
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

/// RPY: the direction Z turned by A2 about X, then by B2 about Y, then by C2 about Z, these at rest; Euler: about Z, the new
/// X, the new Z, of which the last has no effect (PGA, orientation by angles).
std::optional<Vector3> Executor::programmedAxis(const BlockContent& content) {
    if (content.hasAngles()) {
        const auto at = [&](std::size_t i) { return base::radFromDeg(content.angles_deg[i].value_or(0.0)); };
        const bool euler = isActive(group::orientation_angles, "ORIEULER");
        if (euler) return (turnedAbout(2, at(0)) * turnedAbout(0, at(1))).z;
        if (isActive(group::orientation_angles, "ORIRPY"))
            return (turnedAbout(2, at(2)) * turnedAbout(1, at(1)) * turnedAbout(0, at(0))).z;
        error(
            "nc.unsupported",
            "A2, B2, C2 need ORIEULER or ORIRPY: which of them holds from the start is the machine's setting (MD21100)");
        return std::nullopt;
    }
    const Vector3 programmed{content.vector[0].value_or(0.0), content.vector[1].value_or(0.0),
                             content.vector[2].value_or(0.0)};
    const double length = norm(programmed);
    if (length > 0.0 && std::isfinite(length)) return (1.0 / length) * programmed;
    error("nc.vector", "A3, B3, C3 describe no direction");
    return std::nullopt;
}

bool Executor::applyVector(const BlockContent& content) {
    if (!content.hasVector()) return true;
    const auto programmed = programmedAxis(content);
    if (!programmed) return false;
    if (frame().turned() && !isActive(group::orientation_frame, "ORIWKS")) {
        error("nc.unsupported",
              "an orientation in machine coordinates (ORIMKS) under a turned frame is not interpreted");
        return false;
    }
    tool_axis_ = frame().direction(*programmed);
    position_.rotary_rad = {};
    return true;
}

ArcRequest Executor::arcRequest(const ExecutedMotion& motion) const {
    const auto point = [](const AxisPositions& at) {
        return Vector3{at.linear_mm[0].value_or(0.0), at.linear_mm[1].value_or(0.0), at.linear_mm[2].value_or(0.0)};
    };
    ArcRequest request;
    request.start_mm = point(motion.start);
    request.end_mm = point(motion.end);
    request.plane = active_[group::plane];
    request.clockwise = isActive(group::motion, "G2");
    request.through = isActive(group::motion, "CIP");
    request.incremental = isActive(group::dimension, "G91");
    request.mm_per_unit = mmPerUnit();
    return request;
}

/// An arc by its centre and angle says nothing of its end.
bool Executor::endArcByAngle(const BlockContent& content) {
    auto& at = position_.linear_mm;
    if (!content.arc_angle_deg || !at[0] || !at[1] || !at[2]) return true;
    ExecutedMotion stands;
    stands.start = stands.end = position_;
    std::string problem;
    const auto end = endByAngle(content, arcRequest(stands), problem);
    if (!problem.empty()) error("nc.arc", "the arc cannot be run: " + problem);
    if (end) at = {end->x, end->y, end->z};
    return problem.empty();
}

bool Executor::addArc(const BlockContent& content, ExecutedMotion& motion) {
    std::string problem = "where it starts is not known from the program";
    const auto known = [](const AxisPositions& at) { return at.linear_mm[0] && at.linear_mm[1] && at.linear_mm[2]; };
    if (known(motion.start) && known(motion.end)) motion.arc = makeArc(content, arcRequest(motion), problem);
    if (motion.arc) {
        const Frame base = frame();
        motion.arc->center_mm = base.point(motion.arc->center_mm);
        for (Vector3* direction : {&motion.arc->first, &motion.arc->second, &motion.arc->normal})
            *direction = base.direction(*direction);
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

/// Without TRAORI the programmed point is the tip only while every rotary axis is at zero, or where CYCLE800 swivelled:
/// elsewhere the pivot and the tool length come in, which the program does not tell.
std::optional<ToolPose> Executor::pose(const AxisPositions& position) const {
    const auto& at = position.linear_mm;
    if (!at[0] || !at[1] || !at[2] || !tool_axis_) return std::nullopt;
    const Vector3 base = basePoint(position);
    if (transformation_ || swivelled_ || rotaryAtZero(position)) return ToolPose{base, *tool_axis_};
    if (!chain_.placesTip(placement_)) return std::nullopt;
    RotaryValues values{};
    for (std::size_t i = 0; i < chain_.rotaryCount(); ++i) {
        if (!position.rotary_rad[i]) return std::nullopt;
        values[i] = *position.rotary_rad[i];
    }
    return ToolPose{chain_.tip(base, values, placement_), chain_.toolAxis(values)};
}

}  // namespace cusp::post::reader
