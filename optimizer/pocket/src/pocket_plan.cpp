// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Cutting data to paths and back.
#include <cusp/optimizer/pocket/pocket_plan.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <mutex>
#include <numbers>

namespace cusp::pocket {
namespace {

constexpr std::size_t most_points = 40'000;
constexpr double raster_margin_deg = 4.0;  ///< steps are chosen on a raster of 2° by cells of R / 25
constexpr Strategy classical[] = {Strategy::ZigZag, Strategy::OneWay, Strategy::ContourParallel,
                                  Strategy::ConstantEngagement};

double straightDeg(double ae_mm, double diameter_mm) {
    return std::acos(std::clamp(1.0 - 2.0 * ae_mm / diameter_mm, -1.0, 1.0)) * 180.0 / std::numbers::pi;
}

class Planner {
public:
    Planner(const PocketJob& job, const PocketArea& area, const CuttingRange& range, const kinematics::Machine* machine)
        : job_(job), area_(area), range_(range), limits_(job.limits()), machine_(machine) {}

    base::Result<PocketPlan> run(base::Progress& progress) {
        PocketPlan out;
        out.area = area_;
        out.engagement_limit_deg = limits_.engagement_deg;
        if (auto searched = searchData(out, progress); !searched) return tl::unexpected(std::move(searched.error()));
        out.load = loadOf(out.data, limits_, range_.kc_n_per_mm2);
        out.levels = levelsOf(job_.depth, out.data.ap_mm).size();
        auto map = pointMap(area_, out.data.ae_mm, most_points);
        if (!map) return tl::unexpected(std::move(map.error()));
        out.points = map->points.size();
        const PathBuilder limited(area_, *map, {.limit_deg = limits_.engagement_deg - raster_margin_deg});
        for (const Strategy s : classical)
            if (auto added = add(out, limited.build(preferenceOf(*map, s), toText(s)), true); !added)
                return fail(added);
        out.path_search = searchPath(limited, *map, area_, pathOptions(out.data));
        if (auto added = add(out, out.path_search.path, true); !added) return fail(added);
        const PathBuilder free(area_, *map, {.limit_deg = 360.0});
        for (const Strategy s : {Strategy::ZigZag, Strategy::ContourParallel})
            if (auto added = add(out, free.build(preferenceOf(*map, s), toText(s) + "_without_limit"), false); !added)
                return fail(added);
        for (std::size_t i = 0; i < out.strategies.size(); ++i)
            if (isBetter(out.strategies[i], out.strategies[out.chosen])) out.chosen = i;
        return out;
    }

private:
    static tl::unexpected<base::Diagnostics> fail(base::Result<void>& result) {
        return tl::unexpected(std::move(result.error()));
    }

    /// Among limited paths, the fewest steps over the limit, then the least time.
    static bool isBetter(const StrategyOutcome& a, const StrategyOutcome& b) {
        if (a.limited != b.limited) return a.limited;
        if (a.steps_over_limit != b.steps_over_limit) return a.steps_over_limit < b.steps_over_limit;
        return a.time_s < b.time_s;
    }

    PathSpeeds speedsFor(const CuttingData& data) const {
        PathSpeeds out;
        out.feed_mm_per_s = loadOf(data, limits_, 1.0).feed_mm_per_min / 60.0;
        out.rapid_mm_per_s = job_.machine.rapid_mm_per_s;
        out.lift_mm = job_.depth.clearance_mm + job_.depth.top_mm - job_.depth.floor_mm;
        out.ramp_mm = 2.0 * (data.ap_mm + job_.depth.approach_mm) / std::tan(job_.depth.ramp_rad);
        return out;
    }

    PathSearchOptions pathOptions(const CuttingData& data) const {
        PathSearchOptions out;
        out.seed = static_cast<std::uint64_t>(job_.search.seed);
        out.population = static_cast<std::size_t>(job_.search.path_population);
        out.generations = static_cast<std::size_t>(job_.search.path_generations);
        out.target_deg = straightDeg(data.ae_mm, limits_.diameter_mm);
        out.speeds = speedsFor(data);
        return out;
    }

