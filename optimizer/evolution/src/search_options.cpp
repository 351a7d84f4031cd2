// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Options of a search: the paper's, and what makes sense.
#include "option_check.hpp"

#include <cusp/optimizer/evolution/search.hpp>

#include <cmath>
#include <fmt/format.h>

namespace cusp::optimizer {
namespace {

void checkVirus(const VirusOptions& v, OptionCheck& check) {
    check.require(v.population >= 1, "virus.population",
                  "there must be a virus; without viruses take the plain algorithm");
    check.require(v.shortest >= 1 && v.shortest <= v.longest, "virus.shortest",
                  fmt::format("lengths from {} to {} bits; they must be from 1 upwards, the shortest first", v.shortest,
                              v.longest));
    check.require(v.infectivity_force >= 0.0 && v.infectivity_force <= 1.0, "virus.infectivity_force",
                  fmt::format("{} must be from 0 to 1", v.infectivity_force));
    check.share(v.min_infection_rate, "virus.min_infection_rate");
    check.share(v.max_infection_rate, "virus.max_infection_rate");
    check.require(v.min_infection_rate <= v.infection_rate && v.infection_rate <= v.max_infection_rate,
                  "virus.infection_rate",
                  fmt::format("{} is outside its interval {} to {}", v.infection_rate, v.min_infection_rate,
                              v.max_infection_rate));
    check.share(v.rate_adaptation, "virus.rate_adaptation");
    check.share(v.elite_share, "virus.elite_share");
    check.require(v.interval >= 1, "virus.interval", "infections happen every 1, 2, … generations, not every 0");
}

}  // namespace

base::Result<void> SearchOptions::check(const Encoding& encoding) const {
    OptionCheck check;
    check.require(population >= 2, "population", fmt::format("{}; two individuals are the least", population));
    check.require(elite < population, "elite",
                  fmt::format("{} of {} individuals; at least one must be new", elite, population));
    check.require(tournament_size >= 1, "tournament_size", "a tournament has at least one contestant");
    check.share(crossover_probability, "crossover_probability");
    check.share(restart_diversity, "restart_diversity");
    check.share(mutation_probability, "mutation_probability");
    check.require(max_evaluations >= population, "max_evaluations",
                  fmt::format("{} do not suffice for a first population of {}", max_evaluations, population));
    check.require(!std::isnan(target_objective), "target_objective", "is not a number");
    check.require(checkpoint_interval >= 1, "checkpoint_interval", "must be 1 or more generations");
    for (const Values& start : starts)
        check.require(
            start.size() == encoding.genes().size(), "starts",
            fmt::format("a start has {} values where there are {} genes", start.size(), encoding.genes().size()));
    check.require(starts.size() <= population, "starts",
                  fmt::format("{} starts do not fit in a population of {}", starts.size(), population));
    if (algorithm == Algorithm::VirusEvolutionary) checkVirus(virus, check);
    return check.result();
}

SearchOptions paperOptions() {
    SearchOptions out;
    out.selection = Selection::Roulette;
    out.fitness_scale = FitnessScale::Raw;
    out.crossover = Crossover::SinglePoint;
    out.mutation = Mutation::SinglePoint;
    out.mutation_probability = 0.1;
    out.restart_diversity = 0.0;
    out.virus.population = 7;
    out.virus.infection_rate = 0.7;
    out.virus.min_infection_rate = 0.5;
    out.virus.max_infection_rate = 1.0;
    out.virus.elite_share = 0.5;
    out.max_evaluations = 1'000'000;
    out.max_generations = 50;
    return out;
}

}  // namespace cusp::optimizer
