// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Passes, steps and contacts on surfaces whose answers are known.
#include <cusp/base/units.hpp>
#include <cusp/geometry/surface_file.hpp>
#include <cusp/geometry/surface_forms.hpp>
#include <cusp/optimizer/finishing/finishing_path.hpp>
#include <cusp/optimizer/finishing/path_criteria.hpp>
#include <cusp/simulation/surface_envelope.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace cusp::finishing {
namespace {

using geometry::SurfaceFace;

geometry::Cutter torus() {
    geometry::Cutter cutter;
    cutter.diameter_mm = 16.0;
    cutter.corner_radius_mm = 3.0;
    cutter.corner_e_mm = 5.0;
    cutter.corner_f_mm = 3.0;
    cutter.cutting_height_mm = 32.0;
    return cutter;
}

std::vector<SurfaceFace> benchmark() {
    return geometry::readSurfaceFile(CUSP_SOURCE_DIR "/examples/benchmark/surface.toml").value();
}

/// A saddle that no formula of the planner is made for: z = (x² − y²) / 200 over 60 × 40 mm, x and y both bent in u and v.
std::vector<SurfaceFace> saddle() {
    return geometry::readSurface(
               "schema = 1\nname = \"saddle\"\n[[face]]\nform = \"polynomial\"\noutward = \"du x dv\"\n"
               "x_mm = { \"u\" = 60.0 }\ny_mm = { \"v\" = 35.0, \"v^2\" = 5.0 }\n"
               "z_mm = { \"u^2\" = 18.0, \"u\" = -18.0, \"v^2\" = -8.0, \"v\" = 8.0 }\n",
               "saddle.toml")
        .value();
}

PlanOptions tableRow(double step_over_mm, double lead_deg, double tilt_deg, double tolerance_mm) {
    PlanOptions options;
    options.passes.step_over_mm = step_over_mm;
    options.orientation.lead_rad = base::radFromDeg(lead_deg);
    options.orientation.tilt_rad = base::radFromDeg(tilt_deg);
    options.steps = {StepOptions::Method::Bisection, StepOptions::Measure::Surface, tolerance_mm, 1000.0, 3.0};
    return options;
}

PathCriteria criteriaOf(const ContactPath& path) {
    const std::array cutters{path.cutter};
    return judgeContacts(contactsOf(path), cutters);
}

// Table 2 of Fountas 2017: 337 and 289 contact points, mean chord error 0.0043 and 0.0036 mm; calibrated, not validated.
TEST(Planner, Table2) {
    const auto faces = benchmark();
    const Workpiece part{faces, nullptr};
    const auto ga = planContacts(part, torus(), tableRow(4.927, 3.379, 0.040, 8.451e-3));
    const auto vega = planContacts(part, torus(), tableRow(6.677, 2.957, 0.027, 6.338e-3));
    ASSERT_TRUE(ga.has_value() && vega.has_value());
    EXPECT_NEAR(static_cast<double>(ga->points.size()), 337.0, 0.02 * 337.0);
    EXPECT_NEAR(static_cast<double>(vega->points.size()), 289.0, 0.02 * 289.0);
    EXPECT_NEAR(criteriaOf(*ga).chord_error_mm.mean, 0.0043, 0.15 * 0.0043);
    EXPECT_NEAR(criteriaOf(*vega).chord_error_mm.mean, 0.0036, 0.15 * 0.0036);
}

TEST(Planner, PlanesInAnyDirectionHoldTheirPasses) {
    const auto faces = saddle();
    for (const std::array<double, 3>& normal :
         {std::array{1.0, 0.0, 0.0}, {0.3, 0.9, 0.0}, {-2.0, 1.0, 0.4}, {0.0, 5.0, 1.0}}) {
        PlanOptions options;
        options.passes.plane_normal = normal;
        options.passes.step_over_mm = 2.5;
        const auto passes = layOutPasses(faces, nullptr, torus(), options);
        ASSERT_TRUE(passes.has_value());
        const Vector3 unit = geometry::toVector(normal).normalized();
        double before = 0.0;
        for (std::size_t k = 0; k < passes->size(); ++k) {
            const double height = unit.dot((*passes)[k].position(0.5));
            for (int i = 0; i <= 100; ++i) EXPECT_NEAR(unit.dot((*passes)[k].position(i / 100.0)), height, 2e-4) << k;
            if (k > 0) {
                EXPECT_NEAR(std::abs(height - before), 2.5, 1e-4);
            }
            before = height;
        }
    }
}

TEST(Planner, ArcPlacementIsEvenAlongTheSurfaceEverywhere) {
    const auto faces = benchmark();
    PlanOptions options;
    options.passes.family = PassOptions::Family::ConstantU;
    options.passes.placement = PassOptions::Placement::Arc;
    options.passes.order = PassOptions::Order::OneWay;
    options.passes.step_over_mm = 5.0;
    const auto passes = layOutPasses(faces, nullptr, torus(), options);
    ASSERT_TRUE(passes.has_value());
    for (const double t : {0.0, 0.37, 1.0}) {
        const auto gap = [&](std::size_t k) {  // along the surface, by a dense line across at the same v
            const FaceParameters a = (*passes)[k].parameters(t);
            const FaceParameters b = (*passes)[k + 1].parameters(t);
            double sum = 0.0;
            for (int i = 0; i < 200; ++i) {
                const auto at = faces[0].evaluate(std::lerp(a[0], b[0], (i + 0.5) / 200.0), a[1]);
                const FeedFrame frame =
                    feedFrame(faces[0].normal(std::lerp(a[0], b[0], (i + 0.5) / 200.0), a[1]), at.dv);
                sum += std::abs(at.du.dot(frame.left)) * std::abs(b[0] - a[0]) / 200.0;
            }
            return sum;
        };
        const double first = gap(0);
        EXPECT_LE(first, 5.0 + 1e-6);
        for (std::size_t k = 1; k + 1 < passes->size(); ++k) EXPECT_NEAR(gap(k), first, 2e-3 * first) << t << " " << k;
    }
}

TEST(Planner, StepsKeepTheChordTolerance) {
    const auto faces = saddle();
    for (const auto method : {StepOptions::Method::Bisection, StepOptions::Method::Greedy})
        for (const auto measure : {StepOptions::Measure::Surface, StepOptions::Measure::CutterLocation}) {
            PlanOptions options;
            options.passes.plane_normal = {0.4, 1.0, 0.0};
            options.passes.step_over_mm = 6.0;
            options.orientation.lead_rad = 0.1;
            options.steps = {method, measure, 0.002, 50.0, 3.0};
            const auto passes = layOutPasses(faces, nullptr, torus(), options);
            ASSERT_TRUE(passes.has_value());
            const auto path = walkPasses(*passes, torus(), options);
            ASSERT_TRUE(path.has_value());
            // Far finer points of the same passes against the chords of these.
            PlanOptions dense = options;
            dense.steps = {StepOptions::Method::Greedy, measure, 1e-5, 50.0, 3.0};
            const auto fine = walkPasses(*passes, torus(), dense);
            ASSERT_TRUE(fine.has_value());
            const bool tips = measure == StepOptions::Measure::CutterLocation;
            const auto place = [&](const ContactPoint& at) { return tips ? at.location.tip_mm : at.position; };
            double worst = 0.0;
            for (std::uint32_t k = 0; k < path->passes; ++k)
                for (const ContactPoint& point : fine->pass(k)) {
                    double best = 1e9;
                    const auto chords = path->pass(k);
                    for (std::size_t i = 0; i + 1 < chords.size(); ++i) {
                        const Vector3 from = place(chords[i]);
                        const Vector3 chord = place(chords[i + 1]) - from;
                        const double x = std::clamp(chord.dot(place(point) - from) / chord.squaredNorm(), 0.0, 1.0);
                        best = std::min(best, (place(point) - from - x * chord).norm());
                    }
                    worst = std::max(worst, best);
                }
            EXPECT_LE(worst, 0.002 * 1.02);
            EXPECT_GT(worst, method == StepOptions::Method::Greedy ? 0.0015 : 0.0004);
        }
}

TEST(Planner, AdaptiveLeadNeverLeavesTheCutterFlatterThanTheSurface) {
    const auto faces = benchmark();
    PlanOptions options;
    options.passes.step_over_mm = 5.0;
    options.orientation.adaptive = true;
    options.orientation.curvature_safety = 1.05;
    const auto path = planContacts({faces, nullptr}, torus(), options);
    ASSERT_TRUE(path.has_value());
    for (const ContactPoint& point : path->points)
        EXPECT_LE(effectiveRadius(torus(), point.lead_rad, 0.0) * point.cross_curvature_per_mm, 1.0);
    for (std::size_t i = 1; i < path->points.size(); ++i) {
        const auto& a = path->points[i - 1];
        const auto& b = path->points[i];
        if (a.pass != b.pass) continue;
        EXPECT_LE(std::abs(b.lead_rad - a.lead_rad),
                  1.05 * options.orientation.lead_change_rad_per_mm * (b.position - a.position).norm());
    }
}

TEST(Planner, LinksAreRapidAndStayOffThePart) {
    const auto faces = benchmark();
    PlanOptions options;
    options.passes.step_over_mm = 8.0;
    options.orientation.lead_rad = base::radFromDeg(6.0);
    const auto contacts = planContacts({faces, nullptr}, torus(), options);
    ASSERT_TRUE(contacts.has_value());
    const FinishingPath path = joinPasses(*contacts, {faces, nullptr});
    auto links = cutterPath(path);
    std::size_t contact_points = 0;
    for (const PathMove& move : path.moves) {
        const bool touches = move.contact != PathMove::no_contact;
        contact_points += touches ? 1 : 0;
        EXPECT_EQ(touches, move.kind == toolpath::MotionKind::Feed);
    }
    EXPECT_EQ(contact_points, contacts->points.size());
    std::erase_if(links.moves,
                  [&](const simulation::ToolMove& move) { return move.kind == toolpath::MotionKind::Feed; });
    // From the end of a pass upwards the tool leaves the surface, so the envelope of links is that of the ends: no overcut.
    const auto envelope = simulation::surfaceEnvelope(links, faces, {.spacing_mm = 1.0, .band_mm = 0.5});
    ASSERT_TRUE(envelope.has_value());
    EXPECT_LT(simulation::summaryOf(*envelope, 0.01).overcut_max_mm, 0.002);
}

// A CL file does not hold contacts; found again from the locations alone they are those that were planned.
TEST(Contacts, OfAPlannedPathAreFoundAgain) {
    for (const auto& faces : {benchmark(), saddle()}) {
        PlanOptions options;
        options.passes.step_over_mm = 6.0;
        options.orientation.lead_rad = base::radFromDeg(9.0);
        options.orientation.tilt_rad = base::radFromDeg(-2.0);
        const auto contacts = planContacts({faces, nullptr}, torus(), options);
        ASSERT_TRUE(contacts.has_value());
        const FinishingPath path = joinPasses(*contacts, {faces, nullptr});
        const geometry::ParametricSurface shape(faces);
        const auto found = findContacts(cutterPath(path), shape);
        ASSERT_EQ(found.size(), contacts->points.size());
        EXPECT_EQ(found.back().pass + 1, contacts->passes);
        const auto planned = contactsOf(*contacts);
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_LT((found[i].position - planned[i].position).norm(), 2e-3);
            EXPECT_NEAR(found[i].gap_mm, 0.0, 1e-6);
        }
        const std::array cutters{torus()};
        const auto from_file = judgeContacts(found, cutters);
        const auto from_plan = judgeContacts(planned, cutters);
        EXPECT_NEAR(from_file.chord_error_mm.mean, from_plan.chord_error_mm.mean, 1e-5);
        EXPECT_NEAR(from_file.step_over_mm.mean, from_plan.step_over_mm.mean, 1e-3);
    }
}

