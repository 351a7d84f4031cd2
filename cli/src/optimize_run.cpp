// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Search and judgement, in paper mode, in true mode, and through an outside CAM.
#include "optimize_run.hpp"

#include "console.hpp"
#include "finishing_input.hpp"
#include "input.hpp"
#include "shown_progress.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/hash.hpp>
#include <cusp/optimizer/finishing/outside_cam.hpp>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace cusp::cli {

namespace {

constexpr double map_grid_mm = 1.0;
constexpr double band_mm = 0.5;

base::Result<std::vector<toolpath::Tool>> toolsOf(const finishing::ToolChoice& choice, const std::string& job_file) {
    const std::string library = besideFile(job_file, choice.tool_library);
    if (choice.names.empty()) {
        auto tools = toolpath::readToolLibraryFile(library);
        if (!tools) return base::fail(tools.error());
        return std::move(tools->tools);
    }
    std::vector<toolpath::Tool> out;
    for (const std::string& name : choice.names) {
        auto tool = loadTool(library, name);
        if (!tool) return base::fail(tool.error());
        out.push_back(*std::move(tool));
    }
    return out;
}

/// All that the run needs, and where its result goes.
struct Run {
    const OptimizeFlags& flags;
    const finishing::Workpiece& part;
    const geometry::NominalShape& shape;
    const std::vector<toolpath::Tool>& tools;
    const LoadedSetting* setting;
    ShownProgress& watch;
    Optimized& done;

    [[nodiscard]] optimizer::SearchOptions searchOptions() const {
        auto out = done.job.searchOptions();
        out.checkpoint_file = flags.folder + "/checkpoint.json";
        out.resume = flags.resume;
        out.problem_id = problemId();
        return out;
    }

private:
    /// A digest of the job but its number of evaluations, and of the files it names: a run may be gone on with for longer.
    [[nodiscard]] std::string problemId() const {
        constexpr std::size_t most_bytes = std::size_t{1} << 28U;
        finishing::OptimizeJob job = done.job;
        job.search.evaluations = finishing::SearchJob{}.evaluations;
        base::Sha256 digest;
        digest.update(finishing::optimizeJobSection().toToml(job));
        digest.update(flags.evaluator);
        for (const std::string& named : {job.part.nominal, job.tools.tool_library})
            digest.update(base::readWholeFile(besideFile(flags.job_file, named), most_bytes).value_or(""));
        return digest.hex();
    }
};

base::Result<simulation::SurfaceEnvelope> mapOf(const simulation::CutterPath& path, const finishing::Workpiece& part) {
    return simulation::surfaceEnvelope(path, part.faces, {.spacing_mm = map_grid_mm, .band_mm = band_mm});
}

/// What the best path leaves, as a map for people and as figures on the proof grid.
base::Result<void> judge(Optimized& done, const finishing::Workpiece& part) {
    auto map = mapOf(done.cut, part);
    if (!map) return base::fail(map.error());
    done.envelope = *std::move(map);
    const auto proof = simulation::surfaceEnvelope(done.cut, part.faces,
                                                   {.spacing_mm = done.job.search.proof_grid_mm, .band_mm = band_mm});
    if (!proof) return base::fail(proof.error());
    done.left = simulation::summaryOf(*proof, done.job.part.tolerance_mm);
    return {};
}

/// The path that the page shows beside the best.
base::Result<void> judgeBefore(Optimized& done, const finishing::Workpiece& part, Before before,
                               const finishing::FinishingPath& path) {
    auto map = mapOf(finishing::cutterPath(path), part);
    if (!map) return base::fail(map.error());
    before.left = simulation::summaryOf(*map, done.job.part.tolerance_mm);
    before.envelope = *std::move(map);
    before.passes = path.contacts.passes;
    before.points = path.contacts.points.size();
    done.before = std::move(before);
    return {};
}

base::Result<finishing::FinishingPath> planned(const Run& run, const finishing::PaperProblem& problem,
                                               const finishing::PaperCandidate& candidate) {
    auto contacts =
        finishing::planContacts(run.part, run.tools[candidate.tool].cutter(), finishing::optionsOf(problem, candidate));
    if (!contacts) return base::fail(contacts.error());
    return finishing::joinPasses(*std::move(contacts), run.part);
}

base::Result<std::optional<finishing::MachineTime>> timeOn(const Run& run, const finishing::FinishingPath& path,
                                                           const toolpath::Tool& tool) {
    std::optional<finishing::MachineTime> out;
    if (run.setting == nullptr) return out;
    auto on_machine = run.setting->setting;
    if (!run.done.job.machine.tool_length_mm) on_machine.tool_length_mm = tool.gauge_length_mm;
    const auto time = finishing::machineTime(finishing::timedMoves(path), on_machine);
    if (!time) return base::fail(time.error());
    out = *time;
    return out;
}

/// The path of the best candidate, by the planner of the house; before it, the best that chance had found.
base::Result<void> takePlanned(const Run& run, const finishing::PaperProblem& problem) {
    Optimized& done = run.done;
    auto path = planned(run, problem, *done.candidate);
    if (!path) return base::fail(path.error());
    done.path = *std::move(path);
    done.cut = finishing::cutterPath(done.path);
    done.contacts = finishing::contactsOf(done.path.contacts);
    auto time = timeOn(run, done.path, done.tool);
    if (!time) return base::fail(time.error());
    done.time = *time;
    const auto& judged = done.search.evaluated;
    const auto first_generation = std::min(judged.size(), static_cast<std::size_t>(done.job.search.population));
    const auto first = std::min_element(
        judged.begin(), judged.begin() + static_cast<std::ptrdiff_t>(first_generation),
        [](const auto& a, const auto& b) { return a.evaluation.objectives[0] < b.evaluation.objectives[0]; });
    const auto candidate = finishing::candidateOf(problem, first->values);
    const auto before = planned(run, problem, candidate);
    if (!before) return base::fail(before.error());
    const auto before_time = timeOn(run, *before, run.tools[candidate.tool]);
    if (!before_time) return base::fail(before_time.error());
    return judgeBefore(done, run.part,
                       {.name = "best of the first generation",
                        .tool = run.tools[candidate.tool].name,
                        .machining_time_s = *before_time ? std::optional((*before_time)->total_s) : std::nullopt},
                       *before);
}

base::Result<void> optimizePaper(const Run& run) {
    Optimized& done = run.done;
    const auto problem = done.job.paperProblem(run.tools);
    const auto encoding = finishing::paperEncoding(problem);
    if (!encoding) return base::fail(encoding.error());
    const auto objective = finishing::paperObjective(run.part, problem);
    if (!objective) return base::fail(objective.error());
    const finishing::OutsideCam outside{run.flags.evaluator, run.flags.evaluator_seconds};
    const bool by_outside = !outside.command.empty();
    run.watch.begin(static_cast<std::uint64_t>(done.job.search.evaluations), "searching");
    auto found = optimizer::search(*encoding,
                                   by_outside ? finishing::outsideEvaluator(outside, run.shape, problem, *objective)
                                              : finishing::paperEvaluator(run.part, problem, *objective),
                                   run.searchOptions(), run.watch);
    run.watch.end();
    if (!found) return base::fail(found.error());
    done.search = *std::move(found);
    done.genes = encoding->genes();
    done.candidate = finishing::candidateOf(problem, done.search.bestValues());
    done.tool = run.tools[done.candidate->tool];
    if (by_outside) {
        auto path = finishing::outsidePath(outside, run.shape, problem, *done.candidate);
        if (!path) return base::fail(path.error());
        done.outside_cl = std::move(path->cl_text);
        done.cut = std::move(path->path);
        done.contacts = std::move(path->contacts);
    } else if (auto taken = takePlanned(run, problem); !taken) {
        return taken;
    }
    return judge(done, run.part);
}

/// The job's check holds that true mode names a machine.
base::Result<void> optimizeTrue(const Run& run, const LoadedSetting& setting) {
    Optimized& done = run.done;
    const auto problem = done.job.trueProblem(run.tools, setting.setting);
    run.watch.begin(static_cast<std::uint64_t>(done.job.search.evaluations), "searching");
    auto found = finishing::searchTrue(run.part, problem, run.searchOptions(), run.watch);
    run.watch.end();
    if (!found) return base::fail(found.error());
    done.search = std::move(found->search);
    done.genes = std::move(found->genes);
    done.levelled = std::move(found->levelled);
    done.tool = run.tools[found->best.tool];
    done.path = std::move(found->best.levelled.path);
    done.cut = finishing::cutterPath(done.path);
    done.contacts = finishing::contactsOf(done.path.contacts);
    done.time = found->best.time;
    if (!done.job.compare.leads_rad.empty()) {
        auto constant = finishing::bestConstantLead(
            run.part, problem, {.leads_rad = done.job.compare.leads_rad, .tilts_rad = done.job.compare.tilts_rad},
            run.watch);
        if (!constant) return base::fail(constant.error());
        done.constant = *std::move(constant);
        done.compared = true;
    }
    if (done.constant) {
        auto judged = judgeBefore(done, run.part,
                                  {.name = "best constant lead",
                                   .tool = done.tool_names[done.constant->tool],
                                   .machining_time_s = done.constant->time.total_s},
                                  done.constant->levelled.path);
        if (!judged) return judged;
    }
    return judge(done, run.part);
}

}  // namespace

