// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The tables and the coloured cloud of an inspection, streamed.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/inspect/inspection_report.hpp>

#include <functional>
#include <string_view>

namespace cusp::inspect {

/// Takes the next bytes of a file; an error ends the writing.
using ByteSink = std::function<base::Result<void>(std::string_view)>;

/// One row per measured point in the order of the file: point (from 0), line, x_mm … z_mm as measured, the footpoint
/// nominal_x_mm … nominal_z_mm and its normal i, j, k of the judged evaluation, deviation_mm (judged), datum_deviation_mm,
/// best_fit_deviation_mm, beyond_edge_mm, outlier (0 or 1), section.
[[nodiscard]] base::Result<void> writePointsCsv(const InspectionReport& report, const ByteSink& sink);

/// One row per point of a section: section, number (from 1), arc_length_mm, deviation_mm, point, and the footpoint.
[[nodiscard]] base::Result<void> writeSectionsCsv(const InspectionReport& report, const ByteSink& sink);

/// Binary PLY: surface points in the nominal frame with normal, deviation_mm and a colour: blue at or below the lower
/// limit, green at zero, red at or above the upper one (without limits: ± the largest deviation).
[[nodiscard]] base::Result<void> writeDeviationPly(const InspectionReport& report, const ByteSink& sink);

}  // namespace cusp::inspect
