// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A tool with everything that moves with it: cutter, shank, holder, head, as convex turned bodies on one axis.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/cutter.hpp>
#include <cusp/simulation/cutter_body.hpp>
#include <cusp/toolpath/tool_library.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace cusp::simulation {

/// Only the cutter may touch material.
enum class ToolPart : std::uint8_t { Cutter, Shank, Holder, Head };
[[nodiscard]] std::string_view nameOf(ToolPart part);

struct AssemblyBody {
    CutterBody body;
    ToolPart part = ToolPart::Cutter;
};

/// Bodies may overlap; a turned part that is not convex is several of them.
struct ToolAssembly {
    std::vector<AssemblyBody> bodies;

    /// Heights above the tip, lower and upper diameter. Errors: `simulation.part`.
    [[nodiscard]] base::Result<void> addFrustum(ToolPart part, double from_mm, double from_diameter_mm, double to_mm,
                                                double to_diameter_mm);
    [[nodiscard]] double largestRadius() const;
    [[nodiscard]] double height() const;
};

/// One stretch of a profile: its height and its lower and upper diameter, in mm.
using ProfileRing = std::array<double, 3>;

/// The cutter alone, as a CL file tells it. Errors: `simulation.cutter`.
[[nodiscard]] base::Result<ToolAssembly> assemblyOf(const geometry::Cutter& cutter);

/// Cutter, shank and holder of a library's tool; `head` is stacked from the gauge plane upwards. `clearance_mm` is added to
/// shank, holder and head on every side.
/// Errors: `simulation.cutter`, `simulation.part`, `simulation.clearance` when the clearance is negative.
[[nodiscard]] base::Result<ToolAssembly> assemblyOf(const toolpath::Tool& tool, double clearance_mm = 0.0,
                                                    std::span<const ProfileRing> head = {});

}  // namespace cusp::simulation
