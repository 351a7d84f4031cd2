// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Generations of the evolution strategy.
#include "option_check.hpp"
#include "run_file.hpp"

#include <cusp/base/random.hpp>
#include <cusp/optimizer/evolution/evolution_strategy.hpp>
#include <cusp/optimizer/evolution/objective.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

namespace cusp::optimizer {

base::Result<void> StrategyOptions::check(const std::vector<RealVariable>& variables) const {
    OptionCheck check;
    check.require(!variables.empty(), "variables", "there is nothing to search for: no variable is given");
    check.require(objectives >= 1, "objectives", "there must be an objective");
    check.require(offspring >= 2, "offspring", fmt::format("{}; two candidates are the least", offspring));
    check.require(survivors >= 1 && survivors <= offspring, "survivors",
                  fmt::format("{} of {} candidates cannot survive", survivors, offspring));
    check.require(tournament_size >= 1, "tournament_size", "a tournament has at least one contestant");
    check.require(elite < offspring, "elite",
                  fmt::format("{} of {} candidates; at least one must be new", elite, offspring));
    check.share(crossover_probability, "crossover_probability");
    check.require(initial_step > 0.0 && initial_step <= 1.0, "initial_step",
                  fmt::format("{} must be a share of the range, above 0 and up to 1", initial_step));
    check.require(smallest_step > 0.0 && smallest_step <= initial_step, "smallest_step",
                  fmt::format("{} must be above 0 and not above the initial step", smallest_step));
    check.require(max_evaluations >= offspring, "max_evaluations",
                  fmt::format("{} do not suffice for a first generation of {}", max_evaluations, offspring));
    check.require(checkpoint_interval >= 1, "checkpoint_interval", "must be 1 or more generations");
    check.require(target_objectives.empty() || target_objectives.size() == objectives, "target_objectives",
                  fmt::format("{} values where there are {} objectives", target_objectives.size(), objectives));
    check.require(starts.size() <= offspring, "starts",
                  fmt::format("{} starts in a generation of {}", starts.size(), offspring));
    for (const Values& start : starts)
        check.require(
            start.size() == variables.size(), "starts",
            fmt::format("a start has {} values where there are {} variables", start.size(), variables.size()));
    for (const RealVariable& v : variables)
        check.require(
            std::isfinite(v.lower) && std::isfinite(v.upper) && v.lower < v.upper, v.name,
            fmt::format("the range {} to {} is empty; the lower limit must be below the upper one", v.lower, v.upper));
    return check.result();
}

Values crossCoordinates(const Values& a, const Values& b, base::Random& random) {
    Values out;
    for (std::size_t i = 0; i < a.size(); ++i) out.push_back((random.next() >> 63U) != 0 ? a[i] : b[i]);
    return out;
}

void mutateNormally(Values& values, double step, const std::vector<RealVariable>& variables, base::Random& random) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto [name, lower, upper] = variables[i];
        const double range = upper - lower;
        double x = std::fmod(std::abs(values[i] + step * range * random.normal() - lower), 2.0 * range);
        if (x > range) x = 2.0 * range - x;  // folded back at the upper end as abs() does at the lower one
        values[i] = std::clamp(lower + x, lower, upper);
    }
}

namespace {

struct StrategyState {
    std::vector<StrategyIndividual> survivors;
    std::vector<StrategyRecord> history;
};

CandidateKey keyOf(const Values& values) {
    CandidateKey out;
    // -0 and 0 are one candidate.
    for (const double value : values) out.push_back(std::bit_cast<std::uint64_t>(value + 0.0));
    return out;
}
Values valuesOf(const CandidateKey& key) {
    Values out;
    for (const std::uint64_t word : key) out.push_back(std::bit_cast<double>(word));
    return out;
}

base::Json settingsOf(const std::vector<RealVariable>& variables, const StrategyOptions& o) {
    base::Json out;
    out["problem"] = o.problem_id;
    base::Json& list = out["variables"] = base::Json::array();
    for (const RealVariable& v : variables) list.push_back({v.name, v.lower, v.upper});
    out["algorithm"] = "evolution strategy";
    out["seed"] = o.seed;
    out["objectives"] = o.objectives;
    out["population"] = {o.offspring, o.survivors, o.elite};
    out["selection"] = {static_cast<int>(o.selection), o.tournament_size};
    out["variation"] = {o.crossover_probability, o.initial_step, o.smallest_step};
    base::Json& starts = out["starts"] = base::Json::array();
    for (const Values& start : o.starts) starts.push_back(start);
    return out;
}

base::Json toJson(const StrategyState& state) {
    base::Json out;
    base::Json& survivors = out["survivors"] = base::Json::array();
    for (const StrategyIndividual& s : state.survivors) survivors.push_back({s.step, s.entry});
    base::Json& history = out["history"] = base::Json::array();
    for (const StrategyRecord& r : state.history)
        history.push_back(
            {r.generation, r.evaluations, r.repeats, numbersJson(r.best), numbersJson(r.population_best), r.mean_step});
    return out;
}

StrategyState stateOf(const base::Json& run, const std::vector<Ledger::Entry>& entries) {
    StrategyState out;
    for (const base::Json& s : run.at("survivors")) {
        const std::size_t entry = s.at(1);
        out.survivors.push_back({entries.at(entry).values, s.at(0), entry});
    }
    for (const base::Json& r : run.at("history"))
        out.history.push_back({.generation = r.at(0),
                               .evaluations = r.at(1),
                               .repeats = r.at(2),
                               .best = numbersOf(r.at(3)),
                               .population_best = numbersOf(r.at(4)),
                               .mean_step = r.at(5)});
    if (out.history.empty() || out.survivors.empty()) throw std::out_of_range("no generation");
    return out;
}

class StrategyRun {
public:
    StrategyRun(const std::vector<RealVariable>& variables, const EvaluateBatch& evaluate,
                const StrategyOptions& options, base::Progress& progress,
                const std::function<void(const StrategyRecord&)>& on_generation)
        : variables_(variables),
          options_(options),
          progress_(progress),
          on_generation_(on_generation),
          ledger_(evaluate, options.max_evaluations, options.objectives, progress),
          settings_(settingsOf(variables, options)) {}

