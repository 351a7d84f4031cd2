// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The bounds on what goes unseen between samples, held against ways sampled a hundred times as densely.
#include "nc_recorder.hpp"

#include <cusp/base/random.hpp>
#include <cusp/post/reader/move_sampler.hpp>

#include <gtest/gtest.h>

namespace cusp::post::reader::test {
namespace {

constexpr std::uint64_t seed = 7;
constexpr int samples = 400;

Vector3 draw(base::Random& random, double size) {
    return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// Of the way from its chord, and of the axis from its.
struct Sag {
    double tip_mm = 0.0;
    double axis_rad = 0.0;
};

Sag sagOf(const ExecutedMotion& motion, const ForwardChain& chain) {
    const ToolPose from = poseAt(motion, chain, 0.0);
    const ToolPose to = poseAt(motion, chain, 1.0);
    Sag sag;
    for (int i = 1; i < samples; ++i) {
        const double fraction = static_cast<double>(i) / samples;
        const ToolPose pose = poseAt(motion, chain, fraction);
        sag.tip_mm = std::max(sag.tip_mm, norm(pose.tip_mm - ((1.0 - fraction) * from.tip_mm + fraction * to.tip_mm)));
        sag.axis_rad = std::max(sag.axis_rad, norm(pose.axis - ((1.0 - fraction) * from.axis + fraction * to.axis)));
    }
    return sag;
}

ExecutedMotion jointMotion(const ForwardChain& chain, base::Random& random, double largest_turn_rad) {
    ExecutedMotion motion;
    motion.joint_linear = true;
    motion.orientation_path = OrientationPath::RotaryLinear;
    motion.placement = {random.uniform(50, 300), draw(random, 200)};
    motion.path_start_mm = draw(random, 200);
    motion.path_end_mm = motion.path_start_mm + draw(random, 50);
    RotaryValues from{};
    RotaryValues to{};
    for (std::size_t i = 0; i < chain.rotaryCount(); ++i) {
        from[i] = random.uniform(-2, 2);
        to[i] = from[i] + random.uniform(-largest_turn_rad, largest_turn_rad);
        motion.start.rotary_rad[i] = from[i];
        motion.end.rotary_rad[i] = to[i];
    }
    motion.start_pose = ToolPose{chain.tip(motion.path_start_mm, from, motion.placement), chain.toolAxis(from)};
    motion.end_pose = ToolPose{chain.tip(motion.path_end_mm, to, motion.placement), chain.toolAxis(to)};
    return motion;
}

/// |f(t) − chord| ≤ max |f''| / 8.
TEST(Bend, BoundsEveryJointMotion) {
    RecordProperty("seed", static_cast<int>(seed));
    base::Random random(seed);
    for (const char* name : {"head-c200-a95", "trunnion-ac", "nutating-45", "haas-umc-bc", "fooke-endura-ca"}) {
        const ForwardChain chain(shippedMachine(name).machine);
        double tightest = 0.0;
        for (const double turn : {0.001, 0.02, 0.3, 3.0})
            for (int i = 0; i < 100; ++i) {
                const ExecutedMotion motion = jointMotion(chain, random, turn);
                const Bend bend = bendOf(motion, chain);
                const Sag sag = sagOf(motion, chain);
                EXPECT_LE(sag.tip_mm, bend.tip_mm / 8.0 * (1.0 + 1e-9) + 1e-10) << name << ' ' << turn << ' ' << i;
                EXPECT_LE(sag.axis_rad, bend.axis_rad / 8.0 * (1.0 + 1e-9) + 1e-12) << name << ' ' << turn << ' ' << i;
                tightest = std::max(tightest, sag.tip_mm / bend.tip_mm * 8.0);
            }
        EXPECT_GT(tightest, 0.3) << name << ": a bound that is never near says little";
    }
}

TEST(Bend, BoundsArcs) {
    base::Random random(seed);
    const ForwardChain chain(shippedMachine("three-axis").machine);
    for (int i = 0; i < 200; ++i) {
        ExecutedMotion motion;
        motion.start_pose = motion.end_pose = ToolPose{};
        motion.arc = Arc{};
        motion.arc->start_radius_mm = random.uniform(1, 50);
        motion.arc->end_radius_mm = motion.arc->start_radius_mm + random.uniform(-0.01, 0.01);
        motion.arc->sweep_rad = random.uniform(-6, 6);
        motion.arc->height_mm = random.uniform(-20, 20);
        EXPECT_LE(sagOf(motion, chain).tip_mm, bendOf(motion, chain).tip_mm / 8.0 + 1e-12) << i;
    }
}

}  // namespace
}  // namespace cusp::post::reader::test
