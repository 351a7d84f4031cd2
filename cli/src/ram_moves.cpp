// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// One stack of rings on the swivel, and the swivel's way by chords.
#include "ram_moves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cusp::cli {
namespace {

constexpr double chord_mm = 0.02;

/// Axis at a share of the way along the great circle.
geometry::Vector3 between(const geometry::Vector3& from, const geometry::Vector3& to, double angle, double share) {
    if (!(angle > 1e-9)) return from;
    return (std::sin((1.0 - share) * angle) * from + std::sin(share * angle) * to).normalized();
}

base::Result<simulation::ToolAssembly> ramOf(const RamShape& ram, double clearance_mm) {
    simulation::ToolAssembly out;
    double height = 0.0;
    for (const simulation::ProfileRing& ring : ram.rings) {
        const double from = height;
        height += ring[0];
        if (auto ok = out.addFrustum(simulation::ToolPart::Head, from - clearance_mm, ring[1] + 2.0 * clearance_mm,
                                     height + clearance_mm, ring[2] + 2.0 * clearance_mm);
            !ok)
            return base::fail(ok.error());
    }
    return out;
}

}  // namespace

base::Result<RamMoves> RamMoves::make(const SimulateInput& input) {
    RamMoves out;
    out.assemblies_ = input.assemblies;
    out.first_ram_ = static_cast<std::uint32_t>(input.assemblies.size());
    auto ram = ramOf(input.ram, input.ram.clearance_mm);
    if (!ram) return base::fail(ram.error());
    out.assemblies_.push_back(*std::move(ram));
    for (std::size_t i = 0; i < input.path.moves.size(); ++i) {
        const simulation::ToolMove& move = input.path.moves[i];
        const toolpath::Tool* tool = input.path.tools[move.cutter];
        if (tool == nullptr)
            return base::fail("simulate.ram",
                              fmt::format("where the ram is, is known only with the tool's length: the tool of line {} "
                                          "needs to be in the tool library",
                                          move.line));
        const double length = tool->gauge_length_mm + input.ram.pivot_mm;
        const double angle = geometry::angleBetween(move.from.axis, move.to.axis);
        const int chords = std::max(1, static_cast<int>(std::ceil(angle * std::sqrt(length / (8.0 * chord_mm)))));
        const auto swivel = [&](int at) -> toolpath::CutterLocation {
            const double share = static_cast<double>(at) / chords;
            return {move.from.tip_mm + share * (move.to.tip_mm - move.from.tip_mm) +
                        length * between(move.from.axis, move.to.axis, angle, share),
                    geometry::Vector3::UnitZ()};
        };
        out.moves_.push_back(move);
        for (int k = 0; k < chords; ++k)
            out.moves_.push_back({swivel(k), swivel(k + 1), toolpath::MotionKind::Feed, move.line, out.first_ram_});
        out.origins_.resize(out.moves_.size(), static_cast<std::uint32_t>(i));
    }
    return out;
}

}  // namespace cusp::cli
