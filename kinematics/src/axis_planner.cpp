// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Dynamic programming over branches and windings: costs, the forward step, and deciding.
#include <cusp/kinematics/axis_planner.hpp>

#include <cusp/kinematics/angles.hpp>
#include <cusp/kinematics/axis_following.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
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
    demand(orientation_tolerance_rad > 0.0 && orientation_tolerance_rad < 0.2, "orientation_tolerance_rad",
           orientation_tolerance_rad, "lie in 0 to 0.2");
    demand(pole_cone_rad >= 0.0 && pole_cone_rad < 0.2, "pole_cone_rad", pole_cone_rad, "lie in 0 to 0.2");
    demand(pole_cone_penalty_s >= 0.0 && pole_cone_penalty_s <= 3600.0, "pole_cone_penalty_s", pole_cone_penalty_s,
           "lie in 0 to 3600");
    demand(rewind_penalty_s >= 0.0 && rewind_penalty_s <= 3600.0, "rewind_penalty_s", rewind_penalty_s,
           "lie in 0 to 3600");
    return report;
}

AxisPlanner::AxisPlanner(const Machine& machine, PlannerOptions options)
    : machine_(machine), options_(std::move(options)) {
    for (std::size_t i = 0; i < machine_.rotaryCount(); ++i) {
        seconds_per_rad_[i] = 1.0 / machine_.rotaryVelocity(i);
        endless_[i] = machine_.rotaryRange(i).endless;
    }
    options_.window_points = std::max<std::size_t>(options_.window_points, 2);
    layers_.reserve(std::min<std::size_t>(options_.window_points, 1024));
    last_ = options_.start_rad;
}

void AxisPlanner::follow(Layer& layer, const AxisSolutions& solved, const Vector3& axis) {
    const double gap_rad = solved.gap_rad;
    if (solved_before_ && layer.cutting) {
        // Refined, a change of branch at the meeting place parts from the great circle by the gap there, and by up to a
        // third more when the parts on either side differ in length.
        constexpr double share = 0.7;
        const double limit_rad = share * options_.orientation_tolerance_rad;
        const double chord = (axis - axis_before_).norm();
        const bool free_end = solved.pole || solved_before_->pole || solved.count < 2 || solved_before_->count < 2;
        constexpr double arc_per_chord = std::numbers::pi / 2.0;
        const double cone_rad = std::max(limit_rad, share * options_.pole_cone_rad);
        layer.branches_meet = free_end;
        if (!free_end && gap_rad + gap_before_rad_ - arc_per_chord * chord <= 2.0 * cone_rad) {
            const double nearest_rad = nearestMeeting(machine_, axis_before_, axis).gap_rad;
            layer.branches_meet = nearest_rad <= limit_rad;
            layer.cone_meets = nearest_rad <= cone_rad;
        }
        if (!free_end)
            for (std::size_t b = 0; b < 2; ++b) layer.follow[b] = followStep(*solved_before_, solved, b);
    }
    solved_before_ = solved;
    axis_before_ = axis;
    gap_before_rad_ = gap_rad;
}

AxisPlanner::Way AxisPlanner::wayOf(const Layer& layer, const State& from, const Candidate& to) const {
    if (!layer.cutting || machine_.rotaryCount() == 0) return Way::Followed;
    // A hair beyond a limit is put on the limit, which may part the step from the one followed.
    constexpr double same_rad = 1e-5;
    const double first = std::isnan(from.rotary_rad[0]) ? 0.0 : turned(0, from.rotary_rad[0], to.rotary_rad[0]);
    const double second = turned(1, from.rotary_rad[1], to.rotary_rad[1]);
    const bool half_turn = std::max(first, second) <= std::numbers::pi + same_rad;
    if (layer.branches_meet) return half_turn ? Way::Followed : Way::Rewind;
    const RotaryValues& step = layer.follow[to.branch];
    if (from.branch == to.branch && turned(0, from.rotary_rad[0] + step[0], to.rotary_rad[0]) <= same_rad &&
        turned(1, from.rotary_rad[1] + step[1], to.rotary_rad[1]) <= same_rad)
        return Way::Followed;
    return layer.cone_meets && from.branch != to.branch && half_turn ? Way::ThroughCone : Way::Rewind;
}

