// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The envelope where a formula says what is left: balls on plane, cylinder and sphere, an inclined toroid on a plane.
#include "envelope_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace {

using namespace cusp;
using namespace cusp::simulation;
using namespace cusp::test_support;
using geometry::Vector3;

constexpr double bound_mm = 2e-6;

TEST(EnvelopeClosedForm, BallPassesOnAPlaneLeaveTheScallop) {
    const double radius = 5.0;
    const double step = 1.6;  // so that the grid has points on the ridges
    const Vector3 axis = Vector3(0.2, -0.1, 1.0).normalized();
    std::vector<ToolMove> moves;
    for (int pass = -8; pass <= 8; ++pass) {
        const Vector3 center(0.0, pass * step, radius);
        const Vector3 way(30.0, 0.0, 0.0);
        moves.push_back(move(center - radius * axis - way, center - radius * axis + way, axis));
    }
    const auto envelope = envelopeOf(pathOf(ballCutter(2.0 * radius), moves), {planeFace(10.0)}, {0.2, 1.0});
    for (std::size_t i = 0; i < envelope.points.size(); ++i) {
        const double y = envelope.grid.points[i].position.y();
        const double off = y - step * std::round(y / step);
        ASSERT_NEAR(envelope.points[i].deviation_mm, radius - std::sqrt(radius * radius - off * off), bound_mm);
    }
    const auto sum = summaryOf(envelope, 0.01);
    EXPECT_EQ(sum.reached, sum.points);
    EXPECT_NEAR(sum.undercut_max_mm, radius - std::sqrt(radius * radius - step * step / 4.0), bound_mm);
    EXPECT_LE(sum.overcut_max_mm, bound_mm);
}

/// What a ball whose centre is `far` from the axis or centre of a round part of radius `part` leaves at `angle` from it.
double ballOnRound(double part, double radius, double far, double angle, double band) {
    const double root = radius * radius - std::pow(far * std::sin(angle), 2);
    return root < 0.0 ? band : std::min(band, far * std::cos(angle) - std::sqrt(root) - part);
}

TEST(EnvelopeClosedForm, BallAlongACylinder) {
    const double part = 40.0;
    const double radius = 6.0;
    const auto path = pathOf(ballCutter(2.0 * radius), {move({-50, 0, part}, {50, 0, part}, Vector3::UnitZ())});
    const auto envelope = envelopeOf(path, {cylinderFace(part, 20.0)}, {0.3, 2.0});
    std::size_t met = 0;
    for (std::size_t i = 0; i < envelope.points.size(); ++i) {
        const Vector3& p = envelope.grid.points[i].position;
        const double expected = ballOnRound(part, radius, part + radius, std::atan2(p.y(), p.z()), 2.0);
        ASSERT_NEAR(envelope.points[i].deviation_mm, expected, bound_mm);
        met += expected < 2.0 ? 1 : 0;
    }
    EXPECT_GT(met, 1000U);
}

TEST(EnvelopeClosedForm, BallPressedIntoASphere) {
    // The tool stands still, 0.05 mm too deep, its axis askew.
    const double part = 30.0;
    const double radius = 4.0;
    const Vector3 outwards = Vector3(0.3, 0.2, 0.9).normalized();
    const Vector3 axis = Vector3(0.1, 0.2, 1.0).normalized();
    const Vector3 tip = (part + radius - 0.05) * outwards - radius * axis;
    const auto envelope =
        envelopeOf(pathOf(ballCutter(2.0 * radius), {move(tip, tip, axis)}), {sphereFace(part)}, {0.1, 0.5});
    for (std::size_t i = 0; i < envelope.points.size(); ++i) {
        const double angle = geometry::angleBetween(envelope.grid.points[i].position, outwards);
        ASSERT_NEAR(envelope.points[i].deviation_mm, ballOnRound(part, radius, part + radius - 0.05, angle, 0.5),
                    bound_mm);
    }
    EXPECT_NEAR(summaryOf(envelope, 0.01).overcut_max_mm, 0.05, 1e-3);
}

