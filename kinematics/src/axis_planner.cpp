// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Dynamic programming over branches and windings: costs, the forward step, and deciding.
#include <cusp/kinematics/axis_planner.hpp>

#include <cusp/kinematics/angles.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace cusp::kinematics {
namespace {

/// To the nearest billionth; values are never negative.
std::int64_t nano(double value) {
    constexpr double half = 0.5e-9;
    return static_cast<std::int64_t>((value + half) * 1e9);
}

}  // namespace

base::Diagnostics PlannerOptions::check() const {
    base::Diagnostics report;
    const auto demand = [&](bool holds, std::string_view name, double value, std::string_view rule) {
        if (!holds) report.error("kinematics.option", fmt::format("{} is {:g}; it must {}", name, value, rule));
    };
    demand(window_points >= 2, "window_points", static_cast<double>(window_points), "be at least 2");
    demand(axis_tolerance_rad >= 0.0 && axis_tolerance_rad < 0.1, "axis_tolerance_rad", axis_tolerance_rad,
           "lie in 0 to 0.1");
    demand(pole_tolerance_rad >= 0.0 && pole_tolerance_rad < 0.1, "pole_tolerance_rad", pole_tolerance_rad,
           "lie in 0 to 0.1");
    demand(rewind_threshold_rad > 0.0, "rewind_threshold_rad", rewind_threshold_rad, "be above 0");
    demand(rewind_penalty_s >= 0.0 && rewind_penalty_s <= 3600.0, "rewind_penalty_s", rewind_penalty_s,
           "lie in 0 to 3600");
    return report;
}

AxisPlanner::AxisPlanner(const Machine& machine, PlannerOptions options)
    : machine_(machine), options_(std::move(options)) {
    for (std::size_t i = 0; i < machine_.rotaryCount(); ++i) seconds_per_rad_[i] = 1.0 / machine_.rotaryVelocity(i);
    options_.window_points = std::max<std::size_t>(options_.window_points, 2);
    layers_.reserve(std::min<std::size_t>(options_.window_points, 1024));
    last_ = options_.start_rad;
}

double AxisPlanner::turned(std::size_t axis, double from, double to) const {
    const double difference = to - from;
    return std::abs(machine_.rotaryRange(axis).endless ? wrapAngle(difference) : difference);
}

/// The largest turn of the shortest way to the layer if there were no limits.
double AxisPlanner::shortestWay(const Layer& layer, const RotaryValues& from) const {
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t b = 0; b < layer.solved.count; ++b) {
        const RotaryValues& branch = layer.solved.branch[b];
        const double first = layer.solved.pole || std::isnan(from[0]) ? 0.0 : std::abs(wrapAngle(branch[0] - from[0]));
        shortest = std::min(shortest, std::max(first, std::abs(wrapAngle(branch[1] - from[1]))));
    }
    return shortest;
}

bool AxisPlanner::isRewind(const Layer& layer, const RotaryValues& from, const RotaryValues& to,
                           double& shortest_rad) const {
    const double first = std::isnan(from[0]) ? 0.0 : turned(0, from[0], to[0]);
    const double widest = std::max(first, turned(1, from[1], to[1]));
    if (!layer.cutting || widest < options_.rewind_threshold_rad) return false;
    if (shortest_rad == not_known) shortest_rad = shortestWay(layer, from);
    return widest - shortest_rad >= options_.rewind_threshold_rad;
}

AxisPlanner::Cost AxisPlanner::stepCost(const Layer& layer, const RotaryValues& from, const RotaryValues& to,
                                        double& shortest_rad) const {
    const bool was_free = std::isnan(from[0]);
    const double first = was_free ? 0.0 : turned(0, from[0], to[0]);
    const double second = turned(1, from[1], to[1]);
    double time_s = std::max(first * seconds_per_rad_[0], second * seconds_per_rad_[1]);
    if (isRewind(layer, from, to, shortest_rad)) time_s += options_.rewind_penalty_s;
    return {.time_ns = nano(time_s),
            .travel_nrad = nano(first + second),
            .start_nrad = was_free && !std::isnan(to[0]) ? nano(std::abs(to[0])) : 0};
}

void AxisPlanner::addState(const Layer& layer, const RotaryValues& candidate) {
    State state{.rotary_rad = candidate, .cost = {}, .before = 0, .alive = true};
    if (layers_.empty()) {
        double shortest_rad = not_known;
        if (last_)
            state.cost = stepCost(layer, *last_, candidate, shortest_rad);
        else
            for (const double angle : candidate) state.cost.start_nrad += std::isnan(angle) ? 0 : nano(std::abs(angle));
        states_.push_back(state);
        return;
    }
    const Layer& before = layers_.back();
    bool found = false;
    for (std::size_t i = 0; i < before.count; ++i) {
        const State& from = states_[before.first + i];
        if (!from.alive) continue;
        // At the pole only the states with this very angle lead here: the first axis keeps still.
        if (layer.solved.pole && from.rotary_rad[0] != candidate[0] &&
            !(std::isnan(from.rotary_rad[0]) && std::isnan(candidate[0])))
            continue;
        Cost cost = stepCost(layer, from.rotary_rad, candidate, shortest_rad_[i]);
        cost.time_ns += from.cost.time_ns;
        cost.travel_nrad += from.cost.travel_nrad;
        cost.start_nrad += from.cost.start_nrad;
        if (found && !(cost < state.cost)) continue;
        found = true;
        state.cost = cost;
        state.before = static_cast<std::uint32_t>(i);
    }
    state.alive = found;
    states_.push_back(state);
}

