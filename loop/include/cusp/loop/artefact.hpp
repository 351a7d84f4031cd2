// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A part that shows what a machine has wrong: grooves of a ball mill, cut on a hipped block with the tool tilted to all sides.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/loop/virtual_cmm.hpp>
#include <cusp/toolpath/cl_reader.hpp>

#include <string>

namespace cusp::loop {

struct ArtefactOptions {
    double ball_diameter_mm = 10.0;
    double half_width_mm = 30.0;  ///< of the top, which lies at `height_mm`
    double height_mm = 30.0;
    double side_mm = 25.0;           ///< run of the four sides, which fall at 45°
    double groove_mm = 40.0;         ///< length of each groove
    double spacing_mm = 4.0;         ///< between the bottoms of neighbouring grooves
    double point_mm = 5.0;           ///< between the points measured in a groove
    double largest_tilt_rad = 0.87;  ///< 50°; from the vertical
    double feed_mm_per_min = 1000.0;
    double spindle_rpm = 8000.0;
};

struct Artefact {
    std::string surface_toml;  ///< the nominal: five planes
    toolpath::ToolPath path;   ///< plain APT; one groove for each tilt on each plane it can reach
    CmmPlan plan;              ///< points in the bottoms of the grooves
    std::size_t grooves = 0;
};

/// Every tilt is used on the top and on the sides it does not come near to lying in, so that each tool pose is seen along
/// several normals. The block is to be roughed to 0.1 … 0.3 mm over the nominal.
/// Errors: `artefact.option`.
[[nodiscard]] base::Result<Artefact> planArtefact(const ArtefactOptions& options);

/// A table of the plan's points, for `cusp measure --points` or a real measuring machine.
[[nodiscard]] std::string planTable(const CmmPlan& plan);

}  // namespace cusp::loop
