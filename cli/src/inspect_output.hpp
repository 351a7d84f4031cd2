// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The folder `cusp inspect -o` fills.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/inspect/inspection_report.hpp>

#include <string>

namespace cusp::cli {

/// report.json, report.html, report.qif, points.csv, sections.csv and deviations.ply; none of them appears before all are written.
/// Errors: `io.*`.
[[nodiscard]] base::Result<void> writeInspection(const std::string& folder, const inspect::InspectionReport& report);

}  // namespace cusp::cli
