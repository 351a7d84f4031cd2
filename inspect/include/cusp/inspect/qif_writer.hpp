// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// An inspection as a QIF 3.0 document.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/inspect/inspection_report.hpp>

#include <functional>
#include <string_view>

namespace cusp::inspect {

/// Writes the judged evaluation in pieces of about 64 kB, so that a million points need no document in memory: the surface
/// as a feature, its points (of the surface, in the nominal frame, mm) with normals and deviations as one point set, and,
/// with limits, a surface profile characteristic: zone from the lower to the upper limit, value the profile deviation
/// (ISO 1101, twice the largest deviation), status PASS, FAIL or INDETERMINATE as decided. Points beyond an edge of the
/// nominal do not count and are left out. The document's identity (QPId) follows from what it holds: the same report gives
/// the same bytes.
/// Errors: those of `sink`, which ends the writing.
[[nodiscard]] base::Result<void> writeQif(const InspectionReport& report,
                                          const std::function<base::Result<void>(std::string_view)>& sink);

}  // namespace cusp::inspect
