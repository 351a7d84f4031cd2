// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Inverse kinematics of a path; a place the machine cannot take is told with what it would need.
#include "rotary_positions.hpp"

#include <cusp/base/units.hpp>

#include <cmath>
#include <fmt/format.h>
#include <string>

namespace cusp::finishing {

base::Result<std::vector<kinematics::PlannedAxes>> rotaryPositions(std::span<const TimedMove> moves,
                                                                   const MachineSetting& setting) {
    kinematics::PlannerOptions options;
    options.rewinds_are_handled = true;
    kinematics::AxisPlanner planner(*setting.machine, options);
    std::vector<kinematics::PlannedAxes> out;
    const auto drain = [&] {
        for (kinematics::PlannedAxes axes; planner.pop(axes);) out.push_back(axes);
    };
    for (const TimedMove& move : moves) {
        planner.push({move.to.axis, move.line, std::isfinite(move.feed_mm_per_s)});
        drain();
    }
    planner.finish();
    drain();
    const kinematics::Machine& machine = *setting.machine;
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (out[i].reached && out[i].within_limits) continue;
        std::string ranges;
        for (std::size_t k = 0; k < machine.rotaryCount(); ++k) {
            const auto& range = machine.rotaryRange(k);
            ranges += range.endless ? fmt::format(" {} endless", machine.rotaryNames()[k])
                                    : fmt::format(" {} {:g}° to {:g}°", machine.rotaryNames()[k],
                                                  base::degFromRad(range.min), base::degFromRad(range.max));
        }
        if (ranges.empty()) ranges = " no rotary axis among them";
        const Vector3& axis = moves[i].to.axis;
        return base::fail("finishing.pose",
                          fmt::format("the machine cannot lean the tool to ({:.4f}, {:.4f}, {:.4f}) at X{:.3f} Y{:.3f} "
                                      "Z{:.3f}: its axes have{}; less lead or tilt, another clamping of the part or "
                                      "another machine would do",
                                      axis.x(), axis.y(), axis.z(), moves[i].to.tip_mm.x(), moves[i].to.tip_mm.y(),
                                      moves[i].to.tip_mm.z(), ranges),
                          {.file = {}, .line = moves[i].line, .column = 0, .key = {}});
    }
    return out;
}

}  // namespace cusp::finishing
