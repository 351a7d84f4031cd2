// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Measured ball centres as the files measuring machines write: table, DMIS output, QIF.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/inspect/measured_points.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace cusp::loop {

/// What a remark at the head of the file says beside the points: version, seed, machine.
using FileRemarks = std::vector<std::string>;

/// "csv", "dmis", "qif"; by the ending of a file's name: .csv .txt, .dmo .dms, .qif. Error `measure.format`.
[[nodiscard]] base::Result<std::string> measurementFormat(std::string_view path);

/// Centres with their approach i, j, k, in mm to 1e-7 (QIF: 1e-9). CSV has a column `section`; DMIS output and QIF have none
/// for it.
[[nodiscard]] std::string measurementText(const inspect::MeasuredPoints& points, const std::string& format,
                                          const FileRemarks& remarks);

}  // namespace cusp::loop
