// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp tilt`: a three-axis path becomes a five-axis one whose shank and holder touch nothing.
#include "command.hpp"
#include "console.hpp"
#include "machine_lookup.hpp"
#include "progress_bar.hpp"
#include "tilt_output.hpp"

#include <cusp/base/progress.hpp>
#include <cusp/geometry/cad/nominal_file.hpp>
#include <cusp/optimizer/tilt/tilt_search.hpp>
#include <cusp/post/writer/post_options.hpp>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace cusp::cli {

namespace {

struct Flags {
    std::string job_file;
    std::string folder;
    std::optional<std::int64_t> seed;
    std::optional<std::int64_t> generations;
    std::int64_t runs = 1;
    bool resume = false;
    bool json = false;
    bool print_config = false;
};

/// Ends the search after Ctrl-C.
class SearchProgress : public base::Progress {
public:
    void begin(std::uint64_t total, std::string_view /*label*/) override { total_ = total; }
    void advance(std::uint64_t steps) override { done_ += steps; }
    void end() override {}
    [[nodiscard]] bool stopRequested() const override { return interrupted(); }

private:
    std::atomic<std::uint64_t> done_{0};
    std::uint64_t total_ = 0;
};

base::Result<tilt::TiltJob> jobOf(const Flags& flags) {
    auto job = tilt::readTiltJobFile(flags.job_file);
    if (!job) return job;
    if (flags.seed) job->search.seed = *flags.seed;
    if (flags.generations) job->search.generations = *flags.generations;
    return job;
}

bool isBetter(const tilt::TiltFitness& a, const tilt::TiltFitness& b) {
    if (a.range_excess != b.range_excess) return a.range_excess < b.range_excess;
    if (a.collision_volume_mm3 != b.collision_volume_mm3) return a.collision_volume_mm3 < b.collision_volume_mm3;
    return a.harmony_s < b.harmony_s;
}

base::Result<void> findPlan(const Flags& flags, const tilt::TiltCase& problem, TiltResult& result) {
    if (!problem.job().tilt_points_mm.empty()) {
        for (const auto& point : problem.job().tilt_points_mm) result.plan.points.push_back(geometry::toVector(point));
        result.plan.area = problem.job().area;
        result.fitness = problem.judge(result.plan);
        return {};
    }
    SearchProgress progress;
    ProgressBar bar("searching tilt points, runs");
    for (std::int64_t run = 0; run < flags.runs; ++run) {
        bar.show(static_cast<std::uint64_t>(run), static_cast<std::uint64_t>(flags.runs));
        tilt::TiltRun options;
        options.seed = static_cast<std::uint64_t>(problem.job().search.seed + run);
        options.checkpoint_file =
            (std::filesystem::path(flags.folder) / ("checkpoint-" + std::to_string(options.seed))).string();
        options.resume = flags.resume;
        auto outcome = tilt::searchTilt(problem, options, progress);
        if (!outcome) return base::fail(outcome.error());
        result.runs.emplace_back(options.seed, *std::move(outcome));
        if (isBetter(result.runs.back().second.fitness, result.runs[result.best_run].second.fitness))
            result.best_run = result.runs.size() - 1;
        if (interrupted()) break;
    }
    result.plan = result.runs[result.best_run].second.plan;
    result.fitness = result.runs[result.best_run].second.fitness;
    return {};
}

/// What is worth knowing of the path found, by routes the search did not take.
base::Result<void> prove(const tilt::TiltCase& problem, const LoadedMachine& machine, TiltResult& result) {
    const tilt::StartPath& path = problem.path();
    const auto poses = tilt::tilted(path, result.plan);
    std::vector<toolpath::CutterLocation> upright;
    for (const auto& at : path.locations) upright.push_back(at.location);
    const double stick_out = problem.job().tool.stickOutMm();
    const double resolution = problem.job().search.proof_mm;
    auto proof = problem.collisions(poses, resolution, stick_out);
    if (!proof) return base::fail(proof.error());
    result.proof = *std::move(proof);
    auto start = problem.collisions(upright, problem.job().search.coarse_mm, stick_out);
    if (!start) return base::fail(start.error());
    result.start_collisions = *std::move(start);
    if (result.proof.volume_mm3 <= 0.0) {
        const auto text = tiltedText(problem, result.plan);
        if (!text) return base::fail(text.error());
        auto posted = provePosted(*text, post::programNameFromFile(problem.job().name), machine, problem);
        if (!posted) return base::fail(posted.error());
        result.posted = *std::move(posted);
    }
    result.motion = tilt::axisMotion(problem.place(), path, poses);
    result.fitness.range_excess = result.motion.range_excess;
    if (result.motion.range_excess <= 0.0)
        result.machining_time_s = tilt::machiningTime(problem.place(), path, poses, result.motion);
    constexpr double stick_out_step_mm = 0.5;
    if (result.isFree()) result.stick_out_mm = problem.shortestStickOut(poses, stick_out_step_mm);
    result.contact = tilt::contactReport(problem.shape(), path, poses);
    result.start_contact = tilt::contactReport(problem.shape(), path, upright);
    result.center_error_mm = tilt::largestCenterError(path, poses);
    return {};
}

ExitCode runTilt(const Flags& flags) {
    const auto started = std::chrono::steady_clock::now();
    const auto job = jobOf(flags);
    if (!job) return failWith(job.error());
    if (flags.print_config) {
        say(tilt::tiltJobSection().toToml(*job));
        return ExitCode::Done;
    }
    const auto machine = loadMachine(job->machine);
    if (!machine) return failWith(machine.error());
    std::error_code error;
    std::filesystem::create_directories(flags.folder, error);
    base::Diagnostics report;
    const std::string folder = std::filesystem::path(flags.job_file).parent_path().string();
    const auto problem = tilt::TiltCase::make(
        *job, machine->model, folder, report,
        [](const std::string& path, base::Diagnostics& told) { return geometry::loadNominal(path, told); });
    if (!problem) return failWith(problem.error());
    tell(report);
    TiltResult result;
    result.job_file = flags.job_file;
    result.folder = flags.folder;
    result.machine = machine->file.machine.name;
    if (const auto found = findPlan(flags, **problem, result); !found) return failWith(found.error());
    if (interrupted()) return ExitCode::Interrupted;
    if (const auto proved = prove(**problem, *machine, result); !proved) return failWith(proved.error());
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    if (const auto written = writeFiles(result, **problem); !written) return failWith(written.error());
    if (flags.json)
        sayJson(toJson(result, **problem));
    else
        say(toText(result, **problem) + (machine->unanchored() ? unanchored_text : ""));
    return result.isProven() ? ExitCode::Done : ExitCode::FoundSomething;
}

}  // namespace

