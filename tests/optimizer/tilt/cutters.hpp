// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Cutters of every shape, for tests.
#pragma once

#include <cusp/geometry/cutter.hpp>

#include <string>
#include <vector>

namespace cusp::test_support {

[[nodiscard]] geometry::Cutter ballCutter(double diameter_mm);
[[nodiscard]] geometry::Cutter flatCutter(double diameter_mm);
[[nodiscard]] geometry::Cutter toroidalCutter(double diameter_mm, double corner_radius_mm);
/// Tapered by `taper_deg`, 40 mm high.
[[nodiscard]] geometry::Cutter taperedCutter(double diameter_mm, double corner_radius_mm, double taper_deg);

struct NamedCutter {
    std::string name;
    geometry::Cutter cutter;
};
[[nodiscard]] std::vector<NamedCutter> cuttersOfEveryShape();

}  // namespace cusp::test_support
