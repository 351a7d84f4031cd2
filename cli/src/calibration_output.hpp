// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What a calibration found, for people and for machines.
#pragma once

#include <cusp/base/json_report.hpp>
#include <cusp/loop/calibration.hpp>

#include <string>

namespace cusp::cli {

/// calibration.json and `--json`: docs/json.md.
[[nodiscard]] base::Json calibrationJson(const std::string& job, const machine::MachineDefinition& nominal,
                                         const loop::CalibrationResult& result);
[[nodiscard]] std::string calibrationText(const machine::MachineDefinition& nominal,
                                          const loop::CalibrationResult& result);

}  // namespace cusp::cli
