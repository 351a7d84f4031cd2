// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Moves of a tool as blocks in axis space: as dense as the curvature that rotary axes give them asks for.
#pragma once

#include <cusp/dynamics/path_block.hpp>

#include <cusp/kinematics/machine.hpp>

#include <functional>
#include <optional>
#include <utility>

namespace cusp::dynamics {

/// A tip (mm, frame of the work offset) and positions of the rotary axes.
struct ToolPosition {
    geometry::Vector3 tip_mm = geometry::Vector3::Zero();
    kinematics::RotaryValues rotary_rad{};
};

/// Largest step of a rotary axis between two points of a block: 500 mm from the axis the chord then misses the way by 1 µm.
inline constexpr double rotary_step_rad = 0.004;

/// Turns moves of the tool into blocks for a machine, a tool length and a place of the work offset.
class ToolPath {
public:
    /// `origin_mm`: of the work offset in the machine frame, all axes at zero. The machine must outlive this.
    ToolPath(const kinematics::Machine& machine, double tool_length_mm, const geometry::Vector3& origin_mm)
        : machine_(&machine), tool_length_mm_(tool_length_mm), origin_mm_(origin_mm) {}

    /// Empty where no position of the linear axes puts the tip there.
    [[nodiscard]] std::optional<PathPoint> at(const ToolPosition& position) const;
    [[nodiscard]] PathPoint at(const AxisVector& axes) const;
    [[nodiscard]] ToolPlace placeOf(const AxisVector& axes) const;

    /// The tip on a line, rotary axes linearly.
    [[nodiscard]] std::optional<PathBlock> line(const ToolPosition& from, const ToolPosition& to) const;
    /// All axes linearly.
    [[nodiscard]] PathBlock axesLine(const AxisVector& from, const AxisVector& to) const;
    /// Anything else: `position` over [0, 1], at `parts` steps.
    [[nodiscard]] std::optional<PathBlock> along(const std::function<ToolPosition(double)>& position,
                                                 std::size_t parts) const;

private:
    const kinematics::Machine* machine_;
    double tool_length_mm_;
    geometry::Vector3 origin_mm_;
};

/// Steps for a move that turns rotary axes from one position to another.
[[nodiscard]] std::size_t partsOf(const kinematics::RotaryValues& from, const kinematics::RotaryValues& to);

}  // namespace cusp::dynamics
