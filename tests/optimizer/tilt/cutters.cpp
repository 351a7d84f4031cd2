// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Cutters as a tool library makes them.
#include "cutters.hpp"

#include <cusp/toolpath/tool_library.hpp>

#include <numbers>

namespace cusp::test_support {
namespace {

geometry::Cutter shaped(toolpath::Tool::Shape shape, double diameter_mm, double corner_mm = 0.0,
                        double taper_rad = 0.0) {
    toolpath::Tool tool;
    tool.shape = shape;
    tool.diameter_mm = diameter_mm;
    if (corner_mm > 0.0) tool.corner_radius_mm = corner_mm;
    if (taper_rad > 0.0) tool.taper_rad = taper_rad;
    tool.cutting_height_mm = 40.0;
    return tool.cutter();
}

}  // namespace

geometry::Cutter ballCutter(double diameter_mm) { return shaped(toolpath::Tool::Shape::Ball, diameter_mm); }
geometry::Cutter flatCutter(double diameter_mm) { return shaped(toolpath::Tool::Shape::Flat, diameter_mm); }
geometry::Cutter toroidalCutter(double diameter_mm, double corner_radius_mm) {
    return shaped(toolpath::Tool::Shape::Toroidal, diameter_mm, corner_radius_mm);
}
geometry::Cutter taperedCutter(double diameter_mm, double corner_radius_mm, double taper_deg) {
    return shaped(toolpath::Tool::Shape::Tapered, diameter_mm, corner_radius_mm, taper_deg * std::numbers::pi / 180.0);
}

std::vector<NamedCutter> cuttersOfEveryShape() {
    return {{"ball", ballCutter(16.0)},
            {"flat", flatCutter(16.0)},
            {"toroidal", toroidalCutter(16.0, 3.0)},
            {"slender torus", toroidalCutter(16.0, 7.5)},
            {"tapered", taperedCutter(3.0, 1.0, 5.0)},
            {"tapered, sharp", taperedCutter(4.0, 0.0, 12.0)}};
}

}  // namespace cusp::test_support