// On a cylinder the sagitta of a chord across its axis is R − sqrt(R² − L²/4), exactly, and along a helix eq. 1 with normals
// turned about the chord would give more.
TEST(Criteria, ChordErrorOfACylinder) {
    constexpr double radius = 50.0;
    const auto contact = [&](double angle, double along) {
        CutContact out;
        out.frame.normal = {std::cos(angle), std::sin(angle), 0.0};
        out.position = radius * out.frame.normal + along * Vector3::UnitZ();
        return out;
    };
    for (const double angle : {0.01, 0.1, 0.4}) {
        const double length = 2.0 * radius * std::sin(angle / 2.0);
        EXPECT_NEAR(chordError(contact(0.0, 0.0), contact(angle, 0.0)),
                    radius - std::sqrt(radius * radius - length * length / 4.0), 1e-12);
    }
    // Helix at 45°: the normal section there has the curvature 1 / (2 R), the sagitta of a short chord L² / (16 R).
    const auto from = contact(0.0, 0.0);
    const auto to = contact(0.02, 0.02 * radius);
    const double length = (to.position - from.position).norm();
    EXPECT_NEAR(chordError(from, to), length * length / (16.0 * radius), 1e-3 * length * length / (16.0 * radius));
}

}  // namespace
}  // namespace cusp::finishing