base::Result<Optimized> runOptimization(const OptimizeFlags& flags) {
    auto job = finishing::readOptimizeJobFile(flags.job_file);
    if (!job) return base::fail(job.error());
    Optimized done;
    done.job = *std::move(job);
    if (flags.seed >= 0) done.job.search.seed = flags.seed;
    if (flags.evaluations >= 0) done.job.search.evaluations = flags.evaluations;
    const bool paper = done.job.mode == finishing::OptimizeMode::Paper;
    if (!paper && !flags.evaluator.empty())
        return base::fail(
            "optimize.evaluator",
            "an outside CAM is driven in paper mode; true mode moves passes and leads one by one, which only "
            "the planner of the house can",
            {.file = flags.job_file, .line = 0, .column = 0, .key = "mode"});
    const auto tools = toolsOf(done.job.tools, flags.job_file);
    if (!tools) return base::fail(tools.error());
    for (const auto& tool : *tools) done.tool_names.push_back(tool.name);
    auto setting = loadSetting(done.job.machine, flags.job_file);
    if (!setting) return base::fail(setting.error());
    const auto part = loadPart(besideFile(flags.job_file, done.job.part.nominal), done.job.part.faces);
    if (!part) return base::fail(part.error());
    std::error_code failure;
    std::filesystem::create_directories(flags.folder, failure);
    if (failure)
        return base::fail("io.create", "cannot make the folder: " + failure.message(),
                          {.file = flags.folder, .line = 0, .column = 0, .key = {}});
    ShownProgress watch;
    const finishing::Workpiece workpiece = part->workpiece();
    const Run run{flags, workpiece, *part->shape, *tools, *setting ? &**setting : nullptr, watch, done};
    const auto outcome = paper ? optimizePaper(run) : optimizeTrue(run, **setting);
    if (!outcome) {
        std::filesystem::remove(flags.folder, failure);  // empty folders only
        return base::fail(outcome.error());
    }
    return done;
}

}  // namespace cusp::cli
