// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The tables of a planning job: part, tool, machine, and how the path is to run.
#pragma once

#include <cusp/base/toml_schema.hpp>
#include <cusp/optimizer/finishing/plan_options.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cusp::finishing {

/// What is machined.
struct PartJob {
    std::string nominal;
    std::vector<std::int64_t> faces;  ///< counted from 1; empty: all
    double tolerance_mm = 0.01;
};

/// What it is machined with.
struct ToolJob {
    std::string tool_library;  ///< file, from the folder of the job
    std::string name;
    double spindle_rpm = 0.0;
    bool coolant = true;
    double edge_radius_mm = 0.0;  ///< of the inserts of flat cutters, for the undercut h_u
};

/// What it is machined on; without a name nothing is said of time and reach.
struct MachineJob {
    std::string name;
    double block_time_s = 0.0;
    std::optional<double> tool_length_mm;  ///< absent: the gauge length of the library
    std::array<double, 3> origin_mm{0.0, 0.0, 0.0};
    double tolerance_mm = 0.01;
    double orientation_tolerance_rad = 1.7453292519943296e-3;
};

/// How fast.
struct FeedJob {
    double feed_mm_per_s = 3000.0 / 60.0;
    double approach_feed_mm_per_s = 500.0 / 60.0;
    /// The feed of each move is lowered to what block time, axes and curvature allow, and written so.
    bool adapt = false;
    /// Across the path at its tightest curve; with `adapt`.
    double acceleration_mm_per_s2 = 1000.0;
};

struct PlanJob {
    std::int64_t schema = 1;
    std::string name;
    PartJob part;
    ToolJob tool;
    MachineJob machine;
    PassOptions passes;
    OrientationOptions orientation;
    StepOptions steps;
    LinkOptions links;
    FeedJob feed;

    [[nodiscard]] PlanOptions options() const;
};

[[nodiscard]] const base::Section<PartJob>& partSection();
[[nodiscard]] const base::Section<MachineJob>& machineJobSection();
[[nodiscard]] const base::Section<PassOptions>& passSection();
[[nodiscard]] const base::Section<OrientationOptions>& orientationSection();
[[nodiscard]] const base::Section<StepOptions>& stepSection();
[[nodiscard]] const base::Section<LinkOptions>& linkSection();
[[nodiscard]] const base::Section<FeedJob>& feedSection();

/// The field table of `cusp plan`'s job file, with its checks: `finishing.*` errors at the key they speak of.
[[nodiscard]] const base::Section<PlanJob>& planJobSection();

/// Errors: those of `TomlDocument`, `toml.*` of the field table, `finishing.*`.
[[nodiscard]] base::Result<PlanJob> readPlanJobFile(const std::string& path);
[[nodiscard]] base::Result<PlanJob> readPlanJob(std::string_view text, const std::string& file_name);

}  // namespace cusp::finishing
