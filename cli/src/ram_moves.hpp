// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The ram of a machine whose head swivels: it keeps its direction while the tool leans, and goes where the swivel goes.
#pragma once

#include "simulate_input.hpp"

#include <cusp/simulation/collision_field.hpp>

#include <cstdint>
#include <vector>

namespace cusp::cli {

/// The moves of a path with those of the ram behind each of them, as a simulation takes them.
class RamMoves {
public:
    /// `input.ram` must have rings. The swivel's way, a line and an arc together, is cut into chords within 0.02 mm.
    /// Errors: `simulate.ram` (a tool whose length is not known), `simulation.part`.
    [[nodiscard]] static base::Result<RamMoves> make(const SimulateInput& input);

    [[nodiscard]] const std::vector<simulation::ToolMove>& moves() const { return moves_; }
    [[nodiscard]] const std::vector<simulation::ToolAssembly>& assemblies() const { return assemblies_; }
    [[nodiscard]] bool isRam(std::uint32_t move) const { return moves_[move].cutter >= first_ram_; }
    /// The move of the path that a move here is, or goes with.
    [[nodiscard]] std::uint32_t origin(std::uint32_t move) const { return origins_[move]; }

private:
    std::vector<simulation::ToolMove> moves_;
    std::vector<simulation::ToolAssembly> assemblies_;
    std::vector<std::uint32_t> origins_;
    std::uint32_t first_ram_ = 0;
};

}  // namespace cusp::cli
