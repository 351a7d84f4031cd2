// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The order of the questions asked of each block end is what makes this work; see the class.
#include "alignment.hpp"

#include <cusp/post/reader/move_sampler.hpp>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace cusp::post::verify {

namespace {

using reader::ExecutedMotion;
using reader::MotionCode;

/// How many dropped points in a row still let the comparison find its place again.
constexpr std::size_t look_ahead = 64;
/// Ends closer than this are the same printed point.
constexpr double same_tip_mm = 1e-9;
constexpr double same_axis_rad = 1e-12;

/// At the pole a turn of the first axis takes the tool axis no further off its way than this.
constexpr double hardly_beside_rad = base::radFromDeg(0.1);

bool isRapid(const ExecutedMotion& motion) { return motion.code == MotionCode::Rapid; }

bool standsStill(const ExecutedMotion& motion) {
    return motion.start_pose && !motion.arc &&
           difference(*motion.start_pose, *motion.end_pose).within({same_tip_mm, same_axis_rad}) &&
           reader::rotaryTravel(motion) < same_axis_rad;
}

std::string distanceText(const PoseError& error, const Tolerance& tolerance, std::size_t cl_line) {
    std::string text;
    if (error.tip_mm > tolerance.tip_mm)
        text = fmt::format("tip is {:.3g} mm from CL line {}, tolerance {:.3g} mm", error.tip_mm, cl_line,
                           tolerance.tip_mm);
    if (error.axis_rad > tolerance.axis_rad)
        text += fmt::format("{}tool axis is {:.3g}° from CL line {}, tolerance {:.3g}°", text.empty() ? "" : "; ",
                            base::degFromRad(error.axis_rad), cl_line, base::degFromRad(tolerance.axis_rad));
    return text;
}

}  // namespace

Alignment::Alignment(const MachineFile& machine, const ExpectedPath* expected, const VerifyOptions& options,
                     const std::string& program_name, VerifyReport& report)
    : chain_(machine.machine),
      expected_(expected),
      options_(options),
      tolerance_{options.tip_tolerance_mm, options.axis_tolerance_rad},
      report_(report),
      findings_(report, program_name) {
    process_limits_.feed_tolerance = options.feed_tolerance;
    process_limits_.speed_tolerance_rpm = options.speed_tolerance_rpm;
    const auto& spindle = machine.machine.spindle.axis;
    process_limits_.cutting_edge = options.cutting_edge;
    if (!options.fixed_tool_length_axis)
        process_limits_.plane = std::abs(spindle[2]) > 0.7 ? "G17" : std::abs(spindle[1]) > 0.7 ? "G18" : "G19";
    if (!options.check_work_offset) return;
    process_limits_.work_offsets = options.work_offsets;
    if (options.work_offsets.empty()) process_limits_.work_offsets = {machine.control.work_offset};
}

void Alignment::event(const reader::BlockPlace& place, const reader::ExecutedEvent& event) {
    static_cast<void>(place);
    const auto* dwell = std::get_if<reader::DwellTime>(&event);
    if (dwell != nullptr) dwelt_s_ = dwelt_s_.value_or(0.0) + dwell->seconds.value_or(0.0);
}

void Alignment::motion(const ExecutedMotion& motion) {
    checkLimits(motion);
    checkReach(motion);
    if (options_.setup != nullptr) checkTravel(motion);
    if (expected_ != nullptr) {
        compare(motion);
        dwelt_s_.reset();
        return;
    }
    const bool idle = !isRapid(motion) && motion.state->spindle == reader::SpindleTurn::Off;
    if (idle) findings_.warning("verify.spindle-off", motion.place, "the spindle is off in a feed move");
}

void Alignment::compare(const ExecutedMotion& motion) {
    if (!motion.end_pose) return withoutPose(motion);
    if (continuesExcursion(motion) || meetsNext(motion)) return;
    if (isRapid(motion) && atOpening() && !held_) {
        const bool stays = standsStill(motion);
        if ((stays || !onTheWay(motion)) && !meetsLater(motion)) link();
        return;
    }
    if (onTheWay(motion) || beginsExcursion(motion) || meetsLater(motion)) return;
    if (held_) {
        done() ? extra(*held_) : displaced(*held_);
        held_.reset();
        return compare(motion);
    }
    held_ = Held{motion.place, *motion.end_pose, isRapid(motion)};
}

void Alignment::withoutPose(const ExecutedMotion& motion) {
    abandonExcursion();
    if (isRapid(motion)) {
        // The first point of an operation is one the tool may go to again, from home.
        while (!atOpening() && passPointAlreadyMet()) continue;
        if (held_ && done()) {
            extra(*held_);
            held_.reset();
        }
        // A held block can only be the point before an opening; which of the two it was shows now.
        if (held_ && next_ + 1 <= expected_->points.size() &&
            (next_ + 1 == expected_->points.size() || expected_->points[next_ + 1].opens))
            displaced(*held_);
        if (atOpening()) return link();
        ++report_.extra;
        return findings_.error(
            "verify.extra", motion.place,
            fmt::format("this rapid leaves the path in the middle of an operation (before CL line {})",
                        expected_->points[next_].line));
    }
    ++report_.extra;
    findings_.error("verify.unplaced", motion.place,
                    motion.machine_coordinates
                        ? "a feed move in machine coordinates cannot be compared with the CL file"
                    : motion.transformation
                        ? "a feed move before all of X, Y, Z and the rotary axes are known"
                        : "a feed move without TRAORI while rotary axes are away from zero, or with X, Y or Z unknown");
}

