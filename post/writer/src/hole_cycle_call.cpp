// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Spells drilling cycles. An argument left out is an empty place between two commas.
#include "hole_cycle_call.hpp"

#include "fixed_number.hpp"

#include <cusp/base/units.hpp>

#include <initializer_list>
#include <optional>

namespace cusp::post {

namespace {

using Kind = toolpath::CycleStart::Kind;

std::string call(const char* name, const HoleCycle& cycle, int decimals,
                 std::initializer_list<std::optional<double>> own) {
    std::string text = std::string(name) + '(';
    const auto add = [&](double value) { appendFixed(text, toFixed(value, decimals), decimals); };
    add(cycle.retract_z_mm);
    text += ',';
    add(cycle.surface_z_mm);
    text += ',';
    add(cycle.clearance_mm);
    text += ",,";
    add(cycle.depth_mm);
    for (const auto& value : own) {
        text += ',';
        if (value) add(*value);
    }
    return text + ')';
}

double feedPerMinute(const HoleCycle& cycle) {
    return cycle.feed.unit == toolpath::FeedRate::Unit::MmPerRev ? cycle.feed.value * cycle.speed_rpm
                                                                 : base::mmPerMinFromMmPerS(cycle.feed.value);
}

}  // namespace

std::string holeCycleCall(const HoleCycle& cycle, int decimals) {
    switch (cycle.kind) {
        case Kind::Drill:
            if (cycle.dwell_s > 0.0) return call("CYCLE82", cycle, decimals, {cycle.dwell_s});
            return call("CYCLE81", cycle, decimals, {});
        case Kind::Deep:
        case Kind::BreakChip:
            // FDEP left out, FDPR first depth, DAM 0: every further peck like the first; DTB, DTS, FRF, VARI.
            return call("CYCLE83", cycle, decimals,
                        {std::nullopt, cycle.first_peck_mm, 0.0, cycle.dwell_s, 0.0, 1.0,
                         cycle.kind == Kind::Deep ? 1.0 : 0.0});
        case Kind::Bore:
            // DTB, then the feeds in and out.
            return call("CYCLE85", cycle, decimals, {cycle.dwell_s, feedPerMinute(cycle), feedPerMinute(cycle)});
        case Kind::Tap:
            // DTB, SDAC (behind the cycle the spindle turns on as before: M3 or M4), MPIT left out, PIT (below 0: left-hand),
            // POSS, SST and SST1: speeds in and out.
            return call("CYCLE84", cycle, decimals,
                        {cycle.dwell_s, cycle.pitch_mm < 0.0 ? 4.0 : 3.0, std::nullopt, cycle.pitch_mm, 0.0,
                         cycle.speed_rpm, cycle.speed_rpm});
    }
    return {};
}

}  // namespace cusp::post
