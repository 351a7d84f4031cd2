// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// How a tool stands on a surface, against closed forms and against the turned body of the simulation.
#include <cusp/base/random.hpp>
#include <cusp/optimizer/finishing/tool_placement.hpp>
#include <cusp/simulation/cutter_body.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace cusp::finishing {
namespace {

geometry::Cutter cutterOf(double diameter_mm, double corner_mm) {
    geometry::Cutter cutter;
    cutter.diameter_mm = diameter_mm;
    cutter.corner_radius_mm = corner_mm;
    cutter.corner_e_mm = diameter_mm / 2.0 - corner_mm;
    cutter.corner_f_mm = corner_mm;
    cutter.cutting_height_mm = 30.0;
    return cutter;
}

Vector3 anyDirection(base::Random& random) {
    return Vector3(random.normal(), random.normal(), random.normal()).normalized();
}

TEST(ToolPlacement, AnglesComeBack) {
    base::Random random(7101);
    for (int i = 0; i < 2000; ++i) {
        const FeedFrame frame = feedFrame(anyDirection(random), anyDirection(random));
        const double lead = random.uniform(-1.2, 1.2);
        const double tilt = random.uniform(-1.2, 1.2);
        const Vector3 axis = toolAxis(frame, lead, tilt);
        EXPECT_NEAR(axis.norm(), 1.0, 1e-15);
        const LeadTilt back = leadTiltOf(frame, axis);
        EXPECT_NEAR(back.lead_rad, lead, 1e-12);
        EXPECT_NEAR(back.tilt_rad, tilt, 1e-12);
    }
}

TEST(ToolPlacement, LeadLeansToTheFeedAndTiltToItsLeft) {
    const FeedFrame frame = feedFrame(Vector3::UnitZ(), Vector3::UnitX());
    EXPECT_TRUE(frame.left.isApprox(Vector3::UnitY()));
    EXPECT_GT(toolAxis(frame, 0.1, 0.0).x(), 0.0);
    EXPECT_GT(toolAxis(frame, 0.0, 0.1).y(), 0.0);
}

// The simulation's body knows nothing of contacts: the contact must lie on it, and its normal there be the surface's.
TEST(ToolPlacement, TheContactIsOnTheCutterWithTheSurfacesNormal) {
    base::Random random(7102);
    for (const auto& [diameter, corner] : {std::pair{16.0, 3.0}, {16.0, 8.0}, {8.0, 0.5}, {12.0, 1e-4}}) {
        const geometry::Cutter cutter = cutterOf(diameter, corner);
        const auto body = simulation::CutterBody::make(cutter);
        ASSERT_TRUE(body.has_value());
        for (int i = 0; i < 500; ++i) {
            const FeedFrame frame = feedFrame(anyDirection(random), anyDirection(random));
            const Vector3 contact(random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0),
                                  random.uniform(-50.0, 50.0));
            const Vector3 axis = toolAxis(frame, random.uniform(0.01, 0.6), random.uniform(-0.4, 0.4));
            const auto at = placeTool(cutter, contact, frame, axis);
            const auto distanceAt = [&](const Vector3& point) {
                const Vector3 away = point - at.tip_mm;
                const double z = away.dot(axis);
                return body->at(std::sqrt(std::max(0.0, away.squaredNorm() - z * z)), z).distance_mm;
            };
            EXPECT_NEAR(distanceAt(contact), 0.0, 1e-9);
            constexpr double out_mm = 0.01;
            EXPECT_NEAR(distanceAt(contact - out_mm * frame.normal), out_mm, 1e-8);
        }
    }
}

TEST(ToolPlacement, UprightTheForemostPointTouches) {
    const FeedFrame frame = feedFrame(Vector3::UnitZ(), Vector3::UnitX());
    const auto at = placeTool(cutterOf(16.0, 3.0), Vector3::Zero(), frame, Vector3::UnitZ());
    EXPECT_TRUE(at.tip_mm.isApprox(Vector3(-5.0, 0.0, 0.0), 1e-12));
}

TEST(EffectiveRadius, IsThatOfThePapersTable) {
    // R_eff of D16 r3 at a lead of 3.379°, tilt 0.040°: (8 − 3) / sin + 3, the tilt changes the seventh digit.
    const double lead = 3.379 * std::acos(-1.0) / 180.0;
    EXPECT_NEAR(effectiveRadius(cutterOf(16.0, 3.0), lead, 0.0), 5.0 / std::sin(lead) + 3.0, 1e-12);
    EXPECT_DOUBLE_EQ(effectiveRadius(cutterOf(16.0, 8.0), lead, 0.3), 8.0);
    EXPECT_TRUE(std::isinf(effectiveRadius(cutterOf(16.0, 0.0), 0.0, 0.0)));
}

TEST(EffectiveRadius, AtTheMatchedLeadIsTheRadiusOfTheSurface) {
    for (const double corner : {0.0, 1.0, 3.0})
        for (const double curvature : {0.004, 0.018, 0.05}) {
            const geometry::Cutter cutter = cutterOf(16.0, corner);
            const auto lead = matchedLead(cutter, curvature);
            ASSERT_TRUE(lead.has_value());
            EXPECT_NEAR(effectiveRadius(cutter, *lead, 0.0), 1.0 / curvature, 1e-9 / curvature);
        }
    EXPECT_EQ(matchedLead(cutterOf(16.0, 3.0), -0.02), 0.0);
    EXPECT_EQ(matchedLead(cutterOf(16.0, 3.0), 0.5), std::nullopt);  // radius 2 is smaller than the corner
    EXPECT_EQ(matchedLead(cutterOf(16.0, 3.0), 0.2), std::nullopt);  // radius 5: the disc does not fit at any lead
}

/// The ridge by search: the lowest height on the bisector that no circle covers.
double ridgeBySearch(double step, double radius, double curvature) {
    const double half = step / 2.0;
    const double surface =
        1.0 / curvature;  // signed; its centre at (0, surface), the surface passes through the origin
    const double angle = half / surface;
    const Vector3 center(std::sin(angle) * (surface - radius), surface - std::cos(angle) * (surface - radius), 0.0);
    double low = -1.0;
    double high = radius;
    for (int i = 0; i < 200; ++i) {
        const double middle = (low + high) / 2.0;
        ((Vector3(0.0, middle, 0.0) - center).norm() > radius ? low : high) = middle;
    }
    return low;
}

TEST(Scallop, IsTheRidgeBetweenTwoCircles) {
    for (const double curvature : {0.002, 0.01, -0.01, -0.05})
        for (const double step : {0.5, 3.0, 7.0})
            for (const double radius : {8.0, 40.0, 60.0})
                EXPECT_NEAR(scallopHeight(step, radius, curvature), ridgeBySearch(step, radius, curvature), 1e-9)
                    << curvature << " " << step << " " << radius;
    EXPECT_NEAR(scallopHeight(2.0, 8.0, 0.0), 8.0 - std::sqrt(63.0), 1e-14);
    EXPECT_LT(scallopHeight(5.0, 100.0, 0.02), 0.0);  // flatter than the surface is hollow
}

TEST(EdgeUndercut, IsWhatTheRoundedEdgeStaysAbove) {
    // Support of a torus against that of its sharp rim, directly.
    constexpr double edge = 0.8;
    constexpr double lead = 0.06;
    const double sharp = 8.0 * std::sin(lead);
    const double rounded = (8.0 - edge) * std::sin(lead) - edge * std::cos(lead) + edge;
    EXPECT_NEAR(edgeUndercut(edge, lead), sharp - rounded, 1e-15);
}

}  // namespace
}  // namespace cusp::finishing
