// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Finishing passes: they touch, they do not cut in, they cover the area, and the CL file is read back as it was.
#include "cutters.hpp"

#include <cusp/base/random.hpp>
#include <cusp/optimizer/tilt/three_axis_path.hpp>
#include <cusp/toolpath/cl_writer.hpp>

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <sstream>
#include <tbb/global_control.h>

namespace cusp {
namespace {

using geometry::TriangleMesh;
using geometry::Vector3;
using tilt::MeshDrop;
using tilt::Pass;
using tilt::ThreeAxisOptions;

/// A height field over [−20, 20]², as triangles.
template <class Height>
TriangleMesh field(const Height& height, double step) {
    TriangleMesh mesh;
    const auto cells = static_cast<int>(std::lround(40.0 / step));
    for (int j = 0; j <= cells; ++j)
        for (int i = 0; i <= cells; ++i) {
            const double x = -20.0 + i * step;
            const double y = -20.0 + j * step;
            mesh.vertices.emplace_back(x, y, height(x, y));
        }
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const auto at = static_cast<std::uint32_t>(j * (cells + 1) + i);
            const auto up = at + static_cast<std::uint32_t>(cells) + 1;
            mesh.triangles.push_back({at, at + 1, up + 1});
            mesh.triangles.push_back({at, up + 1, up});
        }
    return mesh;
}

double hill(double x, double y) { return 10.0 * std::exp(-(x * x + y * y) / 60.0); }

/// Largest distance, up or down, of points along straight moves from where the dropped cutter stops.
double worstAlong(const MeshDrop& drop, const Pass& pass) {
    double worst = 0.0;
    for (std::size_t i = 1; i < pass.size(); ++i)
        for (const double t : {0.0, 0.13, 0.37, 0.5, 0.71, 0.93}) {
            const Vector3 p = pass[i - 1] + t * (pass[i] - pass[i - 1]);
            worst = std::max(worst, std::abs(p.z() - drop.drop(p.x(), p.y())->tip_z_mm));
        }
    return worst;
}

TEST(ZigZag, KeepsTheToleranceAlongEveryMove) {
    const auto mesh = field(hill, 0.5);
    for (const auto& one : test_support::cuttersOfEveryShape()) {
        const auto drop = MeshDrop::make(mesh, one.cutter);
        ThreeAxisOptions options;
        options.step_over_mm = 5.0;
        options.tolerance_mm = 0.01;
        options.direction_rad = 0.3;
        options.link_mm = 0.0;
        options.area = {{{-15.0, -15.0}}, {{15.0, 15.0}}, {}, {}, {}};
        const auto path = tilt::planThreeAxis(*drop, options);
        ASSERT_TRUE(path.has_value()) << one.name;
        for (const Pass& pass : path->passes) EXPECT_LE(worstAlong(*drop, pass), 0.0105) << one.name;
    }
}

TEST(ZigZag, CoversTheAreaAndNothingElse) {
    const auto mesh = field([](double, double) { return 1.0; }, 2.0);
    const auto drop = MeshDrop::make(mesh, test_support::ballCutter(4.0));
    ThreeAxisOptions options;
    options.step_over_mm = 0.9;
    options.direction_rad = 0.7;
    options.area.center_mm = {2.0, -1.0};
    options.area.radius_mm = 9.0;
    options.area.inner_radius_mm = 3.0;
    const auto path = tilt::planThreeAxis(*drop, options);
    ASSERT_TRUE(path.has_value());
    base::Random random(3);
    int looked = 0;
    while (looked < 300) {
        const Vector3 p(random.uniform(-10, 14), random.uniform(-13, 11), 1.0);
        if (!options.area.contains(p.x(), p.y())) continue;
        ++looked;
        double nearest = 1e9;
        for (const Pass& pass : path->passes)
            for (std::size_t i = 1; i < pass.size(); ++i) {
                const Vector3 way = pass[i] - pass[i - 1];
                const double t = std::clamp((p - pass[i - 1]).dot(way) / std::max(way.squaredNorm(), 1e-30), 0.0, 1.0);
                nearest = std::min(nearest, (p - pass[i - 1] - t * way).norm());
            }
        // Half a row; near the rims a row may end a little earlier.
        EXPECT_LE(nearest, 1.3) << p.transpose();
    }
    for (const Pass& pass : path->passes)
        for (const Vector3& p : pass) EXPECT_LE(std::hypot(p.x() - 2.0, p.y() + 1.0), 9.0 + 1e-6);
}

TEST(ZLevel, RingsOfACone) {
    // A cone of 45°: the tip of a ball of radius 2 runs where the tip plane's offset cone is: r = (12 − z) + 2·(√2 − 1).
    const auto mesh = field([](double x, double y) { return 12.0 - std::hypot(x, y); }, 0.25);
    const auto drop = MeshDrop::make(mesh, test_support::ballCutter(4.0));
    ThreeAxisOptions options;
    options.strategy = ThreeAxisOptions::Strategy::ZLevel;
    options.step_down_mm = 2.0;
    options.highest_mm = 9.0;
    options.lowest_mm = 1.0;
    options.link_mm = 0.0;
    options.sample_mm = 0.5;
    const auto path = tilt::planThreeAxis(*drop, options);
    ASSERT_TRUE(path.has_value());
    EXPECT_EQ(path->passes.size(), 4U);
    for (const Pass& pass : path->passes) {
        const double z = pass.front().z();
        for (const Vector3& p : pass) {
            EXPECT_EQ(p.z(), z);
            EXPECT_NEAR(std::hypot(p.x(), p.y()), 12.0 - z + 2.0 * (std::numbers::sqrt2 - 1.0), 0.01);
            EXPECT_LE(drop->drop(p.x(), p.y())->tip_z_mm, z);
        }
        EXPECT_LE((pass.front() - pass.back()).norm(), 1e-9);  // closed
        // The material is to the right: the ring goes round it clockwise seen from above.
        double turned = 0.0;
        for (std::size_t i = 1; i < pass.size(); ++i)
            turned += pass[i - 1].x() * pass[i].y() - pass[i - 1].y() * pass[i].x();
        EXPECT_LT(turned, 0.0);
    }
}

TEST(ZLevel, DoesNotCutInBetweenPoints) {
    const auto mesh =
        field([](double x, double y) { return 4.0 * std::sin(0.35 * x) * std::cos(0.3 * y + 0.2 * x); }, 1.0);
    for (const auto& one : test_support::cuttersOfEveryShape()) {
        const auto drop = MeshDrop::make(mesh, one.cutter);
        ThreeAxisOptions options;
        options.strategy = ThreeAxisOptions::Strategy::ZLevel;
        options.step_down_mm = 0.7;
        options.highest_mm = 4.0;
        options.lowest_mm = 1.0;
        options.sample_mm = 0.8;
        options.link_mm = 0.0;
        const auto path = tilt::planThreeAxis(*drop, options);
        ASSERT_TRUE(path.has_value()) << one.name;
        for (const Pass& pass : path->passes)
            for (std::size_t i = 1; i < pass.size(); ++i) {
                const Vector3 middle = (pass[i - 1] + pass[i]) / 2.0;
                const auto contact = drop->drop(middle.x(), middle.y());
                if (!contact) continue;
                // What the level line bends is material beside the tip, not below: at slopes below 1 in 1 that is as much.
                EXPECT_LE(contact->tip_z_mm - middle.z(), 0.03) << one.name;
            }
    }
}

TEST(ThreeAxis, OneThreadEqualsMany) {
    const auto drop = MeshDrop::make(field(hill, 1.0), test_support::ballCutter(6.0));
    for (const auto strategy : {ThreeAxisOptions::Strategy::ZigZag, ThreeAxisOptions::Strategy::ZLevel}) {
        ThreeAxisOptions options;
        options.strategy = strategy;
        const auto many = tilt::planThreeAxis(*drop, options);
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        const auto alone = tilt::planThreeAxis(*drop, options);
        EXPECT_TRUE(many->passes == alone->passes);
    }
}

TEST(ThreeAxis, TheClFileReadsBack) {
    const auto drop = MeshDrop::make(field(hill, 1.0), test_support::ballCutter(6.0));
    ThreeAxisOptions options;
    options.step_over_mm = 4.0;
    const auto path = tilt::planThreeAxis(*drop, options);
    toolpath::ToolPath file;
    file.dialect = toolpath::Dialect::Apt;
    file.records = tilt::clRecords(*path, options, "HILL", {1, "BALL_6", drop->cutter()});
    const auto text = toolpath::clText(file);
    ASSERT_TRUE(text.has_value()) << base::toText(text.error());
    EXPECT_NE(text->find("CUTTER/6,3,0,3,0,0,40"), std::string::npos) << text->substr(0, 300);
    std::istringstream in(*text);
    base::Diagnostics warnings;
    const auto back = toolpath::readToolPath(in, "hill.apt", {}, warnings);
    ASSERT_TRUE(back.has_value()) << base::toText(back.error());
    std::size_t rapids = 0;
    for (const auto& record : back->records)
        if (const auto* motion = std::get_if<toolpath::LinearMotion>(&record.statement))
            rapids += motion->kind == toolpath::MotionKind::Rapid ? 1 : 0;
    EXPECT_EQ(rapids, 2 * path->passes.size());
}

TEST(ThreeAxis, SaysWhatIsWrongWithItsOptions) {
    const auto drop = MeshDrop::make(field(hill, 2.0), test_support::ballCutter(6.0));
    ThreeAxisOptions options;
    options.step_over_mm = 0.0;
    EXPECT_EQ(tilt::planThreeAxis(*drop, options).error().front().message, "step_over_mm is 0; it must be above 0");
    options = {};
    options.area.min_mm = {1.0, 1.0};
    options.area.max_mm = {0.0, 2.0};
    EXPECT_EQ(tilt::planThreeAxis(*drop, options).error().front().message,
              "area: min_mm 1 must lie below max_mm 0 along X");
    options = {};
    options.area.min_mm = {100.0, 100.0};
    options.area.max_mm = {110.0, 110.0};
    EXPECT_EQ(tilt::planThreeAxis(*drop, options).error().front().code, "tilt.no-path");
}

}  // namespace
}  // namespace cusp
