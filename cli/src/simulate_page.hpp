// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The document of the simulation page, and the pictures: meshes thinned to what a screen can show.
#pragma once

#include "simulate_run.hpp"

#include <string>

namespace cusp::cli {

/// Meshes of before and after, coarse enough to draw, and the deviation at the vertices of the second.
struct SimulateMeshes {
    geometry::TriangleMesh before;
    geometry::TriangleMesh after;
    std::vector<double> deviation_mm;  ///< not a number where there is none
    std::size_t stride = 1;
};
[[nodiscard]] SimulateMeshes meshesOf(const SimulateInput& input, const SimulateResult& done);

/// simulation.html (pages/web/pages/simulation_input.ts).
[[nodiscard]] base::Result<std::string> simulatePage(const SimulateFlags& flags, const SimulateInput& input,
                                                     const SimulateResult& done, const SimulateMeshes& meshes);

enum class SimulatePicture { Before, After, Deviation };
[[nodiscard]] std::string simulatePng(const SimulateFlags& flags, const SimulateResult& done,
                                      const SimulateMeshes& meshes, SimulatePicture what);

}  // namespace cusp::cli
