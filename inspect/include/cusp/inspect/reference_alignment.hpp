// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Datums from reference points: 3-2-1 and RPS alignments.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/frames.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::inspect {

/// One reference: the measured point must come to lie on the plane through `nominal` across `direction`. Six of them with
/// directions 3-2-1 are the classic alignment; a point that is held in more directions is named once for each (RPS).
struct ReferencePoint {
    geometry::Vector3 measured = geometry::Vector3::Zero();
    geometry::Vector3 nominal = geometry::Vector3::Zero();
    geometry::Vector3 direction = geometry::Vector3::UnitZ();  ///< unit
};

struct ReferenceAlignment {
    geometry::RigidTransform nominal_from_measured = geometry::RigidTransform::Identity();
    std::vector<double> residuals_mm;  ///< along the directions; zero when six references determine the pose
    int iterations = 0;
};

/// The pose that makes the sum of squares of the distances along the directions smallest; of six independent ones, zero.
/// Errors: `reference.too-few` (six are needed), `reference.not-determined` (names the freedoms left open),
/// `reference.not-converged` (measured and nominal points are of different figures).
[[nodiscard]] base::Result<ReferenceAlignment> alignToReferences(std::span<const ReferencePoint> references);

/// A table with a header: measured_x, measured_y, measured_z, nominal_x, nominal_y, nominal_z, i, j, k; mm, separated by
/// commas or semicolons. Errors: `reference.header`, `reference.columns`, `reference.number`, `reference.direction`.
[[nodiscard]] base::Result<std::vector<ReferencePoint>> readReferences(std::string_view text, const std::string& name);

}  // namespace cusp::inspect
