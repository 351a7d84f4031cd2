// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The whole of a pocket job: cutting data and path together (Mitić 2023, interaction module), and the strategies compared.
#pragma once

#include <cusp/optimizer/evolution/search.hpp>
#include <cusp/optimizer/pocket/path_search.hpp>
#include <cusp/optimizer/pocket/pocket_motion.hpp>

#include <string>
#include <vector>

namespace cusp::pocket {

/// A set of cutting data with the best path found for it: a member of the set O.
struct PlannedData {
    CuttingData data;
    CuttingLoad load;
    double time_s = 0.0;  ///< estimated, all levels
    std::string strategy;
};

struct StrategyOutcome {
    FlatPath path;
    CuttingData data;
    Engagement engagement;
    double time_s = 0.0;
    std::size_t turns = 0;
    std::size_t steps_over_limit = 0;  ///< measured more than 1° above it
    double uncleared_area_mm2 = 0.0;
    double gouge_mm = 0.0;
    bool limited = true;  ///< built within the engagement limit
};

struct PocketPlan {
    PocketArea area;
    double engagement_limit_deg = 0.0;
    std::size_t points = 0;
    std::size_t levels = 0;
    CuttingData data;  ///< of the least time: the joint optimum of eq. 1
    CuttingLoad load;
    PlannedData best_by_mrr;         ///< what steps 14 and 15 would take
    std::vector<PlannedData> tried;  ///< the set O in the order it was filled
    optimizer::SearchSummary data_search;
    PathSearchResult path_search;
    std::vector<StrategyOutcome> strategies;
    std::size_t chosen = 0;
};

/// Errors: `pocket.*`; `pocket.no-feasible-data` where no set of cutting data keeps every limit, with the limit that is broken
/// at the gentlest.
[[nodiscard]] base::Result<PocketPlan> planPocket(const PocketJob& job, const PocketContours& contours,
                                                  const CuttingTable& table, const kinematics::Machine* machine,
                                                  base::Progress& progress = base::noProgress());

}  // namespace cusp::pocket
