// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Sections that are no simple curve: folded, closed, in pieces; measured in any order; against closed forms.
#include "analytic_shapes.hpp"

#include <cusp/geometry/parametric_surface.hpp>
#include <cusp/geometry/surface_file.hpp>
#include <cusp/inspect/section.hpp>

#include <gtest/gtest.h>
#include <numbers>

namespace cusp::inspect::test {
namespace {

using geometry::RigidTransform;

std::vector<SectionResult> sectionOf(const MeasuredPoints& points, const geometry::NominalShape& nominal, int axis,
                                     double position_mm) {
    const auto d = deviationsOf(points.positions, RigidTransform::Identity(), nominal, 0.0);
    return cutSections({.axis = axis, .positions_mm = {position_mm}, .width_mm = 0.5}, points, d, nominal, 0.1);
}

/// Nearest of several shapes.
class Several : public SingleShape {
public:
    explicit Several(std::vector<const geometry::NominalShape*> shapes) : shapes_(std::move(shapes)) {}
    using SingleShape::closest;
    Footpoint closest(const Vector3& q) const override {
        Footpoint best = shapes_.front()->closest(q);
        for (const auto* shape : shapes_)
            if (const Footpoint foot = shape->closest(q); std::abs(foot.distance_mm) < std::abs(best.distance_mm))
                best = foot;
        return best;
    }
    Eigen::AlignedBox3d bounds() const override {
        Eigen::AlignedBox3d out;
        for (const auto* shape : shapes_) out.extend(shape->bounds());
        return out;
    }

private:
    std::vector<const geometry::NominalShape*> shapes_;
};

/// A tongue folded over: z(u) and x(u) run out and back, an S on its side; extruded along y.
geometry::ParametricSurface foldedSheet() {
    const auto faces = geometry::readSurface(R"(
schema = 1
name = "S"
[[face]]
form = "bezier"
outward = "du x dv"
points_mm = [[[0, 0, 0], [0, 40, 0]], [[90, 0, 0], [90, 40, 0]], [[-60, 0, 30], [-60, 40, 30]], [[30, 0, 30], [30, 40, 30]]]
)",
                                             "S");
    return geometry::ParametricSurface(faces.value());
}

TEST(SectionOrder, AFoldedSectionIsFollowedAroundItsFolds) {
    const geometry::ParametricSurface sheet = foldedSheet();
    const geometry::SurfaceFace& face = sheet.faces().front();
    MeasuredPoints points;
    std::vector<double> truth;
    double length = 0.0;
    constexpr int steps = 40000;
    for (int i = 0; i <= steps; ++i) {
        if (i > 0)
            length +=
                (face.evaluate(double(i) / steps, 0.5).position - face.evaluate(double(i - 1) / steps, 0.5).position)
                    .norm();
        if (i % 200 != 0) continue;
        points.positions.push_back(face.evaluate(double(i) / steps, 0.5).position);
        truth.push_back(length);
    }
    // Measured in a random order: nothing but the shape says how they follow.
    base::Random random(5);
    std::vector<std::size_t> order(points.positions.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    random.shuffle(order);
    MeasuredPoints shuffled;
    for (const std::size_t i : order) shuffled.positions.push_back(points.positions[i]);
    const SectionResult section = sectionOf(shuffled, sheet, 1, 20.0).front();
    ASSERT_EQ(section.points.size(), truth.size());
    EXPECT_EQ(section.piece_starts, (std::vector<std::uint32_t>{0}));
    const bool forwards = order[section.points.front()] == 0;
    for (std::size_t k = 0; k < truth.size(); ++k) {
        const std::size_t at = forwards ? k : truth.size() - 1 - k;
        ASSERT_EQ(order[section.points[k]], at);
        EXPECT_NEAR(section.arc_length_mm[k], forwards ? truth[at] : truth.back() - truth[at], 1e-4);
    }
}

TEST(SectionOrder, PiecesThatLieOverOneAnotherAreKeptApart) {
    // Two bowls, one 8 mm over the other; both look up, so their sections run the same way.
    const Patch low = benchmarkPatch();
    const Patch high = benchmarkPatch(Vector3(0.0, 0.0, 8.0));
    const Several both({&low, &high});
    MeasuredPoints points;
    const double v = 0.695;
    for (int i = 0; i <= 150; ++i)
        for (const Patch* patch : {&low, &high}) points.positions.push_back(patch->at(0.02 + 0.96 * i / 150.0, v));
    const SectionResult section = sectionOf(points, both, 0, low.at(0.0, v).x()).front();
    ASSERT_EQ(section.piece_starts, (std::vector<std::uint32_t>{0, 151}));
    for (std::uint32_t k = 0; k <= 150; ++k) {
        EXPECT_EQ(section.points[k], 2 * k);
        EXPECT_EQ(section.points[151 + k], 2 * k + 1);
    }
    const double joint = section.arc_length_mm[151] - section.arc_length_mm[150];
    EXPECT_NEAR(section.length_mm, section.arc_length_mm.back() - joint, 1e-9);
    EXPECT_LT(joint, 1.5);  // a usual step, and no chord of 100 mm back
    EXPECT_NEAR(section.arc_length_mm[150], section.arc_length_mm[301] - section.arc_length_mm[151], 1e-6);
}

TEST(SectionOrder, AHoleIsNoPieceButAGapOfTheNominalIs) {
    const Sphere ball(Vector3::Zero(), 10.0);
    const Sphere other(Vector3(0.0, 30.0, 0.0), 10.0);
    const Several both({&ball, &other});
    const auto at = [](double degrees, double y) {
        const double a = degrees * std::numbers::pi / 180.0;
        return Vector3(10.0 * std::cos(a), y + 10.0 * std::sin(a), 0.0);
    };
    MeasuredPoints hole;  // nothing measured over a third of the arc
    for (int i = -100; i <= 100; ++i)
        if (std::abs(i) >= 35) hole.positions.push_back(at(i, 0.0));
    const SectionResult one = sectionOf(hole, ball, 2, 0.0).front();
    EXPECT_EQ(one.piece_starts.size(), 1U);
    EXPECT_NEAR(one.length_mm, 200.0 / 180.0 * std::numbers::pi * 10.0, 2e-4);
    MeasuredPoints two;
    for (int i = 0; i < 360; ++i) two.positions.push_back(at(i, 0.0));
    for (int i = 0; i < 360; ++i) two.positions.push_back(at(i, 30.0));
    const SectionResult balls = sectionOf(two, both, 2, 0.0).front();
    EXPECT_EQ(balls.piece_starts, (std::vector<std::uint32_t>{0, 360}));
    for (std::uint32_t k = 0; k < 720; ++k) EXPECT_EQ(balls.points[k], k);  // closed ones begin where they were begun
}

TEST(SectionOrder, RandomSpacingIsOnePiece) {
    const Patch patch = benchmarkPatch();
    base::Random random(8);
    MeasuredPoints points;
    std::vector<double> places;
    for (int i = 0; i < 3000; ++i) {
        places.push_back(random.uniform(0.01, 0.99));
        points.positions.push_back(patch.at(places.back(), 0.4));
    }
    const SectionResult section = sectionOf(points, patch, 0, patch.at(0.0, 0.4).x()).front();
    EXPECT_EQ(section.piece_starts.size(), 1U);
    const double sign = places[section.points.back()] - places[section.points.front()];
    for (std::size_t k = 1; k < section.points.size(); ++k)
        EXPECT_GT(sign * (places[section.points[k]] - places[section.points[k - 1]]), 0.0);
}

TEST(SectionOrder, SharpCornersAreRounded) {
    // A square bar, 20 mm wide: the section is its outline.
    std::string text = "schema = 1\nname = \"bar\"\n";
    const double c[5][2] = {{-10, -10}, {10, -10}, {10, 10}, {-10, 10}, {-10, -10}};
    for (int side = 0; side < 4; ++side) {
        const auto corner = [&](int k, int z) {
            return "[" + std::to_string(c[k][0]) + ", " + std::to_string(c[k][1]) + ", " + std::to_string(z) + "]";
        };
        text += "[[face]]\nform = \"bezier\"\noutward = \"du x dv\"\npoints_mm = [[" + corner(side, 0) + ", " +
                corner(side, 30) + "], [" + corner(side + 1, 0) + ", " + corner(side + 1, 30) + "]]\n";
    }
    const geometry::ParametricSurface bar(geometry::readSurface(text, "bar").value());
    MeasuredPoints points;
    for (int side = 0; side < 4; ++side)
        for (int k = 0; k < 20; ++k) {
            const double t = (k + 0.3) / 20.0;
            points.positions.emplace_back(c[side][0] + t * (c[side + 1][0] - c[side][0]),
                                          c[side][1] + t * (c[side + 1][1] - c[side][1]), 15.0);
        }
    const SectionResult section = sectionOf(points, bar, 2, 15.0).front();
    EXPECT_EQ(section.piece_starts.size(), 1U);
    for (std::uint32_t k = 0; k < 80; ++k) EXPECT_EQ(section.points[k], k);
    // What lies between two points across a corner is longer than the chord and shorter than the way round it.
    EXPECT_GT(section.length_mm, 76.0 + 3.0 * std::hypot(0.7, 0.3) - 1e-9);
    EXPECT_LT(section.length_mm, 79.0 + 1e-9);
}

}  // namespace
}  // namespace cusp::inspect::test
