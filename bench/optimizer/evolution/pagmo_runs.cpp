// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// pagmo2 works on real vectors: each is rounded to the nearest value of the grid before it is judged and counted.
#include "pagmo_runs.hpp"

#include <limits>
#include <map>
#include <memory>
#include <pagmo/algorithm.hpp>
#include <pagmo/algorithms/cmaes.hpp>
#include <pagmo/algorithms/de.hpp>
#include <pagmo/algorithms/sga.hpp>
#include <pagmo/population.hpp>
#include <pagmo/problem.hpp>
#include <utility>

namespace bench {

using namespace cusp::optimizer;

namespace {

/// Distinct candidates judged, and the best among the first `budget` of them.
struct Account {
    std::map<CandidateKey, double> judged;
    std::size_t budget = 0;
    double best = std::numeric_limits<double>::infinity();
};

struct GridProblem {
    std::shared_ptr<const Encoding> genes;
    Objective objective;
    std::shared_ptr<Account> account;

    [[nodiscard]] pagmo::vector_double fitness(const pagmo::vector_double& x) const {
        const CandidateKey key = genes->codes(genes->encode(x));
        const auto known = account->judged.find(key);
        if (known != account->judged.end()) return {known->second};
        const double value = objective(genes->values(key));
        if (account->judged.size() < account->budget) account->best = std::min(account->best, value);
        account->judged.emplace(key, value);
        return {value};
    }
    [[nodiscard]] std::pair<pagmo::vector_double, pagmo::vector_double> get_bounds() const {
        std::pair<pagmo::vector_double, pagmo::vector_double> out;
        for (const Gene& gene : genes->genes()) {
            out.first.push_back(gene.lower);
            out.second.push_back(gene.upper);
        }
        return out;
    }
};

pagmo::algorithm make(PagmoAlgorithm algorithm, unsigned seed) {
    switch (algorithm) {
        case PagmoAlgorithm::Sga: return pagmo::algorithm(pagmo::sga(1));
        case PagmoAlgorithm::De: return pagmo::algorithm(pagmo::de(1, 0.8, 0.9, 2U, 0.0, 0.0, seed));
        case PagmoAlgorithm::Cmaes:
            return pagmo::algorithm(pagmo::cmaes(1, -1, -1, -1, -1, 0.5, 0.0, 0.0, true, true, seed));
    }
    return {};
}

}  // namespace

Outcomes runPagmo(const Problem& problem, PagmoAlgorithm algorithm, std::size_t population,
                  const std::vector<std::size_t>& budgets) {
    const auto genes = std::make_shared<const Encoding>(Encoding::create(problem.genes, Coding::Gray).value());
    Outcomes out;
    for (std::size_t s = 0; s < budgets.size(); ++s) {
        auto account = std::make_shared<Account>();
        account->budget = budgets[s];
        const auto seed = static_cast<unsigned>(s + 1);
        pagmo::population people(pagmo::problem(GridProblem{genes, problem.objective, account}), population, seed);
        pagmo::algorithm evolver = make(algorithm, seed);
        evolver.set_seed(seed);
        // One generation at a time; a hundred without a new candidate, and it has converged.
        for (std::size_t barren = 0; account->judged.size() < account->budget && barren < 100;) {
            const std::size_t before = account->judged.size();
            people = evolver.evolve(people);
            barren = account->judged.size() == before ? barren + 1 : 0;
        }
        out.best.push_back(account->best);
        out.evaluations.push_back(std::min(account->judged.size(), account->budget));
        out.mean_evaluations += static_cast<double>(out.evaluations.back()) / static_cast<double>(budgets.size());
    }
    return out;
}

}  // namespace bench
