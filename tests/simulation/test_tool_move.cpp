// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// CL records as moves of a cutter.
#include <cusp/simulation/tool_move.hpp>

#include <cusp/toolpath/cl_reader.hpp>

#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace {

using namespace cusp;
using namespace cusp::simulation;

struct Collected {
    CutterPath path;
    base::Diagnostics report;
};

Collected collect(const std::string& text, double chord_mm = 0.001) {
    Collected out;
    std::istringstream in(text);
    const auto file = toolpath::readToolPath(in, "p.apt", {}, out.report).value();
    PathCollector collector("p.apt", chord_mm, out.report);
    for (const auto& record : file.records) collector.take(record);
    out.path = collector.finish();
    return out;
}

TEST(PathCollector, MovesBeginWhereTheToolStands) {
    const auto [path, report] = collect(
        "UNITS/MM\nCUTTER/10,5,0,5,0,0,30\nLOADTL/1\nRAPID\nGOTO/0,0,50\nFEDRAT/100,MMPM\nGOTO/0,0,0\nGOTO/10,0,0\nFINI\n");
    EXPECT_FALSE(report.hasErrors()) << toText(report);
    ASSERT_EQ(path.moves.size(), 2U);
    EXPECT_EQ(path.locations, 3U);
    EXPECT_EQ(path.moves[0].from.tip_mm.z(), 50.0);
    EXPECT_EQ(path.moves[1].to.tip_mm.x(), 10.0);
    EXPECT_EQ(path.moves[1].line, 8U);
    ASSERT_EQ(path.cutters.size(), 1U);
    EXPECT_EQ(path.cutters[0].corner_radius_mm, 5.0);
}

TEST(PathCollector, AnArcIsChordsWithinTolerance) {
    const auto [path, report] = collect(
        "UNITS/MM\nCUTTER/10,5,0,5,0,0,30\nLOADTL/1\nFEDRAT/100,MMPM\nGOTO/20,0,0\nCIRCLE/0,0,0,0,0,1,20\nGOTO/0,20,0\nFINI\n");
    ASSERT_FALSE(report.hasErrors()) << toText(report);
    ASSERT_GT(path.moves.size(), 10U);
    EXPECT_EQ(path.locations, 2U);
    for (const ToolMove& move : path.moves) {
        EXPECT_NEAR(move.to.tip_mm.norm(), 20.0, 1e-9);
        const double sagitta = 20.0 - (0.5 * (move.from.tip_mm + move.to.tip_mm)).norm();
        EXPECT_LE(sagitta, 0.001);
        EXPECT_GT(sagitta, 0.0005);
    }
    EXPECT_NEAR((path.moves.back().to.tip_mm - geometry::Vector3(0, 20, 0)).norm(), 0.0, 1e-9);
}

TEST(PathCollector, AToolWithoutAShapeIsAnErrorAtItsFirstMove) {
    const auto [path, report] = collect("UNITS/MM\nLOADTL/1\nFEDRAT/100,MMPM\nGOTO/0,0,0\nGOTO/1,0,0\nFINI\n");
    EXPECT_TRUE(path.moves.empty());
    EXPECT_EQ(toText(report),
              "p.apt:4: error: the tool moves here, and the CL file has not told its shape (CUTTER, TLDATA) "
              "[simulation.no-cutter]\n");
}

}  // namespace