bool Alignment::meetsNext(const ExecutedMotion& motion) {
    while (true) {
        if (done()) return false;
        if (difference(*motion.end_pose, expected_->points[next_].pose).within(tolerance_)) break;
        const std::size_t before = next_;
        if (!held_) passPointsAlreadyMet();
        if (next_ == before) return false;
    }
    if (held_) extra(*held_);
    held_.reset();
    meet(motion, next_);
    return true;
}

/// A CL point at the place where the path already stands needs no block.
bool Alignment::passPointAlreadyMet() {
    // An arc that ends where it begins is a full circle, and has to be run.
    if (done() || !at_ || expected_->points[next_].arc != none ||
        !difference(*at_, expected_->points[next_].pose).within(tolerance_))
        return false;
    ++report_.matched;
    ++next_;
    skipped_from_.reset();
    fraction_ = 0.0;
    return true;
}
void Alignment::passPointsAlreadyMet() {
    while (passPointAlreadyMet()) continue;
}

bool Alignment::onTheWay(const ExecutedMotion& motion) {
    if (done() || next_ == 0 || (!at_ && expected_->points[next_].opens)) return false;
    auto fraction = nextMove().fractionOf(*motion.end_pose, tolerance_);
    if (!fraction && leavesOut(motion)) fraction = nextMove().fractionOf(*motion.end_pose, tolerance_);
    const bool detour = !fraction;
    if (detour) fraction = besideTheWay(motion);
    const ExpectedCycle* hole = nextHole();
    if (!fraction || (hole == nullptr && *fraction < fraction_ - 1e-9)) return false;
    if (held_) extra(*held_);
    held_.reset();
    const ExpectedPoint& point = expected_->points[next_];
    if (standsStill(motion) && isRapid(motion)) return true;  // a hole where the tool is already
    if (standsStill(motion)) {
        ++report_.extra;
        findings_.error(
            "verify.repeated", motion.place,
            fmt::format("repeats the point before it, which the CL file has once (before CL line {})", point.line));
        return true;
    }
    ++report_.intermediate;
    if (hole != nullptr)
        inHole(motion, *hole, *fraction);
    else
        checkKind(motion, point);
    checkBetween(motion, *fraction);
    checkTurns(motion, point.line);
    const ExpectedMove way = nextMove();
    const double beside_rad =
        reader::angleBetween(motion.end_pose->axis, reader::onGreatCircle(way.from.axis, way.to.axis, *fraction));
    if (detour && !isRapid(motion) && beside_rad > hardly_beside_rad)
        findings_.state(base::Severity::Warning, "verify.winding", motion.place,
                        "the rotary axes change branch near the pole: the tip is on its way, the tool axis beside it",
                        point.line);
    if (!isRapid(motion))
        checkProcess(motion, expected_->processes[point.process], point.line, process_limits_, findings_);
    fraction_ = *fraction;
    at_ = motion.end_pose;
    return true;
}

/// A point the program may leave out: on the way to the one behind it.
bool Alignment::leavesOut(const ExecutedMotion& motion) {
    const auto& points = expected_->points;
    if (held_ || !at_ || !isRapid(motion) || !points[next_].optional || fraction_ > 0.0) return false;
    if (next_ + 1 >= points.size() || !points[next_ + 1].rapid) return false;
    const double axis_rad = motion.joint_linear ? std::numbers::pi : tolerance_.axis_rad;
    const ExpectedMove beyond{*at_, points[next_ + 1].pose, nullptr};
    if (!beyond.fractionOf(*motion.end_pose, {tolerance_.tip_mm, axis_rad})) return false;
    drop(next_ + 1);
    return true;
}

/// Without TRAORI a turn of the rotary axes takes many blocks to keep the tip on its way. In a rapid, and where the branch
/// changes within the pole cone, the tool axis does not keep its own.
std::optional<double> Alignment::besideTheWay(const ExecutedMotion& motion) const {
    if (!motion.joint_linear || held_) return std::nullopt;
    if (!isRapid(motion) && chain_.poleAngle(motion.end_pose->axis) > options_.pole_cone_rad) return std::nullopt;
    const double axis_rad = isRapid(motion) ? std::numbers::pi : options_.pole_cone_rad;
    return nextMove().fractionOf(*motion.end_pose, {tolerance_.tip_mm, axis_rad});
}

