// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The factorial study of the viral parameters, Fountas 2017 Table 1 and fig. 6.
#pragma once

#include "problems.hpp"

#include <string>
#include <vector>

namespace bench {

/// One field of 4 × 4: log10 of the median objective over the seeds.
struct Field {
    std::string title;
    std::string row_title;
    std::string column_title;
    std::vector<std::string> rows;
    std::vector<std::string> columns;
    std::vector<std::vector<double>> log_median;
    std::vector<std::vector<double>> evaluations;  ///< mean number of distinct candidates
};

/// Virus population against length, and infectivity force against infection rate, the other two as in the paper's best
/// setting. `evaluations` = 0: 50 generations each, at whatever cost; else the same number of candidates for all.
[[nodiscard]] std::vector<Field> factorialStudy(const Problem& problem, cusp::optimizer::SearchOptions options,
                                                std::size_t seeds, std::size_t evaluations);

[[nodiscard]] std::string toSvg(const std::vector<Field>& fields, const std::string& caption);

}  // namespace bench
