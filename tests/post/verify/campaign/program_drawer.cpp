// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The CL point is computed from what is printed, so that only the program's mistakes are left to find.
#include "program_drawer.hpp"

#include "../program_pair.hpp"

#include <cusp/base/units.hpp>

#include <algorithm>
#include <fmt/format.h>

namespace cusp::post::verify::test {

using namespace cusp::toolpath;

ProgramDrawer::ProgramDrawer(Form form, base::Random& random, double tool_length_error_mm)
    : random_(random), tool_length_error_mm_(tool_length_error_mm) {
    out_.form = form;
    out_.path.file_name = "P.cls";
}

DrawnProgram ProgramDrawer::draw() {
    chooseMachine();
    const int operations = whole(1, 2);
    for (int i = 0; i < operations; ++i) operation(i);
    record(ProgramEnd{});
    home();
    block({function(5), function(9)});
    block({function(30)});
    return std::move(out_);
}

NcBlock& ProgramDrawer::block(Words words, bool link) {
    NcBlock& added = out_.blocks.emplace_back();
    added.words = std::move(words);
    added.link = link;
    return added;
}
void ProgramDrawer::record(ClStatement statement) {
    ClRecord& added = out_.path.records.emplace_back();
    added.statement = std::move(statement);
    added.line = static_cast<std::uint32_t>(out_.path.records.size());
}
void ProgramDrawer::point(const Vector3d& tip, const Vector3d& axis, bool rapid) {
    LinearMotion motion;
    motion.location.tip_mm = tip;
    motion.location.axis = axis;
    motion.kind = rapid ? MotionKind::Rapid : MotionKind::Feed;
    record(motion);
}

void ProgramDrawer::chooseMachine() {
    const auto& machines = fiveAxisMachines();
    const bool turns = out_.form <= Form::MachineCoordinates || out_.form == Form::Swivelled || random_.chance(0.5);
    if (turns) {
        out_.closed_form = &machines[static_cast<std::size_t>(random_.below(machines.size()))];
        // What a plane needs of the rotary axes is the control's business; the head of the shipped machine reaches all.
        if (out_.form == Form::Swivelled) out_.closed_form = &machines.front();
        out_.machine = out_.closed_form->machine;
    }
    out_.md21104 = shippedMachine(out_.machine).control.md21104_ori_ipo_with_g_code;
    if (out_.form != Form::MachineCoordinates) return;
    out_.options.tool_length_mm = out_.tool_length_mm = rounded(uniform(60, 200), 3);
    out_.origin_mm = rounded(Vector3d(uniform(-80, 80), uniform(-80, 80), uniform(20, 120)));
    out_.options.wcs_origin_mm = {out_.origin_mm.x(), out_.origin_mm.y(), out_.origin_mm.z()};
}

Words ProgramDrawer::rotary(double first_deg, double second_deg) const {
    if (out_.closed_form == nullptr) return {};
    return {number(out_.closed_form->first, first_deg), number(out_.closed_form->second, second_deg)};
}

void ProgramDrawer::home() {
    if (out_.closed_form != nullptr) block({word("TRAFOOF")}, true);
    block({word("SUPA"), code(0), number("Z", 0, 0), number("D", 0, 0)}, true);
    block(Words{word("SUPA"), number("X", 0, 0), number("Y", 0, 0)} + rotary(0, 0), true);
}

void ProgramDrawer::operation(int index) {
    const int tool = whole(2, 40) + 50 * index;
    rpm_ = 100.0 * whole(20, 120);
    feed_ = 100.0 * whole(3, 30);
    record(OperationStart{fmt::format("OP{}", index + 1)});
    record(ToolCall{tool, "", std::nullopt});
    left_ = random_.chance(0.2);
    using Turn = SpindleCommand::Turn;
    record(SpindleCommand{left_ ? Turn::CounterClockwise : Turn::Clockwise, rpm_, SpindleCommand::Unit::Rpm});
    const bool mist = random_.chance(0.3);
    record(CoolantCommand{mist ? CoolantCommand::Kind::Mist : CoolantCommand::Kind::Flood});
    block({code(17), code(710), code(90), code(94)});
    home();
    block({number("T", tool, 0), function(6)});
    block({code(54), number("D", 1, 0)});
    block({number("S", rpm_, 0), function(left_ ? 4 : 3), function(mist ? 7 : 8)});
    content();
}

void ProgramDrawer::content() {
    switch (out_.form) {
        case Form::RotaryAxes:
        case Form::NearThePole:
        case Form::Vectors:
        case Form::MachineCoordinates: return fiveAxisMoves();
        case Form::Arcs:
        case Form::Chords: return arcs();
        case Form::Drilling: return holes();
        case Form::Swivelled: return swivelled();
        case Form::Framed: return framed();
    }
}

/// G94, or the same feed as G93 or G95.
void ProgramDrawer::chooseFeedCode() {
    const int kind = whole(0, 5);
    feed_code_ = kind == 0 && out_.form == Form::RotaryAxes ? 93 : kind == 1 ? 95 : 94;
    if (feed_code_ != 94) block({code(feed_code_)});
    record(FeedRate{feed_ / 60.0, FeedRate::Unit::MmPerS});
}

/// The F word of a cut of `length_mm`; modal unless G93.
Words ProgramDrawer::feedWord(bool first, double length_mm) {
    if (feed_code_ == 93) return {number("F", feed_ / length_mm, 6)};
    if (!first) return {};
    return {number("F", feed_code_ == 95 ? feed_ / rpm_ : feed_, 6)};
}

Vector3d ProgramDrawer::axisOf(const Pose& pose) const {
    return out_.closed_form->axis(pose.first_deg, pose.second_deg);
}

void ProgramDrawer::fiveAxisMoves() {
    const bool pole = out_.form == Form::NearThePole;
    Pose pose{rounded(Vector3d(uniform(-50, 50), uniform(-50, 50), 80)), rounded(uniform(-150, 80)),
              rounded(pole ? uniform(0.2, 2) : uniform(8, 40))};
    block(Words{code(0)} + rotary(pose.first_deg, pose.second_deg), true);
    if (out_.form != Form::MachineCoordinates) {
        block({word("TRAORI")});
        block({word(out_.form == Form::Vectors ? (out_.md21104 ? "ORIVECT" : "ORIWKS")
                                               : (out_.md21104 ? "ORIAXES" : "ORIMKS"))});
    }
    poseBlock({code(0)}, pose, {});
    point(pose.tip, axisOf(pose), true);
    chooseFeedCode();
    const int count = whole(5, 20);
    for (int i = 0; i < count; ++i) {
        const Pose before = pose;
        const double fall = i == 0 ? -40.0 : uniform(-1, 1);
        pose.tip = rounded(Vector3d(pose.tip + Vector3d(uniform(0.5, 3), uniform(-2, 2), fall)));
        const double tilt = pose.second_deg + (pole ? uniform(-0.4, 0.4) : uniform(-2, 2));
        pose.second_deg = rounded(std::clamp(tilt, pole ? 0.1 : 7.0, 60.0));
        pose.first_deg = rounded(pose.first_deg + (pole ? uniform(-8, 8) : uniform(0.5, 3)));
        cut(before, pose, i == 0);
        point(pose.tip, axisOf(pose));
    }
    pose.tip.z() += 40.0;
    poseBlock({code(0)}, pose, {});
    point(pose.tip, axisOf(pose), true);
    if (feed_code_ != 94) block({code(94)});
}

void ProgramDrawer::poseBlock(const Words& before, const Pose& pose, const Words& after) {
    Words orientation = rotary(pose.first_deg, pose.second_deg);
    const Vector3d linear = out_.form == Form::MachineCoordinates ? programmed(pose, tool_length_error_mm_) : pose.tip;
    if (out_.form == Form::Vectors) {
        const Vector3d axis = axisOf(pose);
        orientation = {number("A3", axis.x(), 6), number("B3", axis.y(), 6), number("C3", axis.z(), 6)};
    }
    block(before + xyz(linear) + orientation + after);
}

/// Machine coordinates: as many blocks as hold the chord error, each end on the great circle.
void ProgramDrawer::cut(const Pose& from, const Pose& to, bool first) {
    int pieces = 1;
    if (out_.form == Form::MachineCoordinates)
        while (chordError(from, to, pieces) > drawn_chord_error_mm) ++pieces;
    for (int i = 1; i <= pieces; ++i) {
        const Pose pose = i == pieces ? to : onTheWay(from, to, static_cast<double>(i) / pieces);
        const bool opens = i == 1;
        poseBlock(opens ? Words{code(1)} : Words{}, pose, feedWord(first && opens, (to.tip - from.tip).norm()));
    }
}

/// Of the longest of so many pieces: how far the middle of its joints puts the tip off the line. It falls with the
/// square of their number, and hardly differs between them.
double ProgramDrawer::chordError(const Pose& from, const Pose& to, int pieces) const {
    double worst = 0.0;
    for (const int i : {0, pieces / 2, pieces - 1}) {
        const Pose a = onTheWay(from, to, static_cast<double>(i) / pieces);
        const Pose b = onTheWay(from, to, static_cast<double>(i + 1) / pieces);
        const AxisValues middle{(programmed(a, 0.0) + programmed(b, 0.0)) / 2.0, (a.first_deg + b.first_deg) / 2.0,
                                (a.second_deg + b.second_deg) / 2.0};
        const Vector3d tip = out_.closed_form->tip(middle, out_.origin_mm, out_.tool_length_mm);
        worst = std::max(worst, (tip - a.tip).cross((to.tip - from.tip).normalized()).norm());
    }
    return worst;
}

Vector3d ProgramDrawer::programmed(const Pose& pose, double tool_length_error_mm) const {
    return out_.closed_form->programmed(pose.tip, {{}, pose.first_deg, pose.second_deg}, out_.origin_mm,
                                        out_.tool_length_mm + tool_length_error_mm);
}

/// The rotary axes of the great circle, by Newton's method from the linear guess.
ProgramDrawer::Pose ProgramDrawer::onTheWay(const Pose& from, const Pose& to, double fraction) const {
    const Vector3d a = axisOf(from);
    const Vector3d b = axisOf(to);
    const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
    const Vector3d wanted =
        angle < 1e-9
            ? b
            : Vector3d((std::sin((1 - fraction) * angle) * a + std::sin(fraction * angle) * b) / std::sin(angle));
    Pose pose;
    pose.tip = (1 - fraction) * from.tip + fraction * to.tip;
    pose.first_deg = (1 - fraction) * from.first_deg + fraction * to.first_deg;
    pose.second_deg = (1 - fraction) * from.second_deg + fraction * to.second_deg;
    constexpr double step_deg = 1e-4;
    for (int i = 0; i < 8; ++i) {
        const Vector3d at = axisOf(pose);
        Eigen::Matrix<double, 3, 2> slope;
        slope.col(0) = (out_.closed_form->axis(pose.first_deg + step_deg, pose.second_deg) - at) / step_deg;
        slope.col(1) = (out_.closed_form->axis(pose.first_deg, pose.second_deg + step_deg) - at) / step_deg;
        const Eigen::Vector2d change = (slope.transpose() * slope).inverse() * slope.transpose() * (wanted - at);
        pose.first_deg += change[0];
        pose.second_deg += change[1];
    }
    pose.first_deg = rounded(pose.first_deg);
    pose.second_deg = rounded(pose.second_deg);
    return pose;
}

std::string nameOf(Form form) {
    static constexpr const char* names[] = {"rotary axes", "near the pole", "vectors",  "machine coordinates",
                                            "arcs",        "chords",        "drilling", "swivelled",
                                            "frames"};
    return names[static_cast<std::size_t>(form)];
}

DrawnProgram drawProgram(Form form, base::Random& random, double tool_length_error_mm) {
    return ProgramDrawer(form, random, tool_length_error_mm).draw();
}

}  // namespace cusp::post::verify::test