    base::Result<void> add(PocketPlan& plan, FlatPath path, bool limited) {
        StrategyOutcome out;
        out.data = plan.data;
        out.limited = limited;
        out.engagement = measureEngagement(path, area_, limits_.engagement_deg, 0.25);
        for (const double deg : out.engagement.step_max_deg)
            if (deg > limits_.engagement_deg + 1.0) ++out.steps_over_limit;
        // The feed is lowered where the limit cannot be kept.
        for (std::size_t i = 0; i < path.steps.size(); ++i)
            if (out.engagement.step_max_deg[i] > limits_.engagement_deg + 1.0) path.steps[i].over_limit = true;
        out.turns = turnsOf(path);
        out.uncleared_area_mm2 = unclearedArea(path, area_, 0.2);
        out.gouge_mm = gougeOf(path, area_);
        const auto moves = movesOf(path, job_, plan.data);
        if (machine_ != nullptr) {
            auto time = machineTime(moves, *machine_, job_);
            if (!time) return tl::unexpected(std::move(time.error()));
            out.time_s = *time;
        } else {
            out.time_s = distanceTime(moves, job_.machine.rapid_mm_per_s);
        }
        out.path = std::move(path);
        plan.strategies.push_back(std::move(out));
        return {};
    }

    optimizer::Encoding encoding() const {
        const auto gene = [](const char* name, const std::array<double, 2>& range) {
            return optimizer::Gene{.name = name, .bits = 6, .lower = range[0], .upper = range[1], .choices = 0};
        };
        return optimizer::Encoding::create({gene("ap", range_.ap_mm), gene("ae", range_.ae_mm),
                                            gene("n", range_.spindle_rpm), gene("fz", range_.fz_mm)})
            .value();
    }

    static CuttingData dataOf(const optimizer::Values& v) { return {v[0], v[1], v[2], v[3]}; }

    /// The best classical path for a radial depth: length of feed and rapid moves do not depend on the other data.
    base::Result<const FlatPath*> pathFor(double ae_mm) {
        {
            const std::lock_guard lock(mutex_);
            if (const auto known = paths_.find(ae_mm); known != paths_.end()) return &known->second;
        }
        auto map = pointMap(area_, ae_mm, most_points);
        if (!map) return tl::unexpected(std::move(map.error()));
        const PathBuilder builder(area_, *map, {.limit_deg = limits_.engagement_deg - raster_margin_deg});
        FlatPath best;
        double least = std::numeric_limits<double>::infinity();
        const PathSpeeds speeds = speedsFor({range_.ap_mm[1], ae_mm, range_.spindle_rpm[0], range_.fz_mm[0]});
        for (const Strategy s : {Strategy::ContourParallel, Strategy::ConstantEngagement}) {
            FlatPath path = builder.build(preferenceOf(*map, s), toText(s));
            const double time = estimatedTime(path, speeds);
            if (time < least) best = std::move(path);
            least = std::min(least, time);
        }
        const std::lock_guard lock(mutex_);
        return &paths_.emplace(ae_mm, std::move(best)).first->second;
    }

    base::Result<void> checkAnyFeasible() const {
        const CuttingData gentlest{range_.ap_mm[0], range_.ae_mm[0], range_.spindle_rpm[0], range_.fz_mm[0]};
        const std::string why = infeasibility(gentlest, limits_, range_.kc_n_per_mm2);
        if (why.empty()) return {};
        return base::fail("pocket.no-feasible-data",
                          "even the gentlest cutting data break a limit: " + why +
                              "; take smaller depths of cut, a shorter overhang, another tool or a stronger machine");
    }

