// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Moves through inverse kinematics and look-ahead.
#include "rotary_positions.hpp"

#include <cusp/dynamics/motion_planner.hpp>
#include <cusp/dynamics/tool_path.hpp>
#include <cusp/optimizer/finishing/machine_time.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cusp::finishing {

base::Result<MachineTime> machineTime(std::span<const TimedMove> moves, const MachineSetting& setting) {
    if (moves.size() < 2) return base::fail("finishing.no-moves", "the path has no move whose time could be told");
    const auto rotary = rotaryPositions(moves, setting);
    if (!rotary) return base::fail(rotary.error());
    const dynamics::ToolPath path(*setting.machine, setting.tool_length_mm, setting.origin_mm);
    dynamics::MotionPlanner planner(dynamics::limitsOf(*setting.machine), {},
                                    [&](const dynamics::AxisVector& at) { return path.placeOf(at); });
    MachineTime out;
    const auto run = [&] {
        while (planner.ready())
            for (const auto& piece : planner.plan().committed) out.total_s += piece.law.duration_s;
    };
    for (std::size_t i = 1; i < moves.size(); ++i) {
        const auto& from = (*rotary)[i - 1].rotary_rad;
        const auto& to = (*rotary)[i].rotary_rad;
        for (std::size_t k = 0; k < 2; ++k) out.rotary_travel_rad[k] += std::abs(to[k] - from[k]);
        const double way = (moves[i].to.tip_mm - moves[i - 1].to.tip_mm).norm();
        out.tip_length_mm += way;
        if (way < 1e-9 && from == to) continue;
        auto block = path.line({moves[i - 1].to.tip_mm, from}, {moves[i].to.tip_mm, to});
        if (!block)
            return base::fail("finishing.pose", "no position of the linear axes puts the tool tip there",
                              {.file = {}, .line = moves[i].line, .column = 0, .key = {}});
        block->feed_mm_per_s = moves[i].feed_mm_per_s;
        if (setting.block_time_s > 0.0 && std::isfinite(block->feed_mm_per_s) && way > 0.0 &&
            way / setting.block_time_s < block->feed_mm_per_s) {
            block->feed_mm_per_s = way / setting.block_time_s;
            ++out.slowed_by_blocks;
        }
        block->tolerance_mm = setting.tolerance_mm;
        block->orientation_tolerance_rad = setting.orientation_tolerance_rad;
        ++out.blocks;
        planner.add(*block);
        run();
    }
    planner.stop();
    run();
    out.stops = planner.summary().stops;
    return out;
}

std::vector<TimedMove> timedMoves(const FinishingPath& path) {
    std::vector<TimedMove> out;
    out.reserve(path.moves.size());
    for (const PathMove& move : path.moves) {
        const bool rapid = move.kind == toolpath::MotionKind::Rapid;
        out.push_back({move.location, rapid ? std::numeric_limits<double>::infinity() : move.feed_mm_per_s, 0});
    }
    return out;
}

}  // namespace cusp::finishing
