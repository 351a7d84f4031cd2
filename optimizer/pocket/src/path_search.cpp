// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Generations of orders.
#include <cusp/optimizer/pocket/path_search.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tbb/parallel_for.h>
#include <utility>

namespace cusp::pocket {

double estimatedTime(const FlatPath& path, const PathSpeeds& speeds) {
    double time = 0.0;
    Point at = path.start;
    for (const FlatStep& step : path.steps) {
        const double way = std::hypot(step.to.x_mm - at.x_mm, step.to.y_mm - at.y_mm);
        if (step.kind == StepKind::Cut || step.kind == StepKind::Link)
            time += way / speeds.feed_mm_per_s;
        else
            time += (way + 2.0 * speeds.lift_mm) / speeds.rapid_mm_per_s;
        if (step.kind == StepKind::Helix) time += speeds.ramp_mm / speeds.feed_mm_per_s;
        at = step.to;
    }
    return time;
}

double PathObjective::value(const PathObjective& reference) const {
    const auto share = [](double mine, double other) { return other > 0.0 ? mine / other : 1.0; };
    return 0.5 * share(time_s, reference.time_s) + 0.25 * share(turns, reference.turns) +
           0.25 * share(engagement_deviation_deg, reference.engagement_deviation_deg);
}

Order crossOrder(const Order& a, const Order& b, std::size_t first, std::size_t last) {
    const std::size_t n = a.size();
    Order child(n);
    std::vector<bool> taken(n);
    for (std::size_t i = first; i < last; ++i) {
        child[i] = a[i];
        taken[a[i]] = true;
    }
    std::size_t to = last % n;
    for (std::size_t k = 0; k < n; ++k) {
        const std::uint32_t gene = b[(last + k) % n];
        if (taken[gene]) continue;
        child[to] = gene;
        to = (to + 1) % n;
    }
    return child;
}

void mutateOrder(Order& order, base::Random& random) {
    const std::size_t n = order.size();
    if (n < 4) return;
    auto first = static_cast<std::size_t>(random.below(n));
    auto last = std::min(n, first + 2 + static_cast<std::size_t>(random.below(std::max<std::size_t>(n / 8, 2))));
    const auto begin = order.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = order.begin() + static_cast<std::ptrdiff_t>(last);
    if (random.chance(0.5)) {
        std::reverse(begin, end);
        return;
    }
    const auto target = static_cast<std::size_t>(random.below(n));
    const auto place = order.begin() + static_cast<std::ptrdiff_t>(target);
    if (target < first)
        std::rotate(place, begin, end);
    else if (target > last)
        std::rotate(begin, end, place);
}

namespace {

std::vector<double> ranksOf(const Order& order) {
    std::vector<double> out(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) out[order[i]] = static_cast<double>(i);
    return out;
}

Order orderOf(const std::vector<double>& preference) {
    Order out(preference.size());
    std::iota(out.begin(), out.end(), 0U);
    std::stable_sort(out.begin(), out.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return preference[a] < preference[b]; });
    return out;
}

struct Candidate {
    Order order;
    FlatPath path;
    PathObjective objective;
    double value = 0.0;
};

class Search {
public:
    Search(const PathBuilder& builder, const PointMap& map, const PocketArea& area, const PathSearchOptions& options)
        : builder_(builder), map_(map), area_(area), options_(options) {}

    PathSearchResult run(base::Progress& progress) {
        std::vector<Candidate> people = firstPopulation();
        judge(people, 0);
        reference_ = people.front().objective;
        for (Candidate& c : people) c.value = c.objective.value(reference_);
        sort(people);
        PathSearchResult out;
        record(out, people);
        for (std::size_t g = 1; g <= options_.generations && !progress.stopRequested(); ++g) {
            base::Random random = base::Random(options_.seed).split(g);
            breed(people, random);
            record(out, people);
        }
        improve(people.front(), progress);
        out.path = std::move(people.front().path);
        out.path.name = "genetic";
        out.objective = people.front().objective;
        out.value = people.front().value;
        out.evaluations = evaluations_;
        return out;
    }

private:
    std::vector<Candidate> firstPopulation() const {
        std::vector<Candidate> out;
        base::Random random = base::Random(options_.seed).split(0);
        for (const Strategy s :
             {Strategy::ZigZag, Strategy::OneWay, Strategy::ContourParallel, Strategy::ConstantEngagement})
            out.push_back({orderOf(preferenceOf(map_, s)), {}, {}, 0.0});
        while (out.size() < options_.population) {
            Order order = out.front().order;
            random.shuffle(order);
            out.push_back({std::move(order), {}, {}, 0.0});
        }
        return out;
    }

