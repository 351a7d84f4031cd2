// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The benchmark surface on the way around the loop: the path of `cusp demo`, a machine, four sections.
#pragma once

#include <cusp/geometry/surface_file.hpp>
#include <cusp/loop/budget_path.hpp>
#include <cusp/loop/closed_loop.hpp>

#include <string>

namespace cusp::test_support {

/// Everything a loop on the benchmark surface needs; `source` is the project's folder.
struct LoopScene {
    explicit LoopScene(const std::string& source)
        : file(post::readMachineFile(source + "/machines/fooke-endura-ca.toml").value()),
          machine(file.machine),
          nominal(geometry::readSurfaceFile(source + "/examples/benchmark/surface.toml").value()) {
        toolpath::Tool tool;
        tool.number = 1;
        tool.name = "TOROID_D16_R3";
        tool.shape = toolpath::Tool::Shape::Toroidal;
        tool.diameter_mm = 16.0;
        tool.corner_radius_mm = 3.0;
        tool.cutting_height_mm = 50.0;
        tool.gauge_length_mm = 120.0;
        plan = loop::planWithinBudget(nominal, tool, {}).value();
        path = plan.path;
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
        out.inspection.inspection.planned_step_over_mm = plan.step_over_mm;
        return out;
    }

    post::MachineFile file;
    kinematics::Machine machine;
    geometry::ParametricSurface nominal;
    loop::BudgetPath plan;
    toolpath::ToolPath path;
    loop::CuttingSetup setup;
};

}  // namespace cusp::test_support