    base::Result<StrategySummary> run() {
        if (auto resumed = resume(); !resumed) return tl::unexpected(std::move(resumed.error()));
        std::optional<Termination> end;
        while (!(end = reason())) {
            auto complete = step();
            if (!complete) return tl::unexpected(std::move(complete.error()));
            if (!*complete) {
                end = ledger_.exhausted() ? Termination::Evaluations : Termination::Stopped;
                break;
            }
            if (state_.history.size() % options_.checkpoint_interval == 0)
                if (auto saved = save(); !saved) return tl::unexpected(std::move(saved.error()));
        }
        if (ledger_.size() == 0)
            return base::fail("evolution.stopped", "the search was stopped before one candidate was judged");
        if (auto saved = save(); !saved) return tl::unexpected(std::move(saved.error()));
        return StrategySummary{.termination = *end,
                               .best = best_,
                               .evaluated = ledger_.entries(),
                               .history = std::move(state_.history),
                               .survivors = std::move(state_.survivors),
                               .evaluations = ledger_.size(),
                               .repeats = ledger_.repeats()};
    }

private:
    [[nodiscard]] bool less(std::size_t a, std::size_t b) const {
        return lexicographicallyLess(objectives(a), objectives(b));
    }
    [[nodiscard]] const std::vector<double>& objectives(std::size_t entry) const {
        return ledger_.entries()[entry].evaluation.objectives;
    }

    base::Result<void> resume() {
        if (!options_.resume || options_.checkpoint_file.empty()) return {};
        return readRun(options_.checkpoint_file, settings_, [&](const base::Json& run) {
            auto entries = entriesOf(run.at("entries"), variables_.size(), options_.objectives, valuesOf);
            StrategyState state = stateOf(run, entries);
            charged_ = run.at("charged");
            repeats_ = run.at("repeats");
            for (const StrategyIndividual& s : state.survivors)
                if (s.entry >= charged_) throw std::out_of_range("a survivor");
            ledger_.restore(std::move(entries), charged_, repeats_);
            state_ = std::move(state);
            progress_.advance(charged_);
            trackBest();
        });
    }

    base::Result<void> save() {
        if (options_.checkpoint_file.empty() || state_.history.empty()) return {};
        base::Json run = toJson(state_);
        run["charged"] = charged_;
        run["repeats"] = repeats_;
        run["entries"] = entriesJson(ledger_.known());
        return writeRun(options_.checkpoint_file, settings_, std::move(run));
    }

    /// Candidates of one generation: starts and random ones at first, then children of the survivors.
    std::vector<StrategyIndividual> candidates(base::Random& random) const {
        std::vector<StrategyIndividual> out;
        if (state_.history.empty()) {
            for (const Values& start : options_.starts) out.push_back({clamped(start), options_.initial_step, 0});
            while (out.size() < options_.offspring) {
                Values values;
                for (const RealVariable& v : variables_) values.push_back(random.uniform(v.lower, v.upper));
                out.push_back({std::move(values), options_.initial_step, 0});
            }
            return out;
        }
        for (const StrategyIndividual& kept : sorted(state_.survivors, options_.elite)) out.push_back(kept);
        while (out.size() < options_.offspring) out.push_back(child(random));
        return out;
    }

    [[nodiscard]] Values clamped(Values values) const {
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = std::clamp(values[i], variables_[i].lower, variables_[i].upper);
        return values;
    }

    StrategyIndividual child(base::Random& random) const {
        const auto parent = [&]() -> const StrategyIndividual& {
            return state_.survivors[static_cast<std::size_t>(random.below(state_.survivors.size()))];
        };
        const StrategyIndividual& a = parent();
        const StrategyIndividual& b = parent();
        StrategyIndividual out = a;
        if (random.chance(options_.crossover_probability)) {
            out.values = crossCoordinates(a.values, b.values, random);
            out.step = std::sqrt(a.step * b.step);
        }
        const double tau = 1.0 / std::sqrt(2.0 * static_cast<double>(variables_.size()));
        out.step = std::clamp(out.step * std::exp(tau * random.normal()), options_.smallest_step, 1.0);
        mutateNormally(out.values, out.step, variables_, random);
        return out;
    }

