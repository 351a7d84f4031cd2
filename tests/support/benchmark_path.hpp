// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A five-axis finishing path over the benchmark surface, as a CL file: what tests and examples are fed with.
#pragma once

#include <string>

namespace cusp::test_support {

/// Parameters of the path; the defaults make examples/benchmark/surface_finish.cls. The tool is the one Fountas 2017 chose.
struct BenchmarkPath {
    double diameter_mm = 16.0;
    double corner_radius_mm = 3.0;
    double lead_rad = 0.052359877559829890;  ///< 3°; tilt is 0
    int passes = 15;                         ///< along X, equally spaced in Y, the outer ones half a step inside
    int points_per_pass = 31;                ///< equally spaced in the surface parameter v
    double spindle_rpm = 9950.0;
    double feed_mm_per_min = 3000.0;
    double plunge_mm_per_min = 500.0;
    double retract_mm = 20.0;       ///< along the tool axis, between passes
    double clearance_z_mm = 120.0;  ///< of the tip, before the first and after the last pass
};

/// The CL file as text, in the dialect of NX, in mm. Zig-zag: the lead is towards the feed on every pass.
[[nodiscard]] std::string benchmarkPathText(const BenchmarkPath& path = {});

}  // namespace cusp::test_support
