// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Runs from rest to rest, and the window that moves along them.
#include <cusp/dynamics/motion_planner.hpp>

#include "window_plan.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

namespace cusp::dynamics {

namespace {

/// A corner that may be rounded by less than this is stopped at.
constexpr double least_tolerance_mm = 1e-4;
constexpr double least_tolerance_rad = 1e-7;
constexpr double straight_on_rad = 1e-7;
/// Of a window's blocks, those that are committed; the rest is what the machine could still stop on.
constexpr double committed_share = 0.6;
constexpr std::size_t tail_spans = 8;
/// Bounds the work where blocks have many points.
constexpr std::size_t most_vertices = 600;

struct Run {
    Run(const PathPoint& start, std::size_t axis_count) : path(start, axis_count) {}
    Polyline path;
    bool closed = false;
};

/// What is needed of a block to see the corner to the next one.
struct BlockEnd {
    PathPoint before;
    PathPoint at;
    double tolerance_mm = 0.0;
    double orientation_tolerance_rad = 0.0;
};

/// Whether the axes change direction between two edges.
bool turns(const PathPoint& a, const PathPoint& b, const PathPoint& c, std::size_t axis_count) {
    const double before = pathLength(a, b, axis_count);
    const double after = pathLength(b, c, axis_count);
    if (before <= 0.0 || after <= 0.0) return false;
    for (std::size_t i = 0; i < axis_count; ++i)
        if (std::abs((b.axes[i] - a.axes[i]) / before - (c.axes[i] - b.axes[i]) / after) > straight_on_rad) return true;
    return false;
}

}  // namespace

struct MotionPlanner::State {
    State(AxisLimits axis_limits, PlannerOptions planner_options, ToolModel tool_model)
        : limits(axis_limits), options(planner_options), tool(std::move(tool_model)) {}

    AxisLimits limits;
    PlannerOptions options;
    ToolModel tool;
    PlanSummary summary;
    std::deque<Run> runs;
    std::optional<MotionStart> start;   ///< in the first run; absent at rest
    WindowPlan last_plan;               ///< in this run
    std::size_t done_spans = 0;         ///< of it, committed
    double rest_end = 0.0;              ///< path length where it comes to rest
    std::size_t windows_wanted = 1;     ///< more while one holds too little path to commit any of
    std::optional<BlockEnd> block_end;  ///< of the block added last

    void open(const PathPoint& point) {
        if (!runs.empty()) runs.back().closed = true;
        runs.emplace_back(point, limits.count);
    }

    [[nodiscard]] bool mustStop(const PathBlock& block) const {
        if (!block_end || block.points.size() < 2) return false;
        const double tip = std::min(block_end->tolerance_mm, block.tolerance_mm);
        const double axis = std::min(block_end->orientation_tolerance_rad, block.orientation_tolerance_rad);
        if (tip >= least_tolerance_mm && axis >= least_tolerance_rad) return false;
        return turns(block_end->before, block_end->at, block.points[1], limits.count);
    }

    /// The window's last vertex, and whether it is the end of a run that ends at rest.
    [[nodiscard]] std::size_t horizon(const Run& run) const {
        std::size_t blocks = 0;
        const auto& edges = run.path.edges();
        for (std::size_t i = 0; i < edges.size(); ++i) {
            if (edges[i].ends_block) ++blocks;
            if (blocks == windows_wanted * options.window_blocks || i + 1 == windows_wanted * most_vertices)
                return i + 1;
        }
        return edges.size();
    }

    void finishRun(Plan& plan) {
        plan.committed.insert(plan.committed.end(), plan.to_rest.begin(), plan.to_rest.end());
        plan.to_rest.clear();
        runs.pop_front();
        start.reset();
        last_plan = {};
        windows_wanted = 1;
        ++summary.stops;
    }

