// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A real NX path and the program a commercial post made of it for a B/C dual-table machine: our angles against its.
#include "shipped_machines.hpp"

#include <cusp/base/units.hpp>
#include <cusp/kinematics/angles.hpp>
#include <cusp/kinematics/axis_planner.hpp>
#include <cusp/toolpath/cl_reader.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iostream>
#include <limits>
#include <string_view>

namespace cusp::kinematics::test {
namespace {

using base::degFromRad;
using base::radFromDeg;

const std::string cl_file = CUSP_SHARED_DATA "/cl/nx_variable_axis.cls";
const std::string nc_file = CUSP_SHARED_DATA "/nc/nx_variable_axis_haasBC.nc";
constexpr double tolerance_rad = radFromDeg(0.001);

std::vector<AxisPoint> clPoints() {
    base::Diagnostics warnings;
    const auto path = toolpath::readToolPathFile(cl_file, {}, warnings);
    std::vector<AxisPoint> points;
    if (!path) {
        ADD_FAILURE() << base::toText(path.error());
        return points;
    }
    for (const toolpath::ClRecord& record : path->records)
        if (const auto* motion = std::get_if<toolpath::LinearMotion>(&record.statement))
            points.push_back({.axis = motion->location.axis,
                              .line = record.line,
                              .cutting = motion->kind == toolpath::MotionKind::Feed});
    return points;
}

/// The number behind a letter, outside of comments.
bool word(std::string_view block, char letter, double& value) {
    bool comment = false;
    for (std::size_t i = 0; i < block.size(); ++i) {
        if (block[i] == '(') comment = true;
        if (block[i] == ')') comment = false;
        if (comment || block[i] != letter) continue;
        value = std::strtod(std::string(block.substr(i + 1)).c_str(), nullptr);
        return true;
    }
    return false;
}

/// The modal C and B at every positioning block between tool centre point control on (G234) and off (G255).
std::vector<RotaryValues> postedAngles() {
    std::ifstream in(nc_file);
    std::vector<RotaryValues> posted;
    RotaryValues angles_deg{};
    bool positioning = false;
    for (std::string block; std::getline(in, block);) {
        word(block, 'C', angles_deg[0]);
        word(block, 'B', angles_deg[1]);
        if (block.find("G234") != std::string::npos) positioning = true;
        if (block.find("G255") != std::string::npos) positioning = false;
        double ignored = 0.0;
        if (positioning && (word(block, 'X', ignored) || word(block, 'Y', ignored) || word(block, 'Z', ignored)))
            posted.push_back({radFromDeg(angles_deg[0]), radFromDeg(angles_deg[1])});
    }
    return posted;
}

class PostedPair : public testing::Test {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(cl_file) || !std::filesystem::exists(nc_file))
            GTEST_SKIP() << "no real files at " << CUSP_SHARED_DATA;
    }
};

double difference(const RotaryValues& a, const RotaryValues& b) {
    return std::max(std::abs(wrapAngle(a[0] - b[0])), std::abs(wrapAngle(a[1] - b[1])));
}

TEST_F(PostedPair, AnglesAgreeUpToBranchAndWinding) {
    const Machine machine(shippedMachine("haas-umc-bc"));
    const std::vector<AxisPoint> points = clPoints();
    const std::vector<RotaryValues> posted = postedAngles();
    ASSERT_EQ(points.size(), 348U);
    ASSERT_EQ(posted.size(), 348U);
    double worst = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const AxisSolutions solved = machine.solveAxis(points[i].axis);
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t b = 0; b < solved.count; ++b)
            nearest = std::min(nearest, difference(solved.branch[b], posted[i]));
        EXPECT_LE(nearest, tolerance_rad) << "CL line " << points[i].line;
        worst = std::max(worst, nearest);
    }
    std::cout << "348 points, worst difference " << degFromRad(worst) << " degrees\n";
}

TEST_F(PostedPair, PlannerTakesOneBranchAllAlongAsThePostDid) {
    const Machine machine(shippedMachine("haas-umc-bc"));
    const std::vector<RotaryValues> posted = postedAngles();
    // The posted program lets the tool axis swing near the pole, so the planner may too; held to the great circle it changes
    // branch there instead.
    PlannerOptions options;
    options.orientation_tolerance_rad = radFromDeg(10.0);
    AxisPlanner planner(machine, options);
    for (const AxisPoint& point : clPoints()) planner.push(point);
    planner.finish();
    EXPECT_TRUE(planner.report().empty()) << base::toText(planner.report());
    std::size_t same_branch = 0;
    std::size_t count = 0;
    double posted_travel = 0.0;
    PlannedAxes axes;
    for (; planner.pop(axes); ++count) {
        same_branch += difference(axes.rotary_rad, posted.at(count)) <= tolerance_rad ? 1U : 0U;
        if (count > 0) posted_travel += std::abs(wrapAngle(posted[count][0] - posted[count - 1][0]));
    }
    EXPECT_EQ(count, 348U);
    EXPECT_EQ(same_branch, 348U);
    std::cout << "planner takes the posted branch at " << same_branch << " of " << count << " points; C travel "
              << degFromRad(planner.summary().travel_rad[0]) << " degrees, posted " << degFromRad(posted_travel)
              << "\n";
    EXPECT_LE(planner.summary().travel_rad[0], posted_travel + radFromDeg(0.1));
}

}  // namespace
}  // namespace cusp::kinematics::test
