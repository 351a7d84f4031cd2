// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Axis positions along the path, their excess over the limits, and the time they take.
#include <cusp/optimizer/tilt/axis_motion.hpp>

#include <cusp/base/units.hpp>
#include <cusp/dynamics/motion_planner.hpp>
#include <cusp/dynamics/tool_path.hpp>
#include <cusp/kinematics/axis_planner.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cusp::tilt {

using dynamics::AxisLimits;
using dynamics::AxisVector;
using toolpath::CutterLocation;
using toolpath::MotionKind;

namespace {

/// Of a place the linear axes cannot give (turned into one plane): more than any travel.
constexpr double singular_excess_mm = 1e6;

/// By how much the rotary axes miss a tool axis: the least over the branches.
double excessOf(const kinematics::Machine& machine, const geometry::Vector3& axis) {
    const auto solved = machine.solveAxis(axis);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t branch = 0; branch < solved.count; ++branch) {
        double excess = solved.miss_rad;
        for (std::size_t i = 0; i < machine.rotaryCount(); ++i) {
            if (solved.pole && i == 0) continue;
            if (!machine.windings(i, solved.branch[branch][i]).empty()) continue;
            excess += machine.rotaryRange(i).excess(solved.branch[branch][i]);
        }
        least = std::min(least, excess);
    }
    return least;
}

void planRotary(const MachinePlace& place, const StartPath& path, std::span<const CutterLocation> poses,
                AxisMotion& motion) {
    kinematics::PlannerOptions options;
    options.rewinds_are_handled = true;
    kinematics::AxisPlanner planner(*place.machine, options);
    motion.rotary_rad.reserve(poses.size());
    kinematics::PlannedAxes planned;
    std::size_t next = 0;
    const auto take = [&] {
        while (planner.pop(planned)) {
            motion.rotary_rad.push_back(planned.rotary_rad);
            if (planned.rewind) ++motion.rewinds;
            if (!planned.within_limits || !planned.reached) {
                ++motion.locations_beyond;
                motion.range_excess += base::degFromRad(excessOf(*place.machine, poses[next].axis));
            }
            ++next;
        }
    };
    for (std::size_t i = 0; i < poses.size(); ++i) {
        planner.push({poses[i].axis, path.locations[i].line, path.locations[i].kind == MotionKind::Feed});
        take();
    }
    planner.finish();
    take();
    motion.rotary_travel_rad = planner.summary().travel_rad;
}

/// Positions of all axes; linear ones beyond their travel count as excess.
std::vector<AxisVector> positions(const MachinePlace& place, std::span<const CutterLocation> poses,
                                  AxisMotion& motion) {
    const dynamics::ToolPath chain(*place.machine, place.tool_length_mm, place.origin_mm);
    std::vector<AxisVector> out(poses.size());
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const auto at = chain.at({poses[i].tip_mm, motion.rotary_rad[i]});
        double excess = 0.0;
        if (at) {
            out[i] = at->axes;
            for (std::size_t k = 0; k < 3; ++k) excess += place.machine->linearRange(k).excess(at->axes[k]);
        } else {
            out[i] = i > 0 ? out[i - 1] : AxisVector{};
            excess = singular_excess_mm;
        }
        if (excess > 0.0) ++motion.locations_beyond;
        motion.range_excess += excess;
    }
    return out;
}

/// By how much the moves beside a knot must be slowed down for the changes of velocity there.
double slowing(const AxisLimits& limits, const AxisVector& before, const AxisVector& after,
               const AxisVector& changed_before, double step_s, AxisVector& changed) {
    double slow = 1.0;
    for (std::size_t k = 0; k < limits.count; ++k) {
        changed[k] = (after[k] - before[k]) / step_s;
        slow = std::max(slow, std::sqrt(std::abs(changed[k]) / limits.acceleration[k]));
        slow = std::max(slow, std::cbrt(std::abs(changed[k] - changed_before[k]) / step_s / limits.jerk[k]));
    }
    return slow;
}