    Plan advance();
    Plan fallBack();
    Plan toRestBefore(std::size_t horizon_vertex);
    [[nodiscard]] std::vector<MotionPiece> planAlone(std::size_t edge) const;
    void commit(std::size_t spans, Plan& plan);
    void restAt(double s);
};

MotionPlanner::MotionPlanner(AxisLimits limits, PlannerOptions options, ToolModel tool)
    : state_(std::make_unique<State>(limits, options, std::move(tool))) {}
MotionPlanner::~MotionPlanner() = default;
MotionPlanner::MotionPlanner(MotionPlanner&&) noexcept = default;
MotionPlanner& MotionPlanner::operator=(MotionPlanner&&) noexcept = default;

void MotionPlanner::add(const PathBlock& block) {
    State& state = *state_;
    if (block.points.empty()) return;
    const bool continues =
        !state.runs.empty() && !state.runs.back().closed &&
        pathLength(state.runs.back().path.vertices().back().point, block.points.front(), state.limits.count) < 1e-9;
    if (!continues || state.mustStop(block)) state.open(block.points.front());
    Run& run = state.runs.back();
    const std::size_t before = run.path.edges().size();
    run.path.append(block);
    if (run.path.edges().size() == before) return;
    ++state.summary.blocks;
    const auto& vertices = run.path.vertices();
    state.block_end = {vertices[vertices.size() - 2].point, vertices.back().point, block.tolerance_mm,
                       block.orientation_tolerance_rad};
    if (block.exact_stop) run.closed = true;
}

void MotionPlanner::stop() {
    if (!state_->runs.empty()) state_->runs.back().closed = true;
}

bool MotionPlanner::ready() const {
    const auto& runs = state_->runs;
    if (runs.empty()) return false;
    return runs.front().closed ||
           runs.front().path.blocks() >= state_->windows_wanted * state_->options.window_blocks ||
           runs.front().path.edges().size() >= state_->windows_wanted * most_vertices;
}

std::size_t MotionPlanner::waiting() const {
    std::size_t blocks = 0;
    for (const Run& run : state_->runs) blocks += run.path.blocks();
    return blocks;
}

Plan MotionPlanner::plan() { return state_->advance(); }

void MotionPlanner::takeRest() {
    if (state_->last_plan.pieces.empty()) return;
    state_->restAt(state_->rest_end);
}

const PlanSummary& MotionPlanner::summary() const { return state_->summary; }

Plan MotionPlanner::State::advance() {
    while (!runs.empty() && runs.front().closed && runs.front().path.edges().empty()) runs.pop_front();
    Plan out;
    if (runs.empty() || runs.front().path.edges().empty()) return out;
    Run& run = runs.front();
    const std::size_t last = horizon(run);
    const bool whole = run.closed && last == run.path.edges().size();
    ++summary.windows;
    if (whole && !start) {
        out.committed = planStraight(run.path, limits);
        if (!out.committed.empty()) {
            finishRun(out);
            return out;
        }
    }
    WindowPlan window = planWindow(run.path, last, start, limits, options.limit_use, tool);
    if (!window.usable && start) return fallBack();
    if (!window.usable) return toRestBefore(last);
    summary.largest_tip_mm = std::max(summary.largest_tip_mm, window.tip_mm);
    summary.largest_axis_rad = std::max(summary.largest_axis_rad, window.axis_rad);
    if (whole) {
        out.committed = std::move(window.pieces);
        finishRun(out);
        return out;
    }
    const double begin = window.knots[2];
    rest_end = run.path.vertices()[last].s;
    const double until = begin + committed_share * (rest_end - begin);
    std::size_t spans = 0;
    while (spans + tail_spans < window.first_piece.size() && window.knots[spans + 2] < until) ++spans;
    if (window.first_piece.size() < 2 * tail_spans) {
        windows_wanted *= 2;
        spans = 0;
    }
    last_plan = std::move(window);
    done_spans = 0;
    commit(spans, out);
    return out;
}

/// That many more spans of the last plan.
void MotionPlanner::State::commit(std::size_t spans, Plan& plan) {
    const auto at = [&](std::size_t span) {
        return last_plan.pieces.begin() + static_cast<std::ptrdiff_t>(last_plan.first_piece[span]);
    };
    const auto border = at(done_spans + spans);
    plan.committed.assign(at(done_spans), border);
    plan.to_rest.assign(border, last_plan.pieces.end());
    done_spans += spans;
    if (spans == 0) return;
    start = last_plan.startAt(done_spans);
    runs.front().path.forget(start->knots.front());
}

/// The plan before is still good: half of what is left of it is run, and from there the window is tried again; where too
/// little is left, all of it, and the next motion starts from its rest.
Plan MotionPlanner::State::fallBack() {
    Plan out;
    ++summary.fallbacks;
    const std::size_t left = last_plan.first_piece.size() - done_spans;
    if (left >= tail_spans) {
        commit(left / 2, out);
        return out;
    }
    commit(0, out);
    out.committed.swap(out.to_rest);
    restAt(rest_end);
    return out;
}

/// From rest, with a place in the window that has no plan: half the window, and half of that, until what is left ends before
/// it, or is a single edge, which has a closed form. That is run to its rest, so that the place costs stops around itself only.
Plan MotionPlanner::State::toRestBefore(std::size_t horizon_vertex) {
    Plan out;
    ++summary.fallbacks;
    const Polyline& path = runs.front().path;
    std::size_t last = horizon_vertex;
    while (out.committed.empty() && last > 1) {
        last /= 2;
        WindowPlan window = planWindow(path, last, start, limits, options.limit_use, tool);
        if (!window.usable) continue;
        summary.largest_tip_mm = std::max(summary.largest_tip_mm, window.tip_mm);
        summary.largest_axis_rad = std::max(summary.largest_axis_rad, window.axis_rad);
        out.committed = std::move(window.pieces);
    }
    if (out.committed.empty()) out.committed = planAlone(0);
    restAt(path.vertices()[last].s);
    return out;
}

/// The closed form of one edge, from rest to rest.
std::vector<MotionPiece> MotionPlanner::State::planAlone(std::size_t edge) const {
    const Polyline& path = runs.front().path;
    std::vector<MotionPiece> pieces = planStraight(path.edgeAlone(edge), limits);
    for (MotionPiece& piece : pieces) {
        piece.path_mm += path.vertices()[edge].s;
        piece.block = path.edges()[edge].block;
    }
    return pieces;
}

void MotionPlanner::State::restAt(double s) {
    runs.front().path.forget(s);
    start.reset();
    last_plan = {};
    ++summary.stops;
    if (runs.front().path.end() <= s) {
        const PathPoint point = runs.front().path.vertices().back().point;
        const bool closed = runs.front().closed;
        runs.pop_front();
        if (!closed) runs.emplace_front(point, limits.count);
    }
}

}  // namespace cusp::dynamics