    /// The interaction module: populations of cutting data, a path for each, selection by what comes of both.
    base::Result<void> searchData(PocketPlan& plan, base::Progress& progress) {
        if (auto any = checkAnyFeasible(); !any) return any;
        const optimizer::Encoding genes = encoding();
        optimizer::SearchOptions options = optimizer::paperOptions();
        options.algorithm = optimizer::Algorithm::Genetic;
        options.fitness_scale = optimizer::FitnessScale::Population;
        options.seed = static_cast<std::uint64_t>(job_.search.seed);
        options.population = static_cast<std::size_t>(job_.search.population);
        options.elite = 1;
        options.max_generations = static_cast<std::size_t>(job_.search.iterations) - 1;
        options.starts = feasibleStarts(genes, options.population);
        if (options.max_generations == 0) options.max_evaluations = options.population;
        auto found = optimizer::search(
            genes,
            optimizer::inParallel(optimizer::Evaluate([&](const optimizer::Values& v) { return judge(dataOf(v)); })),
            options, progress);
        if (!found) return tl::unexpected(std::move(found.error()));
        if (!std::isfinite(found->bestObjective()))
            return base::fail("pocket.no-feasible-data", "no set of cutting data that was tried keeps every limit");
        for (const auto& entry : found->evaluated) {
            const double time = entry.evaluation.objectives.front();
            if (!std::isfinite(time)) continue;
            const CuttingData data = dataOf(entry.values);
            plan.tried.push_back({data, loadOf(data, limits_, range_.kc_n_per_mm2), time, paths_.at(data.ae_mm).name});
        }
        plan.best_by_mrr = *std::max_element(plan.tried.begin(), plan.tried.end(), [](const auto& a, const auto& b) {
            return a.load.mrr_mm3_per_min < b.load.mrr_mm3_per_min;
        });
        plan.data = dataOf(found->bestValues());
        plan.data_search = *std::move(found);
        return {};
    }

    /// Steps 1–7: random chromosomes, those that keep every limit.
    std::vector<optimizer::Values> feasibleStarts(const optimizer::Encoding& genes, std::size_t count) const {
        base::Random random = base::Random(static_cast<std::uint64_t>(job_.search.seed)).split(77);
        std::vector<optimizer::Values> out;
        for (int tries = 0; tries < 100'000 && out.size() < count; ++tries) {
            optimizer::Bits bits;
            for (std::size_t i = 0; i < genes.length(); ++i)
                bits.push_back(static_cast<std::uint8_t>(random.next() >> 63U));
            optimizer::Values values = genes.decode(bits);
            if (infeasibility(dataOf(values), limits_, range_.kc_n_per_mm2).empty()) out.push_back(std::move(values));
        }
        if (out.empty()) out.push_back({range_.ap_mm[0], range_.ae_mm[0], range_.spindle_rpm[0], range_.fz_mm[0]});
        return out;
    }

    base::Result<optimizer::Evaluation> judge(const CuttingData& data) {
        constexpr double not_allowed = std::numeric_limits<double>::infinity();
        if (!infeasibility(data, limits_, range_.kc_n_per_mm2).empty()) return optimizer::Evaluation{{not_allowed}, {}};
        auto path = pathFor(data.ae_mm);
        if (!path) return tl::unexpected(std::move(path.error()));
        const auto levels = static_cast<double>(levelsOf(job_.depth, data.ap_mm).size());
        return optimizer::Evaluation{{levels * estimatedTime(**path, speedsFor(data))}, {}};
    }

    const PocketJob& job_;
    const PocketArea& area_;
    const CuttingRange& range_;
    CutterLimits limits_;
    const kinematics::Machine* machine_;
    std::mutex mutex_;
    std::map<double, FlatPath> paths_;
};

}  // namespace

base::Result<PocketPlan> planPocket(const PocketJob& job, const PocketContours& contours, const CuttingTable& table,
                                    const kinematics::Machine* machine, base::Progress& progress) {
    auto range = rangeFor(table, job.cutting.material, job.tool.diameter_mm);
    if (!range) return tl::unexpected(std::move(range.error()));
    const double d = job.tool.diameter_mm;
    range->ae_mm = {job.cutting.ae_share[0] * d, job.cutting.ae_share[1] * d};
    const double deepest =
        std::min({job.cutting.ap_share[1] * d, job.tool.cutting_height_mm, job.depth.top_mm - job.depth.floor_mm});
    range->ap_mm = {std::min(job.cutting.ap_share[0] * d, 0.99 * deepest), deepest};
    auto area = areaFor(contours, d, job.depth.allowance_mm);
    if (!area) return tl::unexpected(std::move(area.error()));
    return Planner(job, *area, *range, machine).run(progress);
}

}  // namespace cusp::pocket
