// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The tables of an optimisation job.
#pragma once

#include <cusp/optimizer/evolution/search.hpp>
#include <cusp/optimizer/finishing/paper_problem.hpp>
#include <cusp/optimizer/finishing/plan_job.hpp>
#include <cusp/optimizer/finishing/true_search.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace cusp::finishing {

enum class OptimizeMode : std::uint8_t {
    Paper,  ///< machining error against number of points, by the paper's formulas
    True    ///< least time within the tolerance, by the exact envelope
};

/// Tools to choose from.
struct ToolChoice {
    std::string tool_library;        ///< file, from the folder of the job
    std::vector<std::string> names;  ///< empty: all of the library
    double spindle_rpm = 0.0;
    bool coolant = true;
    double edge_radius_mm = 0.0;
};

/// What is searched for, and between which ends.
struct SearchRanges {
    std::array<double, 2> step_over_share{0.20, 0.45};  ///< of the diameter
    std::array<double, 2> lead_rad{0.0, 0.0872664625997165};
    std::array<double, 2> tilt_rad{0.0, 0.0349065850398866};
    std::array<double, 2> chord_tolerance_mm{0.005, 0.01};
    std::array<double, 2> depth_share{-0.9, -0.5};  ///< of the tolerance
    std::array<double, 2> curvature_safety{1.0, 1.2};
    std::array<double, 2> passes_share{0.8, 1.4};  ///< of those the ridge alone asks for
};

struct SearchJob {
    optimizer::Algorithm algorithm = optimizer::Algorithm::VirusEvolutionary;
    std::int64_t seed = 1;
    std::int64_t population = 20;
    std::int64_t evaluations = 1000;
    double error_weight = 0.5;
    double search_grid_mm = 1.4;
    double level_grid_mm = 0.6;
    double proof_grid_mm = 0.1;
    std::int64_t front_passes = 2;
};

/// Constant leads to compare with.
struct CompareJob {
    std::vector<double> leads_rad;
    std::vector<double> tilts_rad{0.0};
};

struct OptimizeJob {
    std::int64_t schema = 1;
    std::string name;
    OptimizeMode mode = OptimizeMode::Paper;
    PartJob part;
    ToolChoice tools;
    MachineJob machine;
    PassOptions passes;
    StepOptions steps;
    LinkOptions links;
    FeedJob feed;
    SearchRanges ranges;
    SearchJob search;
    CompareJob compare;

    /// What is not searched for.
    [[nodiscard]] PlanOptions options() const;
    [[nodiscard]] optimizer::SearchOptions searchOptions() const;
    /// The job as a problem for the engines, with the tools its library has.
    [[nodiscard]] PaperProblem paperProblem(std::vector<toolpath::Tool> from) const;
    [[nodiscard]] TrueProblem trueProblem(std::vector<toolpath::Tool> from, const MachineSetting& setting) const;
};

[[nodiscard]] const base::Section<OptimizeJob>& optimizeJobSection();
/// Errors: those of `TomlDocument`, `toml.*` of the field table, `finishing.*`.
[[nodiscard]] base::Result<OptimizeJob> readOptimizeJobFile(const std::string& path);
[[nodiscard]] base::Result<OptimizeJob> readOptimizeJob(std::string_view text, const std::string& file_name);

}  // namespace cusp::finishing
