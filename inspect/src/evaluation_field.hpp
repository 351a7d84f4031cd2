// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The deviation fields of a report.
#pragma once

#include <cusp/inspect/inspection.hpp>

namespace cusp::inspect {

/// Fits the field of either frame, or says in `no_field` why there is none.
void addDeviationFields(InspectionReport& report, const InspectionOptions& options);

}  // namespace cusp::inspect
