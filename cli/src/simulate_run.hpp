// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The simulation itself, from what was read to what is said of it.
#pragma once

#include "simulate_input.hpp"

#include <cusp/base/json_report.hpp>
#include <cusp/simulation/collision_field.hpp>
#include <cusp/simulation/stock_surface.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::cli {

struct FoundCollision {
    std::string with;  ///< "stock", "rapid" (the cutter, through the stock), "nominal", "fixture", "table"
    std::string file;  ///< of a fixture or table
    simulation::Collision collision;
    bool ram = false;  ///< of the ram, not of the tool's own part

    [[nodiscard]] std::string_view part() const { return ram ? "ram" : simulation::nameOf(collision.part); }
};

/// A pose the machine does not reach.
struct RangeViolation {
    std::uint32_t move = 0;
    std::string reason;
};

struct SimulateResult {
    simulation::Stock before;
    simulation::Stock after;
    simulation::MillingReport milling;
    std::vector<FoundCollision> collisions;  ///< by move
    std::optional<simulation::StockDeviation> deviation;
    std::vector<RangeViolation> violations;
    std::size_t violation_count = 0;
    double removed_volume_mm3 = 0.0;
    double nominal_resolution_mm = 0.0;
    double seconds = 0.0;  ///< of the simulation, reading and writing left out
};

/// Errors: `simulation.*`.
[[nodiscard]] base::Result<SimulateResult> runSimulation(const SimulateFlags& flags, SimulateInput& input);

[[nodiscard]] base::Json simulateSummary(const SimulateFlags& flags, const SimulateInput& input,
                                         const SimulateResult& done);
[[nodiscard]] std::string simulateText(const SimulateFlags& flags, const SimulateInput& input,
                                       const SimulateResult& done);
/// Collisions, rapid moves through material, poses out of range, or a deviation out of tolerance.
[[nodiscard]] bool foundSomething(const SimulateFlags& flags, const SimulateResult& done);

/// summary.json, simulation.html, stock.ply, deviations.csv, moves.csv, before.png, after.png, deviation.png; none of them
/// appears before all are written. Errors: `io.*`.
[[nodiscard]] base::Result<void> writeSimulation(const SimulateFlags& flags, const SimulateInput& input,
                                                 const SimulateResult& done);

}  // namespace cusp::cli
