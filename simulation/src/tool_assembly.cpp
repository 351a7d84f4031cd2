// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Stacks the rings of a tool on its cutter.
#include <cusp/simulation/tool_assembly.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cusp::simulation {
namespace {

/// Stacks one ring and moves `height_mm` to its top.
base::Result<void> stack(ToolAssembly& assembly, ToolPart part, const ProfileRing& ring, double clearance_mm,
                         double& height_mm) {
    const double from = height_mm;
    height_mm += ring[0];
    return assembly.addFrustum(part, from - clearance_mm, ring[1] + 2.0 * clearance_mm, height_mm + clearance_mm,
                               ring[2] + 2.0 * clearance_mm);
}

}  // namespace

std::string_view nameOf(ToolPart part) {
    switch (part) {
        case ToolPart::Cutter: return "cutter";
        case ToolPart::Shank: return "shank";
        case ToolPart::Holder: return "holder";
        case ToolPart::Head: return "head";
    }
    return "";
}

base::Result<void> ToolAssembly::addFrustum(ToolPart part, double from_mm, double from_diameter_mm, double to_mm,
                                            double to_diameter_mm) {
    auto body = CutterBody::frustum(from_mm, from_diameter_mm, to_mm, to_diameter_mm);
    if (!body) return base::fail(body.error());
    bodies.push_back({*body, part});
    return {};
}

double ToolAssembly::largestRadius() const {
    double largest = 0.0;
    for (const AssemblyBody& body : bodies) largest = std::max(largest, body.body.largestRadius());
    return largest;
}

double ToolAssembly::height() const {
    double highest = 0.0;
    for (const AssemblyBody& body : bodies) highest = std::max(highest, body.body.height());
    return highest;
}

base::Result<ToolAssembly> assemblyOf(const geometry::Cutter& cutter) {
    auto body = CutterBody::make(cutter);
    if (!body) return base::fail(body.error());
    return ToolAssembly{{{*body, ToolPart::Cutter}}};
}

base::Result<ToolAssembly> assemblyOf(const toolpath::Tool& tool, double clearance_mm,
                                      std::span<const ProfileRing> head) {
    if (!(clearance_mm >= 0.0) || !std::isfinite(clearance_mm))
        return base::fail(
            "simulation.clearance",
            fmt::format("the clearance around shank and holder is {} mm; it must be 0 or more", clearance_mm));
    auto assembly = assemblyOf(tool.cutter());
    if (!assembly) return assembly;
    double height = tool.cutting_height_mm;
    for (const auto& ring : tool.shank_mm)
        if (auto ok = stack(*assembly, ToolPart::Shank, {ring[0], ring[1], ring.back()}, clearance_mm, height); !ok)
            return base::fail(ok.error());
    for (const auto& ring : tool.holder_mm)
        if (auto ok = stack(*assembly, ToolPart::Holder, {ring[0], ring[1], ring.back()}, clearance_mm, height); !ok)
            return base::fail(ok.error());
    height = tool.gauge_length_mm;
    for (const ProfileRing& ring : head)
        if (auto ok = stack(*assembly, ToolPart::Head, ring, clearance_mm, height); !ok) return base::fail(ok.error());
    return assembly;
}

}  // namespace cusp::simulation