    void judge(std::vector<Candidate>& people, std::size_t from) {
        tbb::parallel_for(from, people.size(), [&](std::size_t i) { judge(people[i]); });
        evaluations_ += people.size() - from;
    }

    void judge(Candidate& c) const {
        c.path = builder_.build(ranksOf(c.order), "genetic");
        const Engagement e = measureEngagement(c.path, area_, 360.0, map_.spacing_mm);
        c.objective.time_s = estimatedTime(c.path, options_.speeds);
        c.objective.turns = static_cast<double>(turnsOf(c.path));
        double weight = 0.0;
        Point at = c.path.start;
        for (std::size_t i = 0; i < c.path.steps.size(); ++i) {
            const FlatStep& step = c.path.steps[i];
            const double way = std::hypot(step.to.x_mm - at.x_mm, step.to.y_mm - at.y_mm);
            if (step.kind == StepKind::Cut) {
                c.objective.engagement_deviation_deg += way * std::abs(e.step_max_deg[i] - options_.target_deg);
                weight += way;
            }
            at = step.to;
        }
        if (weight > 0.0) c.objective.engagement_deviation_deg /= weight;
        c.value = c.objective.value(reference_);
    }

    static void sort(std::vector<Candidate>& people) {
        std::stable_sort(people.begin(), people.end(),
                         [](const Candidate& a, const Candidate& b) { return a.value < b.value; });
    }

    void breed(std::vector<Candidate>& people, base::Random& random) {
        constexpr std::size_t elite = 2;
        const std::size_t parents = std::max<std::size_t>(people.size() / 2, 2);
        const std::size_t n = map_.points.size();
        std::vector<Candidate> next(people.begin(), people.begin() + elite);
        while (next.size() < people.size()) {
            const Order& a = people[static_cast<std::size_t>(random.below(parents))].order;
            const Order& b = people[static_cast<std::size_t>(random.below(parents))].order;
            const auto first = static_cast<std::size_t>(random.below(n));
            const auto last = first + 1 + static_cast<std::size_t>(random.below(n - first));
            Order child = crossOrder(a, b, first, last);
            if (random.chance(0.5)) mutateOrder(child, random);
            next.push_back({std::move(child), {}, {}, 0.0});
        }
        judge(next, elite);
        sort(next);
        people = std::move(next);
    }

    /// 2-opt and Or-opt, judged by the path that comes of it: what is better stays.
    void improve(Candidate& best, base::Progress& progress) {
        base::Random random = base::Random(options_.seed).split(1'000'000);
        for (std::size_t done = 0; done < options_.improvements && !progress.stopRequested(); done += 4) {
            std::vector<Candidate> trials(4, Candidate{best.order, {}, {}, 0.0});
            for (Candidate& trial : trials) mutateOrder(trial.order, random);
            judge(trials, 0);
            sort(trials);
            if (trials.front().value < best.value) best = std::move(trials.front());
        }
    }

    void record(PathSearchResult& out, const std::vector<Candidate>& people) const {
        double sum = 0.0;
        for (const Candidate& c : people) sum += c.value;
        out.history.push_back({out.history.size(), people.front().value, sum / static_cast<double>(people.size())});
    }

    const PathBuilder& builder_;
    const PointMap& map_;
    const PocketArea& area_;
    const PathSearchOptions& options_;
    PathObjective reference_;
    std::size_t evaluations_ = 0;
};

}  // namespace

PathSearchResult searchPath(const PathBuilder& builder, const PointMap& map, const PocketArea& area,
                            const PathSearchOptions& options, base::Progress& progress) {
    return Search(builder, map, area, options).run(progress);
}

}  // namespace cusp::pocket
