// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The frame of every search on chromosomes: generations until something ends them.
#include "checkpoint.hpp"
#include "run_state.hpp"

#include <cusp/base/number_text.hpp>
#include <cusp/optimizer/evolution/search.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace cusp::optimizer {
namespace {

/// Generations in a row without a new candidate after which none is expected any more.
constexpr std::size_t barren_generations = 1000;

class Run {
public:
    Run(const Encoding& encoding, const EvaluateBatch& evaluate, const SearchOptions& options, base::Progress& progress,
        const OnGeneration& on_generation)
        : encoding_(encoding),
          options_(options),
          progress_(progress),
          on_generation_(on_generation),
          ledger_(evaluate, options.max_evaluations, 1, progress),
          fingerprint_(fingerprint(encoding, options)) {}

    base::Result<SearchSummary> run() {
        if (auto resumed = resume(); !resumed) return tl::unexpected(std::move(resumed.error()));
        std::optional<Termination> end;
        while (!(end = reason())) {
            auto stepped = step();
            if (!stepped) return tl::unexpected(std::move(stepped.error()));
            if (*stepped == StepEnd::Cut) {
                end = ledger_.exhausted() ? Termination::Evaluations : Termination::Stopped;
                break;
            }
            if (generation() % options_.checkpoint_interval == 0)
                if (auto saved = save(); !saved) return tl::unexpected(std::move(saved.error()));
        }
        if (ledger_.size() == 0)
            return base::fail("evolution.stopped", "the search was stopped before one candidate was judged");
        if (auto saved = save(); !saved) return tl::unexpected(std::move(saved.error()));
        return summary(*end);
    }

private:
    [[nodiscard]] std::size_t generation() const { return state_.history.size() - 1; }
    [[nodiscard]] base::Random randomOf(std::size_t generation) const {
        return base::Random(options_.seed).split(generation);
    }

    base::Result<void> resume() {
        if (!options_.resume || options_.checkpoint_file.empty()) return {};
        auto found = readCheckpoint(options_.checkpoint_file, fingerprint_, encoding_);
        if (!found) return tl::unexpected(std::move(found.error()));
        if (!*found) return {};
        Checkpoint& checkpoint = **found;
        state_ = std::move(checkpoint.state);
        charged_ = checkpoint.charged;
        repeats_ = checkpoint.repeats;
        ledger_.restore(std::move(checkpoint.entries), charged_, repeats_);
        progress_.advance(charged_);
        trackBest();
        return {};
    }

    base::Result<void> save() {
        if (options_.checkpoint_file.empty() || state_.history.empty()) return {};
        return writeCheckpoint(options_.checkpoint_file, fingerprint_, {state_, ledger_.known(), charged_, repeats_});
    }

    /// A step works on a copy: one that is cut short leaves the last complete generation as it was.
    base::Result<StepEnd> step() {
        const bool first = state_.history.empty();
        RunState next = state_;
        StepContext context{encoding_, options_, ledger_, randomOf(state_.history.size())};
        auto stepped = first ? firstPopulation(next, context) : nextGeneration(next, context);
        trackBest();
        if (!stepped || *stepped == StepEnd::Cut) return stepped;
        state_ = std::move(next);
        record(context);
        charged_ = ledger_.size();
        repeats_ = ledger_.repeats();
        if (on_generation_) on_generation_(state_.history.back());
        return StepEnd::Complete;
    }

    void record(const StepContext& context) {
        GenerationRecord r;
        r.generation = state_.history.size();
        r.evaluations = ledger_.size();
        r.viral_evaluations = state_.viral_evaluations;
        r.repeats = ledger_.repeats();
        r.best = ledger_.objective(best_);
        const std::vector<double> objectives = context.objectives(state_.population);
        const auto [low, high] = std::minmax_element(objectives.begin(), objectives.end());
        r.population_best = *low;
        r.population_worst = *high;
        double count = 0.0;
        for (const double z : objectives)
            if (std::isfinite(z)) {
                r.population_mean += z;
                count += 1.0;
            }
        r.population_mean = count > 0.0 ? r.population_mean / count : std::numeric_limits<double>::infinity();
        r.diversity = diversityOf(state_.population);
        r.infections = context.infections;
        r.improvements = context.improvements;
        r.restarted = context.restarted;
        state_.history.push_back(r);
    }

    void trackBest() {
        for (; looked_at_ < ledger_.size(); ++looked_at_)
            if (ledger_.objective(looked_at_) < ledger_.objective(best_)) best_ = looked_at_;
    }

