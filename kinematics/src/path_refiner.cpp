// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Halving a move until the rotary axes, turning linearly, keep the tool axis near its great circle.
#include <cusp/kinematics/path_refiner.hpp>

#include "message_text.hpp"

#include <cusp/kinematics/angles.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace cusp::kinematics {
namespace {

// Halving 40 times leaves a part of 1e-12; only a swing that no insertion mends comes so far.
constexpr int deepest = 40;
// Sampling may miss the maximum by 0.3 %.
constexpr double sampled_part = 0.995;

}  // namespace

base::Diagnostics RefinerOptions::check() const {
    base::Diagnostics report;
    constexpr double least_deg = 0.001;
    const double tolerance_deg = base::degFromRad(orientation_tolerance_rad);
    if (!(tolerance_deg >= least_deg && tolerance_deg <= 10.0))
        report.error("kinematics.option", fmt::format("orientation tolerance is {:g}°; it must lie in {}° to 10°",
                                                      tolerance_deg, least_deg));
    return report;
}

PathRefiner::PathRefiner(const Machine& machine, RefinerOptions options)
    : machine_(machine), options_(std::move(options)) {}

const std::vector<PathPoint>& PathRefiner::advance(const PathPoint& next) {
    out_.clear();
    if (last_ && next.cutting && !next.rewind) refine(*last_, next);
    out_.push_back(next);
    last_ = next;
    return out_;
}

void PathRefiner::refine(const PathPoint& from, const PathPoint& to) {
    const double travel =
        std::abs(to.rotary_rad[0] - from.rotary_rad[0]) + std::abs(to.rotary_rad[1] - from.rotary_rad[1]);
    // Both ways have the same ends and second derivatives of at most travel²: they part by travel²/4 at most.
    if (0.25 * travel * travel <= options_.orientation_tolerance_rad) return;

    from_axis_ = machine_.toolAxis(from.rotary_rad);
    to_axis_ = machine_.toolAxis(to.rotary_rad);
    meeting_fraction_ = nearestMeeting(machine_, from_axis_, to_axis_).fraction;
    worst_rad_ = 0.0;
    inserted_.clear();
    divide(endNode(0.0, from.rotary_rad, from_axis_), endNode(1.0, to.rotary_rad, to_axis_), 0);

    if (worst_rad_ > summary_.max_deviation_rad) {
        summary_.max_deviation_rad = worst_rad_;
        summary_.max_deviation_line = to.line;
    }
    if (worst_rad_ > options_.orientation_tolerance_rad) {
        ++summary_.not_within;
        report_.error(
            "kinematics.between-axis",
            fmt::format("on the way to CL line {} the tool axis swings {}° off, tolerance {}°: {} and {} from "
                        "{}, {} to {}, {}; more points in the CL file or a larger tolerance help",
                        to.line, degreeText(worst_rad_), degreeText(options_.orientation_tolerance_rad),
                        machine_.rotaryNames().front(), machine_.rotaryNames().back(), degreeText(from.rotary_rad[0]),
                        degreeText(from.rotary_rad[1]), degreeText(to.rotary_rad[0]), degreeText(to.rotary_rad[1])),
            {.file = options_.file_name, .line = to.line, .column = 0, .key = {}});
        return;
    }
    if (inserted_.empty()) return;
    ++summary_.refined_moves;
    summary_.inserted += inserted_.size();
    for (const Node& node : inserted_) {
        const Vector3 tip_mm = from.tip_mm + node.fraction * (to.tip_mm - from.tip_mm);
        out_.push_back({.tip_mm = tip_mm, .rotary_rad = node.rotary_rad, .line = to.line, .cutting = true});
    }
    reportLimits(to);
}

void PathRefiner::divide(const Node& from, const Node& to, int depth) {
    const double deviation = linearTurnDeviation(machine_, from.rotary_rad, to.rotary_rad);
    if (deviation <= sampled_part * options_.orientation_tolerance_rad || depth == deepest ||
        inserted_.size() >= options_.max_inserted || machine_.rotaryCount() < 2) {
        worst_rad_ = std::max(worst_rad_, deviation);
        return;
    }
    const Node middle = between(from, to);
    divide(from, middle, depth + 1);
    inserted_.push_back(middle);
    divide(middle, to, depth + 1);
}

PathRefiner::Node PathRefiner::endNode(double fraction, const RotaryValues& rotary_rad, const Vector3& axis) const {
    Node node{.fraction = fraction, .rotary_rad = rotary_rad, .solved = machine_.solveAxis(axis), .branch = any_branch};
    if (node.solved.pole || node.solved.count < 2) return node;
    const auto away = [&](std::size_t branch) {
        return std::abs(wrapAngle(rotary_rad[1] - node.solved.branch[branch][1]));
    };
    node.branch = away(0) <= away(1) ? 0 : 1;
    return node;
}

/// Half way, on the branch of the end it is joined to without passing where the branches meet.
PathRefiner::Node PathRefiner::between(const Node& from, const Node& to) const {
    Node node{.fraction = 0.5 * (from.fraction + to.fraction)};
    node.solved = machine_.solveAxis(onGreatCircle(from_axis_, to_axis_, node.fraction));
    const bool before_meeting = node.fraction <= meeting_fraction_;
    const bool join_from =
        to.branch == any_branch || (from.branch != any_branch && (from.branch == to.branch || before_meeting));
    const Node& joined = join_from ? from : to;
    node.branch = joined.branch;
    if (node.solved.pole || joined.branch == any_branch) {
        // On the pole the first axis stays as it is; between two poles all it can do is to share the turn.
        const bool pole = node.solved.pole;
        node.rotary_rad[0] = pole ? joined.rotary_rad[0] : 0.5 * (from.rotary_rad[0] + to.rotary_rad[0]);
        const double second = node.solved.branch[0][1];
        node.rotary_rad[1] = joined.rotary_rad[1] + wrapAngle(second - joined.rotary_rad[1]);
        if (pole) node.branch = any_branch;
        return node;
    }
    const auto branch = static_cast<std::size_t>(joined.branch);
    const RotaryValues step = followStep(joined.solved, node.solved, branch);
    node.rotary_rad = {joined.rotary_rad[0] + step[0], joined.rotary_rad[1] + step[1]};
    if (node.solved.count < 2) node.branch = any_branch;
    return node;
}

void PathRefiner::reportLimits(const PathPoint& to) {
    for (std::size_t i = 0; i < machine_.rotaryCount(); ++i) {
        const AxisRange& range = machine_.rotaryRange(i);
        double furthest = 0.0;
        double at = 0.0;
        for (const Node& node : inserted_)
            if (const double excess = range.excess(node.rotary_rad[i]); excess > furthest) {
                furthest = excess;
                at = node.rotary_rad[i];
            }
        constexpr double rounding_rad = 1e-6;
        if (furthest <= rounding_rad) continue;
        report_.error("kinematics.axis-limit",
                      fmt::format("{} axis would need {}° on the way to CL line {}; limit {}°",
                                  machine_.rotaryNames()[i], degreeText(at), to.line,
                                  degreeText(at < range.min ? range.min : range.max)),
                      {.file = options_.file_name, .line = to.line, .column = 0, .key = {}});
    }
}

}  // namespace cusp::kinematics
