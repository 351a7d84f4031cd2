// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A generation of viruses: born from elite and others, attacking, renewed or grown.
#include "run_state.hpp"

#include <cusp/optimizer/evolution/operators.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace cusp::optimizer {
namespace {

/// Virus number `index` of a population of `viruses`: the first share of them is cut from the elite (targeted), the rest
/// from anyone else (random).
Virus newVirus(std::size_t index, const RunState& state, StepContext& context) {
    const VirusOptions& options = context.options.virus;
    const std::vector<double> objectives = context.objectives(state.population);
    const std::vector<std::size_t> order = eliteOf(objectives, objectives.size());
    const std::size_t elite = std::min(std::max<std::size_t>(context.options.elite, 1), order.size());
    const auto targeted =
        static_cast<std::size_t>(std::lround(options.elite_share * static_cast<double>(options.population)));
    const bool from_elite = index < targeted || elite == order.size();
    const std::size_t rank = from_elite ? static_cast<std::size_t>(context.random.below(elite))
                                        : elite + static_cast<std::size_t>(context.random.below(order.size() - elite));
    return transduce(state.population[order[rank]].bits, options, context.random);
}

std::vector<std::size_t> drawHosts(std::size_t population, double rate, base::Random& random) {
    std::vector<std::size_t> hosts(population);
    std::iota(hosts.begin(), hosts.end(), std::size_t{0});
    random.shuffle(hosts);
    const auto count = static_cast<std::size_t>(std::lround(rate * static_cast<double>(population)));
    hosts.resize(std::clamp<std::size_t>(count, 1, population));
    return hosts;
}

/// One virus attacks its hosts, all at once. The individual it helped most, as it is after the attack, comes back for
/// partial transduction.
struct Attack {
    double fitness = 0.0;
    Individual best_infected;
};

base::Result<std::optional<Attack>> attack(const Virus& virus, RunState& state, StepContext& context) {
    const std::vector<std::size_t> hosts = drawHosts(state.population.size(), virus.infection_rate, context.random);
    std::vector<Bits> strings;
    for (const std::size_t host : hosts) strings.push_back(reverseTranscribe(state.population[host].bits, virus));
    const std::size_t known = context.ledger.size();
    auto judged = context.judge(std::move(strings));
    state.viral_evaluations += context.ledger.size() - known;
    if (!judged) return tl::unexpected(std::move(judged.error()));
    if (!*judged) return std::nullopt;

    std::vector<double> gains;
    for (std::size_t i = 0; i < hosts.size(); ++i)
        gains.push_back(infectionGain(context.ledger.objective(state.population[hosts[i]].entry),
                                      context.ledger.objective((**judged)[i].entry)));
    const auto most = std::max_element(gains.begin(), gains.end());
    Attack out{.fitness = virusFitness(gains),
               .best_infected = (**judged)[static_cast<std::size_t>(most - gains.begin())]};
    for (std::size_t i = 0; i < hosts.size(); ++i) {
        ++context.infections;
        if (gains[i] > 0.0) ++context.improvements;
        if (gains[i] > 0.0 || context.options.acceptance == InfectionAcceptance::Always)
            state.population[hosts[i]] = std::move((**judged)[i]);
    }
    return out;
}

}  // namespace

base::Result<StepEnd> infect(RunState& state, StepContext& context) {
    const VirusOptions& options = context.options.virus;
    while (state.viruses.size() < options.population)
        state.viruses.push_back(newVirus(state.viruses.size(), state, context));
    for (std::size_t v = 0; v < state.viruses.size(); ++v) {
        auto attacked = attack(state.viruses[v], state, context);
        if (!attacked) return tl::unexpected(std::move(attacked.error()));
        if (!*attacked) return StepEnd::Cut;
        switch (updateInfectivity(state.viruses[v], (*attacked)->fitness, options)) {
            case VirusFate::Renew: state.viruses[v] = newVirus(v, state, context); break;
            case VirusFate::Grow:
                transducePartially(state.viruses[v], (*attacked)->best_infected.bits, options, context.random);
                break;
            case VirusFate::Keep: break;
        }
    }
    return StepEnd::Complete;
}

}  // namespace cusp::optimizer
