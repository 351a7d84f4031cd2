// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// An inspection as a web page: the report's JSON with the points and curves that JSON leaves out.
#pragma once

#include <cusp/base/json_report.hpp>
#include <cusp/inspect/inspection_report.hpp>

#include <cstddef>
#include <string>

namespace cusp::cli {

/// A browser turns this many points without effort, and the page stays below a few megabytes.
inline constexpr std::size_t points_on_map = 60'000;

/// Every section's form, and with a planned step-over (0: not known) its scallops against it, added to the sections of the
/// report's JSON; a section whose arc length does not grow gets neither.
void addSectionForms(base::Json& json, const inspect::InspectionReport& report, double planned_step_over_mm);

/// report.json and `--json`: the report with the form of every section and, with a planned step-over, its scallops.
[[nodiscard]] base::Json inspectionJson(const inspect::InspectionReport& report);

/// The document of the page "inspection" (pages/web/pages/inspection_input.ts). A cloud of more than `map_points` is thinned
/// to points at equal steps and the largest deviations; the page says so.
[[nodiscard]] base::Json inspectionDocument(const inspect::InspectionReport& report, double planned_step_over_mm = 0.0,
                                            std::size_t map_points = points_on_map);

/// report.html.
[[nodiscard]] base::Result<std::string> inspectionPage(const inspect::InspectionReport& report,
                                                       double planned_step_over_mm = 0.0);

}  // namespace cusp::cli
