// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Ranks, ties sharing their mean.
#include "rank_sum.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace bench {

RankSum rankSum(const std::vector<double>& first, const std::vector<double>& second) {
    std::vector<std::pair<double, bool>> all;
    for (const double value : first) all.emplace_back(value, true);
    for (const double value : second) all.emplace_back(value, false);
    std::sort(all.begin(), all.end());
    double sum = 0.0;
    double ties = 0.0;
    for (std::size_t begin = 0; begin < all.size();) {
        std::size_t end = begin;
        while (end < all.size() && all[end].first == all[begin].first) ++end;
        const auto count = static_cast<double>(end - begin);
        const double rank = (static_cast<double>(begin + end) + 1.0) / 2.0;
        for (std::size_t i = begin; i < end; ++i)
            if (all[i].second) sum += rank;
        ties += count * count * count - count;
        begin = end;
    }
    const auto n = static_cast<double>(first.size());
    const auto m = static_cast<double>(second.size());
    const double total = n + m;
    const double variance = n * m / 12.0 * (total + 1.0 - ties / (total * (total - 1.0)));
    RankSum out;
    if (variance <= 0.0) return out;
    out.z = (sum - n * (total + 1.0) / 2.0) / std::sqrt(variance);
    out.probability = std::erfc(std::abs(out.z) / std::sqrt(2.0));
    return out;
}

}  // namespace bench
