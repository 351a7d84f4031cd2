// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// G2 and G3: centre or radius, planes, helices, full circles; points on the way worked out by hand.
#include "nc_recorder.hpp"

#include <cusp/post/reader/move_sampler.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cusp::post::reader::test {
namespace {

constexpr double pi = std::numbers::pi;

struct ArcCase {
    const char* name;
    const char* block;
    double sweep_rad;
    Vector3 half_way;
};

void PrintTo(const ArcCase& c, std::ostream* out) { *out << c.name; }

class ArcByHand : public testing::TestWithParam<ArcCase> {};

TEST_P(ArcByHand, FromTenZeroZero) {
    const MachineFile machine = shippedMachine("three-axis");
    const ForwardChain chain(machine.machine);
    const Recording out = run("G54 G0 X10 Y0 Z0\nF100\n" + std::string(GetParam().block) + "\nM30\n", machine);
    ASSERT_EQ(out.problems, "");
    const ExecutedMotion& motion = out.motions.back().motion;
    ASSERT_TRUE(motion.arc);
    EXPECT_NEAR(motion.arc->sweep_rad, GetParam().sweep_rad, 1e-12);
    EXPECT_NEAR(norm(poseAt(motion, chain, 0.5).tip_mm - GetParam().half_way), 0.0, 1e-12);
    EXPECT_NEAR(norm(poseAt(motion, chain, 1.0).tip_mm - motion.end_pose->tip_mm), 0.0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(
    Arcs, ArcByHand,
    testing::Values(ArcCase{"half turn", "G3 X-10 I-10", pi, {0, 10, 0}},
                    ArcCase{"clockwise", "G2 X-10 I-10", -pi, {0, -10, 0}},
                    ArcCase{"absolute centre", "G3 X-10 I=AC(0) J=AC(0)", pi, {0, 10, 0}},
                    ArcCase{"by radius", "G3 X0 Y10 CR=10", pi / 2, {10 * std::sqrt(0.5), 10 * std::sqrt(0.5), 0}},
                    ArcCase{"by radius, the long way",
                            "G3 X0 Y10 CR=-10",
                            1.5 * pi,
                            {10 + 10 * std::sqrt(0.5), 10 + 10 * std::sqrt(0.5), 0}},
                    ArcCase{"by radius, clockwise",
                            "G2 X0 Y10 CR=10",
                            -pi / 2,
                            {10 - 10 * std::sqrt(0.5), 10 - 10 * std::sqrt(0.5), 0}},
                    ArcCase{"full circle", "G3 I-10", 2 * pi, {-10, 0, 0}},
                    ArcCase{"helix", "G3 X-10 Z4 I-10", pi, {0, 10, 2}},
                    ArcCase{"helix with a turn more", "G3 X-10 Z4 I-10 TURN=1", 3 * pi, {0, -10, 2}},
                    ArcCase{"by angle and end", "G3 X-10 AR=180", pi, {0, 10, 0}},
                    ArcCase{"by angle and end, clockwise",
                            "G2 X0 Y10 AR=90",
                            -pi / 2,
                            {10 - 10 * std::sqrt(0.5), 10 - 10 * std::sqrt(0.5), 0}},
                    ArcCase{"by angle and end, the long way",
                            "G3 X0 Y10 AR=270",
                            1.5 * pi,
                            {10 + 10 * std::sqrt(0.5), 10 + 10 * std::sqrt(0.5), 0}},
                    ArcCase{"by angle and centre", "G2 I-10 AR=180 Z4", -pi, {0, -10, 2}},
                    ArcCase{"through a point", "CIP X-10 I1=0 J1=10", pi, {0, 10, 0}},
                    ArcCase{"through a point, in a plane of its own", "CIP X-10 I1=0 K1=10", pi, {0, 0, 10}},
                    ArcCase{"through a point, by distances", "G91 CIP X-20 I1=-10 J1=-10", pi, {0, -10, 0}},
                    ArcCase{"G18: from Z to X is positive", "G18 G3 X-10 I-10", pi, {0, 0, -10}}));

TEST(Arcs, ARealArcOfLargeRadiusIsAccepted) {
    // Of a real program: end point and centre are rounded to a micrometre.
    const MachineFile machine = shippedMachine("three-axis");
    const Recording out =
        run("G54 G0 X182.443 Y81.839 Z43\nG2 X159.775 Y145.237 I19083.899 J6859.357 F250\nM30\n", machine);
    ASSERT_EQ(out.problems, "");
    EXPECT_NEAR(out.motions[1].motion.arc->start_radius_mm, 20279.2007, 1e-4);
    EXPECT_LT(std::abs(out.motions[1].motion.arc->sweep_rad), 0.01);
}

}  // namespace
}  // namespace cusp::post::reader::test
