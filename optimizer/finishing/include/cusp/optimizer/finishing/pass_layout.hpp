// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The passes of a finishing path: where they lie on the faces, in the order and direction they are run.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/cutter.hpp>
#include <cusp/geometry/parametric_surface.hpp>
#include <cusp/optimizer/finishing/pass_curve.hpp>
#include <cusp/optimizer/finishing/plan_options.hpp>

#include <span>
#include <vector>

namespace cusp::finishing {

/// The passes over each of `faces` in turn. `shape` is the part they belong to where faces end at edges (trimmed): passes then
/// end at the edges too, and a pass over a hole is two. `cutter` and the orientation decide spacing by scallop.
///
/// Errors: `finishing.no-passes` where not one pass fits (with what to change), `finishing.too-many-passes`,
/// `finishing.scallop` where the spacing cannot be worked out.
[[nodiscard]] base::Result<std::vector<PassCurve>> layOutPasses(std::span<const geometry::SurfaceFace> faces,
                                                                const geometry::ParametricSurface* shape,
                                                                const geometry::Cutter& cutter,
                                                                const PlanOptions& options);

/// The lead at a point of a pass before it is smoothed: constant, or matched to the surface.
[[nodiscard]] double wantedLead(const geometry::Cutter& cutter, const PassPoint& point,
                                const OrientationOptions& orientation);

}  // namespace cusp::finishing
