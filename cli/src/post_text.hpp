// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What `cusp post` tells: a page for people, JSON for scripts.
#pragma once

#include "cycle_time.hpp"
#include "machine_lookup.hpp"

#include <cusp/base/diagnostics.hpp>
#include <cusp/base/json_report.hpp>
#include <cusp/kinematics/linear_travel.hpp>
#include <cusp/post/writer/program_planner.hpp>

#include <cstddef>
#include <optional>
#include <string>

namespace cusp::cli {

struct PostOutcome {
    std::string cl_file;
    std::string output;
    const LoadedMachine& machine;
    base::Diagnostics report = base::Diagnostics();
    post::PostSummary summary = {};
    std::optional<kinematics::TravelSummary> travel = {};  ///< with a setup only
    std::optional<CycleTime> cycle_time = {};              ///< where it was estimated
    bool too_long_to_estimate = false;
    std::size_t blocks = 0;
    std::string dialect = {};
    double mm_per_unit = 1.0;

    /// Every error is a limit of the machine: the input is good, this machine cannot do it.
    [[nodiscard]] bool onlyLimits() const;
};

[[nodiscard]] std::string toText(const PostOutcome& outcome);
/// Keys: docs/json.md.
[[nodiscard]] base::Json toJson(const PostOutcome& outcome);

}  // namespace cusp::cli