bool Alignment::meetsLater(const ExecutedMotion& motion) {
    const auto& points = expected_->points;
    const bool rapids_only = isRapid(motion) && atOpening() && !held_;
    for (std::size_t i = next_; i < std::min(points.size(), next_ + 1 + look_ahead); ++i) {
        // A link may pass where the operation comes by later: it only stands for the rapids that begin the operation.
        if (rapids_only && !points[i].rapid) return false;
        if (i == next_ || !difference(*motion.end_pose, points[i].pose).within(tolerance_)) continue;
        if (held_) displaced(*held_);
        drop(i);
        meet(motion, i);
        return true;
    }
    return false;
}

void Alignment::meet(const ExecutedMotion& motion, std::size_t index) {
    const ExpectedPoint& point = expected_->points[index];
    const PoseError error = difference(*motion.end_pose, point.pose);
    ++report_.matched;
    raise(report_.max_tip_error_mm, error.tip_mm, motion.place, point.line);
    raise(report_.max_axis_error_rad, error.axis_rad, motion.place, point.line);
    next_ = index;
    checkKind(motion, point);
    if (const ExpectedCycle* hole = nextHole()) inHole(motion, *hole, 1.0);
    if (point.leaves_hole) checkDwell(motion, point);
    if (index > 0 && at_) checkBetween(motion, 1.0);
    checkTurns(motion, point.line);
    if (!isRapid(motion))
        checkProcess(motion, expected_->processes[point.process], point.line, process_limits_, findings_);
    next_ = index + 1;
    skipped_from_.reset();
    fraction_ = 0.0;
    hole_ = {};
    at_ = motion.end_pose;
}

void Alignment::link() {
    ++report_.links;
    at_.reset();
}

void Alignment::extra(const Held& held) {
    ++report_.extra;
    findings_.error("verify.extra", held.place,
                    fmt::format("this {} leads nowhere in the CL file{}", held.rapid ? "rapid" : "feed move",
                                done() ? std::string(", whose last point is met")
                                       : fmt::format(" (before CL line {})", expected_->points[next_].line)));
}

/// The held block was meant for the next point.
void Alignment::displaced(const Held& held) {
    const ExpectedPoint& point = expected_->points[next_];
    const PoseError error = difference(held.pose, point.pose);
    ++report_.missed;
    raise(report_.max_tip_error_mm, error.tip_mm, held.place, point.line);
    raise(report_.max_axis_error_rad, error.axis_rad, held.place, point.line);
    if (point.lifts)
        findings_.error("verify.low-approach", held.place,
                        fmt::format("goes across to the hole of CL line {} below its retract plane", point.line));
    else
        findings_.error("verify.displaced", held.place, distanceText(error, tolerance_, point.line));
    ++next_;
    skipped_from_.reset();
    fraction_ = 0.0;
    at_.reset();
    held_.reset();
}

void Alignment::drop(std::size_t until) {
    const bool only_optional = std::all_of(expected_->points.begin() + static_cast<std::ptrdiff_t>(next_),
                                           expected_->points.begin() + static_cast<std::ptrdiff_t>(until),
                                           [](const ExpectedPoint& point) { return point.optional; });
    fraction_ = 0.0;
    for (; next_ < until; ++next_) {
        if (expected_->points[next_].optional) {
            ++report_.matched;
            continue;
        }
        ++report_.missed;
        const ExpectedPoint& point = expected_->points[next_];
        if (point.lifts)
            findings_.missing("verify.low-approach",
                              fmt::format("CL line {}: the hole is reached from below its retract plane", point.line));
        else
            findings_.missing("verify.missed", fmt::format("CL line {}: no block ends at this point", point.line));
    }
    if (!only_optional) at_.reset();
    skipped_from_ = only_optional ? at_ : std::nullopt;
}

ExpectedMove Alignment::nextMove() const {
    const ExpectedPoint& point = expected_->points[next_];
    ExpectedMove move{skipped_from_.value_or(expected_->points[next_ - 1].pose), point.pose, nullptr};
    if (point.arc == none) return move;
    move.arc = &expected_->arcs[point.arc];
    move.from.tip_mm = move.arc->start_mm;
    return move;
}

void Alignment::checkKind(const ExecutedMotion& motion, const ExpectedPoint& point) {
    if (isRapid(motion) == point.rapid) return;
    if (!isRapid(motion))
        return findings_.error("verify.kind", motion.place,
                               fmt::format("a feed move where CL line {} is a rapid", point.line));
    const std::string text = fmt::format("a rapid (G0) where CL line {} is a feed move", point.line);
    // The first point of an operation is reached from a home position the CL file knows nothing of.
    if (point.opens && !at_) return findings_.warning("verify.approach", motion.place, text);
    findings_.error("verify.kind", motion.place, text);
}

void Alignment::finish() {
    if (expected_ == nullptr) return;
    abandonExcursion();
    if (!held_) passPointsAlreadyMet();
    if (held_ && done())
        extra(*held_);
    else if (held_)
        displaced(*held_);
    // An operation that ends where the one before it did, with the tool gone home already.
    if (!done() && next_ > 0) at_ = expected_->points[next_ - 1].pose;
    if (atOpening()) passPointsAlreadyMet();
    drop(expected_->points.size());
}

}  // namespace cusp::post::verify
