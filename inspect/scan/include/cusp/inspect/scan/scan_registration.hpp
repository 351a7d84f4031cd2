// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The start of a scan that may lie anywhere: candidates from its features, the best of them by exact distances.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/inspect/pose_search.hpp>

#include <cstddef>
#include <span>
#include <string>

namespace cusp::inspect {

struct ScanStart {
    RigidTransform nominal_from_measured = RigidTransform::Identity();
    double rms_mm = 0.0;         ///< coarse, of a sample, distances to edges included
    std::size_t sampled = 0;     ///< points the features were taken from
    std::size_t outliers = 0;    ///< of these, left aside
    std::size_t candidates = 0;  ///< poses the features proposed
    bool from_features = false;  ///< the best start is one of them, not one of the uniform rotations
};

struct ScanOptions {
    std::string program;     ///< path of cusp-scan
    double offset_mm = 0.0;  ///< the probe's radius for centres
    double wall_s = 60.0;    ///< the child is stopped after this
};

/// Thins the scan, has cusp-scan (PCL) take off outliers, find normals and features and register them to those of the
/// nominal, and refines the proposals together with starts of all orientations against the nominal itself. The exact fit is
/// the caller's next step. Errors: `scan.program` (it is missing or failed), `scan.answer`.
[[nodiscard]] base::Result<ScanStart> findScanStart(std::span<const Vector3> points,
                                                    const geometry::NominalShape& nominal, const ScanOptions& options);

}  // namespace cusp::inspect
