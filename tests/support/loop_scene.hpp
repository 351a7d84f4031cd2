// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The benchmark surface on the way around the loop: a path that never cuts deep, a machine, four sections.
#pragma once

#include "benchmark_path.hpp"

#include <cusp/geometry/surface_file.hpp>
#include <cusp/loop/closed_loop.hpp>

#include <sstream>
#include <string>

namespace cusp::test_support {

/// Everything a loop on the benchmark surface needs; `source` is the project's folder.
struct LoopScene {
    explicit LoopScene(const std::string& source)
        : file(post::readMachineFile(source + "/machines/fooke-endura-ca.toml").value()),
          machine(file.machine),
          nominal(geometry::readSurfaceFile(source + "/examples/benchmark/surface.toml").value()) {
        // Lead 5.2° is steeper than the surface is hollow anywhere; 40 passes leave less than 4 µm.
        BenchmarkPath parameters;
        parameters.lead_rad = 0.09075712110370514;
        parameters.passes = 40;
        parameters.points_per_pass = 61;
        std::istringstream text(benchmarkPathText(parameters));
        base::Diagnostics warnings;
        path = toolpath::readToolPath(text, "benchmark.cls", {}, warnings).value();
        setup = {.tool_length_mm = 120.0, .wcs_origin_mm = {3000.0, 0.0, -900.0}};
    }

    [[nodiscard]] loop::LoopTask task() const {
        loop::LoopTask out{.file = &file, .machine = &machine, .setup = setup, .path = &path, .nominal = &nominal};
        loop::SectionSteps steps;
        steps.edge_margin_mm = 2.0;
        const auto sections = inspect::parseSectionPlan("X=-5,-30,-60,-90").value();
        out.inspection.nominal = &nominal;
        out.inspection.nominal_file = "surface.toml";
        out.inspection.plan = loop::sectionTargets(nominal, sections, steps).value();
        out.inspection.inspection.sections = sections;
        out.inspection.inspection.planned_step_over_mm = 2.6;
        return out;
    }

    post::MachineFile file;
    kinematics::Machine machine;
    geometry::ParametricSurface nominal;
    toolpath::ToolPath path;
    loop::CuttingSetup setup;
};

}  // namespace cusp::test_support
