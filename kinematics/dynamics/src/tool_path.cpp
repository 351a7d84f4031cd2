// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Points along a move, each with its axis positions.
#include <cusp/dynamics/tool_path.hpp>

#include <algorithm>
#include <cmath>

namespace cusp::dynamics {

std::size_t partsOf(const kinematics::RotaryValues& from, const kinematics::RotaryValues& to) {
    const double most = std::max(std::abs(to[0] - from[0]), std::abs(to[1] - from[1]));
    return std::max<std::size_t>(1, static_cast<std::size_t>(std::ceil(most / rotary_step_rad)));
}

std::optional<PathPoint> ToolPath::at(const ToolPosition& position) const {
    const auto linear = machine_->solveLinear(origin_mm_ + position.tip_mm, position.rotary_rad, tool_length_mm_);
    if (!linear) return std::nullopt;
    return PathPoint{axisVector({*linear, position.rotary_rad}),
                     {position.tip_mm, machine_->toolAxis(position.rotary_rad)}};
}

ToolPlace ToolPath::placeOf(const AxisVector& axes) const {
    const toolpath::CutterLocation place = machine_->forward(axisValues(axes), tool_length_mm_);
    return {place.tip_mm - origin_mm_, place.axis};
}

PathPoint ToolPath::at(const AxisVector& axes) const { return {axes, placeOf(axes)}; }

std::optional<PathBlock> ToolPath::along(const std::function<ToolPosition(double)>& position, std::size_t parts) const {
    PathBlock block;
    block.points.reserve(parts + 1);
    for (std::size_t k = 0; k <= parts; ++k) {
        const auto point = at(position(static_cast<double>(k) / static_cast<double>(parts)));
        if (!point) return std::nullopt;
        block.points.push_back(*point);
    }
    return block;
}

std::optional<PathBlock> ToolPath::line(const ToolPosition& from, const ToolPosition& to) const {
    const auto position = [&](double u) {
        ToolPosition out{(1.0 - u) * from.tip_mm + u * to.tip_mm, {}};
        for (std::size_t i = 0; i < 2; ++i) out.rotary_rad[i] = std::lerp(from.rotary_rad[i], to.rotary_rad[i], u);
        return out;
    };
    return along(position, partsOf(from.rotary_rad, to.rotary_rad));
}

PathBlock ToolPath::axesLine(const AxisVector& from, const AxisVector& to) const {
    PathBlock block;
    const std::size_t parts = partsOf({from[3], from[4]}, {to[3], to[4]});
    for (std::size_t k = 0; k <= parts; ++k) {
        AxisVector axes{};
        for (std::size_t i = 0; i < max_axes; ++i)
            axes[i] = std::lerp(from[i], to[i], static_cast<double>(k) / static_cast<double>(parts));
        block.points.push_back(at(axes));
    }
    return block;
}

}  // namespace cusp::dynamics
