// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The pose of points that may lie anywhere: many starts, a coarse fit from each, the best one.
#pragma once

#include <cusp/geometry/closest_point.hpp>
#include <cusp/inspect/measured_points.hpp>

#include <span>
#include <vector>

namespace cusp::inspect {

struct FoundPose {
    RigidTransform nominal_from_measured = RigidTransform::Identity();
    double rms_mm = 0.0;          ///< of the distances to the nominal, edges included
    bool from_candidate = false;  ///< reached from one of the caller's candidates
};

struct PoseSearchOptions {
    double offset_mm = 0.0;                    ///< the probe's radius for centres
    bool mirrored = false;                     ///< search for the mirror image (x → −x) of the points
    std::vector<RigidTransform> candidates{};  ///< tried first
    std::size_t rotations = 72;                ///< uniform over all, tried with the centres brought together
};

/// The best pose found, its candidates refined with a sample of the points. The points should cover most of the nominal.
[[nodiscard]] FoundPose searchPose(std::span<const Vector3> points, const geometry::NominalShape& nominal,
                                   const PoseSearchOptions& options);

/// Points on the nominal, about equally dense: those nearest to the nodes of a grid over its bounds, `wanted` or a few more.
/// Points of edges are left out.
[[nodiscard]] std::vector<geometry::Footpoint> sampleNominal(const geometry::NominalShape& nominal, std::size_t wanted);

}  // namespace cusp::inspect
