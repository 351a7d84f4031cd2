// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The engines on the benchmark problem of Fountas 2017 (nine tools, 46 bits) at 1 000 distinct candidates: how many seeds end within
// 0.1 % of the true optimum, and whether viruses help. `bench_finishing_search [SEEDS]`; 100 unless told.
#include "rank_sum.hpp"
#include "true_optimum.hpp"

#include <cusp/geometry/surface_file.hpp>
#include <cusp/optimizer/evolution/search.hpp>
#include <cusp/optimizer/finishing/optimize_job.hpp>
#include <cusp/optimizer/finishing/paper_problem.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace {

using namespace cusp;
using optimizer::Algorithm;

const std::string benchmark = CUSP_SOURCE_DIR "/examples/benchmark/";

std::vector<toolpath::Tool> toolsOf(const finishing::OptimizeJob& job) {
    return toolpath::readToolLibraryFile(benchmark + job.tools.tool_library).value().tools;
}

struct Row {
    std::string name;
    std::vector<double> best;
    double viral = 0.0;
};

Row run(const std::string& name, const optimizer::Encoding& encoding, const optimizer::EvaluateBatch& evaluate,
        optimizer::SearchOptions options, std::size_t seeds, bench::Optimum& lowest) {
    options.max_evaluations = 1000;
    options.max_generations = 0;
    Row out{name, {}, 0.0};
    for (std::size_t seed = 1; seed <= seeds; ++seed) {
        options.seed = seed;
        const auto found = optimizer::search(encoding, evaluate, options).value();
        out.best.push_back(found.bestObjective());
        out.viral += static_cast<double>(found.viral_evaluations) / static_cast<double>(seeds);
        if (found.bestObjective() < lowest.objective)
            lowest = {found.evaluated[found.best].key, found.bestObjective(), lowest.evaluations};
    }
    return out;
}

void print(const Row& row, double optimum) {
    auto sorted = row.best;
    std::sort(sorted.begin(), sorted.end());
    const auto count = static_cast<double>(sorted.size());
    double mean = 0.0;
    for (const double value : sorted) mean += value / count;
    double square = 0.0;
    for (const double value : sorted) square += (value - mean) * (value - mean);
    const auto within = [&](double share) {
        return std::count_if(sorted.begin(), sorted.end(),
                             [&](double v) { return v - optimum <= share * std::abs(optimum); });
    };
    std::printf("  %-38s %9.6f %9.6f %9.6f %9.6f %9.2e %5zu %6.0f %5ld %5ld %5ld\n", row.name.c_str(), sorted.front(),
                sorted[sorted.size() / 2], sorted.back(), mean, std::sqrt(square / std::max(1.0, count - 1.0)),
                sorted.size(), row.viral, static_cast<long>(within(0.001)), static_cast<long>(within(0.01)),
                static_cast<long>(within(0.05)));
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    const std::size_t seeds = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 100;
    const auto job = finishing::readOptimizeJobFile(benchmark + "paper.toml").value();
    const auto faces = geometry::readSurfaceFile(benchmark + job.part.nominal).value();
    const finishing::Workpiece part{faces, nullptr};
    const auto problem = job.paperProblem(toolsOf(job));
    const auto objective = finishing::paperObjective(part, problem).value();
    const auto evaluate = finishing::paperEvaluator(part, problem, objective);
    const auto binary = finishing::paperEncoding(problem, optimizer::Coding::Binary).value();
    const auto gray = optimizer::Encoding::create(binary.genes(), optimizer::Coding::Gray).value();

    const auto begin = std::chrono::steady_clock::now();
    bench::Optimum lowest = bench::trueOptimum(binary, evaluate, {0, 13, 6, 3, 4}, 1);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    std::printf("Grid of 9 tools x 13 x 6 x 3 x 4, the best of each tool refined: %.9f after %zu evaluations, %.1f s\n",
                lowest.objective, lowest.evaluations, seconds);
    std::fflush(stdout);

    optimizer::SearchOptions ours;
    optimizer::SearchOptions plain = ours;
    plain.algorithm = Algorithm::Genetic;
    optimizer::SearchOptions paper_plain = optimizer::paperOptions();
    paper_plain.algorithm = Algorithm::Genetic;
    optimizer::SearchOptions chance;
    chance.algorithm = Algorithm::RandomSearch;
    std::vector<Row> rows;
    const std::size_t few = std::max<std::size_t>(seeds / 4, 10);
    rows.push_back(run("cusp with viruses, Gray code", gray, evaluate, ours, seeds, lowest));
    rows.push_back(run("cusp without viruses, Gray code", gray, evaluate, plain, seeds, lowest));
    rows.push_back(
        run("paper's operators with viruses, binary", binary, evaluate, optimizer::paperOptions(), few, lowest));
    rows.push_back(run("paper's operators without, binary", binary, evaluate, paper_plain, few, lowest));
    rows.push_back(run("random search", binary, evaluate, chance, few, lowest));
    // Where a search met what the grid had missed, that is refined too: the yardstick is the lowest there is.
    const auto optimum = bench::refined(binary, evaluate, lowest, {1, 64, 16, 16, 16});
    const auto at = finishing::candidateOf(problem, binary.values(optimum.codes));
    std::printf("True optimum %.9f: %s, step-over %.5f mm, lead %.5f rad, tilt %.5f rad, chord tolerance %.6f mm\n",
                optimum.objective, problem.tools[at.tool].name.c_str(), at.step_over_mm, at.lead_rad, at.tilt_rad,
                at.chord_tolerance_mm);
    std::printf("  %-38s %9s %9s %9s %9s %9s %5s %6s %5s %5s %5s\n", "1000 candidates", "best", "median", "worst",
                "mean", "spread", "seeds", "viral", "0.1%", "1%", "5%");
    for (const Row& row : rows) print(row, optimum.objective);
    for (const auto& [a, b] : {std::pair<std::size_t, std::size_t>{0, 1}, {2, 3}}) {
        const auto test = bench::rankSum(rows[a].best, rows[b].best);
        std::printf("Wilcoxon, %s against %s: z %.2f, p %.2e\n", rows[a].name.c_str(), rows[b].name.c_str(), test.z,
                    test.probability);
    }
    return 0;
}
