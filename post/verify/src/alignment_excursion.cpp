// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Excursions: the tool leaves a cut along its axis, the rotary axes unwind, and it comes back to the same place.
#include "alignment.hpp"

#include <cusp/post/reader/move_sampler.hpp>
#include <algorithm>
#include <fmt/format.h>

namespace cusp::post::verify {

namespace {

using reader::ExecutedMotion;
using reader::Vector3;

/// Less than this is not off the part.
constexpr double least_way_mm = 1.0;
constexpr double still_rad = 1e-9;

bool isStraight(const ExecutedMotion& motion) { return motion.start_pose && motion.end_pose && !motion.arc; }

}  // namespace

/// From where the path stands, straight along the tool axis away from the part, with the rotary axes at rest.
bool Alignment::beginsExcursion(const ExecutedMotion& motion) {
    if (held_ || !at_ || done() || !isStraight(motion) || reader::rotaryTravel(motion) > still_rad) return false;
    if (!difference(*motion.start_pose, *at_).within(tolerance_)) return false;
    const Vector3 way = motion.end_pose->tip_mm - at_->tip_mm;
    const double along = reader::dot(way, at_->axis);
    if (along < least_way_mm || reader::norm(way - along * at_->axis) > tolerance_.tip_mm) return false;
    if (reader::angleBetween(motion.end_pose->axis, at_->axis) > tolerance_.axis_rad) return false;
    excursion_ = Excursion{motion.place, *at_, motion.end_pose->tip_mm, false};
    checkOffThePart(motion);
    return true;
}

/// Off the part only the rotary axes move, the tip at rest; then straight back to the same tip and axis, at feed. Anything
/// else was no excursion.
bool Alignment::continuesExcursion(const ExecutedMotion& motion) {
    if (!excursion_) return false;
    Excursion& excursion = *excursion_;
    if (isStraight(motion) && restsAt(motion, excursion.off_mm)) {
        excursion.turned = excursion.turned || reader::rotaryTravel(motion) > still_rad;
        checkOffThePart(motion);
        return true;
    }
    const bool back = isStraight(motion) && excursion.turned && reader::rotaryTravel(motion) <= still_rad &&
                      reader::norm(motion.start_pose->tip_mm - excursion.off_mm) <= tolerance_.tip_mm &&
                      difference(*motion.end_pose, excursion.from).within(tolerance_);
    if (!back) {
        abandonExcursion();
        return false;
    }
    if (motion.code == reader::MotionCode::Rapid)
        findings_.error("verify.kind", motion.place, "a rapid (G0) back onto the path: a cut is taken up at feed");
    ++report_.excursions;
    checkOffThePart(motion);
    at_ = motion.end_pose;
    excursion_.reset();
    return true;
}

/// All but the feed, of which an excursion has its own.
void Alignment::checkOffThePart(const ExecutedMotion& motion) {
    if (done() || motion.code == reader::MotionCode::Rapid) return;
    const ExpectedPoint& point = expected_->points[next_];
    ExpectedProcess process = expected_->processes[point.process];
    process.feed.reset();
    checkProcess(motion, process, point.line, process_limits_, findings_);
}

/// Whether the tip stays where it is all the way.
bool Alignment::restsAt(const ExecutedMotion& motion, const Vector3& tip_mm) const {
    const ExpectedMove rest{{tip_mm, motion.start_pose->axis}, {tip_mm, motion.end_pose->axis}, nullptr};
    return strayBetween(motion, chain_, rest, 0.0, 1.0).tip_mm <=
           std::max(tolerance_.tip_mm, options_.between_tip_tolerance_mm);
}

void Alignment::abandonExcursion() {
    if (!excursion_) return;
    ++report_.extra;
    findings_.error(
        "verify.extra", excursion_->place,
        fmt::format("this move leaves the path along the tool axis and does not come back to the same place "
                    "with the rotary axes turned{}",
                    done() ? std::string() : fmt::format(" (before CL line {})", expected_->points[next_].line)));
    excursion_.reset();
}

}  // namespace cusp::post::verify
