// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// One generation: random search, generations with elitism, steady state.
#include "run_state.hpp"

#include <cusp/optimizer/evolution/operators.hpp>

#include <algorithm>
#include <utility>

namespace cusp::optimizer {

base::Result<std::optional<std::vector<Individual>>> StepContext::judge(std::vector<Bits> strings) {
    std::vector<CandidateKey> keys;
    std::vector<Values> values;
    for (const Bits& bits : strings) {
        keys.push_back(encoding.codes(bits));
        values.push_back(encoding.values(keys.back()));
    }
    auto entries = ledger.evaluate(keys, values);
    if (!entries) return tl::unexpected(std::move(entries.error()));
    std::vector<Individual> out;
    for (std::size_t i = 0; i < strings.size(); ++i) {
        if ((*entries)[i] == Ledger::not_evaluated) return std::nullopt;
        out.push_back({std::move(strings[i]), (*entries)[i]});
    }
    return out;
}

std::vector<double> StepContext::objectives(std::span<const Individual> individuals) const {
    std::vector<double> out;
    out.reserve(individuals.size());
    for (const Individual& individual : individuals) out.push_back(ledger.objective(individual.entry));
    return out;
}

namespace {

/// Picks parents and makes children by the operators the options name.
class Breeder {
public:
    Breeder(const std::vector<Individual>& parents, std::vector<double> objectives, const SearchOptions& options,
            base::Random& random)
        : parents_(parents), objectives_(std::move(objectives)), options_(options), random_(random) {
        if (options.selection == Selection::Roulette) fitness_ = exponentialFitness(objectives_, options.fitness_scale);
    }

    std::pair<Bits, Bits> children() {
        Bits a = parents_[select()].bits;
        Bits b = parents_[select()].bits;
        if (random_.chance(options_.crossover_probability)) cross(a, b);
        mutate(a);
        mutate(b);
        return {std::move(a), std::move(b)};
    }

private:
    std::size_t select() {
        return options_.selection == Selection::Roulette
                   ? selectByRoulette(fitness_, random_)
                   : selectByTournament(objectives_, options_.tournament_size, random_);
    }
    void cross(Bits& a, Bits& b) {
        switch (options_.crossover) {
            case Crossover::SinglePoint: return crossSinglePoint(a, b, random_);
            case Crossover::TwoPoint: return crossTwoPoint(a, b, random_);
            case Crossover::Uniform: return crossUniform(a, b, random_);
        }
    }
    void mutate(Bits& bits) {
        const double p = options_.mutation_probability;
        if (options_.mutation == Mutation::PerBit)
            mutatePerBit(bits, p > 0.0 ? p : 1.0 / static_cast<double>(bits.size()), random_);
        else if (random_.chance(p))
            mutateSinglePoint(bits, random_);
    }

