// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What milling must not depend on, collisions against closed forms, and input that is refused.
#include "milling_scenes.hpp"

#include <cusp/base/random.hpp>
#include <cusp/simulation/collision_field.hpp>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>
#include <string>

namespace {

using namespace cusp;
using namespace cusp::simulation;
using namespace cusp::test_support;
using geometry::Vector3;

constexpr double pi = std::numbers::pi;
const Vector3 up = Vector3::UnitZ();

std::vector<ToolMove> wanderingPath(base::Random& random, int moves) {
    std::vector<ToolMove> out;
    toolpath::CutterLocation at{Vector3(0, 0, -2), up};
    for (int i = 0; i < moves; ++i) {
        toolpath::CutterLocation next = at;
        for (int k = 0; k < 2; ++k) next.tip_mm[k] = std::clamp(at.tip_mm[k] + random.uniform(-4, 4), -14.0, 14.0);
        next.tip_mm[2] = random.uniform(-4, 0);
        next.axis = (up + 0.3 * Vector3(random.normal(), random.normal(), 0.0)).normalized();
        out.push_back({at, next, toolpath::MotionKind::Feed, static_cast<std::uint32_t>(i), 0});
        at = next;
    }
    return out;
}

ToolAssembly shortTool() {
    ToolAssembly tool = cutterOnly(ballCutter(4.0, 4.0));
    EXPECT_TRUE(tool.addFrustum(ToolPart::Shank, 4.0, 4.0, 12.0, 8.0));
    EXPECT_TRUE(tool.addFrustum(ToolPart::Holder, 12.0, 20.0, 30.0, 20.0));
    return tool;
}

/// Every end of every span, and who cut it.
std::vector<double> bytesOf(const Stock& stock) {
    std::vector<double> out;
    for (int axis = 0; axis < 3; ++axis)
        for (std::size_t u = 0; u < stock.lattice().count[(axis + 1) % 3]; ++u)
            for (std::size_t v = 0; v < stock.lattice().count[(axis + 2) % 3]; ++v)
                for (const DexelSpan& span : stock.ray(axis, u, v))
                    out.insert(out.end(), {span.from_mm, span.to_mm, static_cast<double>(span.from_move),
                                           static_cast<double>(span.to_move)});
    return out;
}

TEST(MillingLaws, SubdivisionOfThePathRemovesTheSame) {
    base::Random random(77);
    for (int trial = 0; trial < 6; ++trial) {
        SCOPED_TRACE(trial);
        const auto path = wanderingPath(random, 3);
        std::vector<ToolMove> fine;
        for (const ToolMove& m : path)
            for (const ToolMove& part : cutUp(m, 7)) fine.push_back(part);
        Stock whole = blockOf(boxOf(-20, -20, -12, 20, 20, 0), 0.7);
        Stock parts = whole;
        const ToolAssembly tool = cutterOnly(toroidalCutter(8.0, 2.0, 40.0));
        const MillingOptions exact{.sweep_tolerance_mm = 1e-4, .progress = {}};
        const double removed = millWith(whole, path, tool, exact).removed_volume_mm3;
        EXPECT_NEAR(millWith(parts, fine, tool, exact).removed_volume_mm3, removed, 1e-5 * removed);
    }
}

TEST(MillingLaws, OneThreadEqualsManyBitForBit) {
    base::Random random(78);
    const auto path = wanderingPath(random, 60);
    const auto run = [&](std::size_t threads, std::vector<double>& bytes) {
        tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        Stock stock = blockOf(boxOf(-20, -20, -12, 20, 20, 0), 0.5);
        const MillingReport report = millWith(stock, path, shortTool());
        bytes = bytesOf(stock);
        for (const MoveEngagement& m : report.moves) bytes.insert(bytes.end(), {m.volume_mm3, m.axial_mm, m.radial_mm});
        for (const Collision& c : report.collisions)
            bytes.insert(bytes.end(), {static_cast<double>(c.move), c.volume_mm3, c.depth_mm, c.position_mm.x(),
                                       c.position_mm.y(), c.position_mm.z()});
    };
    std::vector<double> one;
    std::vector<double> many;
    run(1, one);
    run(4, many);
    EXPECT_EQ(one, many);
}

TEST(MillingLaws, ACopyIsAPointOfReturn) {
    base::Random random(79);
    const auto path = wanderingPath(random, 40);
    const ToolAssembly tool = cutterOnly(ballCutter(6.0));
    Stock stock = blockOf(boxOf(-20, -20, -12, 20, 20, 0), 0.5);
    millWith(stock, {path.begin(), path.begin() + 20}, tool);
    const Stock kept = stock;
    const auto before = bytesOf(kept);
    const MillingOptions onwards{.first_move = 20, .progress = {}};
    millWith(stock, {path.begin() + 20, path.end()}, tool, onwards);
    const auto after = bytesOf(stock);
    EXPECT_EQ(bytesOf(kept), before);
    Stock again = kept;
    millWith(again, {path.begin() + 20, path.end()}, tool, onwards);
    EXPECT_EQ(bytesOf(again), after);
    Stock once = blockOf(boxOf(-20, -20, -12, 20, 20, 0), 0.5);
    millWith(once, path, tool);
    EXPECT_EQ(bytesOf(once), after);
}

TEST(MillingCollision, ShankWiderThanItsSlot) {
    // Cutter D4, 5 high, at 9 below the top: the shank, D10 from 5 up, goes 4 deep, beside a slot 4 wide, over 20 mm.
    ToolAssembly tool = cutterOnly(toroidalCutter(4.0, 0.0, 5.0));
    ASSERT_TRUE(tool.addFrustum(ToolPart::Shank, 5.0, 10.0, 30.0, 10.0));
    Stock stock = blockOf(boxOf(-30, -20, -15, 30, 20, 0), 0.25);
    const auto report = millWith(stock, {move(Vector3(-10, 0, -9), Vector3(10, 0, -9), up)}, tool);
    const double shank = 4.0 * (20.0 * 10.0 + pi * 25.0);
    const double slot = 4.0 * (20.0 * 4.0 + pi * 4.0);
    // In the upper 4 mm the cutter's own slot does not reach; the cutter is only 5 high.
    ASSERT_EQ(report.collisions.size(), 1U);
    const Collision& collision = report.collisions.front();
    EXPECT_EQ(collision.part, ToolPart::Shank);
    EXPECT_EQ(collision.move, 0U);
    EXPECT_NEAR(collision.volume_mm3, shank, 0.02 * shank);
    EXPECT_NEAR(collision.depth_mm, 4.0, 1.1);  // to the end of the shank at the surface
    EXPECT_NEAR(report.moves.front().volume_mm3, slot * 5.0 / 4.0, 0.03 * slot);
    EXPECT_NEAR(report.moves.front().axial_mm, 5.0, 1e-6);
    EXPECT_NEAR(report.moves.front().radial_mm, 4.0, 0.26);
}

TEST(MillingCollision, NoneWhereTheShankStaysOut) {
    ToolAssembly tool = cutterOnly(toroidalCutter(4.0, 0.0, 5.0));
    ASSERT_TRUE(tool.addFrustum(ToolPart::Shank, 5.0, 4.0, 30.0, 4.0));
    Stock stock = blockOf(boxOf(-30, -20, -15, 30, 20, 0), 0.25);
    // As deep as the cutter is high, then again: the shank slides along what the cutter left.
    std::vector<ToolMove> moves{move(Vector3(-40, 0, -5), Vector3(40, 0, -5), up),
                                move(Vector3(40, 0, -9), Vector3(-40, 0, -9), up)};
    EXPECT_TRUE(millWith(stock, moves, tool).collisions.empty());
}

TEST(MillingCollision, RapidThroughMaterialIsOne) {
    Stock stock = blockOf(boxOf(-30, -20, -15, 30, 20, 0), 0.5);
    ToolMove m = move(Vector3(-40, 0, -2), Vector3(40, 0, -2), up);
    m.kind = toolpath::MotionKind::Rapid;
    const auto report = millWith(stock, {m}, cutterOnly(ballCutter(6.0)));
    ASSERT_EQ(report.collisions.size(), 1U);
    EXPECT_EQ(report.collisions.front().part, ToolPart::Cutter);
    EXPECT_NEAR(report.collisions.front().volume_mm3, report.removed_volume_mm3, 1e-3 * report.removed_volume_mm3);
}

TEST(CollisionFieldQuery, IsWhatMillingTheSolidAwayGives) {
    base::Random random(80);
    for (int trial = 0; trial < 5; ++trial) {
        SCOPED_TRACE(trial);
        auto path = wanderingPath(random, 25);
        for (ToolMove& m : path) {
            m.from.tip_mm.z() += 2.0 * trial - 4.0;
            m.to.tip_mm.z() += 2.0 * trial - 4.0;
        }
        ToolAssembly tool = shortTool();
        std::erase_if(tool.bodies, [](const AssemblyBody& body) { return body.part == ToolPart::Cutter; });
        Stock solid = blockOf(boxOf(-20, -20, -12, 20, 20, 0), 1.0);
        const CollisionField field(solid);
        const auto found =
            field.measure(path, std::span(&tool, 1), {.sweep_tolerance_mm = 0.005, .touch_tolerance_mm = 0.005});
        const auto milled = millWith(solid, path, tool);
        EXPECT_NEAR(found.volume_mm3, milled.collisionVolume(), 1e-3 * found.volume_mm3);
        ASSERT_EQ(found.collisions.size(), milled.collisions.size());
    }
}

TEST(CollisionFieldQuery, ClearanceIsALowerBound) {
    Stock solid = blockOf(boxOf(-20, -20, -12, 20, 20, 0), 1.0);
    millWith(solid, {move(Vector3(-30, 0, -6), Vector3(30, 0, -6), up)}, cutterOnly(ballCutter(12.0)));
    const CollisionField field(solid);
    base::Random random(81);
    for (int i = 0; i < 300; ++i) {
        const Vector3 x(random.uniform(-40, 40), random.uniform(-40, 40), random.uniform(-30, 30));
        double least = 1e300;
        for (std::size_t u = 0; u < solid.lattice().count[0]; ++u)
            for (std::size_t v = 0; v < solid.lattice().count[1]; ++v)
                for (const DexelSpan& span : solid.ray(2, u, v))
                    least = std::min(least, (Vector3(solid.lattice().node(0, u), solid.lattice().node(1, v),
                                                     std::clamp(x.z(), span.from_mm, span.to_mm)) -
                                             x)
                                                .norm());
        ASSERT_LE(field.clearance(x), least + 1e-9);
        ASSERT_GE(field.clearance(x), std::min(least - 3.0, 0.8 * least));
    }
}

std::string codeOf(const base::Diagnostics& diagnostics) { return diagnostics.front().code; }

TEST(MillingRefusals, BeforeWorkBegins) {
    const auto box = boxOf(0, 0, 0, 100, 100, 50);
    const StockOptions little{0.1, std::uint64_t{100} << 20U};
    const auto too_large = Stock::box(box, little);
    ASSERT_FALSE(too_large);
    EXPECT_EQ(codeOf(too_large.error()), "simulation.memory");
    EXPECT_EQ(codeOf(Stock::box(box, {0.0}).error()), "simulation.resolution");
    EXPECT_EQ(codeOf(Stock::box(box, {60.0}).error()), "simulation.resolution");
    EXPECT_EQ(codeOf(Stock::box(boxOf(0, 0, 0, 1, 0, 1), {0.5}).error()), "simulation.stock");
    geometry::TriangleMesh open;
    open.vertices = {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1)};
    open.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}};
    EXPECT_EQ(codeOf(Stock::mesh(open, {0.1}).error()), "simulation.open-mesh");
    open.triangles.push_back({0, 3, 2});
    EXPECT_TRUE(Stock::mesh(open, {0.1}));
    EXPECT_NEAR(Stock::mesh(open, {0.01})->volume(), 1.0 / 6.0, 2e-3);
    toolpath::Tool tool;
    tool.diameter_mm = 4.0;
    tool.cutting_height_mm = 5.0;
    EXPECT_EQ(codeOf(assemblyOf(tool, -1.0).error()), "simulation.clearance");
}

}  // namespace
