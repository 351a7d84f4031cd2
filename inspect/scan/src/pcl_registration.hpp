// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Registration of a scan to a sampled surface by PCL, without a start.
#pragma once

#include "scan_exchange.hpp"

namespace cusp::inspect {

/// Statistical outlier removal, normals, fast point feature histograms (Rusu 2009), prerejective sample consensus (Buch
/// 2013), then ICP. A scan does not say which side is outside, so both are tried: two poses, or fewer where PCL finds none.
[[nodiscard]] ScanAnswer registerByFeatures(const ScanRequest& request);

}  // namespace cusp::inspect
