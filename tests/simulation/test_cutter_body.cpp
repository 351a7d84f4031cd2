// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The body of a cutter against distances known by construction, and the cutters that are none.
#include "envelope_scenes.hpp"

#include <cusp/simulation/cutter_body.hpp>

#include <cusp/base/random.hpp>

#include <gtest/gtest.h>

#include <numbers>

namespace {

using namespace cusp;
using simulation::CutterBody;

TEST(CutterBody, BallIsItsSphereAndItsShank) {
    const auto body = CutterBody::make(test_support::ballCutter(10.0, 40.0)).value();
    EXPECT_NEAR(body.at(0.0, -1.0).distance_mm, 1.0, 1e-14);
    EXPECT_NEAR(body.at(3.0, 5.0 - 4.0).distance_mm, 0.0, 1e-14);
    EXPECT_NEAR(body.at(6.0, 5.0 - 8.0).distance_mm, 5.0, 1e-14);
    EXPECT_NEAR(body.at(7.0, 20.0).distance_mm, 2.0, 1e-14);
    EXPECT_NEAR(body.at(0.0, 42.0).distance_mm, 2.0, 1e-14);
    EXPECT_LT(body.at(0.0, 5.0).distance_mm, 0.0);
}

TEST(CutterBody, FlatAndToroid) {
    const auto flat = CutterBody::make(test_support::toroidalCutter(10.0, 0.0)).value();
    EXPECT_NEAR(flat.at(4.0, -2.0).distance_mm, 2.0, 1e-14);
    EXPECT_NEAR(flat.at(8.0, -4.0).distance_mm, 5.0, 1e-14);
    const auto toroid = CutterBody::make(test_support::toroidalCutter(16.0, 3.0)).value();
    EXPECT_NEAR(toroid.at(5.0 + 3.0, 3.0 - 4.0).distance_mm, 2.0, 1e-14);
    EXPECT_NEAR(toroid.at(2.0, -0.5).distance_mm, 0.5, 1e-14);
}

TEST(CutterBody, PartsOfATaperedCutterMeetSmoothly) {
    // d is where the flank meets the tip's plane; point angle 10°, taper 15°, corner 2 mm.
    const double degree = std::numbers::pi / 180.0;
    const geometry::Cutter cutter{12.0, 2.0, 0.0, 0.0, 10.0 * degree, 15.0 * degree, 30.0};
    const auto body = CutterBody::make(cutter).value();
    EXPECT_NEAR(body.at(0.0, 0.0).distance_mm, 0.0, 1e-14);
    const double up = 20.0;
    EXPECT_NEAR(body.at(6.0 + up * std::tan(cutter.taper_angle_rad), up).distance_mm, 0.0, 1e-13);
    EXPECT_NEAR(body.largestRadius(), 6.0 + 30.0 * std::tan(cutter.taper_angle_rad), 1e-13);
}

TEST(CutterBody, DerivativesAreThoseOfTheDistanceAndItIsConvex) {
    base::Random random(5);
    const auto body = CutterBody::make({12.0, 2.0, 0.0, 0.0, 0.2, 0.3, 30.0}).value();
    int on_seams = 0;
    for (int i = 0; i < 20000; ++i) {
        const double rho = random.uniform(0.1, 20.0);
        const double z = random.uniform(-10.0, 40.0);
        constexpr double h = 1e-6;
        const auto value = body.at(rho, z);
        const double by_rho = (body.at(rho + h, z).distance_mm - body.at(rho - h, z).distance_mm) / (2.0 * h);
        const double by_z = (body.at(rho, z + h).distance_mm - body.at(rho, z - h).distance_mm) / (2.0 * h);
        on_seams += std::abs(by_rho - value.by_rho) > 1e-5 || std::abs(by_z - value.by_z) > 1e-5 ? 1 : 0;
        const double rho_b = random.uniform(0.0, 20.0);
        const double z_b = random.uniform(-10.0, 40.0);
        EXPECT_LE(body.at(0.5 * (rho + rho_b), 0.5 * (z + z_b)).distance_mm,
                  0.5 * (value.distance_mm + body.at(rho_b, z_b).distance_mm) + 1e-12);
    }
    // Where two parts meet inside the body the derivative jumps; a random point is hardly ever within 1 µm of that.
    EXPECT_LE(on_seams, 2);
}

TEST(CutterBody, ImpossibleCuttersAreNamed) {
    const auto says = [](const geometry::Cutter& cutter) { return toText(CutterBody::make(cutter).error()); };
    EXPECT_EQ(says({0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 10.0}),
              "error: a cutter of diameter 0 mm and corner radius 0 mm is not possible [simulation.cutter]\n");
    EXPECT_EQ(says({10.0, 6.0, 0.0, 0.0, 0.0, 0.0, 10.0}),
              "error: a cutter of diameter 10 mm and corner radius 6 mm is not possible [simulation.cutter]\n");
    EXPECT_EQ(
        says({10.0, 1.0, 4.0, 1.0, -0.1, 0.0, 10.0}),
        "error: the bottom of the cutter must rise outwards and its flank widen upwards, by less than 90° together "
        "[simulation.cutter]\n");
    EXPECT_EQ(
        says({10.0, 1.0, 3.0, 1.0, 0.0, 0.0, 10.0}),
        "error: the corner arc of the cutter does not meet its bottom and flank: its centre is stated at e = 3 mm, "
        "f = 1 mm, where e = 4.0000 mm, f = 1.0000 mm would be [simulation.cutter]\n");
}

}  // namespace
