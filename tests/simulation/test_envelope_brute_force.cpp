// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The envelope of turning tools against a search that only knows whether a point is inside the tool.
#include "envelope_scenes.hpp"

#include <cusp/base/random.hpp>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace {

using namespace cusp;
using namespace cusp::simulation;
using namespace cusp::test_support;
using geometry::Vector3;

constexpr double band_mm = 0.8;

/// Written apart from CutterBody: bottom disc, corner torus, flank cylinder.
bool insideToroid(const geometry::Cutter& c, const toolpath::CutterLocation& at, const Vector3& x) {
    const Vector3 w = x - at.tip_mm;
    const double z = w.dot(at.axis);
    const double rho = (w - z * at.axis).norm();
    if (z < 0.0 || z > c.cutting_height_mm || rho > c.diameter_mm / 2.0) return false;
    if (z >= c.corner_radius_mm || rho <= c.corner_e_mm) return true;
    return std::hypot(rho - c.corner_e_mm, z - c.corner_radius_mm) <= c.corner_radius_mm;
}

toolpath::CutterLocation locationAt(const ToolMove& m, double time) {
    const Vector3 tip = m.from.tip_mm + time * (m.to.tip_mm - m.from.tip_mm);
    const double turn = std::acos(std::clamp(m.from.axis.dot(m.to.axis), -1.0, 1.0));
    if (turn < 1e-7) return {tip, m.from.axis};
    return {tip, (std::sin((1.0 - time) * turn) * m.from.axis + std::sin(time * turn) * m.to.axis) / std::sin(turn)};
}

/// First s at which the line is inside at this time, if before `already`: a scan in steps, then bisection.
double entryBySearch(const CutterPath& path, const ToolMove& m, double time, const GridPoint& point, double already) {
    const toolpath::CutterLocation at = locationAt(m, time);
    const auto inside = [&](double s) {
        return insideToroid(path.cutters[m.cutter], at, point.position + s * point.normal);
    };
    constexpr double step = 0.02;
    for (double s = -band_mm; s < already; s += step) {
        if (!inside(s)) continue;
        if (s <= -band_mm) return -band_mm;
        double low = s - step;
        double high = s;
        for (int i = 0; i < 40; ++i) {
            const double mid = 0.5 * (low + high);
            (inside(mid) ? high : low) = mid;
        }
        return high;
    }
    return already;
}

/// Six locations near the benchmark surface, up to 0.3 mm in it or off it, the axis up to `largest_turn` off the normal.
CutterPath randomPath(base::Random& random, double largest_turn) {
    const auto faces = benchmarkFaces();
    CutterPath path = pathOf(toroidalCutter(random.chance(0.5) ? 16.0 : 6.0, random.chance(0.5) ? 3.0 : 1.0, 50.0), {});
    double u = random.uniform(0.2, 0.8);
    double v = random.uniform(0.2, 0.8);
    toolpath::CutterLocation at;
    for (int i = 0; i < 6; ++i) {
        const Vector3 n = faces[0].normal(u, v);
        const Vector3 lean = Vector3(random.normal(), random.normal(), random.normal()).normalized();
        const toolpath::CutterLocation next{faces[0].evaluate(u, v).position + random.uniform(-0.3, 0.3) * n,
                                            (n + largest_turn * random.uniform() * lean).normalized()};
        if (i > 0) path.moves.push_back({at, next, toolpath::MotionKind::Feed, 1, 0});
        at = next;
        u = std::clamp(u + random.uniform(-0.06, 0.06), 0.05, 0.95);
        v = std::clamp(v + random.uniform(-0.06, 0.06), 0.05, 0.95);
    }
    return path;
}

class EnvelopeBruteForce : public testing::TestWithParam<double> {};

