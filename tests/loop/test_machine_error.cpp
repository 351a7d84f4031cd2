// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What each error does to the tool, against closed forms of a C-then-A head.
#include <cusp/base/random.hpp>
#include <cusp/base/units.hpp>
#include <cusp/loop/executed_motion.hpp>
#include <cusp/post/control/control_definition.hpp>

#include <cmath>
#include <gtest/gtest.h>
#include <sstream>

namespace cusp::loop {
namespace {

using geometry::Matrix3;

constexpr std::uint64_t seed = 20260901;
const CuttingSetup setup{.tool_length_mm = 120.0, .wcs_origin_mm = {3000.0, 40.0, -800.0}};

machine::MachineDefinition head() {
    return post::readMachineFile(std::string(CUSP_SOURCE_DIR) + "/machines/fooke-endura-ca.toml").value().machine;
}

RealMachine machineWith(const MachineErrors& errors) { return realMachine(head(), errors, setup).value(); }

dynamics::AxisVector anyAxes(base::Random& random) {
    return {random.uniform(2900.0, 3100.0), random.uniform(-60.0, 140.0), random.uniform(-500.0, -300.0),
            random.uniform(-4.0, 4.0), random.uniform(-1.5, 1.5)};
}

Matrix3 turnC(double c) { return Eigen::AngleAxisd(c, Vector3::UnitZ()).toRotationMatrix(); }
Matrix3 turnA(double a) { return Eigen::AngleAxisd(a, Vector3::UnitX()).toRotationMatrix(); }

TEST(MachineError, EveryParameterOfAHeadHasItsName) {
    std::string names;
    for (const auto& parameter : errorParameters(kinematics::Machine(head()))) names += parameter.name + " ";
    EXPECT_EQ(names, "pivot_length_mm tool_length_mm tool_radius_mm axis_C_x_mm axis_C_y_mm axis_C_about_x_deg "
                     "axis_C_about_y_deg zero_C_deg axis_A_y_mm axis_A_about_y_deg zero_A_deg square_XY_deg "
                     "square_XZ_deg square_YZ_deg lag_X_ms lag_Y_ms lag_Z_ms lag_C_ms lag_A_ms ");
}

TEST(MachineError, PivotAndToolLengthActAlongTheAxisAndOnlyAsASum) {
    const RealMachine exact = machineWith({});
    const RealMachine pivot = machineWith({{"pivot_length_mm", 0.05}});
    const RealMachine tool = machineWith({{"tool_length_mm", 0.05}});
    base::Random random(seed);
    for (int i = 0; i < 200; ++i) {
        const auto axes = anyAxes(random);
        const auto at = exact.place(axes);
        const Vector3 expected = -0.05 * (at.axis - Vector3::UnitZ());
        EXPECT_LT((pivot.place(axes).tip_mm - at.tip_mm - expected).norm(), 1e-10);
        EXPECT_LT((tool.place(axes).tip_mm - at.tip_mm - expected).norm(), 1e-10);
    }
}

TEST(MachineError, PlacesAndZerosOfRotaryAxes) {
    const RealMachine exact = machineWith({});
    const RealMachine place_a = machineWith({{"axis_A_y_mm", 0.03}});
    const RealMachine place_c = machineWith({{"axis_C_x_mm", -0.02}});
    const RealMachine zero_a = machineWith({{"zero_A_deg", 0.01}});
    base::Random random(seed + 1);
    for (int i = 0; i < 200; ++i) {
        const auto axes = anyAxes(random);
        const auto at = exact.place(axes);
        const Matrix3 c = turnC(axes[3]);
        const Matrix3 a = turnA(axes[4]);
        EXPECT_LT((place_a.place(axes).tip_mm - at.tip_mm - c * (Matrix3::Identity() - a) * Vector3(0, 0.03, 0)).norm(),
                  1e-10);
        EXPECT_LT((place_c.place(axes).tip_mm - at.tip_mm - (Matrix3::Identity() - c) * Vector3(-0.02, 0, 0)).norm(),
                  1e-10);
        EXPECT_LT((zero_a.place(axes).axis - c * turnA(axes[4] + base::radFromDeg(0.01)) * Vector3::UnitZ()).norm(),
                  1e-12);
    }
}

TEST(MachineError, SquarenessLeansTheSecondAxisTowardsTheFirst) {
    const RealMachine exact = machineWith({});
    const RealMachine leaning = machineWith({{"square_XY_deg", 0.01}});
    const double angle = base::radFromDeg(0.01);
    const dynamics::AxisVector axes{3010.0, 140.0, -430.0, 0.0, 0.0};
    const auto at = exact.place(axes).tip_mm;
    const Vector3 off = leaning.place(axes).tip_mm - at;
    // 100 mm from the datum in Y; X and Z do not matter.
    EXPECT_NEAR(at.y(), 100.0, 1e-9);
    EXPECT_NEAR(off.x(), 100.0 * std::sin(angle), 1e-9);
    EXPECT_NEAR(off.y(), -100.0 * (1.0 - std::cos(angle)), 1e-9);
    EXPECT_NEAR(off.z(), 0.0, 1e-12);
}

TEST(MachineError, TheDatumIsWhereTheControlBelievesIt) {
    for (const auto& parameter : errorParameters(kinematics::Machine(head()))) {
        const RealMachine real = machineWith({{parameter.name, 3.0 * parameter.typical}});
        const auto touch =
            kinematics::Machine(head()).solveLinear(setup.wcs_origin_mm, {0.0, 0.0}, setup.tool_length_mm);
        const auto at = real.place(dynamics::axisVector({.linear_mm = *touch, .rotary_rad = {}}));
        EXPECT_LT(at.tip_mm.norm(), 1e-9) << parameter.name;
    }
}

TEST(MachineError, LagOfARampAndOfASine) {
    AxisTrack ramp;
    AxisTrack sine;
    constexpr double step_s = 0.002;
    constexpr double omega = 20.0;
    for (int i = 0; i <= 2000; ++i) {
        const double t = i * step_s;
        ramp.add(t, {50.0 * t, 0, 0, 0, 0});
        sine.add(t, {0, std::sin(omega * t), 0, 0, 0});
    }
    const double lag_s = 0.003;
    const auto late = lagged(ramp, {lag_s, 0, 0, 0, 0});
    EXPECT_NEAR(ramp.axes.back()[0] - late.axes.back()[0], 50.0 * lag_s, 1e-9);
    const auto wave = lagged(sine, {0, lag_s, 0, 0, 0});
    const double t = 2000 * step_s;
    const double share = 1.0 / std::sqrt(1.0 + omega * omega * lag_s * lag_s);
    // The command runs straight between samples: (ωΔ)²/8 of its own height.
    EXPECT_NEAR(wave.axes.back()[1], share * std::sin(omega * t - std::atan(omega * lag_s)), 2.5e-4);
}

TEST(MachineError, FilesAreReadAndRefused) {
    const kinematics::Machine machine(head());
    const MachineErrors errors{{"pivot_length_mm", 0.05}, {"zero_A_deg", -0.002}};
    EXPECT_EQ(parseMachineErrors(toToml(errors), "e.toml", machine).value(), errors);
    const auto unknown = parseMachineErrors("schema = 1\n[error]\npivot_mm = 1.0\n", "e.toml", machine);
    ASSERT_FALSE(unknown);
    EXPECT_EQ(base::toText(unknown.error().front()).substr(0, 95),
              "e.toml:3:1: error: error.pivot_mm: this machine has no error 'pivot_mm'; it has pivot_length_mm");
    const auto absurd =
        parseMachineErrors("schema = 1\n[error]\nlag_X_ms = -1.0\nzero_A_deg = 3.0\n", "e.toml", machine);
    ASSERT_FALSE(absurd);
    EXPECT_EQ(absurd.error().errorCount(), 2u);
    EXPECT_EQ(absurd.error().front().code, "machine-error.range");
    EXPECT_FALSE(parseMachineErrors("schema = 2\n[error]\n", "e.toml", machine));
}

TEST(MachineError, RecordsAreReadAndRefused) {
    const kinematics::Machine machine(head());
    const std::string header = "time_s,X_mm,Y_mm,Z_mm,C_deg,A_deg,tip_x_mm,line\n";
    std::istringstream good(header + "0.0,1,2,3,90,45,0,1\n0.002,1,2,4,90,45,0,1\n");
    const auto track = readTrack(good, "r.csv", machine).value();
    EXPECT_EQ(track.size(), 2u);
    EXPECT_NEAR(track.axes[0][3], base::radFromDeg(90.0), 1e-15);
    const auto codeOf = [&](const std::string& text) {
        std::istringstream in(text);
        const auto read = readTrack(in, "r.csv", machine);
        return read ? std::string("read") : base::toText(read.error().front());
    };
    EXPECT_EQ(codeOf(""), "r.csv: error: the record is empty [track.empty]");
    EXPECT_EQ(
        codeOf("time_s,X_mm,Y_mm\n"),
        "r.csv:1: error: the record has no column Z_mm, C_deg, A_deg; cusp controller --record writes them [track.header]");
    EXPECT_EQ(codeOf(header + "0,1,2,three,4,5,6,7\n"), "r.csv:2: error: 'three' is no number [track.number]");
    EXPECT_EQ(codeOf(header + "0,1,2\n"), "r.csv:2: error: the row has 3 columns, 4 are needed [track.columns]");
    EXPECT_EQ(codeOf(header + "1,1,2,3,4,5,6,7\n0,1,2,3,4,5,6,7\n"),
              "r.csv:3: error: time runs backward [track.number]");
}

}  // namespace
}  // namespace cusp::loop
