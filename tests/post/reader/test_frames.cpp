// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// TRANS, ROT, CYCLE800 and machine coordinates without TRAORI, each held against poses from closed forms.
#include "nc_recorder.hpp"

#include <cusp/base/units.hpp>
#include <cusp/post/reader/move_sampler.hpp>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace cusp::post::reader::test {
namespace {

struct FrameCase {
    const char* name;
    const char* lines;
    Vector3 tip;
};

void PrintTo(const FrameCase& c, std::ostream* out) { *out << c.name; }

class Frames : public testing::TestWithParam<FrameCase> {};

TEST_P(Frames, LastTip) {
    const Recording out =
        run(fmt::format("G54 G0 X0 Y0 Z0\n{}\nM30\n", GetParam().lines), shippedMachine("three-axis"));
    ASSERT_EQ(out.problems, "");
    ASSERT_TRUE(out.motions.back().motion.end_pose);
    EXPECT_NEAR(norm(out.motions.back().motion.end_pose->tip_mm - GetParam().tip), 0.0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(
    Programmable, Frames,
    testing::Values(FrameCase{"trans", "TRANS X10 Y20 Z30\nX1 Y2 Z3", {11, 22, 33}},
                    FrameCase{"trans replaces", "TRANS X10\nTRANS Y5\nX1 Y0 Z0", {1, 5, 0}},
                    FrameCase{"atrans adds", "TRANS X10\nATRANS X1 Y5\nX0 Y0 Z0", {11, 5, 0}},
                    FrameCase{"trans off", "TRANS X10\nTRANS\nX1 Y2 Z3", {1, 2, 3}},
                    FrameCase{"what is not programmed stays", "X5 Y6 Z7\nTRANS X10 Y20\nX0", {10, 6, 7}},
                    FrameCase{"rot about Z", "ROT Z90\nX10 Y1 Z2", {-1, 10, 2}},
                    FrameCase{"rot about X", "ROT X90\nX1 Y10 Z2", {1, -2, 10}},
                    // Rz(90)·Ry(90)·Rx(0)·ex = Rz(90)·(0, 0, −1)
                    FrameCase{"rot about Z, then the new Y", "ROT Y90 Z90\nX10 Y0 Z0", {0, 0, -10}},
                    // Rz(90)·Rx(90)·ey = Rz(90)·ez, where Rx(90)·Rz(90)·ey would be −ex
                    FrameCase{"rot about Z, then the new X", "ROT X90 Z90\nX0 Y10 Z0", {0, 0, 10}},
                    FrameCase{"trans, arot", "TRANS X10\nAROT Z90\nX5 Y0 Z0", {10, 5, 0}},
                    FrameCase{"rot, atrans", "ROT Z90\nATRANS X10\nX5 Y0 Z0", {0, 15, 0}},
                    FrameCase{"rot replaces trans", "TRANS X10\nROT Z90\nX5 Y0 Z0", {0, 5, 0}},
                    FrameCase{"in the plane", "G18\nROT RPL=90\nX10 Y0 Z0", {0, 0, -10}},
                    FrameCase{"an arc", "TRANS X10\nAROT Z90\nX5 Y0 Z0\nG3 X0 Y5 I-5 F100", {5, 0, 0}}));

TEST(Frames, AnArcTurnsWithItsFrame) {
    const MachineFile machine = shippedMachine("three-axis");
    const Recording out = run("G54 G0 X0 Y0 Z0\nROT X90\nG0 X10 Y0 Z0\nG3 X-10 I-10 F100\nM30\n", machine);
    ASSERT_EQ(out.problems, "");
    const ToolPose half = poseAt(out.motions.back().motion, ForwardChain(machine.machine), 0.5);
    EXPECT_NEAR(norm(half.tip_mm - Vector3{0, 0, 10}), 0.0, 1e-12);
}

TEST(Frames, VectorsTurnRotaryAxesDoNot) {
    const Recording vectors = runLines("TRAORI\nG54\nROT Z90\nG0 X0 Y0 Z0 A3=1 C3=1");
    ASSERT_EQ(vectors.problems, "");
    EXPECT_NEAR(norm(vectors.motions[0].motion.end_pose->axis - Vector3{0, std::sqrt(0.5), std::sqrt(0.5)}), 0, 1e-12);
    const Recording rotary = runLines("TRAORI\nG54\nROT Z90\nG0 X0 Y0 Z0 A45 C0");
    EXPECT_EQ(
        rotary.problems,
        "4: warning: rotary axes are programmed while a frame is turned; they are read as axis positions, which the "
        "frame does not turn [nc.turned-frame]\n");
    EXPECT_NEAR(norm(rotary.motions[0].motion.end_pose->axis - Vector3{0, -std::sqrt(0.5), std::sqrt(0.5)}), 0, 1e-12);
}

struct SwivelCase {
    const char* name;
    const char* call;
    Vector3 tip;  ///< of X1 Y2 Z3
    Vector3 axis;
};

void PrintTo(const SwivelCase& c, std::ostream* out) { *out << c.name; }

class Swivelled : public testing::TestWithParam<SwivelCase> {};

TEST_P(Swivelled, PoseInThePlane) {
    const Recording out = runLines(fmt::format("G54\n{}\nG0 X1 Y2 Z3", GetParam().call));
    ASSERT_EQ(out.problems, "");
    const auto& pose = out.motions.back().motion.end_pose;
    ASSERT_TRUE(pose);
    EXPECT_NEAR(norm(pose->tip_mm - GetParam().tip), 0.0, 1e-6);
    EXPECT_NEAR(norm(pose->axis - GetParam().axis), 0.0, 1e-6);
}

// Turned by 90° and 0° only, so that the columns of the frame can be read off; and the plane of a real program.
const double third = std::sqrt(1.0 / 3.0);
INSTANTIATE_TEST_SUITE_P(
    Planes, Swivelled,
    testing::Values(
        SwivelCase{"X 90", "CYCLE800(1,\"TC\",0,57,0,0,0,90,0,0,0,0,0,-1)", {1, -3, 2}, {0, -1, 0}},
        SwivelCase{"reference before, zero after",
                   "CYCLE800(1,\"TC\",0,57,10,20,30,90,0,0,0,0,5,-1)",
                   {11, 12, 32},
                   {0, -1, 0}},
        SwivelCase{"57 is X, Y, Z", "CYCLE800(1,\"TC\",0,57,0,0,0,90,90,0,0,0,0,-1)", {3, 1, 2}, {1, 0, 0}},
        SwivelCase{"27 is Z, Y, X", "CYCLE800(1,\"TC\",0,27,0,0,0,90,90,0,0,0,0,-1)", {-2, 3, -1}, {0, 1, 0}},
        SwivelCase{"39 is Z, X, Y", "CYCLE800(1,\"TC\",0,39,0,0,0,90,90,0,0,0,0,-1)", {3, 1, 2}, {1, 0, 0}},
        SwivelCase{"additive",
                   "CYCLE800(1,\"TC\",0,57,0,0,0,90,0,0,0,0,0,-1)\nCYCLE800(1,\"TC\",1,57,0,0,0,90,0,0,0,0,0,-1)",
                   {1, -2, -3},
                   {0, 0, -1}}));

TEST(Swivelled, ThePlaneOfARealProgram) {
    const Recording out = runLines("G54\nCYCLE800(1,\"TC\",0,57,0,0,0,45,35.2644,150,0,0,0,-1)\nG0 X0 Y0 Z1");
    ASSERT_EQ(out.problems, "");
    const auto& pose = out.motions.back().motion.end_pose;
    ASSERT_TRUE(pose);
    EXPECT_NEAR(norm(pose->axis - Vector3{third, -third, third}), 0.0, 1e-6);
    EXPECT_NEAR(norm(pose->tip_mm - pose->axis), 0.0, 1e-12);
}

TEST(Swivelled, ClearedAndLost) {
    const Recording cleared =
        runLines("G54\nCYCLE800(1,\"TC\",0,57,0,0,0,90,0,0,0,0,0,-1)\nCYCLE800()\nG0 A0 C0\nX1 Y2 Z3");
    ASSERT_EQ(cleared.problems, "");
    EXPECT_EQ(norm(cleared.motions.back().motion.end_pose->tip_mm - Vector3{1, 2, 3}), 0.0);
    // Still tilted, no plane, no TRAORI: the tip is not in the program.
    const Recording lost = runLines("G54\nCYCLE800(1,\"TC\",0,57,0,0,0,90,0,0,0,0,0,-1)\nCYCLE800()\nG0 X1 Y2 Z3");
    ASSERT_EQ(lost.problems, "");
    EXPECT_FALSE(lost.motions.back().motion.end_pose);
}

ReaderOptions withLength(double tool_length_mm) {
    ReaderOptions options;
    options.setup.tool_length_mm = tool_length_mm;
    return options;
}

TEST(MachineCoordinates, AHeadByItsPivotLength) {
    // M = P + (Lp + Lt)(u − ez), from the pivot of the machine file and a tool of 130 mm.
    const MachineFile machine = shippedMachine("head-c200-a95");
    const double length = -machine.machine.spindle.gauge_point_mm[2] + 130.0;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> c_deg(-200, 200);
    std::uniform_real_distribution<double> a_deg(-95, 95);
    for (int i = 0; i < 200; ++i) {
        const double c = c_deg(random);
        const double a = a_deg(random);
        const double cr = base::radFromDeg(c);
        const double ar = base::radFromDeg(a);
        const Vector3 axis{std::sin(cr) * std::sin(ar), -std::cos(cr) * std::sin(ar), std::cos(ar)};
        const Vector3 tip{10.0 + i, 20.0, -5.0};
        const Vector3 m = tip + length * (axis - Vector3{0, 0, 1});
        const Recording out =
            run(fmt::format("G54\nG0 X{:.9f} Y{:.9f} Z{:.9f} A{:.9f} C{:.9f}\nM30\n", m.x, m.y, m.z, a, c), machine,
                withLength(130.0));
        ASSERT_EQ(out.problems, "");
        ASSERT_TRUE(out.motions[0].motion.end_pose);
        EXPECT_NEAR(norm(out.motions[0].motion.end_pose->tip_mm - tip), 0.0, 1e-6);
        EXPECT_NEAR(norm(out.motions[0].motion.end_pose->axis - axis), 0.0, 1e-9);
    }
}

TEST(MachineCoordinates, ATrunnionNeedsItsOrigin) {
    const MachineFile machine = shippedMachine("trunnion-ac");
    const std::string program = "G54\nG0 X10 Y20 Z30 A0 C90\nM30\n";
    ReaderOptions options = withLength(100.0);
    EXPECT_FALSE(run(program, machine, options).motions[0].motion.end_pose);
    options.setup.wcs_origin_mm = {5.0, 0.0, 0.0};
    const Recording out = run(program, machine, options);
    // The table turns about machine zero, and the tip, at (15, 20, 30) there, by +90° with respect to the workpiece.
    ASSERT_TRUE(out.motions[0].motion.end_pose);
    EXPECT_NEAR(norm(out.motions[0].motion.end_pose->tip_mm - Vector3{-25, 15, 30}), 0.0, 1e-9);
}

TEST(MachineCoordinates, BetweenEndsTheTipLeavesItsLine) {
    // The chord error of joint-linear motion: L·Δ²/8 (400 mm, 1°: 0.015 mm).
    const MachineFile machine = shippedMachine("head-c200-a95");
    const double tool_mm = 400.0 + machine.machine.spindle.gauge_point_mm[2];
    const double y = 400.0 * std::sin(base::radFromDeg(1.0));
    const double z = 400.0 * (std::cos(base::radFromDeg(1.0)) - 1.0);
    const Recording out = run(fmt::format("G54 F100\nG1 X0 Y0 Z0 A0 C0\nG1 X0 Y{:.9f} Z{:.9f} A1 C0\nM30\n", -y, z),
                              machine, withLength(tool_mm));
    ASSERT_EQ(out.problems, "");
    const ExecutedMotion& motion = out.motions.back().motion;
    EXPECT_TRUE(motion.joint_linear);
    const ForwardChain chain(machine.machine);
    EXPECT_NEAR(norm(poseAt(motion, chain, 1.0).tip_mm), 0.0, 1e-7);
    EXPECT_NEAR(norm(poseAt(motion, chain, 0.5).tip_mm), 0.01523, 1e-4);
}

TEST(Reaches, AgreesWithASearchOverBothAxes) {
    std::mt19937 random(11);
    for (const char* name : {"head-c200-a95", "trunnion-ac", "nutating-45", "haas-umc-bc", "fooke-endura-ca"}) {
        const MachineFile machine = shippedMachine(name);
        const ForwardChain chain(machine.machine);
        std::normal_distribution<double> normal;
        int reached = 0;
        for (int i = 0; i < 300; ++i) {
            Vector3 axis{normal(random), normal(random), normal(random)};
            axis = (1.0 / norm(axis)) * axis;
            // The nearest direction on a grid of 2° within the limits, all turns of an endless axis.
            double nearest = 10.0;
            const auto range = [&](std::size_t joint) {
                const auto& limits = chain.rotaryAxis(joint);
                return std::pair{base::degFromRad(limits.min_rad.value_or(-3.2)),
                                 base::degFromRad(limits.max_rad.value_or(3.2))};
            };
            for (double p = range(0).first; p <= range(0).second; p += 2.0)
                for (double q = range(1).first; q <= range(1).second; q += 2.0)
                    nearest = std::min(nearest,
                                       angleBetween(axis, chain.toolAxis({base::radFromDeg(p), base::radFromDeg(q)})));
            const auto answer = chain.reaches(axis);
            ASSERT_TRUE(answer) << name;
            reached += *answer ? 1 : 0;
            if (*answer)
                EXPECT_LT(nearest, base::radFromDeg(4.0)) << name << ' ' << i;
            else
                EXPECT_GT(nearest, 1e-6) << name << ' ' << i;
        }
        EXPECT_GT(reached, 50) << name;
    }
}

}  // namespace
}  // namespace cusp::post::reader::test
