// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Takes from a stock what a tool assembly sweeps along its moves, and says what each move removed and what it should not have.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/simulation/stock.hpp>
#include <cusp/simulation/tool_assembly.hpp>
#include <cusp/simulation/tool_move.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace cusp::simulation {

struct MillingOptions {
    /// Of a turning tool: what is taken lies in the exact sweep grown by this, and holds the exact sweep shrunk by it. Moves
    /// that do not turn are exact within 1e-6 mm.
    double sweep_tolerance_mm = 0.002;
    /// Shank, holder and head touch where they go deeper than this into material.
    double touch_tolerance_mm = 0.005;
    /// Number of the first move in reports and in the ends of the stock's spans.
    std::uint32_t first_move = 0;
    /// Called now and then with the moves done; false stops the work (`simulation.interrupted`).
    std::function<bool(std::size_t)> progress;
};

/// What the cutter removed in one move.
struct MoveEngagement {
    double volume_mm3 = 0.0;
    double axial_mm = 0.0;   ///< along the tool axis, from the lowest to the highest place that cut
    double radial_mm = 0.0;  ///< across feed and axis, from one side of what was cut to the other
};

/// A part that must not touch went through material in one move; or the cutter did in a rapid move.
struct Collision {
    std::uint32_t move = 0;
    ToolPart part = ToolPart::Shank;
    double volume_mm3 = 0.0;
    double depth_mm = 0.0;  ///< how far inside the part the deepest place lies
    geometry::Vector3 position_mm = geometry::Vector3::Zero();
};

struct MillingReport {
    double removed_volume_mm3 = 0.0;    ///< by everything that moves
    std::vector<MoveEngagement> moves;  ///< as the moves given
    std::vector<Collision> collisions;  ///< by move, then part
    [[nodiscard]] double collisionVolume() const;
};

/// Moves in their order: the cutter takes its sweep first, then the other parts theirs, each piece of material once. The tip
/// runs on the line, the axis on the great circle; nothing is stamped. `assemblies` are by ToolMove::cutter. The answer is
/// the same, bit for bit, at any number of threads.
///
/// Errors: `simulation.option`, `simulation.interrupted`; the stock is then as far as the work had come.
[[nodiscard]] base::Result<MillingReport> mill(Stock& stock, std::span<const ToolMove> moves,
                                               std::span<const ToolAssembly> assemblies,
                                               const MillingOptions& options = {});

}  // namespace cusp::simulation