void addTiltCommand(CLI::App& app, Action& action) {
    CLI::App* tilt =
        app.add_subcommand("tilt", "Tilts the ball end mill of a three-axis path so that shank and holder touch "
                                   "nothing: finds the point its axis goes through, on your machine.");
    const auto flags = std::make_shared<Flags>();
    tilt->add_option("JOB", flags->job_file, "Job file (TOML); `cusp schema tilt-job` lists its keys.")->required();
    auto* output = tilt->add_option(
        "-o,--output", flags->folder,
        "Folder for tilted.apt, tilted.mpf (posted and proven), start.apt, report.html, report.json, convergence.csv.");
    tilt->add_option("--seed", flags->seed, "Seed of the search, instead of the job's.")->check(CLI::NonNegativeNumber);
    tilt->add_option("--generations", flags->generations, "Generations at most, instead of the job's.")
        ->check(CLI::PositiveNumber);
    tilt->add_option("--runs", flags->runs, "Searches with one seed after the other; the best is taken.")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    tilt->add_flag("--resume", flags->resume, "Goes on from the checkpoints in the folder.");
    auto* print =
        tilt->add_flag("--print-config", flags->print_config, "Prints the job with every default, and does nothing.");
    output->excludes(print);
    tilt->add_flag("--json", flags->json, "One machine-readable summary on stdout.");
    tilt->callback([flags, &action] {
        if (flags->folder.empty() && !flags->print_config) throw CLI::RequiredError("--output");
        action = [flags] { return runTilt(*flags); };
    });
}

}  // namespace cusp::cli
