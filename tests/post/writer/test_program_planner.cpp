// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// From CL text to NC steps, as the text dump shows them; and what the planner refuses or warns of.
#include "planner_fixture.hpp"

#include <cusp/base/units.hpp>

#include <cmath>
#include <fmt/format.h>

namespace cusp::post {
namespace {

TEST_F(Planner, OneOperation) {
    // u = (sin C sin A, −cos C sin A, cos A): leaning to +X by asin 0.6 is C 90, A 36.8699 (or C −90, A −36.8699).
    const std::string text = plan(std::string(head) + "SPINDL/RPM,8000,CLW\n"
                                                      "COOLNT/ON\n"
                                                      "RAPID\n"
                                                      "GOTO/0.0,0.0,50.0,0.0,0.0,1.0\n"
                                                      "FEDRAT/MMPM,1200.0\n"
                                                      "GOTO/0.0,0.0,0.0,0.6,0.0,0.8\n"
                                                      "GOTO/10.0,0.0,0.0\n"
                                                      "RAPID\n"
                                                      "GOTO/10.0,0.0,50.0\n"
                                                      "END-OF-PATH\n");
    EXPECT_TRUE(report.empty()) << base::toText(report);
    EXPECT_EQ(text, "modal-start\n"
                    "tip-programming off\n"
                    "go-home\n"
                    "comment operation OP1\n"
                    "message OP1\n"
                    "comment work offset G54: the programming frame, origin X0.0000 Y0.0000 Z0.0000 mm in the part\n"
                    "change-tool \"BALL_6\"\n"
                    "block M6\n"
                    "smoothing on\n"
                    "work-offset G54\n"
                    "block D1\n"
                    "spindle cw 8000.000 rpm\n"
                    "coolant flood\n"
                    "position-rotary C90.0000 A0.0000\n"
                    "tip-programming on\n"
                    "approach rapid X0.0000 Y0.0000 Z50.0000 C90.0000 A0.0000\n"
                    "move feed X0.0000 Y0.0000 Z0.0000 C90.0000 A36.8699 1200.000 mm/min\n"
                    "move feed X10.0000 Y0.0000 Z0.0000 C90.0000 A36.8699 1200.000 mm/min\n"
                    "move rapid X10.0000 Y0.0000 Z50.0000 C90.0000 A36.8699\n"
                    "tip-programming off\n"
                    "spindle off\n"
                    "coolant off\n"
                    "go-home\n"
                    "smoothing off\n"
                    "block M30\n");
    EXPECT_EQ(summary.cutter_locations, 4U);
    EXPECT_EQ(summary.operations, 1U);
    EXPECT_EQ(summary.tool_changes, 1U);
    EXPECT_NEAR(summary.rotary_travel_rad, std::asin(0.6), 1e-12);
    EXPECT_EQ(summary.largest_rotary_step_axis, 1U);
    EXPECT_EQ(summary.largest_rotary_step_cl_line, 9U);
}

TEST_F(Planner, ToolChangeGoesHomeWithTheSpindleOff) {
    const std::string cut = "RAPID\nGOTO/0.0,0.0,50.0,0.0,0.0,1.0\nFEDRAT/MMPM,100.0\nGOTO/0.0,0.0,0.0\n";
    const std::string text =
        plan(std::string(head) + "SPINDL/RPM,8000,CLW\n" + cut + "END-OF-PATH\n" +
             "TOOL PATH/OP2,TOOL,BALL_8\nTLDATA/MILL,8.0,4.0,50.0,0.0,0.0\n" + cut + "END-OF-PATH\n");
    const auto leave = text.find("tip-programming off\nspindle off\ngo-home\nchange-tool \"BALL_8\"\n");
    EXPECT_NE(leave, std::string::npos) << text;
    // The second operation cuts with the spindle on again, although the file gives its speed once.
    EXPECT_NE(text.find("spindle cw 8000.000 rpm", leave), std::string::npos) << text;
    EXPECT_EQ(summary.tool_changes, 2U);
}

TEST_F(Planner, CuttingWithTheSpindleOffIsToldOnce) {
    const std::string cl = std::string(head) + "FEDRAT/MMPM,100.0\nGOTO/0.0,0.0,0.0,0.0,0.0,1.0\nGOTO/1.0,0.0,0.0\n";
    plan(cl);
    EXPECT_EQ(base::toText(report),
              "part.cls:5: warning: cuts with the spindle off: there is no SPINDL before it. Give "
              "the speed with --spindle-rpm. [post.spindle-off]\n");
    report = base::Diagnostics();
    PostOptions with_spindle;
    with_spindle.spindle_rpm = 5000.0;
    EXPECT_NE(plan(cl, with_spindle).find("spindle cw 5000.000 rpm\n"), std::string::npos);
    EXPECT_TRUE(report.empty()) << base::toText(report);
    PostOptions strict;
    strict.strict = true;
    plan(cl, strict);
    EXPECT_TRUE(report.hasErrors());
}

TEST_F(Planner, FeedMoveWithoutFeedIsAnError) {
    plan("TOOL PATH/OP1,TOOL,T\nTLDATA/MILL,6.0,3.0,50.0,0.0,0.0\nUNITS/MM\nSPINDL/RPM,100,CLW\n"
         "GOTO/0.0,0.0,0.0,0.0,0.0,1.0\n");
    EXPECT_EQ(base::toText(report),
              "part.cls:5: error: a cutting move without a feed rate: there is no FEDRAT before it [post.no-feed]\n");
}

TEST_F(Planner, SpindleAboveItsLimit) {
    plan(std::string(head) + "SPINDL/RPM,15000,CLW\nFEDRAT/MMPM,100.0\nGOTO/0.0,0.0,0.0,0.0,0.0,1.0\n");
    EXPECT_EQ(base::toText(report), "part.cls:4: error: S15000 is above the spindle's limit of 12000 rev/min "
                                    "[post.spindle-limit]\n");
    EXPECT_EQ(summary.limit_violations, 1U);
}

TEST_F(Planner, SurfaceSpeedNeedsTheCutter) {
    // 100 m/min on 6 mm: 100000 / (π·6) = 5305.165 rev/min.
    const std::string cut = "FEDRAT/MMPM,100.0\nGOTO/0.0,0.0,0.0,0.0,0.0,1.0\n";
    EXPECT_NE(plan(std::string(head) + "SPINDL/SMM,100,CLW\n" + cut).find("spindle cw 5305.165 rpm"),
              std::string::npos);
}

TEST_F(Planner, ArcsAndHoles) {
    const std::string text = plan("UNITS/MM\nCUTTER/6,0,3,0,0,0,50\nLOADTL/4\nSPINDL/500,RPM,CLW\n"
                                  "RAPID\nGOTO/10,0,20\nFEDRAT/600,MMPM\nGOTO/10,0,0\n"
                                  "CIRCLE/0,0,0,0,0,1,10\nGOTO/0,10,0\n"
                                  "RAPID\nGOTO/0,10,20\n"
                                  "CYCLE/DRILL,15,MMPM,300,2\nGOTO/5,5,1\nGOTO/6,5,1\nGOTO/6,5,0\nCYCLE/OFF\n"
                                  "RAPID\nGOTO/0,0,50\nFINI\n");
    ASSERT_FALSE(report.hasErrors()) << base::toText(report);
    const auto body = text.find("approach");
    EXPECT_EQ(text.substr(body, text.find("tip-programming off", body) - body),
              "approach rapid X10.0000 Y0.0000 Z20.0000 C0.0000 A0.0000\n"
              "move feed X10.0000 Y0.0000 Z0.0000 C0.0000 A0.0000 600.000 mm/min\n"
              "arc ccw X0.0000 Y10.0000 Z0.0000 I-10.0000 J0.0000 C0.0000 A0.0000 600.000 mm/min\n"
              "move rapid X0.0000 Y10.0000 Z20.0000 C0.0000 A0.0000\n"
              "hole-cycle drill retract Z3.0000 surface Z1.0000 clearance 2.0000 depth 15.0000 dwell 0.000 peck 0.0000 "
              "0.0000 pitch 0.0000 300.000 mm/min\n"
              "hole X5.0000 Y5.0000 C0.0000 A0.0000\n"
              "hole X6.0000 Y5.0000 C0.0000 A0.0000\n"
              "hole-cycle drill retract Z2.0000 surface Z0.0000 clearance 2.0000 depth 15.0000 dwell 0.000 peck 0.0000 "
              "0.0000 pitch 0.0000 300.000 mm/min\n"
              "hole X6.0000 Y5.0000 C0.0000 A0.0000\n"
              "hole-cycle off\n"
              "move rapid X0.0000 Y0.0000 Z50.0000 C0.0000 A0.0000\n");
}

TEST_F(Planner, AHoleReachedFromBelowItsRetractPlaneIsReachedFromAbove) {
    const std::string start = "UNITS/MM\nCUTTER/6,0,3,0,0,0,50\nLOADTL/4\nSPINDL/500,RPM,CLW\nRAPID\nGOTO/0,0,2\n"
                              "CYCLE/DRILL,15,MMPM,300,2\nGOTO/5,5,1\n";
    const auto holes = [&](const std::string& rest) {
        const std::string text = plan(start + rest + "FINI\n");
        EXPECT_TRUE(report.empty()) << base::toText(report);
        const auto body = text.find("approach");
        return text.substr(body, text.find("hole-cycle off\ntip-programming off", body) - body);
    };
    const std::string cycle_1 =
        "hole-cycle drill retract Z3.0000 surface Z1.0000 clearance 2.0000 depth 15.0000 dwell 0.000 peck 0.0000 0.0000 "
        "pitch 0.0000 300.000 mm/min\n";
    const std::string first = "approach rapid X0.0000 Y0.0000 Z2.0000 C0.0000 A0.0000\n"
                              "move rapid X0.0000 Y0.0000 Z3.0000 C0.0000 A0.0000\n" +
                              cycle_1 + "hole X5.0000 Y5.0000 C0.0000 A0.0000\n";
    const auto cycleAt = [](const char* retract, const char* surface) {
        return fmt::format("hole-cycle drill retract Z{} surface Z{} clearance 2.0000 depth 15.0000 dwell 0.000 peck "
                           "0.0000 0.0000 pitch 0.0000 300.000 mm/min\n",
                           retract, surface);
    };
    EXPECT_EQ(holes("GOTO/9,8,11\nCYCLE/OFF\n"),
              first + "hole-cycle off\nmove rapid X5.0000 Y5.0000 Z13.0000 C0.0000 A0.0000\n" +
                  cycleAt("13.0000", "11.0000") + "hole X9.0000 Y8.0000 C0.0000 A0.0000\n");
    // Down to a lower one, or straight up, needs no move of its own.
    EXPECT_EQ(holes("GOTO/9,8,0\nCYCLE/OFF\n"),
              first + cycleAt("2.0000", "0.0000") + "hole X9.0000 Y8.0000 C0.0000 A0.0000\n");
    EXPECT_EQ(holes("GOTO/5,5,11\nCYCLE/OFF\n"),
              first + cycleAt("13.0000", "11.0000") + "hole X5.0000 Y5.0000 C0.0000 A0.0000\n");
}

TEST_F(Planner, FromALeaningToolTheHoleIsReachedAlongItsAxisOrByWayOfHome) {
    const auto above = [&](const char* axis) {
        const std::string text = plan(std::string("UNITS/MM\nCUTTER/6,0,3,0,0,0,50\nLOADTL/4\nSPINDL/500,RPM,CLW\n"
                                                  "MULTAX\nFEDRAT/600,MMPM\nGOTO/0,0,0,") +
                                      axis + "\nCYCLE/DRILL,15,MMPM,300,2\nGOTO/5,5,1,0,0,1\nCYCLE/OFF\nFINI\n");
        EXPECT_TRUE(report.empty()) << base::toText(report);
        const auto body = text.find('\n', text.find("approach")) + 1;
        return text.substr(body, text.find("hole-cycle drill", body) - body);
    };
    // 3 mm up are 3.75 mm along (0, −0.6, 0.8).
    const std::string leaning = above("0,-0.6,0.8");
    EXPECT_TRUE(leaning.starts_with("move rapid X0.0000 Y-2.2500 Z3.0000 C0.0000 A36.8699\n")) << leaning;
    EXPECT_TRUE(leaning.ends_with("move rapid X5.0000 Y5.0000 Z3.0000 C0.0000 A0.0000\n")) << leaning;
    const std::string flat = above("0,-0.98,0.1989975");
    EXPECT_TRUE(flat.starts_with("tip-programming off\n")) << flat;
    EXPECT_TRUE(flat.ends_with("approach rapid X5.0000 Y5.0000 Z3.0000 C0.0000 A0.0000\n")) << flat;
}

TEST_F(Planner, AxisBeyondItsLimitNamesLineValueAndLimit) {
    plan(std::string(head) + "SPINDL/RPM,100,CLW\nFEDRAT/MMPM,100.0\n"
                             "GOTO/0.0,0.0,0.0,0.0,0.0,1.0\n"
                             "GOTO/1.0,0.0,0.0,0.0,0.9848077530122080,-0.1736481776669303\n");
    ASSERT_TRUE(report.hasErrors());
    EXPECT_EQ(report.front().code, "kinematics.axis-limit");
    EXPECT_EQ(report.front().where.line, 7U);
    EXPECT_NE(report.front().message.find("100"), std::string::npos) << report.front().message;
    EXPECT_NE(report.front().message.find("95"), std::string::npos) << report.front().message;
    EXPECT_EQ(summary.limit_violations, 1U);
}

TEST(ProgramName, MadeFromTheFile) {
    EXPECT_EQ(programNameFromFile("/tmp/nx part-7.cls"), "NX_PART_7");
    EXPECT_EQ(programNameFromFile("a_name_that_is_much_too_long_for_a_control.mpf"), "A_NAME_THAT_IS_MUCH_TOO_");
    EXPECT_EQ(programNameFromFile("-"), "PROGRAM");
}

/// Cuts with the head at 30° that turn C from `first_deg` on by 40° a point.
std::string turningCuts(double first_deg, int points) {
    std::string text = "FEDRAT/MMPM,1200.0\n";
    for (int i = 0; i < points; ++i) {
        const double c = base::radFromDeg(first_deg + 40.0 * i);
        text += fmt::format("GOTO/{:.4f},0.0,0.0,{:.7f},{:.7f},0.8660254\n", 10.0 * i, 0.5 * std::sin(c),
                            -0.5 * std::cos(c));
    }
    return text;
}
/// Turns C further than the ±200° of the head.
std::string spiral() {
    return "SPINDL/RPM,8000,CLW\nRAPID\nGOTO/0.0,0.0,50.0,0.0,-0.5,0.8660254\n" + turningCuts(0.0, 13);
}

TEST_F(Planner, WhereLimitsForceItTheToolLeavesThePartAndUnwinds) {
    PostOptions options;
    options.engage_feed_mm_per_s = 5.0;
    // Wide enough that no block has to be put in.
    options.orientation_tolerance_rad = base::radFromDeg(10.0);
    file.machine.rotary.at("A").min_rad = base::radFromDeg(5.0);
    file.machine.rotary.at("A").home_rad = base::radFromDeg(5.0);
    const std::string text = plan(head + spiral(), options);
    EXPECT_FALSE(report.hasErrors()) << base::toText(report);
    EXPECT_EQ(summary.excursions, 1U);
    EXPECT_EQ(summary.limit_violations, 0U);
    const auto begin = text.find("comment off the part");
    ASSERT_NE(begin, std::string::npos) << text;
    const auto end = text.find("move", text.find("comment back on the path"));
    // C goes from 0° to 160°, where −200° is the same; 50 mm along the axis (sin 160° / 2, −cos 160° / 2, cos 30°).
    EXPECT_EQ(text.substr(begin, end - begin),
              "comment off the part: the rotary axes unwind\n"
              "move feed X48.5505 Y23.4923 Z43.3013 C160.0000 A30.0000 5000.000 mm/min\n"
              "move rapid X48.5505 Y23.4923 Z43.3013 C-200.0000 A30.0000\n"
              "move feed X40.0000 Y0.0000 Z0.0000 C-200.0000 A30.0000 300.000 mm/min\n"
              "comment back on the path\n");
}

TEST_F(Planner, ARewindIsRefusedWhenAsked) {
    PostOptions options;
    options.at_limit = PostOptions::AtLimit::Refuse;
    file.machine.rotary.at("A").min_rad = base::radFromDeg(5.0);
    file.machine.rotary.at("A").home_rad = base::radFromDeg(5.0);
    plan(head + spiral(), options);
    EXPECT_EQ(summary.excursions, 0U);
    EXPECT_EQ(summary.limit_violations, 1U);
    ASSERT_TRUE(report.hasErrors());
    EXPECT_EQ(report.front().code, "kinematics.rewind") << base::toText(report);
}

TEST_F(Planner, AFirstCutFromHomeIsNoRewind) {
    // Together the operations turn C through 480°, each through 160°; between them the axes turn at home height.
    file.machine.rotary.at("A").min_rad = base::radFromDeg(5.0);
    file.machine.rotary.at("A").home_rad = base::radFromDeg(5.0);
    PostOptions options;
    options.at_limit = PostOptions::AtLimit::Refuse;
    std::string text = head;
    for (int i = 0; i < 3; ++i)
        text += fmt::format("TOOL PATH/OP{0},TOOL,BALL_{0}\nTLDATA/MILL,8.0,4.0,50.0,0.0,0.0\n", i) +
                "SPINDL/RPM,8000,CLW\n" + turningCuts(160.0 * i, 5) + "END-OF-PATH\n";
    plan(text, options);
    EXPECT_FALSE(report.hasErrors()) << base::toText(report);
}

}  // namespace
}  // namespace cusp::post
