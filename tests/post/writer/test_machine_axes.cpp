// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Positions of all axes against a closed form, and the chord bound against walking every move in small steps.
#include "machine_axes.hpp"

#include <cusp/base/random.hpp>
#include <cusp/base/units.hpp>

#include <filesystem>
#include <gtest/gtest.h>

namespace cusp::post {
namespace {

using geometry::Vector3;

constexpr std::uint64_t seed = 715;

MachineFile shipped(const std::string& name) {
    return readMachineFile(CUSP_SOURCE_DIR "/machines/" + name + ".toml").value();
}

TEST(MachineAxes, AForkHeadByItsTextbookFormula) {
    // M = P + (Lp + Lt)(u − ez), u = (sin C sin A, −cos C sin A, cos A): pivot 220 mm above the gauge point.
    const MachineFile file = shipped("head-c200-a95");
    const kinematics::Machine machine(file.machine);
    MachineAxes axes(machine, file.control.format);
    axes.setUp(130.0, Vector3::Zero());
    EXPECT_TRUE(axes.needsToolLength());
    EXPECT_FALSE(axes.needsOrigin());
    base::Random random(seed);
    for (int i = 0; i < 200; ++i) {
        const double c = random.uniform(-3.4, 3.4);
        const double a = random.uniform(-1.6, 1.6);
        const Vector3 tip(random.uniform(-500, 500), random.uniform(-500, 500), random.uniform(-500, 500));
        const Vector3 u(std::sin(c) * std::sin(a), -std::cos(c) * std::sin(a), std::cos(a));
        const Vector3 programmed = *axes.programmedFromWorkpiece({c, a}) * tip;
        EXPECT_LT((programmed - (tip + (220.0 + 130.0) * (u - Vector3::UnitZ()))).norm(), 1e-9);
    }
}

TEST(MachineAxes, ForwardKinematicsGivesTheTipBack) {
    base::Random random(seed);
    for (const std::string name : {"fooke-endura-ca", "head-c200-a95", "nutating-45", "trunnion-ac", "haas-umc-bc"}) {
        const MachineFile file = shipped(name);
        const kinematics::Machine machine(file.machine);
        MachineAxes axes(machine, file.control.format);
        const Vector3 origin(33.0, -17.0, 81.0);
        axes.setUp(95.0, origin);
        // X, Y, Z of these machines lie along the machine frame: what is programmed is the position but for a shift.
        const Vector3 shift = *axes.programmedFromWorkpiece({0.0, 0.0}) * Vector3::Zero() -
                              *machine.solveLinear(origin, {0.0, 0.0}, 95.0);
        for (int i = 0; i < 100; ++i) {
            const kinematics::RotaryValues rotary{random.uniform(-3.0, 3.0), random.uniform(-1.5, 1.5)};
            const Vector3 tip(random.uniform(-200, 200), random.uniform(-200, 200), random.uniform(-200, 200));
            const Vector3 linear = *axes.programmedFromWorkpiece(rotary) * tip - shift;
            EXPECT_LT((machine.forward({linear, rotary}, 95.0).tip_mm - origin - tip).norm(), 1e-9) << name;
        }
    }
}

TEST(MachineAxes, TheChordBoundIsABoundAndATightOne) {
    base::Random random(seed);
    for (const std::string name : {"fooke-endura-ca", "head-c200-a95", "nutating-45", "trunnion-ac", "haas-umc-bc"}) {
        const MachineFile file = shipped(name);
        const kinematics::Machine machine(file.machine);
        MachineAxes axes(machine, file.control.format);
        axes.setUp(120.0, Vector3(10.0, 20.0, 30.0));
        double loosest = 0.0;
        for (int i = 0; i < 300; ++i) {
            // From tenths of a degree to half a turn.
            const double size = std::pow(10.0, random.uniform(-3.0, 0.5));
            MachineAxes::Position from{.point_mm = {random.uniform(-200, 200), random.uniform(-200, 200), 50.0},
                                       .rotary_rad = {random.uniform(-3.0, 3.0), random.uniform(-1.5, 1.5)}};
            MachineAxes::Position to = from;
            for (std::size_t k = 0; k < 2; ++k) to.rotary_rad[k] += size * random.uniform(-1.0, 1.0);
            for (Eigen::Index k = 0; k < 3; ++k) to.point_mm[k] += 100.0 * size * random.uniform(-1.0, 1.0);
            const auto tip_at = [&](double s) {
                const kinematics::RotaryValues rotary{std::lerp(from.rotary_rad[0], to.rotary_rad[0], s),
                                                      std::lerp(from.rotary_rad[1], to.rotary_rad[1], s)};
                const Vector3 point = from.point_mm + s * (to.point_mm - from.point_mm);
                return Vector3(axes.programmedFromWorkpiece(rotary)->inverse() * point);
            };
            double walked = 0.0;
            for (int step = 1; step < 400; ++step) {
                const double s = step / 400.0;
                walked = std::max(walked, (tip_at(s) - (tip_at(0.0) + s * (tip_at(1.0) - tip_at(0.0)))).norm());
            }
            const double bound = axes.chordError(from, to);
            ASSERT_GE(bound, walked * (1.0 - 1e-9))
                << name << ", size " << size << ", trial " << i << ", seed " << seed;
            if (size < 0.02 && walked > 1e-4) loosest = std::max(loosest, bound / walked);
        }
        // Small moves, which are what linearisation ends with, are not divided more than they have to be.
        EXPECT_LT(loosest, 1.2) << name;
        EXPECT_GT(loosest, 0.0) << name;
    }
}

}  // namespace
}  // namespace cusp::post
