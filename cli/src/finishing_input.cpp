// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Files named in finishing jobs.
#include "finishing_input.hpp"

#include "console.hpp"
#include "input.hpp"

#include <cusp/geometry/cad/nominal_file.hpp>

#include <fmt/format.h>

namespace cusp::cli {

base::Result<LoadedPart> loadPart(const std::string& path, const std::vector<std::int64_t>& faces) {
    base::Diagnostics warnings;
    auto shape = geometry::loadNominal(path, warnings);
    if (!shape) return base::fail(shape.error());
    tell(warnings);
    LoadedPart part;
    part.shape = *std::move(shape);
    part.surface = dynamic_cast<const geometry::ParametricSurface*>(part.shape.get());
    if (part.surface == nullptr)
        return base::fail("finishing.mesh",
                          "a path is planned over faces, and a mesh has none; the STEP or IGES file of the part has",
                          {.file = path, .line = 0, .column = 0, .key = {}});
    const auto& all = part.surface->faces();
    if (faces.empty()) part.chosen = all;
    for (const std::int64_t face : faces) {
        if (face < 1 || static_cast<std::size_t>(face) > all.size())
            return base::fail("finishing.face",
                              fmt::format("there is no face {}; the file has faces 1 to {}", face, all.size()),
                              {.file = path, .line = 0, .column = 0, .key = "part.faces"});
        part.chosen.push_back(all[static_cast<std::size_t>(face - 1)]);
    }
    return part;
}

base::Result<toolpath::Tool> loadTool(const std::string& library, const std::string& name) {
    const auto tools = toolpath::readToolLibraryFile(library);
    if (!tools) return base::fail(tools.error());
    if (const auto* tool = tools->findName(name)) return *tool;
    std::string names;
    for (const auto& tool : tools->tools) names += (names.empty() ? "" : ", ") + tool.name;
    return base::fail("finishing.tool", fmt::format("the library has no tool \"{}\"; it has {}", name, names),
                      {.file = library, .line = 0, .column = 0, .key = {}});
}

base::Result<std::optional<LoadedSetting>> loadSetting(const finishing::MachineJob& job, const std::string& job_file) {
    if (job.name.empty()) return std::optional<LoadedSetting>();
    const bool is_path = job.name.find('/') != std::string::npos || job.name.ends_with(".toml");
    auto machine = loadMachine(is_path ? besideFile(job_file, job.name) : job.name);
    if (!machine) return base::fail(machine.error());
    LoadedSetting out;
    out.machine = std::make_unique<LoadedMachine>(*std::move(machine));
    out.setting.machine = &out.machine->model;
    out.setting.origin_mm = geometry::toVector(job.origin_mm);
    out.setting.tolerance_mm = job.tolerance_mm;
    out.setting.orientation_tolerance_rad = job.orientation_tolerance_rad;
    out.setting.block_time_s = job.block_time_s;
    if (job.tool_length_mm) out.setting.tool_length_mm = *job.tool_length_mm;
    return std::optional(std::move(out));
}

}  // namespace cusp::cli
