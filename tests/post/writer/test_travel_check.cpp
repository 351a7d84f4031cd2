// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Linear travel of whole programs, step by step, with positions worked by hand.
#include <cusp/base/units.hpp>
#include <cusp/post/control/control_definition.hpp>
#include <cusp/post/writer/travel_check.hpp>

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace cusp::post {
namespace {

using base::radFromDeg;
using geometry::Vector3;

class Counter : public NcSink {
public:
    void step(const NcStep& /*step*/) override { ++steps; }
    std::size_t steps = 0;
};

/// The gantry with C-then-A head: the pivot is 250 mm above the gauge point, home is X0 Y0 Z0, Z goes from −1250 to 0.
class Travel : public ::testing::Test {
protected:
    Travel() : file(readMachineFile(CUSP_SOURCE_DIR "/machines/fooke-endura-ca.toml").value()), machine(file.machine) {
        setup.work_offsets["G54"].origin_mm = {1000.0, 200.0, -800.0};
        setup.tools = {{.number = 1, .name = "BALL", .length_mm = 150.0},
                       {.number = 2, .name = "DRILL", .length_mm = 250.0}};
    }

    /// Runs the steps, each on the CL line of its place, and gives the diagnostics.
    std::string check(const std::vector<NcItem>& items, const std::string& work_offset = "G54") {
        Counter counter;
        TravelCheck travel(machine, setup, work_offset, "part.cls", counter);
        std::uint32_t line = 0;
        for (const NcItem& item : items) travel.step({item, ++line});
        travel.finish();
        EXPECT_EQ(counter.steps, items.size());
        range = travel.summary().range_mm;
        return base::toText(travel.report());
    }
    static Move feedTo(const Vector3& tip_mm, double c_deg = 0.0, double a_deg = 0.0) {
        return {tip_mm, {radFromDeg(c_deg), radFromDeg(a_deg)}, toolpath::MotionKind::Feed, {}};
    }

    MachineFile file;
    kinematics::Machine machine;
    machine::SetupDefinition setup;
    std::array<std::pair<double, double>, 3> range{};
};

TEST_F(Travel, FollowsTheMachineFromHomeToThePart) {
    // Pivot to tip is 400 mm. At home the tip is at Z −400 in the machine: 400 above the origin.
    EXPECT_EQ(check({GoHome{}, ChangeTool{1, "BALL"}, PositionRotary{}, TipProgramming{true},
                     Approach{{10.0, 20.0, 5.0}, {}, toolpath::MotionKind::Rapid, {}}, feedTo({30.0, 20.0, 0.0}),
                     TipProgramming{false}, GoHome{}}),
              "");
    EXPECT_NEAR(range[0].first, 1010.0, 1e-9);
    EXPECT_NEAR(range[0].second, 1030.0, 1e-9);
    EXPECT_NEAR(range[1].first, 220.0, 1e-9);
    EXPECT_NEAR(range[2].first, -400.0, 1e-9);
    EXPECT_NEAR(range[2].second, 0.0, 1e-9);
}

TEST_F(Travel, TheToolLengthCounts) {
    // Z stands 500 above the tip of the drill, 400 above that of the ball.
    const Approach low{{0.0, 0.0, -900.0}, {}, toolpath::MotionKind::Rapid, {}};
    EXPECT_EQ(check({GoHome{}, ChangeTool{2, "DRILL"}, TipProgramming{true}, low}), "");
    EXPECT_EQ(check({GoHome{}, ChangeTool{1, "BALL"}, TipProgramming{true}, low}),
              "part.cls:4: error: Z axis would need -1300 mm at CL line 4; limit -1250 mm [kinematics.linear-limit]\n");
}

TEST_F(Travel, ATiltedApproachMovesInThePlaneOfTheHomeTip) {
    // With A at 90° (axis −Y) at home the tip is 400 mm in +Y of the pivot, at the pivot's height.
    check({GoHome{}, ChangeTool{1, "BALL"}, PositionRotary{{0.0, radFromDeg(90.0)}}, TipProgramming{true},
           Approach{{0.0, 0.0, 0.0}, {0.0, radFromDeg(90.0)}, toolpath::MotionKind::Rapid, {}}});
    EXPECT_NEAR(range[1].first, -200.0, 1e-9);
    EXPECT_NEAR(range[2].first, -800.0, 1e-9);
    EXPECT_NEAR(range[2].second, 0.0, 1e-9);
}

TEST_F(Travel, ArcsAreFollowedToTheirSides) {
    const Approach start{{-950.0, 0.0, 0.0}, {}, toolpath::MotionKind::Rapid, {}};
    // A whole turn of radius 60 about (−950, 60): X from −1010 to −890, machine −10 to 110, within the bound of 0.01 mm.
    const ArcMove turn{{-950.0, 0.0, 0.0}, {0.0, 60.0, 0.0}, false, {}, {}};
    EXPECT_EQ(check({GoHome{}, ChangeTool{1, "BALL"}, TipProgramming{true}, start, turn}),
              "part.cls:5: error: X axis would need -9.998 mm on the way to CL line 5; limit 0 mm "
              "[kinematics.linear-limit]\n");
    EXPECT_NEAR(range[0].first, -10.0, 0.02);
    EXPECT_NEAR(range[1].second, 320.0, 0.02);
    // A quarter clockwise from the bottom to the left reaches exactly as far; three quarters the other way, further.
    const ArcMove quarter{{-1000.0, 50.0, 0.0}, {0.0, 50.0, 0.0}, true, {}, {}};
    EXPECT_EQ(check({GoHome{}, ChangeTool{1, "BALL"}, TipProgramming{true}, start, quarter}), "");
    EXPECT_NEAR(range[0].second, 50.0, 1e-9);
    EXPECT_NEAR(range[1].second, 250.0, 1e-9);
}

TEST_F(Travel, HolesAreFollowedToTheirBottom) {
    HoleCycle cycle;
    cycle.retract_z_mm = 20.0;
    cycle.surface_z_mm = -800.0;
    cycle.depth_mm = 60.0;
    EXPECT_EQ(check({GoHome{}, ChangeTool{1, "BALL"}, TipProgramming{true},
                     Approach{{0.0, 0.0, 20.0}, {}, toolpath::MotionKind::Rapid, {}}, cycle,
                     HolePosition{-1100.0, 0.0, {}}, HoleCycleOff{}}),
              "part.cls:6: error: X axis would need -100 mm at CL line 6; limit 0 mm [kinematics.linear-limit]\n"
              "part.cls:6: error: Z axis would need -1260 mm on the way to CL line 6; limit -1250 mm "
              "[kinematics.linear-limit]\n");
}

TEST_F(Travel, SaysWhatTheSetupDoesNotKnow) {
    const Approach start{{-9000.0, 0.0, 0.0}, {}, toolpath::MotionKind::Rapid, {}};
    EXPECT_EQ(check({GoHome{}, ChangeTool{1, "BALL"}, TipProgramming{true}, start}, "G55"),
              "error: the setup does not place work offset G55; it places G54 [post.setup-offset]\n");
    EXPECT_EQ(check({GoHome{}, ChangeTool{9, "MILL"}, TipProgramming{true}, start, ChangeTool{9, {}}}),
              "part.cls:2: error: the setup does not say how long the tool named \"MILL\" is [post.setup-tool]\n"
              "part.cls:5: error: the setup does not say how long the tool 9 is [post.setup-tool]\n");
    EXPECT_EQ(check({GoHome{}, TipProgramming{true}, start}),
              "part.cls:2: error: no tool is called, so the setup cannot say how long it is and linear travel is "
              "unknown [post.setup-tool]\n");
}

}  // namespace
}  // namespace cusp::post
