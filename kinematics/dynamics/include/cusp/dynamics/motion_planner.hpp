// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Look-ahead: blocks in, motion within the limits of every axis out, whatever the length of the program.
#pragma once

#include <cusp/dynamics/motion_piece.hpp>
#include <cusp/dynamics/path_block.hpp>

#include <cstddef>
#include <memory>
#include <vector>

namespace cusp::dynamics {

struct PlannerOptions {
    std::size_t window_blocks = 100;  ///< looked at together; a control's look-ahead buffer
    /// Share of every axis limit that is planned with. The rest is for whoever slows the motion down on its way.
    double limit_use = 0.98;
};

struct PlanSummary {
    std::size_t blocks = 0;
    std::size_t stops = 0;        ///< times the machine comes to rest
    std::size_t windows = 0;      ///< optimisations
    std::size_t fallbacks = 0;    ///< that failed: the plan before was run towards its stop, or a shorter window taken
    double largest_tip_mm = 0.0;  ///< by which smoothing takes the tip off the path
    double largest_axis_rad = 0.0;  ///< … and the tool axis
};

/// The motion planned: `committed` is final and ends in motion or at rest; `to_rest` follows it and comes to rest at the
/// end of what is known, to be run when nothing more is to come in time.
struct Plan {
    std::vector<MotionPiece> committed;
    std::vector<MotionPiece> to_rest;
};

/// Corners between blocks are rounded within the blocks' tolerances by a spline, or stopped at where a tolerance below
/// 0.1 µm or an exact stop asks for it. Along that path speed is the outcome of an optimisation over the window, which always
/// ends at rest, so that whatever comes next there is a way to stop. See README.md.
///
/// The motion handed out keeps the limits at every instant. Memory is bounded by the window.
class MotionPlanner {
public:
    MotionPlanner(AxisLimits limits, PlannerOptions options, ToolModel tool);
    ~MotionPlanner();
    MotionPlanner(const MotionPlanner&) = delete;
    MotionPlanner& operator=(const MotionPlanner&) = delete;
    MotionPlanner(MotionPlanner&&) noexcept;
    MotionPlanner& operator=(MotionPlanner&&) noexcept;

    /// A block starts where the block before ended; a first point elsewhere begins a new path, at rest.
    void add(const PathBlock& block);
    /// The machine comes to rest at the end of what was added.
    void stop();

    /// Whether `plan` has enough to look at: a full window, or a path that ends at rest.
    [[nodiscard]] bool ready() const;
    /// Blocks added and not yet committed.
    [[nodiscard]] std::size_t waiting() const;
    /// Plans what is waiting. Call it until `ready` is false; earlier only where no more blocks come in time.
    [[nodiscard]] Plan plan();
    /// The `to_rest` of the last plan is being run: the next motion starts at rest at its end.
    void takeRest();

    [[nodiscard]] const PlanSummary& summary() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace cusp::dynamics
