// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Drilling cycles: heights, pecks, pitch, and the exact CYCLE calls.
#include "hole_cycle_call.hpp"
#include "hole_plan.hpp"

#include <cusp/base/units.hpp>

#include <gtest/gtest.h>

namespace cusp::post {
namespace {

using toolpath::CycleStart;
using toolpath::FeedRate;
using Kind = CycleStart::Kind;

constexpr FeedRate feed_200{200.0 / 60.0, FeedRate::Unit::MmPerS};
constexpr Spindle spindle_500{toolpath::SpindleCommand::Turn::Clockwise, 500.0};

CycleStart cycleOf(Kind kind) {
    CycleStart cycle;
    cycle.kind = kind;
    cycle.depth_mm = 20.0;
    cycle.clearance_mm = 2.0;
    return cycle;
}

std::string callFor(const CycleStart& cycle, double z = 5.0, const Spindle& spindle = spindle_500) {
    const toolpath::CutterLocation hole{{1.0, 2.0, z}, geometry::Vector3::UnitZ()};
    const auto planned = planHole(cycle, hole, spindle, feed_200);
    return planned ? holeCycleCall(*planned, 5) : planned.error();
}

TEST(HoleCycles, Drilling) {
    CycleStart cycle = cycleOf(Kind::Drill);
    EXPECT_EQ(callFor(cycle), "CYCLE81(7,5,2,,20)");
    cycle.retract_mm = 30.0;
    EXPECT_EQ(callFor(cycle), "CYCLE81(35,5,2,,20)");
    cycle.dwell_s = 0.5;
    EXPECT_EQ(callFor(cycle, -1.25), "CYCLE82(28.75,-1.25,2,,20,0.5)");
}

TEST(HoleCycles, DeepDrillingAndChipBreaking) {
    CycleStart cycle = cycleOf(Kind::Deep);
    EXPECT_EQ(callFor(cycle), "deep drilling without a depth per peck");
    cycle.peck_mm = 4.0;
    EXPECT_EQ(callFor(cycle), "CYCLE83(7,5,2,,20,,4,0,0,0,1,1)");
    cycle.first_peck_mm = 3.0;
    cycle.kind = Kind::BreakChip;
    EXPECT_EQ(callFor(cycle), "CYCLE83(7,5,2,,20,,3,0,0,0,1,0)");
}

TEST(HoleCycles, Boring) { EXPECT_EQ(callFor(cycleOf(Kind::Bore)), "CYCLE85(7,5,2,,20,0,200,200)"); }

TEST(HoleCycles, TappingTakesItsPitchFromFeedAndSpeed) {
    // 200 mm/min at 500 rev/min is 0.4 mm per revolution.
    EXPECT_EQ(callFor(cycleOf(Kind::Tap)), "CYCLE84(7,5,2,,20,0,3,,0.4,0,500,500)");
    const Spindle left{toolpath::SpindleCommand::Turn::CounterClockwise, 500.0};
    EXPECT_EQ(callFor(cycleOf(Kind::Tap), 5.0, left), "CYCLE84(7,5,2,,20,0,4,,-0.4,0,500,500)");
    CycleStart per_rev = cycleOf(Kind::Tap);
    per_rev.feed = FeedRate{1.5, FeedRate::Unit::MmPerRev};
    EXPECT_EQ(callFor(per_rev), "CYCLE84(7,5,2,,20,0,3,,1.5,0,500,500)");
    EXPECT_EQ(callFor(cycleOf(Kind::Tap), 5.0, Spindle{}),
              "tapping with the spindle off: there is no SPINDL before it");
}

TEST(HoleCycles, WhatCannotBeACycleIsRefused) {
    CycleStart cycle = cycleOf(Kind::Drill);
    const toolpath::CutterLocation tilted{{0, 0, 0}, geometry::Vector3(0.6, 0.0, 0.8)};
    EXPECT_EQ(planHole(cycle, tilted, spindle_500, feed_200).error(),
              "a hole that is not along Z needs a tilted plane (CYCLE800), and the machine file says it has none");
    const toolpath::CutterLocation straight{{0, 0, 0}, geometry::Vector3::UnitZ()};
    EXPECT_EQ(planHole(cycle, straight, spindle_500, std::nullopt).error(),
              "the cycle has no feed, and no FEDRAT stands before it");
    cycle.clearance_mm.reset();
    EXPECT_EQ(planHole(cycle, straight, spindle_500, feed_200).error(), "the cycle says no clearance above the hole");
}

}  // namespace
}  // namespace cusp::post
