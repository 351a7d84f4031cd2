// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Measured points as a QIF 3.0 document, as a measuring machine hands them over.
#pragma once

#include <cusp/inspect/measured_points.hpp>

#include <string>
#include <vector>

namespace cusp::inspect {

/// One point set: ball centres in mm with the directions of their approach as normals, not compensated, and the probe's
/// radius. `remarks` become comments before the root. `readMeasuredPoints` takes it back; sections are not in it.
[[nodiscard]] std::string qifOfCentres(const MeasuredPoints& points, const std::vector<std::string>& remarks);

}  // namespace cusp::inspect
