// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A whole inspection: from points and nominal to the report, with what makes its result doubtful said aloud.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/closest_point.hpp>
#include <cusp/inspect/inspection_report.hpp>

#include <optional>

namespace cusp::inspect {

struct InspectionOptions {
    FitKind fit = FitKind::LeastSquares;
    std::array<bool, 6> locked{};
    Loss loss = Loss::Squared;
    double loss_scale_mm = 0.0;                         ///< 0: from the spread of the residuals
    bool use_weights = false;                           ///< points count in the fit by the weights of the file
    RigidTransform start = RigidTransform::Identity();  ///< nominal_from_measured; the fixed datums
    std::optional<double> probe_radius_mm{};            ///< absent: as the file says
    std::optional<ToleranceLimits> limits{};
    DecisionRule rule = DecisionRule::Probability;
    std::optional<double> uncertainty_mm{};  ///< standard uncertainty of a deviation; absent: computed from the points
    double probe_form_error_mm = 0.0;        ///< of the stylus, full width; part of a computed uncertainty
    bool judge_in_datum = false;             ///< decide in the fixed datums instead of best-fitted
    std::optional<SectionPlan> sections{};   ///< absent: the sections the file names
    /// Distance of neighbouring passes as planned; 0: not known. The deviation field keeps waves longer than four of them.
    double planned_step_over_mm = 0.0;
    OutlierRule outlier_rule{};
    double edge_tolerance_mm =
        0.1;  ///< points farther beyond an edge have no deviation along a normal and do not count
};

/// Errors: `inspect.weights` (asked for, and the file has none), `inspect.unit` (the sizes of points and nominal say that the unit is wrong), `inspect.kind`, `inspect.radius`
/// (centres or surface points, and the probe's radius, do not fit together), `align.*`. Doubts become warnings in `report`
/// and withhold the decision (undecided, with the reason): `inspect.poor-fit` (wrong nominal, mirrored part, start too far
/// off), `inspect.many-outliers`, `inspect.few-points`, `inspect.beyond-edge`.
[[nodiscard]] base::Result<InspectionReport> inspectPoints(MeasuredPoints points, const geometry::NominalShape& nominal,
                                                           const InspectionOptions& options, base::Diagnostics& report);

}  // namespace cusp::inspect
