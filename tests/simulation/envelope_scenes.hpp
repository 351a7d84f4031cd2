// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Surfaces, cutters and paths that tests of the envelope are made of.
#pragma once

#include <cusp/simulation/surface_envelope.hpp>

#include <vector>

namespace cusp::test_support {

[[nodiscard]] geometry::Cutter ballCutter(double diameter_mm, double height_mm = 60.0);
[[nodiscard]] geometry::Cutter toroidalCutter(double diameter_mm, double corner_mm, double height_mm = 60.0);

/// z = 0 over [−half, half]², material below.
[[nodiscard]] geometry::SurfaceFace planeFace(double half_mm);
/// An eighth of a sphere about the origin, from 5° to 45° off +Z, material inside; exact.
[[nodiscard]] geometry::SurfaceFace sphereFace(double radius_mm);
/// A cylinder about the X axis, |x| ≤ half, within 45° of +Z, material inside; exact.
[[nodiscard]] geometry::SurfaceFace cylinderFace(double radius_mm, double half_mm);
/// Fountas 2017 eq. 14, from examples/benchmark/surface.toml.
[[nodiscard]] std::vector<geometry::SurfaceFace> benchmarkFaces();

[[nodiscard]] simulation::ToolMove move(const geometry::Vector3& from, const geometry::Vector3& to,
                                        const geometry::Vector3& axis);
[[nodiscard]] simulation::CutterPath pathOf(const geometry::Cutter& cutter, std::vector<simulation::ToolMove> moves);

/// The envelope; a failure fails the test and gives an empty one.
[[nodiscard]] simulation::SurfaceEnvelope envelopeOf(const simulation::CutterPath& path,
                                                     const std::vector<geometry::SurfaceFace>& faces,
                                                     const simulation::EnvelopeOptions& options);

}  // namespace cusp::test_support
