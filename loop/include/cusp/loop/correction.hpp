// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A compensated path, proved: what it changes on the surface against what it was meant to change.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/parametric_surface.hpp>
#include <cusp/loop/executed_motion.hpp>
#include <cusp/toolpath/compensation.hpp>

#include <cstddef>

namespace cusp::loop {

struct CorrectionCheck {
    std::size_t points = 0;      ///< of the surface, reached by both paths
    double max_change_mm = 0.0;  ///< of what is cut, between the paths
    /// The most that is cut deeper, and left higher, than was meant: > 0.
    double gouge_mm = 0.0;
    double left_mm = 0.0;
    geometry::Vector3 gouge_at_mm = geometry::Vector3::Zero();
    double allowed_mm = 0.0;

    [[nodiscard]] bool holds() const { return gouge_mm <= allowed_mm; }
};

/// The exact envelopes of both paths on the surface, every `spacing_mm`; what changes between them must be what the field and
/// the options say, within `allowed_mm`: a path bent too sharply for its cutter would gouge. Errors: those of `cutJob` and
/// `simulation::surfaceEnvelope`.
[[nodiscard]] base::Result<CorrectionCheck>
checkCorrection(const toolpath::ToolPath& path, const toolpath::ToolPath& corrected,
                const geometry::ParametricSurface& nominal, const geometry::DeviationField& field,
                const toolpath::CompensationOptions& options, double spacing_mm = 1.0, double allowed_mm = 0.002);

}  // namespace cusp::loop
