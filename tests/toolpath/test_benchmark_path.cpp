// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The benchmark example: the committed file is what the generator writes, and its tool touches the surface everywhere.
#include <benchmark_path.hpp>

#include <cusp/toolpath/cl_reader.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

namespace cusp::toolpath::test {
namespace {

using geometry::Vector3;

const std::string example = CUSP_SOURCE_DIR "/examples/benchmark/surface_finish.cls";

/// Fountas 2017 eq. 14 with its first derivatives; the witness, written apart from the generator.
struct SurfaceAt {
    Vector3 point, du, dv;
};

SurfaceAt eq14(double u, double v) {
    SurfaceAt s;
    s.point = {-94.4 + v * (88.9 + 5.6 * v), u * (28.1 * u - 131.3),
               12.1 + u * (-50.8 + 76.2 * u) + v * (25.0 + 6.7 * v) - 27.3 * u * v - 3.9 * u * v * v +
                   5.9 * u * u * v * (1.0 + v)};
    s.du = {0.0, 56.2 * u - 131.3, -50.8 + 152.4 * u - 27.3 * v - 3.9 * v * v + 11.8 * u * v * (1.0 + v)};
    s.dv = {88.9 + 11.2 * v, 0.0, 25.0 + 13.4 * v - 27.3 * u - 7.8 * u * v + 5.9 * u * u * (1.0 + 2.0 * v)};
    return s;
}

struct Footpoint {
    double u, v;
    double distance;  ///< along the normal, > 0 on the side of +Z
    Vector3 normal, along;
};

/// Closest point by Gauss-Newton on the two tangency conditions.
Footpoint footpoint(const Vector3& q, double u, double v) {
    for (int i = 0; i < 50; ++i) {
        const SurfaceAt s = eq14(u, v);
        const Vector3 gap = q - s.point;
        Eigen::Matrix2d metric;
        metric << s.du.dot(s.du), s.du.dot(s.dv), s.du.dot(s.dv), s.dv.dot(s.dv);
        const Eigen::Vector2d step = metric.ldlt().solve(Eigen::Vector2d(gap.dot(s.du), gap.dot(s.dv)));
        u += step.x();
        v += step.y();
        if (step.norm() < 1e-14) {
            break;
        }
    }
    const SurfaceAt s = eq14(u, v);
    Vector3 normal = s.dv.cross(s.du).normalized();
    normal *= normal.z() < 0.0 ? -1.0 : 1.0;
    return {u, v, (q - s.point).dot(normal), normal, s.dv.normalized()};
}

struct Contact {
    Footpoint foot;
    double gap;    ///< between torus and surface
    double slope;  ///< of the gap along the corner circle: 0 where torus and surface are tangent
};

/// The front point of the corner circle (radius e, r above the tip), in the direction of the feed on the surface below it.
/// Searching the circle for its stationary point instead would be ill-conditioned: where the tool's effective radius meets
/// the surface's, the gap is flat along the circle.
Contact contactAtFront(const CutterLocation& cl, double feed_sign, double e, double r, double u, double v) {
    Contact contact{};
    Vector3 feed(feed_sign, 0.0, 0.0);
    for (int i = 0; i < 30; ++i) {
        const Vector3 front = (feed - feed.dot(cl.axis) * cl.axis).normalized();
        contact.foot = footpoint(cl.tip_mm + r * cl.axis + e * front, u, v);
        contact.gap = contact.foot.distance - r;
        contact.slope = contact.foot.normal.dot(cl.axis.cross(front));
        feed = feed_sign * contact.foot.along;
    }
    return contact;
}

ToolPath readExample() {
    base::Diagnostics warnings;
    const base::Result<ToolPath> path = readToolPathFile(example, {}, warnings);
    EXPECT_TRUE(path.has_value()) << (path ? "" : base::toText(path.error()));
    EXPECT_TRUE(warnings.empty()) << base::toText(warnings);
    return path.value_or(ToolPath{});
}

TEST(BenchmarkPath, TheExampleIsWhatTheGeneratorWrites) {
    std::ifstream in(example, std::ios::binary);
    std::ostringstream committed;
    committed << in.rdbuf();
    EXPECT_EQ(committed.str(), test_support::benchmarkPathText()) << "run the program update_examples";
}

TEST(BenchmarkPath, EveryCutTouchesTheSurface) {
    const double lead = 3.0 * std::numbers::pi / 180.0;
    constexpr double e = 5.0;
    constexpr double r = 3.0;
    constexpr int points_per_pass = 31;
    std::size_t cuts = 0;
    for (const ClRecord& record : readExample().records) {
        const auto* motion = std::get_if<LinearMotion>(&record.statement);
        if (motion == nullptr || motion->kind == MotionKind::Rapid) {
            continue;
        }
        const std::size_t pass = cuts / points_per_pass;
        const double feed_sign = pass % 2 == 0 ? 1.0 : -1.0;
        const double guess_v = std::clamp((motion->location.tip_mm.x() + 94.4) / 94.5, 0.0, 1.0);
        const double guess_u = std::clamp(-motion->location.tip_mm.y() / 103.2, 0.0, 1.0);
        const Contact contact = contactAtFront(motion->location, feed_sign, e, r, guess_u, guess_v);
        EXPECT_NEAR(contact.gap, 0.0, 1e-4) << "line " << record.line;
        EXPECT_NEAR(contact.slope, 0.0, 1e-5) << "line " << record.line;
        EXPECT_GT(contact.foot.v, -1e-5);
        EXPECT_LT(contact.foot.v, 1.0 + 1e-5);
        EXPECT_NEAR(eq14(contact.foot.u, contact.foot.v).point.y(), -103.2 * (static_cast<double>(pass) + 0.5) / 15.0,
                    2e-3);
        // Lead towards the feed, no tilt.
        const Vector3 along = feed_sign * contact.foot.along;
        const Vector3& axis = motion->location.axis;
        EXPECT_NEAR(std::atan2(axis.dot(along), axis.dot(contact.foot.normal)), lead, 1e-5);
        EXPECT_NEAR(axis.dot(contact.foot.normal.cross(along)), 0.0, 1e-5);
        ++cuts;
    }
    EXPECT_EQ(cuts, 15U * points_per_pass);
}

TEST(BenchmarkPath, RapidsStayClearOfTheSurface) {
    for (const ClRecord& record : readExample().records) {
        const auto* motion = std::get_if<LinearMotion>(&record.statement);
        if (motion == nullptr || motion->kind == MotionKind::Feed) {
            continue;
        }
        // The whole bottom disc of the tool, against a grid of the surface.
        const CutterLocation& cl = motion->location;
        double nearest = 1e9;
        for (int i = 0; i <= 100; ++i) {
            for (int j = 0; j <= 100; ++j) {
                const Vector3 q = eq14(i / 100.0, j / 100.0).point - cl.tip_mm;
                const double height = q.dot(cl.axis);
                if ((q - height * cl.axis).norm() < 8.0) {
                    nearest = std::min(nearest, -height);
                }
            }
        }
        EXPECT_GT(nearest, 15.0) << "line " << record.line;
    }
}

}  // namespace
}  // namespace cusp::toolpath::test
