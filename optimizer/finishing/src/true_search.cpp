// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Search by cheap looks, levelling, proof.
#include "true_parts.hpp"

#include <cusp/optimizer/finishing/true_search.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace cusp::finishing {

using optimizer::Evaluation;
using optimizer::Values;

namespace {

/// A candidate that misses the tolerance is worth so much more time, in parts of the reference, for each part it misses by.
constexpr double penalty = 2.0;
/// Tools that need more than this many times the passes of the best by the ridge alone are not looked at.
constexpr double hopeless = 2.0;

struct Search {
    const Workpiece& part;
    const TrueProblem& problem;
    std::vector<std::int64_t> ridge_counts;  ///< of passes, for each tool
    std::int64_t fewest = 0;

    [[nodiscard]] Evaluation refuse(std::size_t tool) const {
        const double ratio = static_cast<double>(ridge_counts[tool]) / static_cast<double>(fewest);
        return {{1.0 + penalty + ratio}, {0.0, 0.0, 0.0}};
    }
    [[nodiscard]] base::Result<Evaluation> judge(const Values& values) const {
        const auto tool = static_cast<std::size_t>(std::lround(values[0]));
        if (static_cast<double>(ridge_counts[tool]) > hopeless * static_cast<double>(fewest)) return refuse(tool);
        const std::int64_t count = countOf(values);
        LevelOptions level = levelOptions(problem, problem.search_grid_mm);
        level.rounds = problem.search_rounds;
        const auto seen = levelPasses(part, problem.tools[tool].cutter(), optionsOf(values), count, level);
        if (!seen) return base::fail(seen.error());
        const double time = static_cast<double>(count) / static_cast<double>(fewest);
        return Evaluation{{time + penalty * std::max(0.0, seen->excess - 1.0)},
                          {seen->excess, static_cast<double>(count), estimatedTime(seen->path)}};
    }
    [[nodiscard]] std::int64_t countOf(const Values& values) const {
        const auto tool = static_cast<std::size_t>(std::lround(values[0]));
        return std::max<std::int64_t>(2, std::llround(values[1] * static_cast<double>(ridge_counts[tool])));
    }
    [[nodiscard]] PlanOptions optionsOf(const Values& values) const {
        return adaptiveOptions(problem, values[2] * problem.tolerance_mm, values[3]);
    }
};

/// From a candidate to fewer passes while the tolerance holds, or to more until it does.
base::Result<std::optional<ProvedPath>> toFewest(const Search& search, const Values& values,
                                                 std::vector<FrontPoint>& front, base::Progress& progress) {
    const auto tool = static_cast<std::size_t>(std::lround(values[0]));
    const std::int64_t start = search.countOf(values);
    const auto most = start + std::max<std::int64_t>(6, start / 2);
    std::optional<ProvedPath> best;
    PlanOptions options = search.optionsOf(values);
    for (std::int64_t count = start; count >= 2 && count <= most && !progress.stopRequested();) {
        auto path = leveled(search.part, search.problem, tool, options, count);
        progress.advance();
        if (!path) return base::fail(path.error());
        front.push_back(frontPointOf(*path, search.problem, true, 0.0));
        if (path->levelled.excess <= 1.0) {
            const bool was_coming_down = !best || path->time.total_s < best->time.total_s;
            if (was_coming_down) best = *std::move(path);
            if (count > start) break;
            --count;
        } else if (best) {
            break;
        } else {
            ++count;
            if (count <= start) break;
        }
    }
    return best;
}

/// The best path with passes left out and added, each levelled to the tolerance that its ridges, which grow with the square of
/// their width at least, leave in sight.
base::Result<void> widenFront(const Search& search, TrueResult& out, base::Progress& progress) {
    const FinishingPath& best = out.best.levelled.path;
    const auto count = static_cast<std::int64_t>(best.contacts.options.passes.places.size());
    const std::int64_t beside = search.problem.front_passes;
    progress.begin(static_cast<std::uint64_t>(2 * beside), "time against deviation");
    for (std::int64_t passes = std::max<std::int64_t>(2, count - beside); passes <= count + beside; ++passes) {
        if (progress.stopRequested()) break;
        const bool known = std::any_of(out.levelled.begin(), out.levelled.end(), [&](const FrontPoint& point) {
            return point.tool == out.best.tool && point.passes == static_cast<std::size_t>(passes);
        });
        if (known) continue;
        const double scale = std::pow(static_cast<double>(count) / static_cast<double>(passes), 2.0);
        TrueProblem problem = search.problem;
        problem.tolerance_mm *= scale;
        PlanOptions options = best.contacts.options;
        options.orientation.depth_offset_mm *= scale;
        options.passes.scallop_mm *= scale;
        auto path = leveled(search.part, problem, out.best.tool, options, passes);
        progress.advance();
        if (!path) return base::fail(path.error());
        if (path->levelled.whole) out.levelled.push_back(frontPointOf(*path, problem, true, 0.0));
    }
    progress.end();
    return {};
}

}  // namespace