void AxisPlanner::push(const AxisPoint& point) {
    Layer layer;
    layer.solved = machine_.solveAxis(point.axis, options_.pole_tolerance_rad);
    layer.first = states_.size();
    layer.line = point.line;
    layer.cutting = point.cutting;
    gatherCandidates(layer);
    if (candidates_.empty()) {
        layer.within_limits = false;
        gatherNearest(layer);
    }
    shortest_rad_.assign(layers_.empty() ? 0 : layers_.back().count, not_known);
    for (const RotaryValues& candidate : candidates_) addState(layer, candidate);
    layer.count = states_.size() - layer.first;
    layers_.push_back(layer);
    if (layers_.size() >= options_.window_points) commit(layers_.size() / 2);
}

void AxisPlanner::finish() {
    if (!layers_.empty()) commit(layers_.size());
}

bool AxisPlanner::pop(PlannedAxes& out) {
    if (next_ready_ == ready_.size()) {
        ready_.clear();
        next_ready_ = 0;
        return false;
    }
    out = ready_[next_ready_++];
    return true;
}

std::vector<std::uint32_t> AxisPlanner::traceBack() const {
    const Layer& last = layers_.back();
    std::uint32_t best = 0;
    for (std::uint32_t i = 0; i < last.count; ++i) {
        const State& state = states_[last.first + i];
        const State& leader = states_[last.first + best];
        if (state.alive && (!leader.alive || state.cost < leader.cost)) best = i;
    }
    std::vector<std::uint32_t> chosen(layers_.size());
    for (std::size_t l = layers_.size(); l-- > 0;) {
        chosen[l] = best;
        best = states_[layers_[l].first + best].before;
    }
    return chosen;
}

/// A path that begins at the pole takes its first angle from its first point off it, which is then decided as well. With
/// no such point in the window, the angle is the one nearest to zero.
std::size_t AxisPlanner::settleFreeAngle(std::vector<std::uint32_t>& chosen, std::size_t layer_count) {
    const auto first_angle = [&](std::size_t l) -> double& {
        return states_[layers_[l].first + chosen[l]].rotary_rad[0];
    };
    std::size_t bound = 0;
    while (bound < layers_.size() && std::isnan(first_angle(bound))) ++bound;
    if (bound == 0) return layer_count;
    if (bound < layers_.size()) {
        for (std::size_t l = 0; l < bound; ++l) first_angle(l) = first_angle(bound);
        return std::max(layer_count, bound + 1);
    }
    const AxisRange& range = machine_.rotaryRange(0);
    const double angle = range.endless ? 0.0 : std::clamp(0.0, range.min, range.max);
    for (State& state : states_)
        if (std::isnan(state.rotary_rad[0])) state.rotary_rad[0] = angle;
    return layer_count;
}

void AxisPlanner::commit(std::size_t layer_count) {
    std::vector<std::uint32_t> chosen = traceBack();
    layer_count = settleFreeAngle(chosen, layer_count);
    for (std::size_t l = 0; l < layer_count; ++l) handOut(layers_[l], states_[layers_[l].first + chosen[l]].rotary_rad);
    dropFront(layer_count, chosen[layer_count - 1]);
}

void AxisPlanner::dropFront(std::size_t layer_count, std::uint32_t chosen) {
    if (layer_count == layers_.size()) {
        layers_.clear();
        states_.clear();
        return;
    }
    // What does not descend from the last point handed out would break the path, however cheap it is.
    const std::size_t first_kept = layers_[layer_count].first;
    for (std::size_t l = layer_count; l < layers_.size(); ++l)
        for (std::size_t i = 0; i < layers_[l].count; ++i) {
            State& state = states_[layers_[l].first + i];
            state.alive = state.alive && (l == layer_count ? state.before == chosen
                                                           : states_[layers_[l - 1].first + state.before].alive);
        }
    // Costs count from here on, so that they stay far from overflow on paths of any length.
    const Cost spent = states_[layers_[layer_count - 1].first + chosen].cost;
    for (std::size_t i = 0; i < layers_.back().count; ++i) {
        Cost& cost = states_[layers_.back().first + i].cost;
        cost.time_ns -= spent.time_ns;
        cost.travel_nrad -= spent.travel_nrad;
        cost.start_nrad -= spent.start_nrad;
    }
    states_.erase(states_.begin(), states_.begin() + static_cast<std::ptrdiff_t>(first_kept));
    layers_.erase(layers_.begin(), layers_.begin() + static_cast<std::ptrdiff_t>(layer_count));
    for (Layer& layer : layers_) layer.first -= first_kept;
}

}  // namespace cusp::kinematics
