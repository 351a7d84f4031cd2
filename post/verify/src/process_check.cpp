// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// One comparison per kind of state; each says nothing, or what differs.
#include "process_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>

namespace cusp::post::verify {

namespace {

using base::Severity;
using reader::Feed;
using reader::ModalSnapshot;
using reader::RadiusCompensation;
using reader::SpindleTurn;
using toolpath::CoolantCommand;
using toolpath::FeedRate;
using toolpath::SpindleCommand;

/// A path shorter than this says too little about its inverse-time feed.
constexpr double shortest_timed_path_mm = 0.1;

std::optional<double> pathLength(const reader::ExecutedMotion& motion) {
    if (motion.arc) {
        const double radius = (motion.arc->start_radius_mm + motion.arc->end_radius_mm) / 2.0;
        return std::hypot(radius * motion.arc->sweep_rad, motion.arc->height_mm);
    }
    if (!motion.start_pose || !motion.end_pose) return std::nullopt;
    return reader::norm(motion.end_pose->tip_mm - motion.start_pose->tip_mm);
}

/// What the program's F means in the unit the CL file uses; nothing when that cannot be told.
std::optional<double> feedAsExpected(const reader::ExecutedMotion& motion, FeedRate::Unit unit) {
    const Feed& feed = motion.state->feed;
    if (!feed.value) return std::nullopt;
    double per_minute = *feed.value;
    if (feed.mode == Feed::Mode::InverseTime) {
        const auto length = pathLength(motion);
        if (!length || *length < shortest_timed_path_mm) return std::nullopt;
        per_minute *= *length;
    } else if (feed.mode == Feed::Mode::PerRevolution) {
        if (unit == FeedRate::Unit::MmPerRev) return feed.value;
        per_minute *= motion.state->spindle_rpm;
    }
    if (unit == FeedRate::Unit::MmPerS) return per_minute;
    if (motion.state->spindle_rpm <= 0.0) return std::nullopt;
    return per_minute / motion.state->spindle_rpm;
}

std::string feedProblem(const reader::ExecutedMotion& motion, const ExpectedProcess& expected, double tolerance) {
    if (!expected.feed) return {};
    const bool per_minute = expected.feed->unit == FeedRate::Unit::MmPerS;
    const double wanted = per_minute ? base::mmPerMinFromMmPerS(expected.feed->value) : expected.feed->value;
    const auto actual = feedAsExpected(motion, expected.feed->unit);
    if (!actual || std::abs(*actual - wanted) <= tolerance * std::abs(wanted)) return {};
    return fmt::format("feed is {0:.6g} {2}, the CL file has {1:.6g} {2}", *actual, wanted,
                       per_minute ? "mm/min" : "mm/rev");
}

std::string turnName(SpindleTurn turn) {
    return turn == SpindleTurn::Off         ? "off"
           : turn == SpindleTurn::Clockwise ? "clockwise (M3)"
                                            : "counter-clockwise (M4)";
}

SpindleTurn toReader(SpindleCommand::Turn turn) {
    return turn == SpindleCommand::Turn::Off         ? SpindleTurn::Off
           : turn == SpindleCommand::Turn::Clockwise ? SpindleTurn::Clockwise
                                                     : SpindleTurn::CounterClockwise;
}

std::string turnProblem(const ModalSnapshot& state, const ExpectedProcess& expected) {
    if (!expected.turn) return {};
    const SpindleTurn wanted = toReader(*expected.turn);
    if (state.spindle == wanted) return {};
    return fmt::format("the spindle is {} in a feed move, the CL file has it {}", turnName(state.spindle),
                       turnName(wanted));
}

std::string speedProblem(const ModalSnapshot& state, const ExpectedProcess& expected, double tolerance_rpm) {
    if (!expected.rpm || state.spindle == SpindleTurn::Off || expected.turn == SpindleCommand::Turn::Off) return {};
    if (std::abs(state.spindle_rpm - *expected.rpm) <= tolerance_rpm) return {};
    return fmt::format("the spindle runs at {:.6g} rpm, the CL file has {:.6g} rpm", state.spindle_rpm, *expected.rpm);
}

bool sameText(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    return a.size() == b.size() &&
           std::equal(a.begin(), a.end(), b.begin(), [&](char x, char y) { return lower(x) == lower(y); });
}

std::string toolProblem(const ModalSnapshot& state, const ExpectedProcess& expected) {
    if (!expected.tool_number && expected.tool_name.empty()) return {};
    const std::string number = expected.tool_number ? fmt::format("{}", *expected.tool_number) : std::string();
    if (!state.tool.empty() && (state.tool == number || sameText(state.tool, expected.tool_name))) return {};
    const std::string wanted = expected.tool_name.empty() ? number
                               : number.empty()           ? fmt::format("\"{}\"", expected.tool_name)
                                                          : fmt::format("{} \"{}\"", number, expected.tool_name);
    if (state.tool.empty()) return fmt::format("no tool has been changed in, the CL file has tool {}", wanted);
    return fmt::format("tool \"{}\" is in the spindle, the CL file has tool {}", state.tool, wanted);
}

std::string coolantName(bool mist, bool flood) {
    return mist && flood ? "mist and flood (M7, M8)" : mist ? "mist (M7)" : flood ? "flood (M8)" : "off";
}

std::string coolantProblem(const ModalSnapshot& state, const ExpectedProcess& expected) {
    if (!expected.coolant) return {};
    bool good = false;
    std::string_view wanted;
    switch (*expected.coolant) {
        case CoolantCommand::Kind::Off:
            good = !state.mist && !state.flood;
            wanted = "off";
            break;
        case CoolantCommand::Kind::Flood:
            good = state.flood && !state.mist;
            wanted = "flood";
            break;
        case CoolantCommand::Kind::Mist:
            good = state.mist && !state.flood;
            wanted = "mist";
            break;
        // Which M function coolant through the tool has is the machine builder's choice.
        case CoolantCommand::Kind::Through:
            good = state.mist || state.flood;
            wanted = "through the tool";
            break;
    }
    if (good) return {};
    return fmt::format("coolant is {}, the CL file has it {}", coolantName(state.mist, state.flood), wanted);
}

/// An edge the program never chose is the first: the one a tool change sets (MD20270 as delivered).
std::string lengthProblem(const ModalSnapshot& state, std::int64_t wanted) {
    const int edge = state.cutting_edge.value_or(1);
    if (edge == wanted) return {};
    if (edge == 0) return "the tool length is not applied (D0) in a feed move";
    return fmt::format("the tool is applied with D{}, expected is D{}", edge, wanted);
}

std::string planeProblem(const ModalSnapshot& state, std::string_view wanted) {
    if (wanted.empty() || state.plane == wanted) return {};
    return fmt::format(
        "a feed move in {}: unless the machine fixes the direction of the tool length (SD42940), it acts across the spindle",
        state.plane);
}

std::string compensationName(RadiusCompensation side) {
    return side == RadiusCompensation::Off ? "off" : side == RadiusCompensation::Left ? "left (G41)" : "right (G42)";
}

std::string compensationProblem(const ModalSnapshot& state, const ExpectedProcess& expected) {
    using Side = toolpath::CutterCompensation::Side;
    const RadiusCompensation wanted = expected.compensation == Side::Left    ? RadiusCompensation::Left
                                      : expected.compensation == Side::Right ? RadiusCompensation::Right
                                                                             : RadiusCompensation::Off;
    if (state.compensation == wanted) return {};
    return fmt::format("cutter compensation is {}, the CL file has it {}", compensationName(state.compensation),
                       compensationName(wanted));
}

/// G54 to G57, then G505 to G599; nothing behind.
std::string nextSettableFrame(const std::string& name) {
    const int number = std::atoi(name.c_str() + 1);
    const bool last = number == 599 || number < 54;
    return last ? std::string() : fmt::format("G{}", number == 57 ? 505 : number + 1);
}

std::string wantedOffset(const std::vector<std::string>& names, std::size_t frame) {
    if (frame < names.size()) return names[frame];
    std::string name = names.empty() ? std::string() : names.back();
    for (std::size_t i = names.size(); i <= frame && !name.empty(); ++i) name = nextSettableFrame(name);
    return name;
}

std::string offsetProblem(const ModalSnapshot& state, const std::string& wanted) {
    if (wanted.empty() || state.work_offset == wanted || (wanted == "G500" && state.work_offset.empty())) return {};
    return fmt::format("runs in {}, the work offset of the CL file's frame is {}",
                       state.work_offset.empty() ? "no work offset" : state.work_offset, wanted);
}

}  // namespace

void checkProcess(const reader::ExecutedMotion& motion, const ExpectedProcess& expected, std::size_t cl_line,
                  const ProcessLimits& limits, Findings& findings) {
    const ModalSnapshot& state = *motion.state;
    const auto report = [&](Severity severity, std::string_view code, const std::string& text) {
        findings.state(severity, code, motion.place, text, cl_line);
    };
    report(Severity::Error, "verify.feed", feedProblem(motion, expected, limits.feed_tolerance));
    const bool nobody_turns = state.spindle == SpindleTurn::Off &&
                              expected.turn.value_or(SpindleCommand::Turn::Off) == SpindleCommand::Turn::Off;
    report(Severity::Warning, "verify.spindle-off",
           nobody_turns ? "the spindle is off in a feed move, as in the CL file" : std::string());
    report(Severity::Error, "verify.spindle-direction", turnProblem(state, expected));
    report(Severity::Error, "verify.spindle-speed", speedProblem(state, expected, limits.speed_tolerance_rpm));
    report(Severity::Error, "verify.tool", toolProblem(state, expected));
    report(Severity::Error, "verify.tool-length", lengthProblem(state, expected.edge.value_or(limits.cutting_edge)));
    report(Severity::Error, "verify.plane", planeProblem(state, limits.plane));
    report(Severity::Error, "verify.compensation", compensationProblem(state, expected));
    report(
        Severity::Warning, "verify.contour",
        state.compensation == RadiusCompensation::Off
            ? std::string()
            : "under G41 and G42 it is the programmed contour that is compared; the tool's own path is the control's");
    report(Severity::Error, "verify.coolant", coolantProblem(state, expected));
    report(Severity::Error, "verify.work-offset",
           offsetProblem(state, wantedOffset(limits.work_offsets, expected.frame)));
}

}  // namespace cusp::post::verify
