// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The shape a cutter leaves across its feed, and how wide a strip it keeps within a height.
#pragma once

#include <cusp/optimizer/finishing/tool_placement.hpp>

namespace cusp::finishing {

/// The most (mm, along the surface) that two passes may be apart so that neither leaves a ridge higher than `height_mm`. The
/// silhouette of the cutter along the feed is the offset of an ellipse; the surface across the feed is taken as a circle of
/// `curvature_per_mm`. Never more than the silhouette is wide.
[[nodiscard]] double stripWidth(const geometry::Cutter& cutter, double lead_rad, double tilt_rad,
                                double curvature_per_mm, double height_mm);

}  // namespace cusp::finishing
