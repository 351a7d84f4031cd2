// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The folder `cusp optimize` leaves: the path, the job that plans it again, the curves and the map.
#pragma once

#include <cusp/base/json_report.hpp>
#include <cusp/optimizer/finishing/optimize_job.hpp>
#include <cusp/optimizer/finishing/paper_problem.hpp>
#include <cusp/optimizer/finishing/true_search.hpp>
#include <cusp/simulation/surface_envelope.hpp>

#include <optional>
#include <string>

namespace cusp::cli {

/// The path that the best is shown beside.
struct Before {
    std::string name;
    std::string tool;
    std::size_t passes = 0;
    std::size_t points = 0;
    std::optional<double> machining_time_s;
    simulation::SurfaceEnvelope envelope = {};  ///< on the map's grid
    simulation::EnvelopeSummary left = {};      ///< on the map's grid
};

struct Optimized {
    finishing::OptimizeJob job;
    toolpath::Tool tool;
    finishing::FinishingPath path;  ///< empty where an outside CAM planned
    std::string outside_cl;         ///< its answer for the best
    simulation::CutterPath cut;     ///< the moves of either
    std::vector<finishing::CutContact> contacts;
    std::optional<finishing::PaperCandidate> candidate;  ///< paper mode
    std::vector<optimizer::Gene> genes;
    std::optional<Before> before;
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
/// Whether no levelled path is both faster and nearer.
[[nodiscard]] bool isOnFront(const Optimized& done, const finishing::FrontPoint& point);
[[nodiscard]] base::Json toJson(const std::string& folder, const std::string& job_file, const Optimized& done);
[[nodiscard]] std::string toText(const std::string& folder, const Optimized& done);
/// best.apt, best.toml (a planning job; not where an outside CAM planned), convergence.csv, front.csv, map.csv, summary.json,
/// report.html. Errors: `io.*`, `cl.not-writable`.
[[nodiscard]] base::Result<void> writeFolder(const std::string& folder, const std::string& job_file,
                                             const Optimized& done);

}  // namespace cusp::cli
