// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The search for an order of points: order crossover, mutation, objectives of Mitić 2023 eq. 15–18.
#pragma once

#include <cusp/base/progress.hpp>
#include <cusp/base/random.hpp>
#include <cusp/optimizer/pocket/path_builder.hpp>
#include <cusp/optimizer/pocket/strategies.hpp>

#include <cstdint>
#include <vector>

namespace cusp::pocket {

/// How a path's time is estimated while it is searched for.
struct PathSpeeds {
    double feed_mm_per_s = 10.0;
    double rapid_mm_per_s = 300.0;
    double lift_mm = 50.0;  ///< up and down once for each rapid move
    double ramp_mm = 0.0;   ///< way of a helical entry at the feed
};

/// Eq. 15: feed moves at the feed, rapid moves with their lift at rapid speed.
[[nodiscard]] double estimatedTime(const FlatPath& path, const PathSpeeds& speeds);

/// Eq. 18 with its three parts made comparable: each is divided by that of a reference path before it is weighted by ½, ¼, ¼.
/// As printed it adds seconds, counts and degrees.
struct PathObjective {
    double time_s = 0.0;
    double turns = 0.0;
    double engagement_deviation_deg = 0.0;  ///< eq. 17: mean over the cutting length of |θ − θ target|

    [[nodiscard]] double value(const PathObjective& reference) const;
};

using Order = std::vector<std::uint32_t>;

/// OX (Davis 1985): the child has `a` between two cuts, and elsewhere what is left in the order of `b`, beginning behind the
/// second cut.
[[nodiscard]] Order crossOrder(const Order& a, const Order& b, std::size_t first, std::size_t last);
/// A stretch of the order is turned round (2-opt) or moved elsewhere (Or-opt), either with probability ½.
void mutateOrder(Order& order, base::Random& random);

struct PathSearchOptions {
    std::uint64_t seed = 1;
    std::size_t population = 8;
    std::size_t generations = 4;
    std::size_t improvements = 8;  ///< steps of 2-opt and Or-opt on the best at the end
    double target_deg = 0.0;       ///< engagement of a straight cut at the radial depth
    PathSpeeds speeds;
};

struct PathGeneration {
    std::size_t generation = 0;
    double best = 0.0;
    double mean = 0.0;
};

struct PathSearchResult {
    FlatPath path;
    PathObjective objective;
    double value = 0.0;  ///< against the first classical strategy, whose value is 1
    std::vector<PathGeneration> history;
    std::size_t evaluations = 0;
};

/// Half of the first population are the classical orders, the other half random ones (steps 1–12). The best two pass on.
[[nodiscard]] PathSearchResult searchPath(const PathBuilder& builder, const PointMap& map, const PocketArea& area,
                                          const PathSearchOptions& options,
                                          base::Progress& progress = base::noProgress());

}  // namespace cusp::pocket
