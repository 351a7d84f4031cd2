// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The cases of Weinert & Stautner 2004: how hard they are, how fast the strategy is, and what random search makes of them.
#include "convergence_chart.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/optimizer/tilt/tilt_search.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

namespace {

using cusp::tilt::TiltCase;
using cusp::tilt::TiltOutcome;
using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }
double cpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

bool isBetter(const cusp::tilt::TiltFitness& a, const cusp::tilt::TiltFitness& b) {
    if (a.range_excess != b.range_excess) return a.range_excess < b.range_excess;
    if (a.collision_volume_mm3 != b.collision_volume_mm3) return a.collision_volume_mm3 < b.collision_volume_mm3;
    return a.harmony_s < b.harmony_s;
}

/// Besides the table: convergence-NAME.csv and .png in the folder the program runs in.
void plot(const std::string& name, const std::vector<TiltOutcome>& runs) {
    const auto spread = cusp::bench::spreadOf(runs);
    for (const auto& [ending, bytes] : {std::pair<const char*, std::string>{".csv", cusp::bench::csvOf(spread)},
                                        {".png", cusp::bench::pngOf(spread)}}) {
        const std::string file = "convergence-" + name + ending;
        if (cusp::base::writeWholeFile(file, bytes)) std::printf("  written: %s\n", file.c_str());
    }
    std::printf("  generation: best fitness, mean ± standard deviation over the runs (runs that are free)\n ");
    for (std::size_t g = 0; g < spread.size() && g <= 10; ++g)
        std::printf(" %zu: %.3f±%.3f (%zu)", g, spread[g].best_mean, spread[g].best_deviation, spread[g].free_runs);
    std::printf("\n");
}

void tellContact(const TiltCase& problem, const cusp::tilt::TiltPlan& plan) {
    const auto report = cusp::tilt::contactReport(problem.shape(), problem.path(), tilted(problem.path(), plan));
    std::printf(
        "  contact of the ball: %.1f m/min at least, %.1f in the mean; force proxy %.3f in the mean, %.3f at most\n",
        report.speed_min_m_per_min, report.speed_mean_m_per_min, report.force_proxy_mean, report.force_proxy_max);
}

void compare(const TiltCase& problem, int runs, std::uint64_t first_seed) {
    std::printf("  %d seeded runs against random search at equal evaluations, seeds %llu to %llu\n", runs,
                static_cast<unsigned long long>(first_seed),
                static_cast<unsigned long long>(first_seed) + static_cast<unsigned long long>(runs) - 1);
    std::printf("  %4s %6s %12s %10s %14s %10s %14s %14s\n", "seed", "evals", "free in gen", "points", "harmony s",
                "CPU s", "random free", "random harmony");
    std::vector<TiltOutcome> outcomes;
    std::vector<double> generations;
    std::vector<double> harmony;
    int beaten = 0;
    int unfree = 0;
    for (int run = 0; run < runs; ++run) {
        const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(run);
        const double start = cpuSeconds();
        const auto found = cusp::tilt::searchTilt(problem, {seed, {}, false});
        if (!found) {
            std::printf("%s\n", cusp::base::toText(found.error()).c_str());
            return;
        }
        const double seconds = cpuSeconds() - start;
        const TiltOutcome random = cusp::tilt::randomTilt(problem, seed + 500, found->evaluations);
        if (found->generations_to_collision_free)
            generations.push_back(static_cast<double>(*found->generations_to_collision_free));
        else
            ++unfree;
        if (found->fitness.isFree()) harmony.push_back(found->fitness.harmony_s);
        if (isBetter(found->fitness, random.fitness)) ++beaten;
        std::size_t random_free = 0;
        for (const auto& one : random.history) random_free += one.free;
        std::printf("  %4llu %6zu %12s %10zu %14.3f %10.1f %14zu %14.3f\n", static_cast<unsigned long long>(seed),
                    found->evaluations,
                    found->generations_to_collision_free ? std::to_string(*found->generations_to_collision_free).c_str()
                                                         : "never",
                    found->plan.points.size(), found->fitness.harmony_s, seconds, random_free,
                    random.fitness.harmony_s);
        std::fflush(stdout);
        outcomes.push_back(*found);
    }
    const auto print = [](const char* name, const std::vector<double>& values) {
        if (values.empty()) return;
        double mean = 0.0;
        for (const double value : values) mean += value / static_cast<double>(values.size());
        double spread = 0.0;
        for (const double value : values) spread += (value - mean) * (value - mean);
        const double deviation = std::sqrt(spread / std::max<double>(1.0, static_cast<double>(values.size()) - 1.0));
        std::printf("  %s: mean %.2f, standard deviation %.2f, largest %.2f\n", name, mean, deviation,
                    *std::max_element(values.begin(), values.end()));
    };
    print("generations to collision-free", generations);
    print("harmony of the winners, s", harmony);
    std::printf("  never free: %d of %d; random search beaten in %d of %d\n", unfree, runs, beaten, runs);
    plot(problem.job().name, outcomes);
    tellContact(problem, outcomes.front().plan);
}

