// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Eq. 13 and what many seeds make of it.
#include "problems.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace bench {

using namespace cusp::optimizer;

namespace {

double bohachevsky(double x, double y) {
    using std::numbers::pi;
    return x * x + y * y - 0.3 * std::cos(3.0 * pi * x) - 0.4 * std::cos(4.0 * pi * y) + 0.7;
}

std::vector<Gene> square() {
    return {{.name = "x", .bits = 23, .lower = -1.0, .upper = 1.0},
            {.name = "y", .bits = 23, .lower = -1.0, .upper = 1.0}};
}

}  // namespace

Problem eq13() {
    return {"eq. 13", square(), [](const Values& v) { return bohachevsky(v[0], v[1]); }};
}

Problem shiftedEq13() {
    return {"eq. 13, shifted", square(), [](const Values& v) { return bohachevsky(v[0] - 0.2137, v[1] + 0.3391); }};
}

EvaluateBatch serial(Objective objective) {
    return [objective = std::move(objective)](std::span<const Values> batch,
                                              cusp::base::Progress&) -> cusp::base::Result<std::vector<Evaluation>> {
        std::vector<Evaluation> out;
        for (const Values& values : batch) out.push_back({{objective(values)}, {}});
        return out;
    };
}

Spread spreadOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
        const double place = share * static_cast<double>(values.size() - 1);
        const auto below = static_cast<std::size_t>(place);
        const std::size_t above = std::min(below + 1, values.size() - 1);
        return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
    };
    return {values.front(), at(0.25), at(0.5), at(0.75), values.back()};
}

Outcomes runSeeds(const Problem& problem, Coding coding, SearchOptions options, std::size_t seeds,
                  const std::vector<std::size_t>& budgets) {
    const Encoding genes = Encoding::create(problem.genes, coding).value();
    const EvaluateBatch evaluate = serial(problem.objective);
    Outcomes out;
    for (std::size_t seed = 1; seed <= seeds; ++seed) {
        options.seed = seed;
        if (!budgets.empty()) {
            options.max_evaluations = budgets[seed - 1];
            options.max_generations = 0;
        }
        const auto found = search(genes, evaluate, options).value();
        out.best.push_back(found.bestObjective());
        out.evaluations.push_back(found.evaluations);
        out.mean_evaluations += static_cast<double>(found.evaluations) / static_cast<double>(seeds);
        out.mean_viral += static_cast<double>(found.viral_evaluations) / static_cast<double>(seeds);
    }
    return out;
}

}  // namespace bench
