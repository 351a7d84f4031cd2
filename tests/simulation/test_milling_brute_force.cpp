// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Milling with shifting and turning tools against a search over time that knows nothing of sweeps.
#include "milling_scenes.hpp"

#include <cusp/base/random.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace cusp;
using namespace cusp::simulation;
using namespace cusp::test_support;
using geometry::Vector3;

Vector3 randomUnit(base::Random& random) {
    return Vector3(random.normal(), random.normal(), random.normal()).normalized();
}

/// Through or near the middle of a block of ±8 mm.
ToolMove randomMove(base::Random& random, double largest_turn) {
    const Vector3 middle(random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-4, 4));
    const Vector3 way = random.uniform(0.0, 6.0) * randomUnit(random);
    const Vector3 axis = randomUnit(random);
    ToolMove out = move(middle - 0.5 * way, middle + 0.5 * way, axis);
    out.to.axis = (axis + random.uniform(0.0, largest_turn) * randomUnit(random)).normalized();
    return out;
}

/// Every ray of a block after one move: at random places material is where the search says, ends of spans are on the sweep.
void checkMove(const geometry::Cutter& cutter, const ToolMove& m, double tolerance, base::Random& random) {
    const auto box = boxOf(-8, -8, -8, 8, 8, 8);
    Stock stock = blockOf(box, 2.0);
    const MillingOptions options{.sweep_tolerance_mm = 0.002, .progress = {}};
    millWith(stock, {m}, cutterOnly(cutter), options);
    for (int axis = 0; axis < 3; ++axis)
        for (std::size_t u = 0; u < 8; ++u)
            for (std::size_t v = 0; v < 8; ++v) {
                Vector3 x;
                x[(axis + 1) % 3] = stock.lattice().node((axis + 1) % 3, u);
                x[(axis + 2) % 3] = stock.lattice().node((axis + 2) % 3, v);
                const auto spans = stock.ray(axis, u, v);
                for (int i = 0; i < 3; ++i) {
                    x[axis] = random.uniform(-8.0, 8.0);
                    const bool there = std::any_of(spans.begin(), spans.end(), [&](const DexelSpan& span) {
                        return span.from_mm <= x[axis] && x[axis] <= span.to_mm;
                    });
                    const double distance = sweptDistance(cutter, m, x);
                    if (std::abs(distance) <= tolerance) continue;
                    ASSERT_EQ(there, distance > 0.0) << distance;
                }
                for (const DexelSpan& span : spans)
                    for (const auto& [end, by] :
                         {std::pair(span.from_mm, span.from_move), std::pair(span.to_mm, span.to_move)}) {
                        if (by == DexelSpan::no_cut) continue;
                        x[axis] = end;
                        ASSERT_NEAR(sweptDistance(cutter, m, x), 0.0, tolerance);
                    }
            }
}

TEST(MillingBruteForce, ShiftingTools) {
    base::Random random(20261);
    for (int i = 0; i < 60; ++i) {
        SCOPED_TRACE(i);
        const double corner = i % 3 == 0 ? 3.0 : i % 3 == 1 ? 1.0 : 1e-9;
        checkMove(toroidalCutter(6.0, corner, random.uniform(3.0, 30.0)), randomMove(random, 0.0), 2e-6, random);
        if (HasFatalFailure()) return;
    }
}

/// Balls on long shafts along an axis of the stock have a way of their own through the rays, eight at a time.
TEST(MillingBruteForce, BallsAlongTheAxesOfTheStock) {
    base::Random random(20263);
    for (int i = 0; i < 90; ++i) {
        SCOPED_TRACE(i);
        ToolMove m = randomMove(random, 0.0);
        Vector3 axis = Vector3::Zero();
        axis[i % 3] = i % 7 == 6 ? -1.0 : 1.0;
        m.from.axis = m.to.axis = axis;
        const Vector3 way = m.to.tip_mm - m.from.tip_mm;
        Vector3 straight = way;
        const int kind = i / 3 % 6;
        if (kind == 0) straight = way.dot(axis) * axis;        // plunging
        if (kind == 1) straight = way - way.dot(axis) * axis;  // level
        if (kind == 2) straight = Vector3::Zero();
        if (kind == 3) straight = way.norm() * Vector3::Unit((i + 1) % 3);
        m.to.tip_mm = m.from.tip_mm + straight;
        // Shafts too short for it, just long enough, and long.
        const double height = i % 5 == 0 ? random.uniform(3.0, 6.0) : i % 5 == 1 ? 6.0 : random.uniform(6.0, 30.0);
        checkMove(toroidalCutter(6.0, 3.0, height), m, 2e-6, random);
        if (HasFatalFailure()) return;
    }
}

TEST(MillingBruteForce, TurningTools) {
    base::Random random(20262);
    for (int i = 0; i < 60; ++i) {
        SCOPED_TRACE(i);
        const double corner = i % 3 == 0 ? 3.0 : i % 3 == 1 ? 1.0 : 1e-9;
        checkMove(toroidalCutter(6.0, corner, random.uniform(3.0, 30.0)), randomMove(random, i % 2 == 0 ? 0.1 : 0.8),
                  0.0025, random);
        if (HasFatalFailure()) return;
    }
}

}  // namespace
