// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What `cusp inspect` says to people.
#pragma once

#include <cusp/inspect/inspection_report.hpp>

#include <string>

namespace cusp::cli {

[[nodiscard]] std::string inspectionText(const inspect::InspectionReport& report);

}  // namespace cusp::cli
