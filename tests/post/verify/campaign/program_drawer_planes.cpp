// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The forms with the tool along one direction: arcs, their chords, holes, planes and frames.
#include "program_drawer.hpp"

#include <cusp/base/units.hpp>

#include <numbers>
#include <optional>

namespace cusp::post::verify::test {

using namespace cusp::toolpath;

namespace {

Eigen::Isometry3d turned(const Vector3d& angles_deg, const std::array<int, 3>& order) {
    Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
    for (std::size_t i = 0; i < 3; ++i)
        turn.rotate(
            Eigen::AngleAxisd(base::radFromDeg(angles_deg[static_cast<Eigen::Index>(i)]), Vector3d::Unit(order[i])));
    return turn;
}

}  // namespace

void ProgramDrawer::arcs() {
    Vector3d at = rounded(Vector3d(uniform(-50, 50), uniform(-50, 50), 30));
    const Vector3d up = Vector3d::UnitZ();
    block(Words{code(0)} + xyz(at));
    point(at, up, true);
    chooseFeedCode();
    at.z() -= 25.0;
    block(Words{code(1)} + xyz(at) + feedWord(true, 1));
    point(at, up);
    const int count = whole(4, 9);
    for (int i = 0; i < count; ++i) {
        if (random_.chance(0.7)) {
            arc(at);
            continue;
        }
        at = rounded(Vector3d(at + Vector3d(uniform(1, 9), uniform(-9, 9), uniform(-1, 1))));
        block(Words{code(1)} + xyz(at));
        point(at, up);
    }
    at.z() += 25.0;
    block(Words{code(0)} + xyz(at));
    point(at, up, true);
    if (feed_code_ != 94) block({code(94)});
}

void ProgramDrawer::arc(Vector3d& at) {
    const bool clockwise = random_.chance(0.5);
    const bool full = random_.chance(0.2);
    const double radius = uniform(2, 12);
    const double begin = uniform(0, 6.28);
    const double sweep = (clockwise ? -1 : 1) * (full ? 2.0 * std::numbers::pi : uniform(0.4, 5.5));
    const double height = random_.chance(0.5) ? 0.0 : rounded(uniform(-2, 2));
    const Vector3d center = rounded(Vector3d(at - radius * Vector3d(std::cos(begin), std::sin(begin), 0)));
    const Vector3d from = at - center;
    const auto on = [&](double fraction) {
        const double c = std::cos(fraction * sweep);
        const double s = std::sin(fraction * sweep);
        return Vector3d(center + Vector3d(c * from.x() - s * from.y(), s * from.x() + c * from.y(), fraction * height));
    };
    const Vector3d end = full ? Vector3d(at + Vector3d(0, 0, height)) : rounded(on(1.0));
    ArcMotion motion;
    motion.end.tip_mm = end;
    motion.center_mm = center;
    motion.normal = (clockwise ? -1.0 : 1.0) * Vector3d::UnitZ();
    motion.radius_mm = from.norm();
    motion.full_circle = full;
    record(motion);
    if (out_.form == Form::Arcs)
        block(Words{code(clockwise ? 2 : 3)} + xyz(end) + Words{number("I", -from.x()), number("J", -from.y())});
    else {
        // A chord of angle φ is r·φ²/8 off its arc.
        const double step = std::sqrt(8.0 * drawn_chord_error_mm / motion.radius_mm);
        const int pieces = static_cast<int>(std::ceil(std::abs(sweep) / step));
        for (int i = 1; i <= pieces; ++i)
            block(Words{code(1)} + xyz(i == pieces ? end : rounded(on(static_cast<double>(i) / pieces))));
    }
    at = end;
}

void ProgramDrawer::holes() {
    const double clearance = rounded(uniform(1, 3), 3);
    const double retract = rounded(clearance + uniform(1, 20), 3);
    const double depth = rounded(uniform(5, 30), 3);
    const double top = rounded(uniform(-10, 10), 3);
    CycleStart cycle;
    cycle.depth_mm = depth;
    cycle.clearance_mm = clearance;
    cycle.retract_mm = retract;
    cycle.feed = FeedRate{feed_ / 60.0, FeedRate::Unit::MmPerS};
    NcBlock call;
    call.words = {word("MCALL")};
    call.cycle = "CYCLE81";
    call.arguments = {top + retract, top, clearance, top - depth, std::nullopt};
    chooseCycle(cycle, call);
    record(cycle);
    Vector3d at(rounded(uniform(-50, 50)), rounded(uniform(-50, 50)), top);
    block({number("F", feed_, 0)});
    block(Words{code(0)} + xyz(at + Vector3d(0, 0, retract)), true);
    out_.blocks.push_back(call);
    const int count = whole(2, 8);
    for (int i = 0; i < count; ++i) {
        record(HoleLocation{{at, Vector3d::UnitZ()}});
        block({number("X", at.x()), number("Y", at.y())});
        at = rounded(Vector3d(at + Vector3d(uniform(3, 20), uniform(-20, 20), 0)));
    }
    record(CycleEnd{});
    block({word("MCALL")});
    record(OperationStart{"AWAY"});
    at.z() = rounded(top + retract + 5.0);
    point(at, Vector3d::UnitZ(), true);
    block(Words{code(0)} + xyz(at));
}

void ProgramDrawer::chooseCycle(CycleStart& cycle, NcBlock& call) {
    auto& arguments = call.arguments;
    switch (whole(0, 5)) {
        case 1:
            call.cycle = "CYCLE82";
            cycle.dwell_s = 0.5;
            arguments.push_back(0.5);
            return;
        case 2:
        case 3:
            call.cycle = "CYCLE83";
            cycle.kind = random_.chance(0.5) ? CycleStart::Kind::Deep : CycleStart::Kind::BreakChip;
            cycle.peck_mm = rounded(cycle.depth_mm / 3.5, 3);
            arguments.insert(arguments.end(),
                             {std::nullopt, *cycle.peck_mm, 0, 0, 0, 1, cycle.kind == CycleStart::Kind::Deep ? 1 : 0});
            return;
        case 4:
            call.cycle = "CYCLE85";
            cycle.kind = CycleStart::Kind::Bore;
            arguments.insert(arguments.end(), {0, feed_, feed_});
            return;
        case 5:
            call.cycle = "CYCLE84";
            cycle.kind = CycleStart::Kind::Tap;
            cycle.feed = FeedRate{1.25, FeedRate::Unit::MmPerRev};
            arguments.insert(arguments.end(), {0, left_ ? 4 : 3, std::nullopt, left_ ? -1.25 : 1.25, 0, rpm_, rpm_});
            return;
        default: return;
    }
}

/// A zigzag in the plane at hand.
void ProgramDrawer::zigzag(const Eigen::Isometry3d& frame, const Vector3d& axis) {
    Vector3d at(0, 0, 50);
    block(Words{code(0)} + xyz(at));
    point(frame * at, axis, true);
    chooseFeedCode();
    at.z() = 0;
    block(Words{code(1)} + xyz(at) + feedWord(true, 1));
    point(frame * at, axis);
    const bool incremental = random_.chance(0.3);
    if (incremental) block({code(91)});
    const int count = whole(3, 10);
    for (int i = 0; i < count; ++i) {
        const Vector3d by = rounded(Vector3d(uniform(1, 9), uniform(-9, 9), uniform(-2, 2)));
        at += by;
        block(xyz(incremental ? by : at));
        point(frame * at, axis);
    }
    if (incremental) block({code(90)});
    at = rounded(Vector3d(at + Vector3d(0, 0, 50)));
    block(Words{code(0)} + xyz(at));
    point(frame * at, axis, true);
    if (feed_code_ != 94) block({code(94)});
}

void ProgramDrawer::swivelled() {
    static constexpr std::pair<int, std::array<int, 3>> modes[] = {{57, {0, 1, 2}}, {27, {2, 1, 0}}, {39, {2, 0, 1}}};
    const auto& [mode, order] = modes[random_.below(3)];
    const Vector3d angles = rounded(Vector3d(uniform(5, 40), uniform(5, 40), uniform(5, 40)));
    const Vector3d before = rounded(Vector3d(uniform(-30, 30), uniform(-30, 30), uniform(-30, 30)));
    const Vector3d after = rounded(Vector3d(uniform(-5, 5), uniform(-5, 5), uniform(-5, 5)));
    NcBlock& call = block({});
    call.cycle = "CYCLE800";
    call.arguments = {1, 1, 0, mode};
    for (const Vector3d& part : {before, angles, after})
        call.arguments.insert(call.arguments.end(), {part.x(), part.y(), part.z()});
    call.arguments.emplace_back(-1);
    const Eigen::Isometry3d frame = Eigen::Translation3d(before) * turned(angles, order) * Eigen::Translation3d(after);
    zigzag(frame, frame.linear().col(2));
    block({}).cycle = "CYCLE800";
}

void ProgramDrawer::framed() {
    const Vector3d by = rounded(Vector3d(uniform(-30, 30), uniform(-30, 30), uniform(-30, 30)));
    const double angle = rounded(uniform(-170, 170), 4);
    block(Words{word("TRANS")} + xyz(by));
    block({word("AROT"), number("Z", angle)});
    const Eigen::Isometry3d frame = Eigen::Translation3d(by) * turned({angle, 0, 0}, {2, 0, 1});
    zigzag(frame, Vector3d::UnitZ());
    block({word("TRANS")});
}

}  // namespace cusp::post::verify::test
