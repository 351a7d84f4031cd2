// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Straight ways in the XY plane brought down on a shape, with as many points as the tolerance asks for.
#pragma once

#include <cusp/optimizer/tilt/three_axis_path.hpp>

#include <vector>

namespace cusp::tilt::detail {

struct PlanePoint {
    double x = 0.0;
    double y = 0.0;
};

/// The tip along the way from `from` to `to`: one pass for each stretch on which the cutter meets the shape.
[[nodiscard]] std::vector<Pass> droppedLine(const DropShape& shape, PlanePoint from, PlanePoint to,
                                            const ThreeAxisOptions& options);

/// Without the points that the straight way between their neighbours misses by less than `tolerance_mm` (Douglas, Peucker
/// 1973); the ends stay.
[[nodiscard]] Pass thinned(const Pass& pass, double tolerance_mm);

[[nodiscard]] std::vector<Pass> zigZagPasses(const DropShape& shape, const ThreeAxisOptions& options);
[[nodiscard]] std::vector<Pass> zLevelPasses(const DropShape& shape, const ThreeAxisOptions& options);

}  // namespace cusp::tilt::detail
