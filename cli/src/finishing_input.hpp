// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What finishing jobs name by file: the part, the tool, the machine.
#pragma once

#include "machine_lookup.hpp"

#include <cusp/geometry/parametric_surface.hpp>
#include <cusp/optimizer/finishing/machine_time.hpp>
#include <cusp/optimizer/finishing/plan_job.hpp>
#include <cusp/toolpath/tool_library.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cusp::cli {

struct LoadedPart {
    std::unique_ptr<geometry::NominalShape> shape;
    const geometry::ParametricSurface* surface = nullptr;
    std::vector<geometry::SurfaceFace> chosen;

    [[nodiscard]] finishing::Workpiece workpiece() const { return {chosen, surface}; }
};

/// Errors: those of `loadNominal`; `finishing.mesh` for a nominal without faces, `finishing.face` for a face that is not there.
[[nodiscard]] base::Result<LoadedPart> loadPart(const std::string& path, const std::vector<std::int64_t>& faces);

/// Errors: those of the reader; `finishing.tool` with the names there are.
[[nodiscard]] base::Result<toolpath::Tool> loadTool(const std::string& library, const std::string& name);

/// A machine with how the job sets it up; the setting points into the machine.
struct LoadedSetting {
    std::unique_ptr<LoadedMachine> machine;
    finishing::MachineSetting setting;
};
/// Empty when the job names no machine.
[[nodiscard]] base::Result<std::optional<LoadedSetting>> loadSetting(const finishing::MachineJob& job,
                                                                     const std::string& job_file);

}  // namespace cusp::cli
