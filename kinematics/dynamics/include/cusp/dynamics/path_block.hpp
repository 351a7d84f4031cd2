// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The programmed path, block by block, in axis space and at the tool.
#pragma once

#include <cusp/dynamics/axis_limits.hpp>
#include <cusp/geometry/frames.hpp>

#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

namespace cusp::dynamics {

/// Where tip (mm) and unit tool axis are, in the workpiece frame.
struct ToolPlace {
    geometry::Vector3 tip_mm = geometry::Vector3::Zero();
    geometry::Vector3 axis = geometry::Vector3::UnitZ();
};

/// Forward kinematics as the planner needs it.
using ToolModel = std::function<ToolPlace(const AxisVector&)>;

struct PathPoint {
    AxisVector axes{};
    ToolPlace tool;
};

/// One block: points so close that axes and tip run straight between them, the first being where the block before ends.
struct PathBlock {
    std::vector<PathPoint> points;
    /// Speed of the tip; in a block that moves rotary axes only, of a point at `feed_radius_mm` from them (FGREF).
    double feed_mm_per_s = std::numeric_limits<double>::infinity();
    double tolerance_mm = 0.01;                 ///< how far smoothing may take the tip from the path (CTOL)
    double orientation_tolerance_rad = 1.7e-3;  ///< … and the tool axis (OTOL)
    bool exact_stop = false;                    ///< comes to rest at its end
    std::uint64_t id = 0;
};

/// PM12 p. 112: FGREF as the control has it, 1° = 1 mm.
inline constexpr double feed_radius_mm = 57.29577951308232;

}  // namespace cusp::dynamics