base::Result<TrueResult> searchTrue(const Workpiece& part, const TrueProblem& problem,
                                    const optimizer::SearchOptions& options, base::Progress& progress,
                                    const optimizer::OnGeneration& on_generation) {
    Search search{part, problem, {}, 0};
    for (const toolpath::Tool& tool : problem.tools) {
        const auto count = ridgeCount(part, problem, tool.cutter());
        if (!count) return base::fail(count.error());
        search.ridge_counts.push_back(*count);
    }
    search.fewest = *std::min_element(search.ridge_counts.begin(), search.ridge_counts.end());
    const auto tools = static_cast<std::int64_t>(problem.tools.size());
    const auto range = [](std::string name, int bits, const std::array<double, 2>& ends) {
        return optimizer::Gene{std::move(name), bits, ends[0], ends[1], 0};
    };
    const auto encoding = optimizer::Encoding::create(
        {{.name = "tool", .bits = 4, .lower = 0.0, .upper = static_cast<double>(tools - 1), .choices = tools},
         range("width_share", 6, problem.width_share),
         range("depth_share", 6, problem.depth_share),
         range("curvature_safety", 6, problem.curvature_safety)});
    if (!encoding) return base::fail(encoding.error());
    auto found =
        optimizer::search(*encoding, optimizer::inParallel([&](const Values& values) { return search.judge(values); }),
                          options, progress, on_generation);
    if (!found) return base::fail(found.error());

    TrueResult out;
    out.search = *std::move(found);
    out.genes = encoding->genes();
    std::vector<const optimizer::Ledger::Entry*> order;
    for (const auto& entry : out.search.evaluated) order.push_back(&entry);
    std::sort(order.begin(), order.end(), [](const auto* a, const auto* b) {
        return std::pair(a->evaluation.objectives[0], a->key) < std::pair(b->evaluation.objectives[0], b->key);
    });
    std::optional<ProvedPath> best;
    std::vector<std::size_t> seen;
    progress.begin(0, "levelling passes");
    for (const auto* entry : order) {
        const auto tool = static_cast<std::size_t>(std::lround(entry->values[0]));
        if (seen.size() >= problem.finalists || entry->evaluation.details[1] == 0.0) break;
        if (std::find(seen.begin(), seen.end(), tool) != seen.end()) continue;
        seen.push_back(tool);
        auto path = toFewest(search, entry->values, out.levelled, progress);
        if (!path) return base::fail(path.error());
        if (*path && (!best || (*path)->time.total_s < best->time.total_s)) best = **std::move(path);
    }
    progress.end();
    if (!best) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const FrontPoint& point : out.levelled) nearest = std::min(nearest, point.deviation_mm);
        return base::fail(
            "finishing.no-path",
            fmt::format("no path keeps ±{:g} mm; the nearest leaves or cuts {:.4f} mm. Smaller tools, passes along "
                        "the other direction, a longer run_out_mm or a wider tolerance would help",
                        problem.tolerance_mm, nearest));
    }
    auto proved = prove(part, problem, *std::move(best), true);
    if (!proved) return base::fail(proved.error());
    out.best = *std::move(proved);
    if (auto widened = widenFront(search, out, progress); !widened) return base::fail(widened.error());
    return out;
}

}  // namespace cusp::finishing