int study(const std::string& file, int samples, int runs, int generations) {
    auto job = cusp::tilt::readTiltJobFile(file);
    if (!job) return std::printf("%s\n", cusp::base::toText(job.error()).c_str()), 1;
    if (generations > 0) job->search.generations = generations;
    const auto document = cusp::base::TomlDocument::readFile(CUSP_SOURCE_DIR "/machines/" + job->machine + ".toml");
    if (!document) return 1;
    cusp::base::Diagnostics report;
    auto section = cusp::machine::machineSection();
    const cusp::kinematics::Machine machine(section.sharesTable().read(document->root(), report));
    if (report.hasErrors()) return std::printf("%s\n", cusp::base::toText(report).c_str()), 1;
    auto start = Clock::now();
    const auto made = TiltCase::make(*job, machine, {}, report);
    if (!made) return std::printf("%s\n", cusp::base::toText(made.error()).c_str()), 1;
    const TiltCase& problem = **made;
    std::printf("%s: %zu CL locations, %.0f mm of path, ready in %.1f s\n", job->name.c_str(),
                problem.path().locations.size(), problem.path().lengthMm(), since(start));
    start = Clock::now();
    double cpu = cpuSeconds();
    const TiltOutcome random = cusp::tilt::randomTilt(problem, 1, static_cast<std::size_t>(samples));
    std::size_t free = 0;
    for (const auto& one : random.history) free += one.free;
    std::printf("  of %d random tilt points %zu are free of collision: %.3f %% (%.1f s, %.1f CPU s, seed 1)\n", samples,
                free, 100.0 * static_cast<double>(free) / samples, since(start), cpuSeconds() - cpu);
    std::fflush(stdout);
    if (runs > 0) compare(problem, runs, 1);
    return 0;
}

}  // namespace

/// bench_tilt_search [JOB [SAMPLES [RUNS [GENERATIONS]]]]; without a job: cavity and dome as the paper has them, and the mould
/// with fewer samples, ten runs and an early stop.
int main(int count, char** arguments) {
    const int samples = count > 2 ? std::atoi(arguments[2]) : 10000;
    const int runs = count > 3 ? std::atoi(arguments[3]) : 20;
    const int generations = count > 4 ? std::atoi(arguments[4]) : 0;
    if (count > 1) return study(arguments[1], samples, runs, generations);
    for (const char* name : {"cavity", "dome"})
        if (const int code = study(std::string(CUSP_SOURCE_DIR "/examples/tilt/") + name + ".toml", samples, runs, 0);
            code != 0)
            return code;
    return study(CUSP_SOURCE_DIR "/examples/tilt/mould.toml", 1000, 10, 12);
}
