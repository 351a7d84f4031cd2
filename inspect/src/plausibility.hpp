// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Whether points and nominal can belong together at all, and what is wrong when they do not fit.
#pragma once

#include <cusp/inspect/inspection.hpp>

#include <optional>
#include <string>

namespace cusp::inspect {

/// The error `inspect.unit` when the points are so much larger or smaller than the nominal that another unit explains it.
[[nodiscard]] std::optional<base::Diagnostics> checkUnit(const MeasuredPoints& points,
                                                         const geometry::NominalShape& nominal);

/// What the points are, who said so, and the radius that follows.
struct ProbeDecision {
    PointKind kind = PointKind::Surface;
    std::string source;
    double radius_mm = 0.0;
};
/// Errors `inspect.radius`, `inspect.kind`; a stated kind that fits far worse than the other is a warning.
[[nodiscard]] base::Result<ProbeDecision> decideProbe(const MeasuredPoints& points,
                                                      const geometry::NominalShape& nominal,
                                                      const InspectionOptions& options, base::Diagnostics& report);

/// The error `align.not-determined` when all points lie in a plane that the nominal is not, with all freedoms free: a
/// plane fits a curved surface in many ways.
[[nodiscard]] std::optional<base::Diagnostics>
checkPlane(const MeasuredPoints& points, const geometry::NominalShape& nominal, const InspectionOptions& options);

/// Root mean square deviation above which points are not of this nominal, or not where they should be.
[[nodiscard]] double poorFitLimit(const geometry::NominalShape& nominal);

struct Doubt {
    std::string code;
    std::string cause;
};
/// Why points fit badly: found by a robust fit, and by searching from no start for them and for their mirror image.
[[nodiscard]] Doubt explainPoorFit(const MeasuredPoints& points, const geometry::NominalShape& nominal,
                                   const InspectionOptions& options, double offset_mm);

}  // namespace cusp::inspect
