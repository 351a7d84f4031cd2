// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// 400 calibrations on the artefact: how often each identified error lies within its own 95 % interval, and how often
// something significant is found where nothing is; judged by the exact binomial distribution at 99.9 %. Argument: seeds (400).
#include <cusp/geometry/parametric_surface.hpp>
#include <cusp/geometry/surface_file.hpp>
#include <cusp/loop/artefact.hpp>
#include <cusp/loop/calibration.hpp>
#include <cusp/loop/closed_loop.hpp>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <string>

namespace {

using namespace cusp;

constexpr std::uint64_t campaign_seed = 20260929;
constexpr double presetter_mm = 0.002;
constexpr double tram_deg = 0.0005;

/// P(X ≤ k) and P(X ≥ k) of the binomial distribution, summed exactly.
double probabilityUpTo(int k, int n, double p) {
    double sum = 0.0;
    for (int i = 0; i <= k; ++i)
        sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0) + i * std::log(p) +
                        (n - i) * std::log1p(-p));
    return sum;
}

/// Two-sided at 99.9 %.
bool plausible(int k, int n, double p) {
    return probabilityUpTo(k, n, p) > 0.0005 && 1.0 - (k > 0 ? probabilityUpTo(k - 1, n, p) : 0.0) > 0.0005;
}

struct Count {
    int looks = 0;
    int outside = 0;
    int found = 0;
};

}  // namespace

int main(int argc, char** argv) {
    const int seeds = argc > 1 ? std::atoi(argv[1]) : 400;
    const loop::CuttingSetup setup{.tool_length_mm = 120.0, .wcs_origin_mm = {3000.0, 0.0, -900.0}};
    const auto file = post::readMachineFile(std::string(CUSP_SOURCE_DIR) + "/machines/fooke-endura-ca.toml").value();
    const kinematics::Machine machine(file.machine);
    const auto artefact = loop::planArtefact({}).value();
    const geometry::ParametricSurface nominal(geometry::readSurface(artefact.surface_toml, "artefact.toml").value());
    const auto job = loop::cutJob(artefact.path).value();
    const auto track = loop::idealTrack(job, machine, setup).value();
    std::printf("seed %llu, %d seeds with errors and %d without, %zu points\n",
                static_cast<unsigned long long>(campaign_seed), seeds, seeds, artefact.plan.targets.size());
    std::map<std::string, Count> with;
    std::map<std::string, Count> without;
    for (int i = 0; i < 2 * seeds; ++i) {
        base::Random random = base::Random(campaign_seed).split(static_cast<std::uint64_t>(i));
        const bool hides = i < seeds;
        loop::MachineErrors hidden;
        if (hides) hidden = loop::drawErrors(machine, random);
        const auto truth = [&](const std::string& name) { return hidden.contains(name) ? hidden.at(name) : 0.0; };
        const auto real = loop::realMachine(file.machine, hidden, setup).value();
        loop::CmmOptions cmm;
        cmm.seed = random.next();
        const auto cut = loop::realPath(track, real, job.cutter(), job.part_from_wcs);
        const auto measured = loop::measurePart(cut, artefact.plan, nominal, cmm).value();
        loop::CalibrationOptions options;
        options.known = {{"tool_length_mm", truth("tool_length_mm") + random.normal(0.0, presetter_mm), presetter_mm},
                         {"zero_A_deg", truth("zero_A_deg") + random.normal(0.0, tram_deg), tram_deg}};
        const loop::CalibrationPart part{.name = "artefact",
                                         .job = &job,
                                         .track = &track,
                                         .nominal = &nominal,
                                         .points = &measured.points,
                                         .probe_radius_mm = cmm.probe_radius_mm};
        const auto result = loop::calibrate(file.machine, setup, {part}, options);
        if (!result) {
            std::printf("seed %d: %s\n", i, base::toText(result.error()).c_str());
            return 1;
        }
        for (const auto& one : result->parameters) {
            if (one.state != loop::ParameterState::Identified) continue;
            Count& count = (hides ? with : without)[one.parameter.name];
            ++count.looks;
            if (std::abs(one.value - truth(one.parameter.name)) > one.interval_95) ++count.outside;
            if (one.significant) ++count.found;
        }
    }
    bool sound = !with.empty();
    std::printf("%-22s %8s %18s %26s\n", "error", "looks", "outside its 95 %", "found where nothing is");
    for (const auto& [name, count] : with) {
        const Count& none = without[name];
        const bool covers = plausible(count.outside, count.looks, 0.05);
        const bool quiet = plausible(none.found, none.looks, 0.05);
        sound = sound && covers && quiet;
        std::printf("%-22s %8d %9d = %4.1f %% %s %9d = %4.1f %% %s\n", name.c_str(), count.looks, count.outside,
                    100.0 * count.outside / count.looks, covers ? "ok " : "BAD", none.found,
                    100.0 * none.found / std::max(1, none.looks), quiet ? "ok" : "BAD");
    }
    std::printf("%s; %.1f s CPU\n", sound ? "every interval holds" : "an interval does not hold",
                static_cast<double>(std::clock()) / CLOCKS_PER_SEC);
    return sound ? 0 : 1;
}
