// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Three limits on the feed of each move; the lowest holds.
#include "rotary_positions.hpp"

#include <cusp/dynamics/tool_path.hpp>
#include <cusp/optimizer/finishing/feed_adaption.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace cusp::finishing {

namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

/// Fastest tip speed at which no axis exceeds its velocity on the way, its ends taken as straight.
double axisLimit(const dynamics::PathPoint& from, const dynamics::PathPoint& to, const dynamics::AxisLimits& limits) {
    double time = 0.0;
    for (std::size_t k = 0; k < limits.count; ++k)
        time = std::max(time, std::abs(to.axes[k] - from.axes[k]) / limits.velocity[k]);
    const double way = (to.tool.tip_mm - from.tool.tip_mm).norm();
    return time > 0.0 ? way / time : no_limit;
}

/// From the turn at a corner between two moves, shared by half of each.
double curveLimit(const Vector3& before, const Vector3& corner, const Vector3& after, double acceleration) {
    const Vector3 in = corner - before;
    const Vector3 out = after - corner;
    const double turn = geometry::angleBetween(in, out);
    const double length = (in.norm() + out.norm()) / 2.0;
    return turn > 1e-9 ? std::sqrt(acceleration * length / turn) : no_limit;
}

}  // namespace

base::Result<FeedChange> adaptFeeds(FinishingPath& path, const MachineSetting& setting, const FeedLimits& limits) {
    const auto moves = timedMoves(path);
    const auto rotary = rotaryPositions(moves, setting);
    if (!rotary) return base::fail(rotary.error());
    const dynamics::ToolPath chain(*setting.machine, setting.tool_length_mm, setting.origin_mm);
    const dynamics::AxisLimits axes = dynamics::limitsOf(*setting.machine);
    FeedChange change;
    change.lowest_mm_per_s = no_limit;
    const auto feeds = [&](std::size_t i) {
        return i > 0 && i < path.moves.size() && path.moves[i].kind == toolpath::MotionKind::Feed;
    };
    for (std::size_t i = 1; i < path.moves.size(); ++i) {
        if (!feeds(i)) continue;
        PathMove& move = path.moves[i];
        const Vector3& from = path.moves[i - 1].location.tip_mm;
        const Vector3& to = move.location.tip_mm;
        const double by_block = setting.block_time_s > 0.0 ? (to - from).norm() / setting.block_time_s : no_limit;
        const auto first = chain.at(dynamics::ToolPosition{from, (*rotary)[i - 1].rotary_rad});
        const auto last = chain.at(dynamics::ToolPosition{to, (*rotary)[i].rotary_rad});
        const double by_axes = first && last ? axisLimit(*first, *last, axes) : no_limit;
        double by_curve = no_limit;
        if (feeds(i - 1) && i >= 2)
            by_curve = curveLimit(path.moves[i - 2].location.tip_mm, from, to, limits.acceleration_mm_per_s2);
        if (feeds(i + 1))
            by_curve = std::min(by_curve,
                                curveLimit(from, to, path.moves[i + 1].location.tip_mm, limits.acceleration_mm_per_s2));
        const double allowed = std::min({by_block, by_axes, by_curve});
        if (allowed < move.feed_mm_per_s) {
            ++change.lowered;
            ++(allowed == by_block ? change.by_block_time : allowed == by_axes ? change.by_axes : change.by_curvature);
            const double steps = std::floor(allowed / limits.finest_mm_per_s);
            // Below one step the feed is not rounded: it must not become 0.
            move.feed_mm_per_s = steps >= 1.0 ? steps * limits.finest_mm_per_s : std::max(allowed, 1e-3);
        }
        change.lowest_mm_per_s = std::min(change.lowest_mm_per_s, move.feed_mm_per_s);
    }
    return change;
}

}  // namespace cusp::finishing
