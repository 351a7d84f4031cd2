// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Wilcoxon's rank-sum test, to say whether one engine's outcomes are lower than another's.
#pragma once

#include <vector>

namespace bench {

struct RankSum {
    double z = 0.0;            ///< below 0: the first sample is lower
    double probability = 1.0;  ///< two-sided, normal approximation with the correction for ties
};
/// Of two independent samples (Wilcoxon 1945, Mann & Whitney 1947); both need ten values or more for the approximation.
[[nodiscard]] RankSum rankSum(const std::vector<double>& first, const std::vector<double>& second);

}  // namespace bench