/// Of the axes alone, the slower one.
double AxisPlanner::turnTime(const State& from, const Candidate& to) const {
    const bool was_free = std::isnan(from.rotary_rad[0]);
    const double first = was_free ? 0.0 : turned(0, from.rotary_rad[0], to.rotary_rad[0]);
    return std::max(first * seconds_per_rad_[0], turned(1, from.rotary_rad[1], to.rotary_rad[1]) * seconds_per_rad_[1]);
}

AxisPlanner::Cost AxisPlanner::stepCost(const Layer& layer, const State& from, const Candidate& to) const {
    const bool was_free = std::isnan(from.rotary_rad[0]);
    const double first = was_free ? 0.0 : turned(0, from.rotary_rad[0], to.rotary_rad[0]);
    const double second = turned(1, from.rotary_rad[1], to.rotary_rad[1]);
    double time_s = std::max(first * seconds_per_rad_[0], second * seconds_per_rad_[1]);
    const Way way = wayOf(layer, from, to);
    if (way != Way::Followed) time_s += way == Way::Rewind ? options_.rewind_penalty_s : options_.pole_cone_penalty_s;
    return {.time_ns = nano(time_s),
            .travel_nrad = nano(first + second),
            .start_nrad = was_free && !std::isnan(to.rotary_rad[0]) ? nano(std::abs(to.rotary_rad[0])) : 0};
}

/// `likely` is asked first: most of the others then take longer by their turn alone.
AxisPlanner::Frontier AxisPlanner::reached(const Layer& layer, const Candidate& candidate, std::size_t likely) const {
    Frontier best{.state = {.rotary_rad = candidate.rotary_rad, .before = 0, .branch = candidate.branch},
                  .cost = {},
                  .alive = false};
    if (likely < frontier_.size()) consider(layer, candidate, likely, best);
    for (std::size_t i = 0; i < frontier_.size(); ++i)
        if (i != likely) consider(layer, candidate, i, best);
    return best;
}

/// Among equals the first counts.
void AxisPlanner::consider(const Layer& layer, const Candidate& candidate, std::size_t index, Frontier& best) const {
    const Frontier& from = frontier_[index];
    if (!from.alive) return;
    // At the pole only the states with this very angle lead here: the first axis keeps still.
    if (layer.pole && from.state.rotary_rad[0] != candidate.rotary_rad[0] &&
        !(std::isnan(from.state.rotary_rad[0]) && std::isnan(candidate.rotary_rad[0])))
        return;
    // Whatever the way, it takes the time of the turn.
    if (best.alive && from.cost.time_ns + nano(turnTime(from.state, candidate)) > best.cost.time_ns) return;
    Cost cost = stepCost(layer, from.state, candidate);
    cost.time_ns += from.cost.time_ns;
    cost.travel_nrad += from.cost.travel_nrad;
    cost.start_nrad += from.cost.start_nrad;
    if (best.alive && (best.cost < cost || (cost == best.cost && best.state.before < index))) return;
    best.alive = true;
    best.cost = cost;
    best.state.before = static_cast<std::uint32_t>(index);
}

void AxisPlanner::addState(const Layer& layer, const Candidate& candidate) {
    if (!layers_.empty()) {
        reached_.push_back(reached(layer, candidate, reached_.size()));
        return;
    }
    Frontier first{.state = {.rotary_rad = candidate.rotary_rad, .before = 0, .branch = candidate.branch}, .cost = {}};
    if (last_)
        first.cost = stepCost(layer, {.rotary_rad = *last_, .before = 0, .branch = last_branch_}, candidate);
    else
        for (const double angle : candidate.rotary_rad)
            first.cost.start_nrad += std::isnan(angle) ? 0 : nano(std::abs(angle));
    reached_.push_back(first);
}

