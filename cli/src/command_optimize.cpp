// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp optimize`: tool and parameters of a finishing path, searched for.
#include "command.hpp"
#include "console.hpp"
#include "finishing_input.hpp"
#include "input.hpp"
#include "optimize_output.hpp"
#include "progress_bar.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/units.hpp>
#include <cusp/optimizer/finishing/paper_problem.hpp>
#include <cusp/optimizer/finishing/path_criteria.hpp>

#include <array>
#include <fmt/format.h>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace cusp::cli {

namespace {

struct Flags {
    std::string job_file;
    std::string folder;
    std::int64_t seed = -1;
    bool json = false;
};

/// A bar on stderr, and Ctrl-C.
class Watch : public base::Progress {
public:
    void begin(std::uint64_t total, std::string_view label) override {
        const std::lock_guard lock(mutex_);
        bar_ = std::make_unique<ProgressBar>(std::string(label));
        total_ = total;
        done_ = 0;
    }
    void advance(std::uint64_t steps) override {
        const std::lock_guard lock(mutex_);
        done_ += steps;
        if (bar_) bar_->show(done_, total_);
    }
    void end() override {
        const std::lock_guard lock(mutex_);
        bar_.reset();
    }
    [[nodiscard]] bool stopRequested() const override { return interrupted(); }

private:
    std::mutex mutex_;
    std::unique_ptr<ProgressBar> bar_;
    std::uint64_t total_ = 0;
    std::uint64_t done_ = 0;
};

base::Result<std::vector<toolpath::Tool>> toolsOf(const finishing::ToolChoice& choice, const std::string& job_file) {
    const std::string library = besideFile(job_file, choice.library);
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

/// What a path leaves, as a map for people and as figures on the proof grid.
base::Result<void> judge(Optimized& done, const finishing::Workpiece& part) {
    constexpr double map_grid_mm = 1.0;
    constexpr double band_mm = 0.5;
    const auto path = finishing::cutterPath(done.path);
    auto map = simulation::surfaceEnvelope(path, part.faces, {.spacing_mm = map_grid_mm, .band_mm = band_mm});
    if (!map) return base::fail(map.error());
    done.envelope = *std::move(map);
    const auto proof = simulation::surfaceEnvelope(path, part.faces,
                                                   {.spacing_mm = done.job.search.proof_grid_mm, .band_mm = band_mm});
    if (!proof) return base::fail(proof.error());
    done.left = simulation::summaryOf(*proof, done.job.part.tolerance_mm);
    return {};
}

base::Result<void> optimizePaper(Optimized& done, const finishing::Workpiece& part,
                                 const std::vector<toolpath::Tool>& tools, LoadedSetting* setting, Watch& watch) {
    finishing::PaperProblem problem;
    problem.tools = tools;
    const auto& ranges = done.job.ranges;
    problem.step_over_share = ranges.step_over_share;
    problem.lead_rad = ranges.lead_rad;
    problem.tilt_rad = ranges.tilt_rad;
    problem.chord_tolerance_mm = ranges.chord_tolerance_mm;
    problem.error_weight = done.job.search.error_weight;
    problem.edge_radius_mm = done.job.tools.edge_radius_mm;
    problem.options = done.job.options();
    const auto encoding = finishing::paperEncoding(problem);
    if (!encoding) return base::fail(encoding.error());
    const auto objective = finishing::paperObjective(part, problem);
    if (!objective) return base::fail(objective.error());
    watch.begin(static_cast<std::uint64_t>(done.job.search.evaluations), "searching");
    auto found = optimizer::search(*encoding, finishing::paperEvaluator(part, problem, *objective),
                                   done.job.searchOptions(), watch);
    watch.end();
    if (!found) return base::fail(found.error());
    done.search = *std::move(found);
    const auto best = finishing::candidateOf(problem, done.search.bestValues());
    done.tool = tools[best.tool];
    auto contacts = finishing::planContacts(part, done.tool.cutter(), finishing::optionsOf(problem, best));
    if (!contacts) return base::fail(contacts.error());
    done.path = finishing::joinPasses(*std::move(contacts), part);
    if (setting != nullptr) {
        auto on_machine = setting->setting;
        if (!done.job.machine.tool_length_mm) on_machine.tool_length_mm = done.tool.gauge_length_mm;
        auto time = finishing::machineTime(finishing::timedMoves(done.path), on_machine);
        if (!time) return base::fail(time.error());
        done.time = *time;
    }
    return judge(done, part);
}

base::Result<void> optimizeTrue(Optimized& done, const finishing::Workpiece& part,
                                const std::vector<toolpath::Tool>& tools, const LoadedSetting& setting, Watch& watch) {
    finishing::TrueProblem problem;
    problem.tools = tools;
    problem.setting = setting.setting;
    problem.tool_length_fixed = done.job.machine.tool_length_mm.has_value();
    problem.options = done.job.options();
    problem.tolerance_mm = done.job.part.tolerance_mm;
    problem.depth_share = done.job.ranges.depth_share;
    problem.width_share = done.job.ranges.passes_share;
    problem.curvature_safety = done.job.ranges.curvature_safety;
    problem.search_grid_mm = done.job.search.search_grid_mm;
    problem.level_grid_mm = done.job.search.level_grid_mm;
    problem.proof_grid_mm = done.job.search.proof_grid_mm;
    watch.begin(static_cast<std::uint64_t>(done.job.search.evaluations), "searching");
    auto found = finishing::searchTrue(part, problem, done.job.searchOptions(), watch);
    watch.end();
    if (!found) return base::fail(found.error());
    done.search = std::move(found->search);
    done.levelled = std::move(found->levelled);
    done.tool = tools[found->best.tool];
    done.path = std::move(found->best.levelled.path);
    done.time = found->best.time;
    if (!done.job.compare.leads_rad.empty()) {
        auto constant = finishing::bestConstantLead(
            part, problem, {.leads_rad = done.job.compare.leads_rad, .tilts_rad = done.job.compare.tilts_rad}, watch);
        if (!constant) return base::fail(constant.error());
        done.constant = *std::move(constant);
        done.compared = true;
    }
    return judge(done, part);
}

base::Result<Optimized> optimize(const Flags& flags) {
    auto job = finishing::readOptimizeJobFile(flags.job_file);
    if (!job) return base::fail(job.error());
    Optimized done;
    done.job = *std::move(job);
    if (flags.seed >= 0) done.job.search.seed = flags.seed;
    const auto tools = toolsOf(done.job.tools, flags.job_file);
    if (!tools) return base::fail(tools.error());
    for (const auto& tool : *tools) done.tool_names.push_back(tool.name);
    auto setting = loadSetting(done.job.machine, flags.job_file);
    if (!setting) return base::fail(setting.error());
    const auto part = loadPart(besideFile(flags.job_file, done.job.part.nominal), done.job.part.faces);
    if (!part) return base::fail(part.error());
    Watch watch;
    const auto outcome = done.job.mode == finishing::OptimizeMode::Paper
                             ? optimizePaper(done, part->workpiece(), *tools, *setting ? &**setting : nullptr, watch)
                             : optimizeTrue(done, part->workpiece(), *tools, **setting, watch);
    if (!outcome) return base::fail(outcome.error());
    return done;
}

base::Json constantJson(const Optimized& done) {
    if (!done.compared) return {};
    if (!done.constant) return {{"found", false}};
    const auto& path = *done.constant;
    const auto& options = path.levelled.path.contacts.options;
    return {{"found", true},
            {"tool", done.tool_names[path.tool]},
            {"lead_deg", base::degFromRad(options.orientation.lead_rad)},
            {"tilt_deg", base::degFromRad(options.orientation.tilt_rad)},
            {"depth_offset_mm", options.orientation.depth_offset_mm},
            {"passes", path.levelled.path.contacts.passes},
            {"machining_time_s", path.time.total_s},
            {"overcut_max_mm", path.proof.overcut_max_mm},
            {"undercut_max_mm", path.proof.undercut_max_mm},
            {"within_tolerance_percent", path.proof.within_tolerance_percent},
            {"keeps_tolerance", path.proved}};
}

base::Json toJson(const Flags& flags, const Optimized& done) {
    const std::array cutters{done.tool.cutter()};
    const auto criteria = finishing::judgeContacts(finishing::contactsOf(done.path.contacts), cutters);
    const bool paper = done.job.mode == finishing::OptimizeMode::Paper;
    base::Json out = base::jsonReport("optimize", 1);
    out["job"] = flags.job_file;
    out["folder"] = flags.folder;
    out["mode"] = paper ? "paper" : "true";
    out["best"] = parametersOf(done);
    out["objective"] = done.search.bestObjective();
    out["cc_points"] = criteria.cc_points;
    out["mean_chord_error_mm"] = criteria.chord_error_mm.mean;
    out["overcut_max_mm"] = done.left.overcut_max_mm;
    out["undercut_max_mm"] = done.left.undercut_max_mm;
    out["within_tolerance_percent"] = done.left.within_tolerance_percent;
    out["reached_percent"] = done.left.reached_percent;
    out["tolerance_mm"] = done.job.part.tolerance_mm;
    out["grid_mm"] = done.job.search.proof_grid_mm;
    out["machining_time_s"] = done.time ? base::Json(done.time->total_s) : base::Json();
    out["evaluations"] = done.search.evaluations;
    out["viral_evaluations"] = done.search.viral_evaluations;
    out["levelled_paths"] = done.levelled.size();
    out["seed"] = done.job.search.seed;
    out["constant_lead"] = constantJson(done);
    return out;
}

std::string toText(const Flags& flags, const Optimized& done) {
    std::string out =
        fmt::format("{}: {} with {} passes, {} contact points, after {} evaluations\n", flags.folder, done.tool.name,
                    done.path.contacts.passes, done.path.contacts.points.size(), done.search.evaluations);
    out += fmt::format("  within ±{:<8} mm {:8.2f} % of the surface, {:.2f} % of it reached, grid {} mm\n",
                       done.job.part.tolerance_mm, done.left.within_tolerance_percent, done.left.reached_percent,
                       done.job.search.proof_grid_mm);
    out += fmt::format("  overcut            {:8.4f} mm\n  material left      {:8.4f} mm\n", done.left.overcut_max_mm,
                       done.left.undercut_max_mm);
    if (done.time) out += fmt::format("  machining time     {:8.2f} s\n", done.time->total_s);
    if (done.constant)
        out += fmt::format("  constant lead      {:8.2f} s at best: {} at {:.2f}°, {} passes, {}\n",
                           done.constant->time.total_s, done.tool_names[done.constant->tool],
                           base::degFromRad(done.constant->levelled.path.contacts.options.orientation.lead_rad),
                           done.constant->levelled.path.contacts.passes,
                           done.constant->proved ? "within tolerance" : "and not within tolerance on the proof grid");
    else if (done.compared)
        out += "  constant lead      none of the grid keeps the tolerance\n";
    return out;
}

ExitCode runOptimize(const Flags& flags) {
    const auto done = optimize(flags);
    if (!done) return interrupted() ? ExitCode::Interrupted : failWith(done.error());
    if (const auto written = writeFolder(flags.folder, flags.job_file, *done); !written)
        return failWith(written.error());
    const base::Json summary = toJson(flags, *done);
    const auto text = base::jsonText(summary);
    if (!text) return failWith(text.error());
    if (const auto written = base::writeWholeFile(flags.folder + "/summary.json", *text); !written)
        return failWith(written.error());
    if (flags.json)
        sayJson(summary);
    else
        say(toText(flags, *done));
    return interrupted() ? ExitCode::Interrupted : ExitCode::Done;
}

}  // namespace

void addOptimizeCommand(CLI::App& app, Action& action) {
    CLI::App* optimize = app.add_subcommand(
        "optimize",
        "Searches tool and parameters of a finishing path: by the formulas of Fountas 2017 (paper mode), or the "
        "least machining time within a tolerance, by the exact envelope of the tool (true mode).");
    const auto flags = std::make_shared<Flags>();
    optimize->add_option("JOB", flags->job_file, "Job file (TOML); `cusp schema optimize-job` lists its keys.")
        ->required();
    optimize
        ->add_option("-o,--output", flags->folder,
                     "Folder for the path, the job that plans it again, convergence, front and map.")
        ->required();
    optimize->add_option("--seed", flags->seed, "Wins over the job's seed.")->check(CLI::NonNegativeNumber);
    optimize->add_flag("--json", flags->json, "One machine-readable summary on stdout.");
    optimize->callback([flags, &action] { action = [flags] { return runOptimize(*flags); }; });
}

}  // namespace cusp::cli