    /// The best `count`, best first; of equals the first.
    [[nodiscard]] std::vector<StrategyIndividual> sorted(const std::vector<StrategyIndividual>& individuals,
                                                         std::size_t count) const {
        std::vector<std::size_t> order(individuals.size());
        std::iota(order.begin(), order.end(), std::size_t{0});
        std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            const std::size_t ea = individuals[a].entry;
            const std::size_t eb = individuals[b].entry;
            return less(ea, eb) || (!less(eb, ea) && a < b);
        });
        order.resize(std::min(count, order.size()));
        std::vector<StrategyIndividual> out;
        for (const std::size_t i : order) out.push_back(individuals[i]);
        return out;
    }

    std::vector<StrategyIndividual> survive(const std::vector<StrategyIndividual>& all, base::Random& random) const {
        if (options_.selection == SurvivorSelection::Truncation) return sorted(all, options_.survivors);
        std::vector<StrategyIndividual> out;
        for (const StrategyIndividual& kept : sorted(all, options_.elite)) out.push_back(kept);
        while (out.size() < options_.survivors) {
            auto winner = static_cast<std::size_t>(random.below(all.size()));
            for (std::size_t i = 1; i < options_.tournament_size; ++i) {
                const auto other = static_cast<std::size_t>(random.below(all.size()));
                if (less(all[other].entry, all[winner].entry)) winner = other;
            }
            out.push_back(all[winner]);
        }
        return out;
    }

    /// Whether the generation was carried through.
    base::Result<bool> step() {
        base::Random random = base::Random(options_.seed).split(state_.history.size());
        std::vector<StrategyIndividual> all = candidates(random);
        std::vector<CandidateKey> keys;
        std::vector<Values> values;
        for (const StrategyIndividual& i : all) {
            keys.push_back(keyOf(i.values));
            values.push_back(valuesOf(keys.back()));
        }
        auto entries = ledger_.evaluate(keys, values);
        if (!entries) return tl::unexpected(std::move(entries.error()));
        trackBest();
        for (std::size_t i = 0; i < all.size(); ++i) {
            if ((*entries)[i] == Ledger::not_evaluated) return false;
            all[i].entry = (*entries)[i];
        }
        state_.survivors = survive(all, random);
        record(all);
        charged_ = ledger_.size();
        repeats_ = ledger_.repeats();
        if (on_generation_) on_generation_(state_.history.back());
        return true;
    }

    void record(const std::vector<StrategyIndividual>& all) {
        StrategyRecord r;
        r.generation = state_.history.size();
        r.evaluations = ledger_.size();
        r.repeats = ledger_.repeats();
        r.best = objectives(best_);
        r.population_best = objectives(sorted(all, 1).front().entry);
        for (const StrategyIndividual& s : state_.survivors) r.mean_step += s.step;
        r.mean_step /= static_cast<double>(state_.survivors.size());
        state_.history.push_back(std::move(r));
    }

    void trackBest() {
        for (; looked_at_ < ledger_.size(); ++looked_at_)
            if (less(looked_at_, best_)) best_ = looked_at_;
    }

    [[nodiscard]] std::optional<Termination> reason() const {
        if (progress_.stopRequested()) return Termination::Stopped;
        const auto& history = state_.history;
        if (history.empty()) return std::nullopt;
        if (!options_.target_objectives.empty() &&
            !lexicographicallyLess(options_.target_objectives, objectives(best_)))
            return Termination::Target;
        if (ledger_.size() >= options_.max_evaluations) return Termination::Evaluations;
        if (options_.max_generations > 0 && history.size() > options_.max_generations) return Termination::Generations;
        const std::size_t stall = options_.stall_generations;
        if (stall > 0 && history.size() > stall && history[history.size() - 1 - stall].best == history.back().best)
            return Termination::Stalled;
        return std::nullopt;
    }

    const std::vector<RealVariable>& variables_;
    const StrategyOptions& options_;
    base::Progress& progress_;
    const std::function<void(const StrategyRecord&)>& on_generation_;
    Ledger ledger_;
    base::Json settings_;
    StrategyState state_;
    std::size_t charged_ = 0;
    std::size_t repeats_ = 0;
    std::size_t best_ = 0;
    std::size_t looked_at_ = 0;
};

}  // namespace

base::Result<StrategySummary> evolve(const std::vector<RealVariable>& variables, const EvaluateBatch& evaluate,
                                     const StrategyOptions& options, base::Progress& progress,
                                     const std::function<void(const StrategyRecord&)>& on_generation) {
    if (auto good = options.check(variables); !good) return tl::unexpected(std::move(good.error()));
    progress.begin(options.max_evaluations, "candidates");
    auto out = StrategyRun(variables, evaluate, options, progress, on_generation).run();
    progress.end();
    return out;
}

}  // namespace cusp::optimizer