    [[nodiscard]] std::optional<Termination> reason() const {
        if (progress_.stopRequested()) return Termination::Stopped;
        if (state_.history.empty()) return std::nullopt;
        if (ledger_.objective(best_) <= options_.target_objective) return Termination::Target;
        if (ledger_.size() >= options_.max_evaluations) return Termination::Evaluations;
        if (options_.max_generations > 0 && generation() >= options_.max_generations) return Termination::Generations;
        if (static_cast<double>(ledger_.size()) >= encoding_.candidateCount() || unchanged(barren_generations, true))
            return Termination::Exhausted;
        if (options_.stall_generations > 0 && unchanged(options_.stall_generations, false)) return Termination::Stalled;
        return std::nullopt;
    }

    /// Whether the last `count` generations met no new candidate, or no better one.
    [[nodiscard]] bool unchanged(std::size_t count, bool candidates) const {
        const auto& history = state_.history;
        if (history.size() <= count) return false;
        const GenerationRecord& then = history[history.size() - 1 - count];
        return candidates ? then.evaluations == history.back().evaluations : then.best == history.back().best;
    }

    SearchSummary summary(Termination end) {
        // A generation cut short by the limit has no population, but what it judged counts.
        if (ledger_.size() > charged_ && !state_.history.empty()) {
            GenerationRecord last = state_.history.back();
            ++last.generation;
            last.evaluations = ledger_.size();
            last.repeats = ledger_.repeats();
            last.best = ledger_.objective(best_);
            last.infections = last.improvements = 0;
            last.restarted = false;
            state_.history.push_back(last);
        }
        SearchSummary out;
        out.termination = end;
        out.best = best_;
        out.evaluated = ledger_.entries();
        out.history = std::move(state_.history);
        out.population = std::move(state_.population);
        out.viruses = std::move(state_.viruses);
        out.evaluations = ledger_.size();
        out.viral_evaluations = state_.viral_evaluations;
        out.repeats = ledger_.repeats();
        return out;
    }

    const Encoding& encoding_;
    const SearchOptions& options_;
    base::Progress& progress_;
    const OnGeneration& on_generation_;
    Ledger ledger_;
    base::Json fingerprint_;
    RunState state_;
    std::size_t charged_ = 0;
    std::size_t repeats_ = 0;
    std::size_t best_ = 0;
    std::size_t looked_at_ = 0;
};

}  // namespace

double diversityOf(const std::vector<Individual>& population) {
    const std::size_t length = population.front().bits.size();
    double sum = 0.0;
    for (std::size_t b = 0; b < length; ++b) {
        double ones = 0.0;
        for (const Individual& individual : population) ones += individual.bits[b];
        const double p = ones / static_cast<double>(population.size());
        sum += 4.0 * p * (1.0 - p);
    }
    return sum / static_cast<double>(length);
}

base::Result<SearchSummary> search(const Encoding& encoding, const EvaluateBatch& evaluate,
                                   const SearchOptions& options, base::Progress& progress,
                                   const OnGeneration& on_generation) {
    if (auto good = options.check(encoding); !good) return tl::unexpected(std::move(good.error()));
    progress.begin(options.max_evaluations, "candidates");
    auto out = Run(encoding, evaluate, options, progress, on_generation).run();
    progress.end();
    return out;
}

std::string toText(Termination termination) {
    switch (termination) {
        case Termination::Evaluations: return "evaluation limit reached";
        case Termination::Generations: return "generation limit reached";
        case Termination::Stalled: return "no better candidate for the generations allowed";
        case Termination::Target: return "target objective reached";
        case Termination::Exhausted: return "no new candidates left";
        case Termination::Stopped: return "stopped";
    }
    return {};
}

std::string convergenceCsv(const std::vector<GenerationRecord>& history) {
    const auto number = [](double value) { return std::isfinite(value) ? base::formatShortest(value) : "inf"; };
    std::string out = "generation,evaluations,viral_evaluations,repeats,best,population_best,population_mean,"
                      "population_worst,diversity,infections,improvements,restarted\n";
    for (const GenerationRecord& r : history)
        out += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", r.generation, r.evaluations, r.viral_evaluations,
                           r.repeats, number(r.best), number(r.population_best), number(r.population_mean),
                           number(r.population_worst), number(r.diversity), r.infections, r.improvements,
                           r.restarted ? 1 : 0);
    return out;
}

}  // namespace cusp::optimizer
