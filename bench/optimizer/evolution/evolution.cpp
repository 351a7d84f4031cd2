// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The engines against each other at equal numbers of distinct candidates: eq. 13 (Fountas 2017, Kubota 1996) over 100 seeds, the
// same with its optimum shifted, and the paper's factorial study of the viral parameters as pictures in the folder given.
#include "factorial.hpp"
#include "pagmo_runs.hpp"
#include "problems.hpp"

#include <cusp/base/atomic_file.hpp>

#include <algorithm>
#include <cstdio>
#include <string>

namespace {

using namespace cusp::optimizer;
using bench::Outcomes;

constexpr std::size_t seeds = 100;

void print(const std::string& name, const Outcomes& outcomes) {
    const bench::Spread s = bench::spreadOf(outcomes.best);
    const auto on_the_bottom =
        std::count_if(outcomes.best.begin(), outcomes.best.end(), [](double z) { return z < 7e-13; });
    std::printf("  %-34s %9.2e %9.2e %9.2e %9.2e %9.2e %6.0f %6.0f %6d\n", name.c_str(), s.best, s.quartile, s.median,
                s.upper_quartile, s.worst, outcomes.mean_evaluations, outcomes.mean_viral,
                static_cast<int>(on_the_bottom));
    std::fflush(stdout);
}

/// Selection, crossover and mutation as the defaults have them, with the viruses of the paper.
SearchOptions paperVirusesOnOurOperators() {
    SearchOptions out = paperOptions();
    const SearchOptions ours;
    out.selection = ours.selection;
    out.tournament_size = 2;
    out.crossover = ours.crossover;
    out.mutation = ours.mutation;
    out.mutation_probability = 0.0;
    return out;
}

void compare(const bench::Problem& problem, Coding coding, const std::string& title, const SearchOptions& viral) {
    std::printf(
        "%s, %s code, %s operators: population 20, 50 generations of the viral algorithm; the others to the same number "
        "of candidates, seed by seed\n",
        problem.name.c_str(), coding == Coding::Gray ? "Gray" : "binary", title.c_str());
    std::printf("  %-34s %9s %9s %9s %9s %9s %6s %6s %6s\n", "", "best", "quartile", "median", "quartile", "worst",
                "cand.", "viral", "<7e-13");
    const Outcomes reference = bench::runSeeds(problem, coding, viral, seeds);
    print("virus-evolutionary", reference);
    SearchOptions other = viral;
    other.algorithm = Algorithm::Genetic;
    print("the same without viruses", bench::runSeeds(problem, coding, other, seeds, reference.evaluations));
    other.algorithm = Algorithm::SteadyState;
    print("steady state", bench::runSeeds(problem, coding, other, seeds, reference.evaluations));
    other.algorithm = Algorithm::RandomSearch;
    print("random search", bench::runSeeds(problem, coding, other, seeds, reference.evaluations));
    print("cusp's defaults (Gray)",
          bench::runSeeds(problem, Coding::Gray, SearchOptions{}, seeds, reference.evaluations));
    print("pagmo2 sga", bench::runPagmo(problem, bench::PagmoAlgorithm::Sga, 20, reference.evaluations));
    print("pagmo2 de", bench::runPagmo(problem, bench::PagmoAlgorithm::De, 20, reference.evaluations));
    print("pagmo2 cmaes", bench::runPagmo(problem, bench::PagmoAlgorithm::Cmaes, 20, reference.evaluations));
}

void picture(const std::string& path, std::size_t evaluations, const std::string& caption) {
    const auto fields = bench::factorialStudy(bench::eq13(), paperOptions(), seeds, evaluations);
    for (const bench::Field& field : fields) {
        std::printf("  %s: log10 of the median over %zu seeds\n", field.title.c_str(), seeds);
        for (std::size_t r = 0; r < field.rows.size(); ++r) {
            std::printf("    %8s", field.rows[r].c_str());
            for (const double value : field.log_median[r]) std::printf(" %7.2f", value);
            std::printf("\n");
        }
    }
    if (auto written = cusp::base::writeWholeFile(path, bench::toSvg(fields, caption)); !written)
        std::fputs(cusp::base::toText(written.error()).c_str(), stderr);
}

}  // namespace

int main(int argc, char** argv) {
    const std::string folder = argc > 1 ? argv[1] : ".";
    std::printf(
        "Kubota 1996 on eq. 13: 8.12e-05 (virus-evolutionary), 1.00e-04 (steady state). Best on the grid: 6.67e-13.\n\n");
    compare(bench::eq13(), Coding::Binary, "the paper's", paperOptions());
    compare(bench::eq13(), Coding::Binary, "stronger", paperVirusesOnOurOperators());
    compare(bench::shiftedEq13(), Coding::Binary, "stronger", paperVirusesOnOurOperators());
    compare(bench::shiftedEq13(), Coding::Gray, "stronger", paperVirusesOnOurOperators());
    std::printf("\nFactorial study (Table 1), 50 generations\n");
    picture(
        folder + "/factorial_generations.svg", 0,
        "log10 of the median of eq. 13 over 100 seeds after 50 generations; below it the distinct candidates that took.");
    std::printf("Factorial study, 350 candidates each\n");
    picture(
        folder + "/factorial_candidates.svg", 350,
        "log10 of the median of eq. 13 over 100 seeds after 350 distinct candidates (fewer where no new one was met).");
    return 0;
}
