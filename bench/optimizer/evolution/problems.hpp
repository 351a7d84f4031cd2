// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The problems engines are compared on, and the outcome of many seeds in a few numbers.
#pragma once

#include <cusp/optimizer/evolution/search.hpp>

#include <functional>
#include <string>
#include <vector>

namespace bench {

using Objective = std::function<double(const cusp::optimizer::Values&)>;

struct Problem {
    std::string name;
    std::vector<cusp::optimizer::Gene> genes;
    Objective objective;
};

/// Fountas 2017 eq. 13 on its square, 23 bits a variable. Its optimum is between the two middle codes, where plain binary has
/// its largest cliff and every lower bit decides for itself.
[[nodiscard]] Problem eq13();
/// The same, its optimum at (0.2137, −0.3391): nothing about the code helps.
[[nodiscard]] Problem shiftedEq13();

/// Judged one after the other: each judgement is too short for threads.
[[nodiscard]] cusp::optimizer::EvaluateBatch serial(Objective objective);

struct Spread {
    double best = 0.0;
    double quartile = 0.0;
    double median = 0.0;
    double upper_quartile = 0.0;
    double worst = 0.0;
};
[[nodiscard]] Spread spreadOf(std::vector<double> values);

/// The best objective of each seed 1 … seeds; evaluations summed over them.
struct Outcomes {
    std::vector<double> best;
    std::vector<std::size_t> evaluations;
    double mean_evaluations = 0.0;
    double mean_viral = 0.0;
};
/// With `budgets`, seed s ends at budgets[s − 1] distinct candidates and no sooner for generations.
[[nodiscard]] Outcomes runSeeds(const Problem& problem, cusp::optimizer::Coding coding,
                                cusp::optimizer::SearchOptions options, std::size_t seeds,
                                const std::vector<std::size_t>& budgets = {});

}  // namespace bench
