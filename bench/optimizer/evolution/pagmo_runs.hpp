// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// pagmo2's algorithms on the same grid of candidates, charged for distinct ones as ours are.
#pragma once

#include "problems.hpp"

namespace bench {

enum class PagmoAlgorithm { Sga, De, Cmaes };

[[nodiscard]] Outcomes runPagmo(const Problem& problem, PagmoAlgorithm algorithm, std::size_t population,
                                const std::vector<std::size_t>& budgets);

}  // namespace bench