    const std::vector<Individual>& parents_;
    std::vector<double> objectives_;
    std::vector<double> fitness_;
    const SearchOptions& options_;
    base::Random& random_;
};

base::Result<void> checkRawRoulette(const std::vector<double>& objectives, const SearchOptions& options) {
    if (options.selection != Selection::Roulette || options.fitness_scale != FitnessScale::Raw) return {};
    if (std::all_of(objectives.begin(), objectives.end(), [](double z) { return z >= 0.0; })) return {};
    return base::fail("evolution.negative-objective",
                      "roulette on eq. 10 as printed needs objectives from 0 upwards (exp(-z²) prefers -1 to -2); "
                      "take the population's scale or tournaments",
                      {.file = {}, .line = 0, .column = 0, .key = "fitness_scale"});
}

/// `strings`, filled up with random ones.
base::Result<StepEnd> randomGeneration(RunState& state, StepContext& context, std::vector<Bits> strings) {
    while (strings.size() < context.options.population)
        strings.push_back(randomBits(context.encoding.length(), context.random));
    auto judged = context.judge(std::move(strings));
    if (!judged) return tl::unexpected(std::move(judged.error()));
    if (!*judged) return StepEnd::Cut;
    state.population = std::move(**judged);
    return StepEnd::Complete;
}

base::Result<StepEnd> elitistGeneration(RunState& state, StepContext& context) {
    const SearchOptions& options = context.options;
    const std::vector<double> objectives = context.objectives(state.population);
    if (auto good = checkRawRoulette(objectives, options); !good) return tl::unexpected(std::move(good.error()));
    std::vector<Individual> next;
    for (const std::size_t i : eliteOf(objectives, options.elite)) next.push_back(state.population[i]);

    Breeder breeder(state.population, objectives, options, context.random);
    std::vector<Bits> strings;
    const std::size_t wanted = options.population - next.size();
    while (strings.size() < wanted) {
        auto [a, b] = breeder.children();
        strings.push_back(std::move(a));
        if (strings.size() < wanted) strings.push_back(std::move(b));
    }
    auto judged = context.judge(std::move(strings));
    if (!judged) return tl::unexpected(std::move(judged.error()));
    if (!*judged) return StepEnd::Cut;
    std::move((*judged)->begin(), (*judged)->end(), std::back_inserter(next));
    state.population = std::move(next);
    return StepEnd::Complete;
}

/// A child takes the place of the worst where it is better, unless it is there already.
void replaceWorst(std::vector<Individual>& population, Individual child, const Ledger& ledger) {
    const auto same = [&](const Individual& other) { return other.entry == child.entry; };
    if (std::any_of(population.begin(), population.end(), same)) return;
    const auto worst =
        std::max_element(population.begin(), population.end(), [&](const Individual& a, const Individual& b) {
            return ledger.objective(a.entry) < ledger.objective(b.entry);
        });
    if (ledger.objective(child.entry) < ledger.objective(worst->entry)) *worst = std::move(child);
}

base::Result<StepEnd> steadyGeneration(RunState& state, StepContext& context) {
    // As many births as an elitist generation has, so that the generations of both can be compared.
    for (std::size_t births = 0; births < context.options.population; births += 2) {
        const std::vector<double> objectives = context.objectives(state.population);
        if (auto good = checkRawRoulette(objectives, context.options); !good)
            return tl::unexpected(std::move(good.error()));
        auto [a, b] = Breeder(state.population, objectives, context.options, context.random).children();
        auto judged = context.judge({std::move(a), std::move(b)});
        if (!judged) return tl::unexpected(std::move(judged.error()));
        if (!*judged) return StepEnd::Cut;
        for (Individual& child : **judged) replaceWorst(state.population, std::move(child), context.ledger);
    }
    return StepEnd::Complete;
}

}  // namespace

base::Result<StepEnd> firstPopulation(RunState& state, StepContext& context) {
    std::vector<Bits> strings;
    for (const Values& start : context.options.starts) strings.push_back(context.encoding.encode(start));
    return randomGeneration(state, context, std::move(strings));
}

base::Result<StepEnd> nextGeneration(RunState& state, StepContext& context) {
    const Algorithm algorithm = context.options.algorithm;
    if (algorithm == Algorithm::RandomSearch) return randomGeneration(state, context, {});
    if (diversityOf(state.population) < context.options.restart_diversity) {
        context.restarted = true;
        const std::size_t best = eliteOf(context.objectives(state.population), 1).front();
        auto renewed = randomGeneration(state, context, {state.population[best].bits});
        if (!renewed || *renewed == StepEnd::Cut) return renewed;
        return algorithm == Algorithm::VirusEvolutionary ? infect(state, context) : renewed;
    }
    switch (algorithm) {
        case Algorithm::RandomSearch: break;
        case Algorithm::SteadyState: return steadyGeneration(state, context);
        case Algorithm::Genetic: return elitistGeneration(state, context);
        case Algorithm::VirusEvolutionary: break;
    }
    auto bred = elitistGeneration(state, context);
    if (!bred || *bred == StepEnd::Cut) return bred;
    if (state.history.size() % context.options.virus.interval != 0) return StepEnd::Complete;
    return infect(state, context);
}

}  // namespace cusp::optimizer
