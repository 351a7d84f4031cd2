// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// 100 machines with hidden errors: the first part out by more than ±0.030 mm in the fixed datums; how many second parts are
// within ±0.010 mm after one correction, and how many when nothing is done. Arguments: how many machines (100), and
// the number of the first (0).
#include "loop_scene.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

namespace {

using namespace cusp;

constexpr std::uint64_t campaign_seed = 20260917;
constexpr double out_mm = 0.030;
constexpr double in_mm = 0.010;

double medianOf(std::vector<double> values) {
    std::ranges::sort(values);
    return values.empty() ? 0.0 : values[values.size() / 2];
}

}  // namespace

int main(int argc, char** argv) {
    const int machines = argc > 1 ? std::atoi(argv[1]) : 100;
    const int begin = argc > 2 ? std::atoi(argv[2]) : 0;
    const test_support::LoopScene scene(CUSP_SOURCE_DIR);
    base::Diagnostics warnings;
    const auto program = loop::postPath(scene.path, scene.file, scene.machine, "FIRST", warnings).value();
    const auto run = loop::runProgram(program, scene.file, scene.machine, scene.setup, "").value();
    const auto job = loop::cutJob(scene.path).value();
    loop::LoopTask task = scene.task();
    std::printf("seed %llu; %zu blocks, %.1f s of machine time\n", static_cast<unsigned long long>(campaign_seed),
                program.blocks, run.run_s);
    std::vector<double> before;
    std::vector<double> after;
    std::vector<double> before_fit;
    int within = 0;
    int still_out = 0;
    for (int i = begin; i < begin + machines; ++i) {
        base::Random random = base::Random(campaign_seed).split(static_cast<std::uint64_t>(i));
        const auto drawn = loop::drawErrors(scene.machine, random);
        task.inspection.cmm.seed = random.next();
        const auto first = loop::firstPartOut(task, run.track, job, drawn, out_mm);
        if (!first) {
            std::printf("machine %d: %s\n", i, base::toText(first.error()).c_str());
            return 1;
        }
        const auto second = loop::secondPart(task, first->hidden, first->part, random.next());
        loop::InspectionTask again = task.inspection;
        again.cmm.seed = random.next();
        const auto real = loop::realMachine(scene.file.machine, first->hidden, scene.setup).value();
        const double nothing = loop::cutAndMeasure(run.track, job, real, again).value().maxAbsInDatum();
        before.push_back(first->part.maxAbsInDatum());
        before_fit.push_back(first->part.maxAbsBestFit());
        if (nothing > in_mm) ++still_out;
        if (!second) {
            std::printf("machine %d: not corrected: %s\n", i, base::toText(second.error()).c_str());
            continue;
        }
        after.push_back(second->part.maxAbsInDatum());
        if (after.back() <= in_mm)
            ++within;
        else
            std::printf("machine %d: %.4f mm before, %.4f after\n", i, before.back(), after.back());
    }
    std::printf("%d machines: first part %.4f mm (median, fixed datums; %.4f best-fitted)\n", machines,
                medianOf(before), medianOf(before_fit));
    std::printf("corrected once: %d within %.3f mm, median %.4f mm, worst %.4f mm\n", within, in_mm, medianOf(after),
                after.empty() ? 0.0 : *std::ranges::max_element(after));
    std::printf("nothing done:   %d of %d out of %.3f mm\n", still_out, machines, in_mm);
    std::printf("%.1f s CPU\n", static_cast<double>(std::clock()) / CLOCKS_PER_SEC);
    return within * 100 >= machines * 95 && still_out == machines ? 0 : 1;
}
