// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Surfaces, cutters and paths that tests of the envelope are made of.
#include "envelope_scenes.hpp"

#include <cusp/geometry/surface_file.hpp>
#include <cusp/geometry/surface_forms.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

namespace cusp::test_support {

using geometry::Vector3;

geometry::Cutter toroidalCutter(double diameter_mm, double corner_mm, double height_mm) {
    return {diameter_mm, corner_mm, diameter_mm / 2.0 - corner_mm, corner_mm, 0.0, 0.0, height_mm};
}

geometry::Cutter ballCutter(double diameter_mm, double height_mm) {
    return toroidalCutter(diameter_mm, diameter_mm / 2.0, height_mm);
}

geometry::SurfaceFace planeFace(double half_mm) {
    const double h = half_mm;
    geometry::BezierForm form;
    form.points = {{Vector3(-h, -h, 0), Vector3(-h, h, 0)}, {Vector3(h, -h, 0), Vector3(h, h, 0)}};
    return geometry::toFace(form, geometry::Outward::DuCrossDv).value();
}

geometry::SurfaceFace cylinderFace(double radius_mm, double half_mm) {
    // A quarter circle as a rational quadratic: the middle point where the tangents meet, its weight cos 45°.
    const double c = radius_mm * std::sqrt(0.5);
    geometry::BezierForm form;
    for (const double x : {-half_mm, half_mm}) {
        form.points.push_back({Vector3(x, -c, c), Vector3(x, 0.0, 2.0 * c), Vector3(x, c, c)});
        form.weights.push_back({1.0, std::sqrt(0.5), 1.0});
    }
    return geometry::toFace(form, geometry::Outward::DuCrossDv).value();
}

geometry::SurfaceFace sphereFace(double radius_mm) {
    // An arc of a meridian turned about Z by 90°, both as rational quadratics.
    const double low = 5.0 * std::numbers::pi / 180.0;
    const double high = 45.0 * std::numbers::pi / 180.0;
    const double half = 0.5 * (high - low);
    const auto at = [](double r, double angle) { return Vector3(r * std::sin(angle), 0.0, r * std::cos(angle)); };
    const std::vector<Vector3> meridian{at(radius_mm, low), at(radius_mm / std::cos(half), 0.5 * (high + low)),
                                        at(radius_mm, high)};
    const std::vector<double> weights{1.0, std::cos(half), 1.0};
    geometry::BezierForm form;
    for (std::size_t i = 0; i < 3; ++i) {
        const double r = meridian[i].x();
        const double z = meridian[i].z();
        form.points.push_back({Vector3(r, 0.0, z), Vector3(r, r, z), Vector3(0.0, r, z)});
        form.weights.push_back({weights[i], weights[i] * std::sqrt(0.5), weights[i]});
    }
    return geometry::toFace(form, geometry::Outward::DuCrossDv).value();
}

std::vector<geometry::SurfaceFace> benchmarkFaces() {
    return geometry::readSurfaceFile(std::string(CUSP_SOURCE_DIR) + "/examples/benchmark/surface.toml").value();
}

simulation::ToolMove move(const Vector3& from, const Vector3& to, const Vector3& axis) {
    return {{from, axis.normalized()}, {to, axis.normalized()}, toolpath::MotionKind::Feed, 1, 0};
}

simulation::CutterPath pathOf(const geometry::Cutter& cutter, std::vector<simulation::ToolMove> moves) {
    return {std::move(moves), {cutter}, 0};
}

simulation::SurfaceEnvelope envelopeOf(const simulation::CutterPath& path,
                                       const std::vector<geometry::SurfaceFace>& faces,
                                       const simulation::EnvelopeOptions& options) {
    auto envelope = simulation::surfaceEnvelope(path, faces, options);
    if (!envelope) {
        ADD_FAILURE() << base::toText(envelope.error());
        return {};
    }
    EXPECT_EQ(envelope->points.size(), envelope->grid.points.size());
    EXPECT_FALSE(envelope->points.empty());
    return *std::move(envelope);
}

}  // namespace cusp::test_support
