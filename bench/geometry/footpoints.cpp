// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Footpoints on the benchmark surface and on a part of 100 bicubic patches, beside OCCT in the same run.
//
//   bench_footpoints [points]
#include "occt_runner.hpp"

#include <cusp/base/random.hpp>
#include <cusp/geometry/parametric_surface.hpp>
#include <cusp/geometry/surface_forms.hpp>

#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

namespace {

using cusp::geometry::BSplineForm;
using cusp::geometry::Footpoint;
using cusp::geometry::Outward;
using cusp::geometry::ParametricSurface;
using cusp::geometry::Vector3;

constexpr std::uint64_t seed = 1;

/// CPU seconds of this process: other programs on the machine do not count.
double cpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

BSplineForm benchmarkForm() {
    BSplineForm form;
    form.degree_u = form.degree_v = 2;
    form.knots_u = form.knots_v = {0, 0, 0, 1, 1, 1};
    form.points = {{{-94.4, 0, 12.1}, {-49.95, 0, 24.6}, {0.1, 0, 43.8}},
                   {{-94.4, -65.65, -13.3}, {-49.95, -65.65, -7.625}, {0.1, -65.65, 2.8}},
                   {{-94.4, -103.2, 37.5}, {-49.95, -103.2, 39.3}, {0.1, -103.2, 49.8}}};
    return form;
}

/// 10 × 10 bicubic spans over 200 × 200 mm, hills and valleys of a few millimetres.
BSplineForm hundredPatches() {
    cusp::base::Random random(seed);
    BSplineForm form;
    form.degree_u = form.degree_v = 3;
    constexpr int count = 13;
    for (int i = 0; i < count + 4; ++i) form.knots_u.push_back(std::clamp((i - 3.0) / 10.0, 0.0, 1.0));
    form.knots_v = form.knots_u;
    for (int i = 0; i < count; ++i) {
        form.points.emplace_back();
        for (int j = 0; j < count; ++j) {
            form.points.back().emplace_back(200.0 * i / (count - 1), 200.0 * j / (count - 1),
                                            random.uniform(-6.0, 6.0));
        }
    }
    return form;
}

void compare(const char* name, const BSplineForm& form, std::size_t points) {
    const auto face = cusp::geometry::toFace(form, Outward::DuCrossDv).value();
    double start = cpuSeconds();
    const ParametricSurface surface({face});
    const double build_ms = 1e3 * (cpuSeconds() - start);

    cusp::base::Random random(seed);
    std::vector<Vector3> queries;
    std::vector<double> offsets;
    for (std::size_t i = 0; i < points; ++i) {
        const double u = random.uniform();
        const double v = random.uniform();
        offsets.push_back(random.uniform(-0.02, 0.02));
        queries.push_back(face.evaluate(u, v).position + offsets.back() * face.normal(u, v));
    }
    std::vector<Footpoint> feet(points);
    start = cpuSeconds();
    surface.closest(queries, feet, false);
    const double cold_us = 1e6 * (cpuSeconds() - start) / static_cast<double>(points);
    double error_mm = 0.0;
    for (std::size_t i = 0; i < points; ++i) {
        error_mm = std::max(error_mm, std::abs(feet[i].distance_mm - offsets[i]));
    }
    start = cpuSeconds();
    surface.closest(queries, feet, true);
    const double warm_us = 1e6 * (cpuSeconds() - start) / static_cast<double>(points);

    cusp::bench::OcctRunner occt(form);
    const std::size_t occt_points = std::min<std::size_t>(points, 5000);
    double occt_error_mm = 0.0;
    std::size_t occt_none = 0;
    start = cpuSeconds();
    for (std::size_t i = 0; i < occt_points; ++i) {
        const double distance = occt.distance(queries[i]);
        if (distance < 0.0) {
            ++occt_none;
        } else {
            occt_error_mm = std::max(occt_error_mm, std::abs(distance - std::abs(offsets[i])));
        }
    }
    const double occt_us = 1e6 * (cpuSeconds() - start) / static_cast<double>(occt_points);
    std::printf("%-16s %9.1f %9.3f %9.3f %9.1e %9.2f %9.1e %6zu %8.0f\n", name, build_ms, cold_us, warm_us, error_mm,
                occt_us, occt_error_mm, occt_none, occt_us / cold_us);
}

}  // namespace

int main(int argc, char** argv) {
    const std::size_t points = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 500000;
    // One thread, so that CPU time is time per point and core.
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    std::printf("%zu points within 0.02 mm; CPU microseconds per point, errors in mm\n", points);
    std::printf("%-16s %9s %9s %9s %9s %9s %9s %6s %8s\n", "surface", "build ms", "cusp", "warm", "error", "OCCT Tree",
                "error", "none", "ratio");
    compare("benchmark", benchmarkForm(), points);
    compare("100 patches", hundredPatches(), points);
    return 0;
}
