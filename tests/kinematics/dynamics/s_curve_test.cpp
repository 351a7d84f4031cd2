// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The straight move from rest to rest against what it must be.
#include <cusp/base/random.hpp>
#include <cusp/dynamics/s_curve.hpp>

#include <cmath>
#include <gtest/gtest.h>

namespace cusp::dynamics {
namespace {

TEST(SCurve, JerkAloneDecides) {
    // A quarter of the time under each of +j -j -j +j covers j t³ / 32.
    const double t = 0.08;
    EXPECT_NEAR(straightTime(30000.0 * t * t * t / 32.0, {1e6, 1e6, 30000.0}), t, 1e-12);
}

TEST(SCurve, LongMovesCruise) {
    // Ramps of v/a + a/j cover v (v/a + a/j) together.
    const double ramp = 1000.0 / 3000.0 + 3000.0 / 30000.0;
    EXPECT_NEAR(straightTime(2000.0, {1000.0, 3000.0, 30000.0}), 2.0 * ramp + (2000.0 - 1000.0 * ramp) / 1000.0, 1e-12);
}

TEST(SCurve, EveryMoveEndsAtRestWithinItsLimits) {
    base::Random random(20);
    for (int i = 0; i < 20000; ++i) {
        const double distance = std::pow(10.0, random.uniform(-4.0, 4.0));
        const ScalarLimits limits{std::pow(10.0, random.uniform(0.0, 3.0)), std::pow(10.0, random.uniform(1.0, 4.0)),
                                  std::pow(10.0, random.uniform(2.0, 6.0))};
        double way = 0.0;
        double speed = 0.0;
        double acceleration = 0.0;
        double time = 0.0;
        double fastest = 0.0;
        double hardest = 0.0;
        for (const StraightPhase& phase : straightPhases(distance, limits)) {
            ASSERT_NEAR(phase.law.speed, speed, 1e-9 * limits.velocity) << "case " << i;
            const double t = phase.law.duration_s;
            way += phase.length;
            speed += t * (acceleration + 0.5 * phase.law.rate * t);
            acceleration += phase.law.rate * t;
            time += t;
            fastest = std::max(fastest, speed);
            hardest = std::max(hardest, std::abs(acceleration));
        }
        ASSERT_NEAR(way, distance, 1e-9 * distance) << "case " << i;
        ASSERT_NEAR(speed, 0.0, 1e-9 * limits.velocity) << "case " << i;
        ASSERT_LE(fastest, limits.velocity * (1.0 + 1e-9)) << "case " << i;
        ASSERT_LE(hardest, limits.acceleration * (1.0 + 1e-9)) << "case " << i;
        ASSERT_NEAR(time, straightTime(distance, limits), 1e-9 * time) << "case " << i;
        // Time optimal: some limit is reached at each stage, so a tenth more of every limit must be faster.
        ASSERT_LT(straightTime(distance, {1.1 * limits.velocity, 1.1 * limits.acceleration, 1.1 * limits.jerk}), time);
    }
}

}  // namespace
}  // namespace cusp::dynamics
