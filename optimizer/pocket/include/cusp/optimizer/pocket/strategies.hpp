// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Classical strategies as orders of preference over the same points, so that each keeps the same engagement limit.
#pragma once

#include <cusp/optimizer/pocket/point_map.hpp>

#include <string>
#include <vector>

namespace cusp::pocket {

enum class Strategy {
    ZigZag,              ///< row after row, to and fro
    OneWay,              ///< row after row, always the same way
    ContourParallel,     ///< from the middle towards the walls, ring after ring
    ConstantEngagement,  ///< from where the tool came in, front after front
};

[[nodiscard]] std::string toText(Strategy strategy);
/// One number a point: lower is sooner. Contour points come last but in `ContourParallel`, where they are the last ring.
[[nodiscard]] std::vector<double> preferenceOf(const PointMap& map, Strategy strategy);

}  // namespace cusp::pocket
