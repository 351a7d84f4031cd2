// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The plainest nominal: closed forms hold on it.
#pragma once

#include <cusp/geometry/parametric_surface.hpp>
#include <cusp/geometry/surface_file.hpp>

#include <string>

namespace cusp::test_support {

/// z = slope · x over 40 × 40 mm from the origin, outward upwards.
inline geometry::ParametricSurface slopingPlane(double slope) {
    return geometry::ParametricSurface(
        geometry::readSurface("schema = 1\nname = \"plane\"\n[[face]]\nform = \"polynomial\"\noutward = \"du x dv\"\n"
                              "x_mm = { \"u\" = 40.0 }\ny_mm = { \"v\" = 40.0 }\nz_mm = { \"u\" = " +
                                  std::to_string(40.0 * slope) + " }\n",
                              "plane.toml")
            .value());
}

}  // namespace cusp::test_support
