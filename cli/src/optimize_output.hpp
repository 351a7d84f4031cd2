// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The folder `cusp optimize` leaves: the path, the job that plans it again, the curves and the map.
#pragma once

#include <cusp/base/json_report.hpp>
#include <cusp/optimizer/finishing/optimize_job.hpp>
#include <cusp/optimizer/finishing/true_search.hpp>
#include <cusp/simulation/surface_envelope.hpp>

#include <optional>
#include <string>

namespace cusp::cli {

struct Optimized {
    finishing::OptimizeJob job;
    toolpath::Tool tool;
    finishing::FinishingPath path;
    optimizer::SearchSummary search;
    std::optional<finishing::MachineTime> time;
    simulation::SurfaceEnvelope envelope;  ///< of the path, on the map's grid
    simulation::EnvelopeSummary left;      ///< on the proof grid
    std::vector<finishing::FrontPoint> levelled;
    std::vector<std::string> tool_names;
    std::optional<finishing::ProvedPath> constant;  ///< the best with a constant lead
    bool compared = false;
};

/// The best parameters, by name.
[[nodiscard]] base::Json parametersOf(const Optimized& done);
/// best.apt, best.toml (a planning job), convergence.csv, front.csv, map.csv. Errors: `io.*`, `cl.not-writable`.
[[nodiscard]] base::Result<void> writeFolder(const std::string& folder, const std::string& job_file,
                                             const Optimized& done);

}  // namespace cusp::cli
