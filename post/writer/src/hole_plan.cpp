// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Drilling cycles along Z; others are refused by name.
#include "hole_plan.hpp"

#include <cusp/base/units.hpp>

#include <algorithm>

namespace cusp::post {

using toolpath::CycleStart;
using toolpath::FeedRate;
using toolpath::SpindleCommand;

namespace {

// The seventh decimal of a CL file's axis.
constexpr double along_z_rad = 1e-6;

tl::unexpected<std::string> refuse(const char* why) { return tl::unexpected<std::string>(why); }

/// mm per revolution; the thread's pitch when tapping.
double perRevolution(const FeedRate& feed, double speed_rpm) {
    return feed.unit == FeedRate::Unit::MmPerRev ? feed.value : base::mmPerMinFromMmPerS(feed.value) / speed_rpm;
}

}  // namespace

bool alongZ(const geometry::Vector3& axis) {
    return geometry::angleBetween(axis, geometry::Vector3::UnitZ()) <= along_z_rad;
}

tl::expected<HoleCycle, std::string> planHole(const CycleStart& cycle, const toolpath::CutterLocation& hole,
                                              const Spindle& spindle, const std::optional<FeedRate>& feed,
                                              const std::optional<double>& tap_pitch_mm) {
    if (!alongZ(hole.axis))
        return refuse(
            "a hole that is not along Z needs a tilted plane (CYCLE800), and the machine file says it has none");
    if (!cycle.clearance_mm) return refuse("the cycle says no clearance above the hole");
    const bool tap = cycle.kind == CycleStart::Kind::Tap;
    std::optional<FeedRate> rate = cycle.feed ? cycle.feed : feed;
    if (tap && !cycle.feed && tap_pitch_mm) rate = FeedRate{*tap_pitch_mm, FeedRate::Unit::MmPerRev};
    if (!rate && tap)
        return refuse(
            "the tapping cycle has no feed to take the pitch of the thread from; give it with --tap-pitch-mm");
    if (!rate) return refuse("the cycle has no feed, and no FEDRAT stands before it");

    HoleCycle out;
    out.kind = cycle.kind;
    out.surface_z_mm = hole.tip_mm.z();
    out.clearance_mm = *cycle.clearance_mm;
    out.retract_z_mm = hole.tip_mm.z() + std::max(cycle.retract_mm.value_or(0.0), *cycle.clearance_mm);
    out.depth_mm = cycle.depth_mm;
    out.dwell_s = cycle.dwell_s.value_or(0.0);
    out.feed = *rate;
    out.speed_rpm = spindle.speed_rpm;
    if (cycle.kind == CycleStart::Kind::Deep || cycle.kind == CycleStart::Kind::BreakChip) {
        if (!cycle.peck_mm && !cycle.first_peck_mm) return refuse("deep drilling without a depth per peck");
        out.peck_mm = cycle.peck_mm.value_or(cycle.first_peck_mm.value_or(0.0));
        // CYCLE83 keeps one depth per peck; the shallower of the two never asks more of the drill than the file does.
        out.peck_mm = std::min(out.peck_mm, cycle.first_peck_mm.value_or(out.peck_mm));
        out.first_peck_mm = out.peck_mm;
    }
    if (tap) {
        if (spindle.turn == SpindleCommand::Turn::Off || spindle.speed_rpm <= 0.0)
            return refuse("tapping with the spindle off: there is no SPINDL before it");
        const double right_hand = spindle.turn == SpindleCommand::Turn::Clockwise ? 1.0 : -1.0;
        out.pitch_mm = right_hand * perRevolution(*rate, spindle.speed_rpm);
    }
    return out;
}

}  // namespace cusp::post