TEST_P(EnvelopeBruteForce, NothingThatTheSearchFindsIsMissed) {
    constexpr int times = 400;
    base::Random random(static_cast<std::uint64_t>(GetParam() * 1000.0) + 11);
    const auto faces = benchmarkFaces();
    std::size_t looked_at = 0;
    double closest = band_mm;
    for (int scene = 0; scene < 4; ++scene) {
        const CutterPath path = randomPath(random, GetParam());
        const auto envelope = envelopeOf(path, faces, {1.7, band_mm});
        for (std::size_t i = 0; i < envelope.points.size(); ++i) {
            const EnvelopePoint& ours = envelope.points[i];
            if (!ours.reached() && random.chance(0.97)) continue;  // most of the surface is far away
            double found = band_mm;
            for (const ToolMove& m : path.moves)
                for (int k = 0; k <= times; ++k)
                    found = entryBySearch(path, m, static_cast<double>(k) / times, envelope.grid.points[i], found);
            // The search sees the tool at some times only, so it cannot find less than there is.
            ASSERT_LE(ours.deviation_mm, found + 2e-6) << "scene " << scene << " point " << i;
            closest = std::min(closest, std::abs(found - ours.deviation_mm));
            ++looked_at;
        }
    }
    EXPECT_GT(looked_at, 200U);
    EXPECT_LT(closest, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Turns, EnvelopeBruteForce, testing::Values(0.0, 0.05, 0.6));

TEST(Envelope, EveryEntryIsInsideTheToolAtSomeTimeOfTheMoveThatMadeIt) {
    base::Random random(77);
    const auto faces = benchmarkFaces();
    std::size_t checked = 0;
    for (int scene = 0; scene < 8; ++scene) {
        const CutterPath path = randomPath(random, 0.2);
        const auto envelope = envelopeOf(path, faces, {0.9, band_mm});
        for (std::size_t i = 0; i < envelope.points.size(); ++i) {
            const EnvelopePoint& out = envelope.points[i];
            if (!out.reached()) continue;
            // A point 1 µm behind the entry: the tool must be over it at some of 20 000 times.
            const Vector3 x =
                envelope.grid.points[i].position + (out.deviation_mm + 1e-3) * envelope.grid.points[i].normal;
            bool inside = false;
            for (int k = 0; k <= 20000 && !inside; ++k)
                inside = insideToroid(path.cutters[0], locationAt(path.moves[out.move], k / 20000.0), x);
            ASSERT_TRUE(inside) << "scene " << scene << " point " << i << " at " << out.deviation_mm;
            ++checked;
        }
    }
    EXPECT_GT(checked, 300U);
}

TEST(Envelope, SplittingMovesChangesNothing) {
    base::Random random(3);
    const auto faces = benchmarkFaces();
    const CutterPath whole = randomPath(random, 0.3);
    CutterPath parts = whole;
    parts.moves.clear();
    for (const ToolMove& m : whole.moves)
        for (int k = 0; k < 7; ++k)
            parts.moves.push_back({locationAt(m, k / 7.0), locationAt(m, (k + 1) / 7.0), m.kind, m.line, m.cutter});
    const auto a = envelopeOf(whole, faces, {0.5, 1.0});
    const auto b = envelopeOf(parts, faces, {0.5, 1.0});
    ASSERT_EQ(a.points.size(), b.points.size());
    for (std::size_t i = 0; i < a.points.size(); ++i)
        ASSERT_NEAR(a.points[i].deviation_mm, b.points[i].deviation_mm, 3e-6) << i;
}

TEST(Envelope, SameBitsAtAnyNumberOfThreads) {
    base::Random random(4);
    const auto faces = benchmarkFaces();
    const CutterPath path = randomPath(random, 0.3);
    const auto many = envelopeOf(path, faces, {0.5, 1.0});
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto single = envelopeOf(path, faces, {0.5, 1.0});
    ASSERT_EQ(many.points.size(), single.points.size());
    for (std::size_t i = 0; i < many.points.size(); ++i) {
        ASSERT_EQ(std::memcmp(&many.points[i].deviation_mm, &single.points[i].deviation_mm, sizeof(double)), 0);
        ASSERT_EQ(many.points[i].move, single.points[i].move);
    }
}

}  // namespace