double localTime(const AxisLimits& limits, const StartPath& path, std::span<const CutterLocation> poses,
                 const std::vector<AxisVector>& axes) {
    constexpr double shortest_s = 1e-6;
    const std::size_t moves = axes.size() - 1;
    std::vector<double> seconds(moves, shortest_s);
    std::vector<AxisVector> velocity(moves);
    for (std::size_t i = 0; i < moves; ++i) {
        const double feed = path.locations[i + 1].feed_mm_per_s;
        if (feed > 0.0) seconds[i] = std::max(seconds[i], (poses[i + 1].tip_mm - poses[i].tip_mm).norm() / feed);
        for (std::size_t k = 0; k < limits.count; ++k)
            seconds[i] = std::max(seconds[i], std::abs(axes[i + 1][k] - axes[i][k]) / limits.velocity[k]);
        for (std::size_t k = 0; k < limits.count; ++k) velocity[i][k] = (axes[i + 1][k] - axes[i][k]) / seconds[i];
    }
    std::vector<double> slow(moves, 1.0);
    AxisVector changed_before{};
    for (std::size_t i = 0; i + 1 < moves; ++i) {
        AxisVector changed{};
        const double here =
            slowing(limits, velocity[i], velocity[i + 1], changed_before, (seconds[i] + seconds[i + 1]) / 2.0, changed);
        slow[i] = std::max(slow[i], here);
        slow[i + 1] = std::max(slow[i + 1], here);
        changed_before = changed;
    }
    double total = 0.0;
    for (std::size_t i = 0; i < moves; ++i) total += seconds[i] * slow[i];
    return total;
}

}  // namespace

double rotaryExcess(const kinematics::Machine& machine, std::span<const CutterLocation> poses) {
    // What a CL file's last decimal can be off by.
    constexpr double rounding_rad = 1e-6;
    double excess = 0.0;
    for (const CutterLocation& pose : poses) {
        const double one = excessOf(machine, pose.axis);
        if (one > rounding_rad) excess += base::degFromRad(one);
    }
    return poses.empty() ? 0.0 : excess / static_cast<double>(poses.size());
}

AxisMotion axisMotion(const MachinePlace& place, const StartPath& path, std::span<const CutterLocation> poses) {
    AxisMotion motion;
    planRotary(place, path, poses, motion);
    const std::vector<AxisVector> axes = positions(place, poses, motion);
    motion.range_excess /= static_cast<double>(poses.size());
    const AxisLimits limits = dynamics::limitsOf(*place.machine);
    motion.time_s = localTime(limits, path, poses, axes);
    motion.harmony_s = motion.time_s;
    for (std::size_t i = 0; i < place.machine->rotaryCount(); ++i)
        motion.harmony_s += motion.rotary_travel_rad[i] / place.machine->rotaryVelocity(i);
    return motion;
}

std::optional<double> machiningTime(const MachinePlace& place, const StartPath& path,
                                    std::span<const CutterLocation> poses, const AxisMotion& motion,
                                    double tolerance_mm) {
    const dynamics::ToolPath chain(*place.machine, place.tool_length_mm, place.origin_mm);
    dynamics::MotionPlanner planner(dynamics::limitsOf(*place.machine), {},
                                    [&chain](const AxisVector& at) { return chain.placeOf(at); });
    double seconds = 0.0;
    const auto run = [&] {
        while (planner.ready())
            for (const auto& piece : planner.plan().committed) seconds += piece.law.duration_s;
    };
    for (std::size_t i = 1; i < poses.size(); ++i) {
        auto block =
            chain.line({poses[i - 1].tip_mm, motion.rotary_rad[i - 1]}, {poses[i].tip_mm, motion.rotary_rad[i]});
        if (!block) return std::nullopt;
        const StartLocation& to = path.locations[i];
        const bool feeds = to.kind == MotionKind::Feed && to.feed_mm_per_s > 0.0;
        block->feed_mm_per_s = feeds ? to.feed_mm_per_s : std::numeric_limits<double>::infinity();
        block->tolerance_mm = tolerance_mm;
        block->exact_stop = !feeds;
        planner.add(*block);
        run();
    }
    planner.stop();
    run();
    return seconds;
}

}  // namespace cusp::tilt
