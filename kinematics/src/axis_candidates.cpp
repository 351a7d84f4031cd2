// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The planner's two ends: which positions a point can have, and what is handed out and reported of the one chosen.
#include <cusp/kinematics/axis_planner.hpp>

#include "message_text.hpp"

#include <cusp/kinematics/angles.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace cusp::kinematics {
namespace {

// The first rotary angle of a path that begins at the pole, until its first point off the pole decides it.
constexpr double free_angle = std::numeric_limits<double>::quiet_NaN();

/// The winding of `angle_rad` that lies least beyond `range`.
double nearestWinding(const AxisRange& range, double angle_rad) {
    if (range.endless) return angle_rad;
    const double middle = 0.5 * (range.min + range.max);
    return middle + wrapAngle(angle_rad - middle);
}

}  // namespace

void AxisPlanner::addWindings(std::size_t axis, double angle_rad) {
    std::vector<double>& positions = positions_[axis];
    positions.clear();
    const AxisRange& range = machine_.rotaryRange(axis);
    if (axis >= machine_.rotaryCount() || range.endless) {
        positions.push_back(angle_rad);
        return;
    }
    // A horizontal axis printed with six decimals can need 90.00003°; at a limit of 90° that is the limit.
    const double tolerance = options_.axis_tolerance_rad;
    double position = angle_rad;
    while (position - turn_rad >= range.min - tolerance) position -= turn_rad;
    while (position < range.min - tolerance) position += turn_rad;
    for (; position <= range.max + tolerance; position += turn_rad)
        positions.push_back(std::clamp(position, range.min, range.max));
}

/// The free first axis keeps the angles of the states before; at the very start it stays free.
void AxisPlanner::gatherAtPole(const AxisSolutions& solved) {
    std::vector<double>& first = positions_[0];
    first.clear();
    if (!layers_.empty()) {
        for (const Frontier& before : frontier_) {
            const double angle = before.state.rotary_rad[0];
            const bool known = std::any_of(first.begin(), first.end(), [&](double other) {
                return other == angle || (std::isnan(other) && std::isnan(angle));
            });
            if (before.alive && !known) first.push_back(angle);
        }
    } else {
        first.push_back(last_ ? (*last_)[0] : free_angle);
    }
    addWindings(1, solved.branch[0][1]);
}

void AxisPlanner::gatherCandidates(const AxisSolutions& solved) {
    candidates_.clear();
    for (std::size_t b = 0; b < solved.count; ++b) {
        if (solved.pole)
            gatherAtPole(solved);
        else
            for (std::size_t i = 0; i < 2; ++i) addWindings(i, solved.branch[b][i]);
        for (const double first : positions_[0])
            for (const double second : positions_[1])
                candidates_.push_back({{first, second}, static_cast<std::uint8_t>(b)});
    }
}

/// No candidate lies within the limits: the one (or ones, when equal) that lies least beyond them.
void AxisPlanner::gatherNearest(const AxisSolutions& solved) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < solved.count; ++b) {
        RotaryValues nearest = solved.branch[b];
        double excess = 0.0;
        for (std::size_t i = 0; i < machine_.rotaryCount(); ++i) {
            if (i == 0 && solved.pole) continue;
            nearest[i] = nearestWinding(machine_.rotaryRange(i), nearest[i]);
            excess = std::max(excess, machine_.rotaryRange(i).excess(nearest[i]));
        }
        constexpr double equal_rad = 1e-9;
        if (excess > least + equal_rad) continue;
        if (excess < least - equal_rad) candidates_.clear();
        least = std::min(least, excess);
        if (!solved.pole) {
            candidates_.push_back({nearest, static_cast<std::uint8_t>(b)});
            continue;
        }
        gatherAtPole(solved);
        for (const double first : positions_[0])
            candidates_.push_back({{first, nearest[1]}, static_cast<std::uint8_t>(b)});
    }
}

void AxisPlanner::handOut(const Layer& layer, const State& chosen) {
    const Way way = last_ ? wayOf(layer, {.rotary_rad = *last_, .before = 0, .branch = last_branch_},
                                  {chosen.rotary_rad, chosen.branch})
                          : Way::Followed;
    PlannedAxes out{.rotary_rad = chosen.rotary_rad,
                    .line = layer.line,
                    .pole = layer.pole,
                    .within_limits = layer.within_limits,
                    .reached = layer.miss_rad <= options_.axis_tolerance_rad,
                    .rewind = way == Way::Rewind,
                    .in_pole_cone = way == Way::ThroughCone};
    for (std::size_t i = 0; i < machine_.rotaryCount() && last_; ++i) {
        if (machine_.rotaryRange(i).endless) {
            const bool followed = layer.cutting && !layer.branches_meet && way == Way::Followed;
            const double near = (*last_)[i] + (followed ? layer.follow[chosen.branch][i] : 0.0);
            out.rotary_rad[i] = near + wrapAngle(chosen.rotary_rad[i] - near);
        }
        summary_.travel_rad[i] += std::abs(out.rotary_rad[i] - (*last_)[i]);
    }
    reportProblems(layer, last_.value_or(chosen.rotary_rad), out);
    ++summary_.points;
    summary_.pole_points += out.pole ? 1 : 0;
    summary_.limit_violations += out.within_limits ? 0 : 1;
    summary_.unreached += out.reached ? 0 : 1;
    summary_.rewinds += out.rewind ? 1 : 0;
    summary_.pole_cone_moves += out.in_pole_cone ? 1 : 0;
    last_ = out.rotary_rad;
    last_branch_ = chosen.branch;
    ready_.push_back(out);
}

void AxisPlanner::reportProblems(const Layer& layer, const RotaryValues& before, const PlannedAxes& out) {
    const base::Location where{.file = options_.file_name, .line = layer.line, .column = 0, .key = {}};
    if (!out.reached) {
        const std::string miss = degreeText(layer.miss_rad);
        report_.error(
            "kinematics.axis-unreachable",
            machine_.rotaryCount() == 0
                ? fmt::format("the tool axis at CL line {} leans {}° from the spindle, and the machine has no "
                              "rotary axis",
                              layer.line, miss)
                : fmt::format("the tool axis at CL line {} is {}° beyond what the rotary axes can reach", layer.line,
                              miss),
            where);
    }
    for (std::size_t i = 0; i < machine_.rotaryCount() && !out.within_limits; ++i) {
        const AxisRange& range = machine_.rotaryRange(i);
        if (range.excess(out.rotary_rad[i]) == 0.0) continue;
        report_.error("kinematics.axis-limit",
                      fmt::format("{} axis would need {}° at CL line {}; limit {}°", machine_.rotaryNames()[i],
                                  degreeText(out.rotary_rad[i]), layer.line,
                                  degreeText(out.rotary_rad[i] < range.min ? range.min : range.max)),
                      where);
    }
    if (!out.rewind || options_.rewinds_are_handled) return;
    std::string turns;
    for (std::size_t i = 0; i < machine_.rotaryCount(); ++i) {
        const double step = std::abs(out.rotary_rad[i] - before[i]);
        constexpr double worth_saying_rad = 1e-3;
        if (step < worth_saying_rad) continue;
        turns += fmt::format("{}{} axis from {}° to {}° ({}°)", turns.empty() ? "" : ", ", machine_.rotaryNames()[i],
                             degreeText(before[i]), degreeText(out.rotary_rad[i]), degreeText(step));
    }
    report_.error("kinematics.rewind",
                  fmt::format("the limits force a rewind while cutting, at CL line {}: {}", layer.line, turns), where);
}

}  // namespace cusp::kinematics