/// Height above the plane, over y, that an inclined toroid drawn along X leaves. Seen along X its corner circle (radius e) is
/// an ellipse of semi-axes e and e·sin(lead), and the toroid is that ellipse thickened by the corner radius.
double toroidHeight(double e, double corner, double lead, double y) {
    const double lift = corner + e * std::sin(lead);
    const auto at = [&](double phi) {
        const double ny = std::sin(phi) * std::sin(lead);
        const double nz = -std::cos(phi);
        const double norm = std::hypot(ny, nz);
        return std::pair(e * std::sin(phi) + corner * ny / norm,
                         lift - e * std::sin(lead) * std::cos(phi) + corner * nz / norm);
    };
    double low = 0.0;
    double high = std::numbers::pi / 2.0;
    for (int i = 0; i < 80; ++i) {
        const double mid = 0.5 * (low + high);
        (at(mid).first < std::abs(y) ? low : high) = mid;
    }
    return at(low).second;
}

TEST(EnvelopeClosedForm, InclinedToroidOnAPlaneLeavesTheOffsetOfAnEllipse) {
    const double corner = 3.0;
    const double e = 5.0;
    for (const double lead_deg : {0.7, 3.0, 12.0}) {
        const double lead = lead_deg * std::numbers::pi / 180.0;
        const Vector3 axis(std::sin(lead), 0.0, std::cos(lead));
        // The lowest point of the corner circle is e·sin(lead) below its centre, which is `corner` above the tip.
        const Vector3 tip = Vector3(0, 0, corner + e * std::sin(lead)) - corner * axis;
        const Vector3 way(40, 0, 0);
        const auto envelope = envelopeOf(pathOf(toroidalCutter(16.0, corner), {move(tip - way, tip + way, axis)}),
                                         {planeFace(9.0)}, {0.17, 1.0});
        for (std::size_t i = 0; i < envelope.points.size(); ++i) {
            const double y = envelope.grid.points[i].position.y();
            if (std::abs(std::abs(y) - 8.0) < 1e-3) continue;  // on the flank, where the height jumps
            const double expected = std::abs(y) < 8.0 ? std::min(1.0, toroidHeight(e, corner, lead, y)) : 1.0;
            ASSERT_NEAR(envelope.points[i].deviation_mm, expected, bound_mm) << "lead " << lead_deg << " y " << y;
        }
    }
}

TEST(EnvelopeClosedForm, FlatCutterSideOnAWall) {
    // The axis lies in the plane, the flank is 0.02 mm in it; the cut ends with the cutting height.
    const auto path =
        pathOf(toroidalCutter(10.0, 0.0, 12.0), {move({-20, -6, 5.0 - 0.02}, {20, -6, 5.0 - 0.02}, Vector3::UnitY())});
    const auto envelope = envelopeOf(path, {planeFace(10.0)}, {0.25, 1.0});
    for (std::size_t i = 0; i < envelope.points.size(); ++i) {
        const double y = envelope.grid.points[i].position.y();
        if (std::abs(std::abs(y) - 6.0) < 1e-6) continue;  // on the rim
        ASSERT_NEAR(envelope.points[i].deviation_mm, std::abs(y) < 6.0 ? -0.02 : 1.0, bound_mm) << y;
    }
}

TEST(EnvelopeClosedForm, OptionsAndPathsThatAreNoneAreNamed) {
    const std::vector faces{planeFace(1.0)};
    EXPECT_EQ(toText(surfaceEnvelope({}, faces, {0.0, -1.0}).error()),
              "error: the grid spacing is 0 mm; it must be positive [simulation.option]\n"
              "error: the band is -1 mm; it must be positive [simulation.option]\n"
              "error: the path has no moves of a tool whose shape is known [simulation.no-moves]\n");
}

}  // namespace
