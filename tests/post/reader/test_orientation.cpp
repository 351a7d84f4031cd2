// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Tool axes worked out by hand for each kind of machine, and the way between block ends.
#include "nc_recorder.hpp"

#include <cusp/base/units.hpp>
#include <cusp/post/reader/move_sampler.hpp>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace cusp::post::reader::test {
namespace {

constexpr double half_root_3 = 0.86602540378443865;
constexpr double half_root_2 = 0.70710678118654752;

struct Case {
    const char* machine;
    const char* rotary;
    Vector3 axis;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.machine << " at " << c.rotary; }

class PoseByHand : public testing::TestWithParam<Case> {};

TEST_P(PoseByHand, UnderTraori) {
    const Case& c = GetParam();
    const Recording out =
        run(fmt::format("TRAORI\nG54\nG0 X10 Y20 Z30 {}\nM30\n", c.rotary), shippedMachine(c.machine));
    ASSERT_EQ(out.problems, "");
    ASSERT_EQ(out.motions.size(), 1U);
    const auto& pose = out.motions[0].motion.end_pose;
    ASSERT_TRUE(pose);
    EXPECT_NEAR(norm(pose->axis - c.axis), 0.0, 1e-14);
    EXPECT_EQ(norm(pose->tip_mm - Vector3{10, 20, 30}), 0.0);
}

// Heads: u = (sin C sin A, −cos C sin A, cos A). Nutating 45° head with C table: t = Rz(−C)·((1−cos B)/2, sin B/√2,
// (1+cos B)/2). Dual table B/C: t = Rz(C)·Ry(B)·ez.
INSTANTIATE_TEST_SUITE_P(Machines, PoseByHand,
                         testing::Values(Case{"head-c200-a95", "A0 C0", {0, 0, 1}},
                                         Case{"head-c200-a95", "A30 C0", {0, -0.5, half_root_3}},
                                         Case{"head-c200-a95", "A30 C90", {0.5, 0, half_root_3}},
                                         Case{"head-c200-a95", "A-30 C90", {-0.5, 0, half_root_3}},
                                         Case{"fooke-endura-ca", "A90 C180", {0, 1, 0}},
                                         Case{"trunnion-ac", "A60 C0", {0, -half_root_3, 0.5}},
                                         Case{"trunnion-ac", "A60 C90", {half_root_3, 0, 0.5}},
                                         Case{"nutating-45", "B90 C0", {0.5, half_root_2, 0.5}},
                                         Case{"nutating-45", "B90 C90", {half_root_2, -0.5, 0.5}},
                                         Case{"nutating-45", "B180 C0", {1, 0, 0}},
                                         Case{"haas-umc-bc", "B30 C0", {0.5, 0, half_root_3}},
                                         Case{"haas-umc-bc", "B30 C90", {0, 0.5, half_root_3}}));

/// A planar cut of a real program, on a plane through three of its points: the tool is perpendicular to it
/// (facts of the C/A head with A −70.529, C 45).
TEST(Orientation, RealPlanarCutOfTheCAHead) {
    const ForwardChain chain(shippedMachine("head-c200-a95").machine);
    RotaryValues values{};
    ASSERT_EQ(chain.rotaryName(0), "C");
    values[0] = base::radFromDeg(45.0);
    values[1] = base::radFromDeg(-70.529);
    // cos 70.529° is 1/3 within the printed digits, so u = (−2/3, 2/3, 1/3).
    EXPECT_NEAR(norm(chain.toolAxis(values) - Vector3{-2.0 / 3.0, 2.0 / 3.0, 1.0 / 3.0}), 0.0, 1e-5);
}

TEST(Orientation, VectorsOfAnyLengthAndMissingComponents) {
    const Recording out = runLines("TRAORI\nG0 X0 Y0 Z0 A3=0 B3=-2 C3=2\nX1 A3=5");
    ASSERT_EQ(out.problems, "");
    EXPECT_NEAR(norm(out.motions[0].motion.end_pose->axis - Vector3{0, -half_root_2, half_root_2}), 0.0, 1e-15);
    EXPECT_NEAR(norm(out.motions[1].motion.end_pose->axis - Vector3{1, 0, 0}), 0.0, 1e-15);
    EXPECT_TRUE(out.motions[0].motion.vector_programmed);
    EXPECT_FALSE(out.motions[0].motion.end.rotary_rad[0]);
}

TEST(Orientation, AnglesInBothConventions) {
    // RPY 90, 90 about X and Z: Z goes to −Y, and then to X. Euler 90, 90: about Z, then about the new X, which is Y: Z to X.
    const Recording out = runLines("TRAORI\nORIRPY G0 X0 Y0 Z0 A2=90 C2=90\nA2=30\nORIEULER A2=90 B2=90 C2=17");
    ASSERT_EQ(out.problems, "");
    EXPECT_NEAR(norm(out.motions[0].motion.end_pose->axis - Vector3{1, 0, 0}), 0.0, 1e-15);
    EXPECT_NEAR(norm(out.motions[1].motion.end_pose->axis - Vector3{0, -0.5, std::sqrt(0.75)}), 0.0, 1e-15);
    EXPECT_NEAR(norm(out.motions[2].motion.end_pose->axis - Vector3{1, 0, 0}), 0.0, 1e-15);
    EXPECT_TRUE(out.motions[2].motion.vector_programmed);
}

TEST(Orientation, Md21104DecidesWhichWordActs) {
    MachineFile machine = shippedMachine("head-c200-a95");
    const std::string program = "TRAORI\nORIAXES ORIWKS\nG0 X0 Y0 Z0 A0 C0\nORIVECT ORIMKS\nX1\nM30\n";
    const auto paths = [&](bool md21104) {
        machine.control.md21104_ori_ipo_with_g_code = md21104;
        const Recording out = run(program, machine);
        EXPECT_EQ(out.problems, "");
        return std::pair(out.motions[0].motion.orientation_path, out.motions[1].motion.orientation_path);
    };
    EXPECT_EQ(paths(true), std::pair(OrientationPath::RotaryLinear, OrientationPath::GreatCircle));
    EXPECT_EQ(paths(false), std::pair(OrientationPath::GreatCircle, OrientationPath::RotaryLinear));
}

TEST(Orientation, BetweenEndsRotaryAxesRunLinearlyOrTheAxisOnTheGreatCircle) {
    const ForwardChain chain(shippedMachine("head-c200-a95").machine);
    const Recording linear = runLines("TRAORI\nORIAXES\nG0 X0 Y0 Z0 A90 C0\nX10 C90");
    const Recording circle = runLines("TRAORI\nORIVECT\nG0 X0 Y0 Z0 A30 C0\nX10 C180");
    ASSERT_EQ(linear.problems + circle.problems, "");
    const ToolPose half_linear = poseAt(linear.motions[1].motion, chain, 0.5);
    EXPECT_NEAR(norm(half_linear.axis - Vector3{half_root_2, -half_root_2, 0}), 0.0, 1e-14);
    EXPECT_NEAR(norm(half_linear.tip_mm - Vector3{5, 0, 0}), 0.0, 1e-14);
    // From 30° on one side to 30° on the other, the great circle passes the pole, which A = 30° never does.
    EXPECT_NEAR(norm(poseAt(circle.motions[1].motion, chain, 0.5).axis - Vector3{0, 0, 1}), 0.0, 1e-14);
    EXPECT_NEAR(rotaryTravel(circle.motions[1].motion), base::radFromDeg(180.0), 1e-14);
}

TEST(Orientation, WithoutTraoriThePoseIsKnownOnlyWithRotaryAxesAtZero) {
    const Recording out = runLines("G54 G0 X1 Y2 Z3\nSUPA A0 C0\nX1 Y2 Z3\nA10\nX2");
    ASSERT_EQ(out.problems, "");
    EXPECT_FALSE(out.motions[0].motion.end_pose) << "rotary axes not yet known";
    EXPECT_TRUE(out.motions[1].motion.machine_coordinates);
    ASSERT_TRUE(out.motions[2].motion.end_pose);
    EXPECT_EQ(out.motions[2].motion.end_pose->axis.z, 1.0);
    EXPECT_FALSE(out.motions[4].motion.end_pose) << "pivot and tool length come in";
}

TEST(Orientation, EndlessAxisTakesTheShortestWayUnderDc) {
    const Recording out = run("TRAORI\nG0 X0 Y0 Z0 A0 C350\nC=DC(10)\nM30\n", shippedMachine("trunnion-ac"));
    ASSERT_EQ(out.problems, "");
    EXPECT_NEAR(*out.motions[1].motion.end.rotary_rad[0], base::radFromDeg(370.0), 1e-12);
}

}  // namespace
}  // namespace cusp::post::reader::test
