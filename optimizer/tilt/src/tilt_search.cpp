// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The strategy's problem, its generations in the paper's measure, and the next number of tilt points where one is not enough.
#include <cusp/optimizer/tilt/tilt_search.hpp>

#include <cusp/base/number_text.hpp>
#include <cusp/base/random.hpp>
#include <cusp/optimizer/evolution/evolution_strategy.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <utility>

namespace cusp::tilt {

using optimizer::Evaluation;
using optimizer::Values;

namespace {

TiltFitness fitnessOf(const Evaluation& evaluation) {
    return {evaluation.objectives[0], evaluation.objectives[1], evaluation.objectives[2]};
}

bool isBetter(const TiltFitness& a, const TiltFitness& b) {
    const std::array left{a.range_excess, a.collision_volume_mm3, a.harmony_s};
    const std::array right{b.range_excess, b.collision_volume_mm3, b.harmony_s};
    return optimizer::lexicographicallyLess(left, right);
}

TiltPlan planOf(const TiltCase& problem, const Values& values) {
    TiltPlan plan;
    plan.area = problem.job().area;
    for (std::size_t i = 0; i + 2 < values.size(); i += 3)
        plan.points.emplace_back(values[i], values[i + 1], values[i + 2]);
    return plan;
}

std::vector<optimizer::RealVariable> variablesOf(const TiltSearch& search, std::size_t points) {
    std::vector<optimizer::RealVariable> out;
    for (std::size_t k = 1; k <= points; ++k)
        for (std::size_t axis = 0; axis < 3; ++axis)
            out.push_back({fmt::format("{}{}_mm", "xyz"[axis], k), search.center_mm[axis] - search.cube_mm / 2.0,
                           search.center_mm[axis] + search.cube_mm / 2.0});
    return out;
}

/// Turns the candidates of each generation into the paper's measure.
class History {
public:
    void begin(std::size_t points) {
        points_ = points;
        generation_ = 0;
        scale_mm3_ = 0.0;
    }
    void take(const std::vector<TiltFitness>& candidates, TiltOutcome& outcome) {
        if (candidates.empty()) return;
        if (generation_ == 0)
            for (const TiltFitness& one : candidates)
                if (std::isfinite(one.collision_volume_mm3))
                    scale_mm3_ = std::max(scale_mm3_, one.collision_volume_mm3);
        TiltGeneration record;
        record.points = points_;
        record.generation = generation_++;
        record.worst = 1.0;
        for (const TiltFitness& one : candidates) {
            const double value = valueOf(one);
            record.best = std::max(record.best, value);
            record.worst = std::min(record.worst, value);
            record.mean += value / static_cast<double>(candidates.size());
            if (one.isFree()) ++record.free;
            if (!any_ || isBetter(one, best_)) best_ = one;
            any_ = true;
        }
        outcome.evaluations += candidates.size();
        record.evaluations = outcome.evaluations;
        record.best_so_far = best_;
        if (record.free > 0 && !outcome.generations_to_collision_free)
            outcome.generations_to_collision_free = outcome.history.size();
        outcome.history.push_back(record);
    }

private:
    [[nodiscard]] double valueOf(const TiltFitness& one) const {
        if (one.range_excess > 0.0) return 0.0;
        if (one.collision_volume_mm3 <= 0.0) return 1.0;
        return scale_mm3_ > 0.0 ? std::max(0.0, 1.0 - one.collision_volume_mm3 / scale_mm3_) : 0.0;
    }
    std::size_t points_ = 1;
    std::size_t generation_ = 0;
    double scale_mm3_ = 0.0;
    bool any_ = false;
    TiltFitness best_;
};

optimizer::StrategyOptions optionsOf(const TiltSearch& search, const TiltRun& run, std::size_t points) {
    optimizer::StrategyOptions options;
    options.seed = run.seed + 1000003U * (points - 1);
    options.objectives = 3;
    // 3.2.2 selects the best ("truncation"), 3.2 speaks of tournaments; the best are found sooner so.
    options.selection = optimizer::SurvivorSelection::Truncation;
    options.elite = 5;
    options.offspring = static_cast<std::size_t>(search.offspring);
    options.survivors = static_cast<std::size_t>(search.survivors);
    options.max_generations = static_cast<std::size_t>(search.generations);
    options.max_evaluations = options.offspring * (options.max_generations + 1);
    options.resume = run.resume;
    options.problem_id = fmt::format("tilt, {} points", points);
    if (!run.checkpoint_file.empty()) options.checkpoint_file = fmt::format("{}.{}", run.checkpoint_file, points);
    return options;
}

/// With one more point: the best so far, with every point of the new curve where the old one passes.
Values spread(const TiltPlan& plan, std::size_t points) {
    Values out;
    for (std::size_t k = 0; k < points; ++k) {
        const geometry::Vector3 at = plan.pointAt(static_cast<double>(k) / static_cast<double>(points - 1));
        out.insert(out.end(), {at.x(), at.y(), at.z()});
    }
    return out;
}

}  // namespace

base::Result<TiltOutcome> searchTilt(const TiltCase& problem, const TiltRun& run, base::Progress& progress) {
    const TiltSearch& search = problem.job().search;
    TiltOutcome outcome;
    History history;
    const auto judge = optimizer::inParallel([&](const Values& values) -> base::Result<Evaluation> {
        const TiltFitness fitness = problem.judge(planOf(problem, values));
        return Evaluation{{fitness.range_excess, fitness.collision_volume_mm3, fitness.harmony_s}, {}};
    });
    for (std::size_t points = 1; points <= static_cast<std::size_t>(search.most_points); ++points) {
        optimizer::StrategyOptions options = optionsOf(search, run, points);
        if (points > 1) options.starts.push_back(spread(outcome.plan, points));
        history.begin(points);
        const optimizer::EvaluateBatch batch = [&](std::span<const Values> values, base::Progress& each) {
            auto judged = judge(values, each);
            if (judged) {
                std::vector<TiltFitness> candidates;
                for (const Evaluation& one : *judged) candidates.push_back(fitnessOf(one));
                history.take(candidates, outcome);
            }
            return judged;
        };
        const auto summary = optimizer::evolve(variablesOf(search, points), batch, options, progress);
        if (!summary) return base::fail(summary.error());
        const TiltFitness found = fitnessOf(summary->bestEvaluation());
        if (points == 1 || isBetter(found, outcome.fitness)) {
            outcome.fitness = found;
            outcome.plan = planOf(problem, summary->bestValues());
        }
        outcome.stopped = summary->termination == optimizer::Termination::Stopped;
        if (outcome.fitness.isFree() || outcome.stopped) break;
    }
    return outcome;
}

TiltOutcome randomTilt(const TiltCase& problem, std::uint64_t seed, std::size_t evaluations) {
    base::Random random(seed);
    const auto variables = variablesOf(problem.job().search, 1);
    std::vector<Values> candidates(evaluations);
    for (Values& one : candidates)
        for (const auto& variable : variables) one.push_back(random.uniform(variable.lower, variable.upper));
    std::vector<TiltFitness> judged(evaluations);
    tbb::parallel_for(std::size_t{0}, evaluations,
                      [&](std::size_t i) { judged[i] = problem.judge(planOf(problem, candidates[i])); });
    TiltOutcome outcome;
    History history;
    history.begin(1);
    const auto generation = static_cast<std::size_t>(problem.job().search.offspring);
    for (std::size_t first = 0; first < evaluations; first += generation)
        history.take({judged.begin() + static_cast<std::ptrdiff_t>(first),
                      judged.begin() + static_cast<std::ptrdiff_t>(std::min(evaluations, first + generation))},
                     outcome);
    std::size_t best = 0;
    for (std::size_t i = 1; i < evaluations; ++i)
        if (isBetter(judged[i], judged[best])) best = i;
    outcome.fitness = judged[best];
    outcome.plan = planOf(problem, candidates[best]);
    return outcome;
}

std::string convergenceCsv(const std::vector<std::pair<std::uint64_t, TiltOutcome>>& runs) {
    std::string out =
        "run,seed,points,generation,best,mean,worst,evaluations,free,range_excess,collision_volume_mm3,harmony_s\n";
    for (std::size_t run = 0; run < runs.size(); ++run)
        for (const TiltGeneration& one : runs[run].second.history) {
            out += fmt::format("{},{},{},{},{},{},{},{},{}", run + 1, runs[run].first, one.points, one.generation,
                               base::formatShortest(one.best), base::formatShortest(one.mean),
                               base::formatShortest(one.worst), one.evaluations, one.free);
            // Collisions that were not looked for stay empty.
            const TiltFitness& best = one.best_so_far;
            out += "," + base::formatShortest(best.range_excess) + ",";
            if (std::isfinite(best.collision_volume_mm3)) out += base::formatShortest(best.collision_volume_mm3);
            out += "," + base::formatShortest(best.harmony_s) + "\n";
        }
    return out;
}

}  // namespace cusp::tilt
