// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Everything an inspection found, as plain data: what the results files, the page and QIF are made of.
#pragma once

#include <cusp/base/json_report.hpp>
#include <cusp/geometry/deviation_field.hpp>
#include <cusp/inspect/alignment.hpp>
#include <cusp/inspect/conformance.hpp>
#include <cusp/inspect/deviation.hpp>
#include <cusp/inspect/measured_points.hpp>
#include <cusp/inspect/section.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cusp::inspect {

/// The points in one frame: fixed datums, or best-fitted. `deviations` has one entry per measured point, in the order of
/// the file; points beyond an edge have one too but do not count in statistics, histogram and decision.
struct Evaluation {
    RigidTransform nominal_from_measured = RigidTransform::Identity();
    std::vector<PointDeviation> deviations;
    DeviationStatistics statistics;
    Histogram histogram;
    std::size_t beyond_edge = 0;
    std::vector<std::uint32_t> outliers;  ///< by `InspectionReport::outlier_rule`
    Decision decision;
    /// Smooth over the part, from the points that count and are no outliers; absent where the result is doubtful or the
    /// points are too few (`InspectionReport::no_field`).
    std::optional<geometry::DeviationField> field;
};

struct InspectionReport {
    std::string points_file;
    std::string nominal_file;
    bool nominal_flipped = false;  ///< its outward normal is the opposite of what the file says
    MeasuredPoints points;
    PointKind kind = PointKind::Surface;
    std::string kind_source;       ///< who said so: "flag", "file", "found by fitting both ways"
    double probe_radius_mm = 0.0;  ///< 0 for surface points
    AlignmentSummary alignment;
    bool weighted = false;  ///< points counted in the fit by the weights of the file; never in statistics and decision
    double planned_step_over_mm = 0.0;  ///< 0: not known
    /// With the start pose: the coordinates of the file, or datums from reference points.
    Evaluation datum;
    /// With the fitted pose; the same as `datum` when the fit is none.
    Evaluation best_fit;
    bool judged_in_datum = false;  ///< which of the two the decision is taken from
    OutlierRule outlier_rule;
    double edge_tolerance_mm = 0.1;
    std::vector<SectionResult> sections;  ///< of the judged evaluation
    std::vector<std::string> doubts;      ///< why no decision can be taken from this, each one sentence
    std::string no_field;                 ///< why there is no deviation field; empty when there is one

    [[nodiscard]] const Evaluation& judged() const { return judged_in_datum ? datum : best_fit; }
};

/// report.json and `--json`: all but the single points. Keys: docs/json.md.
[[nodiscard]] base::Json toJson(const InspectionReport& report);

}  // namespace cusp::inspect