void AxisPlanner::push(const AxisPoint& point) {
    const AxisSolutions solved = machine_.solveAxis(point.axis, options_.pole_tolerance_rad);
    Layer layer;
    layer.miss_rad = solved.miss_rad;
    layer.pole = solved.pole;
    layer.first = states_.size();
    layer.line = point.line;
    layer.cutting = point.cutting;
    follow(layer, solved, point.axis);
    gatherCandidates(solved);
    if (candidates_.empty()) {
        layer.within_limits = false;
        gatherNearest(solved);
    }
    reached_.clear();
    for (const Candidate& candidate : candidates_) addState(layer, candidate);
    frontier_.swap(reached_);
    for (const Frontier& state : frontier_) states_.push_back(state.state);
    layer.count = frontier_.size();
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
    std::uint32_t best = 0;
    for (std::uint32_t i = 0; i < frontier_.size(); ++i) {
        const Frontier& leader = frontier_[best];
        if (frontier_[i].alive && (!leader.alive || frontier_[i].cost < leader.cost)) best = i;
    }
    std::vector<std::uint32_t> chosen(layers_.size());
    for (std::size_t l = layers_.size(); l-- > 0;) {
        chosen[l] = best;
        best = states_[layers_[l].first + best].before;
    }
    return chosen;
}

std::size_t AxisPlanner::settleFreeAngle(std::vector<std::uint32_t>& chosen, std::size_t layer_count) {
    const auto first_angle = [&](std::size_t l) -> double& {
        return states_[layers_[l].first + chosen[l]].rotary_rad[0];
    };
    std::size_t bound = 0;
    while (bound < layers_.size() && std::isnan(first_angle(bound))) ++bound;
    if (bound == 0) return layer_count;
    if (bound < layers_.size()) {
        for (std::size_t l = 0; l < bound; ++l) first_angle(l) = first_angle(bound);
        settleFrontier();
        return std::max(layer_count, bound + 1);
    }
    const AxisRange& range = machine_.rotaryRange(0);
    const double angle = range.endless ? 0.0 : std::clamp(0.0, range.min, range.max);
    for (State& state : states_)
        if (std::isnan(state.rotary_rad[0])) state.rotary_rad[0] = angle;
    settleFrontier();
    return layer_count;
}

void AxisPlanner::commit(std::size_t layer_count) {
    std::vector<std::uint32_t> chosen = traceBack();
    layer_count = settleFreeAngle(chosen, layer_count);
    for (std::size_t l = 0; l < layer_count; ++l) handOut(layers_[l], states_[layers_[l].first + chosen[l]]);
    dropFront(layer_count, chosen[layer_count - 1]);
}

/// The states of the last layer are kept twice.
void AxisPlanner::settleFrontier() {
    for (std::size_t i = 0; i < frontier_.size(); ++i) frontier_[i].state = states_[layers_.back().first + i];
}

void AxisPlanner::dropFront(std::size_t layer_count, std::uint32_t chosen) {
    if (layer_count == layers_.size()) {
        layers_.clear();
        states_.clear();
        frontier_.clear();
        return;
    }
    // What does not descend from the last point handed out would break the path, however cheap it is.
    for (std::uint32_t i = 0; i < frontier_.size(); ++i) {
        std::uint32_t ancestor = i;
        for (std::size_t l = layers_.size(); l-- > layer_count;) ancestor = states_[layers_[l].first + ancestor].before;
        frontier_[i].alive = frontier_[i].alive && ancestor == chosen;
    }
    // Costs count from here on, so that they stay far from overflow on paths of any length.
    const auto cheapest =
        std::min_element(frontier_.begin(), frontier_.end(), [](const Frontier& a, const Frontier& b) {
            return a.alive != b.alive ? a.alive : a.cost < b.cost;
        });
    const Cost spent = cheapest->cost;
    for (Frontier& state : frontier_) {
        state.cost.time_ns -= spent.time_ns;
        state.cost.travel_nrad -= spent.travel_nrad;
        state.cost.start_nrad -= spent.start_nrad;
    }
    const std::size_t first_kept = layers_[layer_count].first;
    states_.erase(states_.begin(), states_.begin() + static_cast<std::ptrdiff_t>(first_kept));
    layers_.erase(layers_.begin(), layers_.begin() + static_cast<std::ptrdiff_t>(layer_count));
    for (Layer& layer : layers_) layer.first -= first_kept;
}

}  // namespace cusp::kinematics
