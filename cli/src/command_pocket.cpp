// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp pocket`: contour roughing, cutting data and path chosen together.
#include "command.hpp"
#include "console.hpp"
#include "finishing_input.hpp"
#include "input.hpp"
#include "machine_lookup.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/json_report.hpp>
#include <cusp/base/version.hpp>
#include <cusp/optimizer/pocket/pocket_plan.hpp>
#include <cusp/toolpath/cl_writer.hpp>

#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>
#include <system_error>

namespace cusp::cli {

namespace {

struct Flags {
    std::string job_file;
    std::string folder;
    std::string strategy = "best";
    std::optional<std::int64_t> seed;
    bool json = false;
};

class StopOnSignal : public base::CountingProgress {
public:
    [[nodiscard]] bool stopRequested() const override { return interrupted(); }
};

base::Result<std::string> findTable(const std::string& name, const std::string& job_file) {
    if (name.ends_with(".toml")) return besideFile(job_file, name);
    // Tables lie beside the machines that ship.
    auto machine = findMachineFile("three-axis");
    if (!machine) return machine;
    return (std::filesystem::path(*machine).parent_path() / "cutting" / (name + ".toml")).string();
}

base::Json toJson(const pocket::CuttingData& data, const pocket::CuttingLoad& load) {
    return {{"ap_mm", data.ap_mm},
            {"ae_mm", data.ae_mm},
            {"spindle_rpm", data.spindle_rpm},
            {"fz_mm", data.fz_mm},
            {"feed_mm_per_min", load.feed_mm_per_min},
            {"mrr_mm3_per_min", load.mrr_mm3_per_min},
            {"power_kw", load.power_kw},
            {"bending_n_per_mm2", load.bending_n_per_mm2},
            {"deflection_mm", load.deflection_mm},
            {"engagement_deg", load.engagement_deg}};
}

base::Json toJson(const Flags& flags, const pocket::PocketPlan& plan, const std::string& cl_file) {
    base::Json out = base::jsonReport("pocket", 1);
    out["job"] = flags.job_file;
    out["cl_file"] = cl_file;
    out["engagement_limit_deg"] = plan.engagement_limit_deg;
    out["cutting_data"] = toJson(plan.data, plan.load);
    out["best_by_mrr"] = toJson(plan.best_by_mrr.data, plan.best_by_mrr.load);
    out["best_by_mrr"]["estimated_time_s"] = plan.best_by_mrr.time_s;
    out["cutting_data_tried"] = plan.tried.size();
    out["points"] = plan.points;
    out["levels"] = plan.levels;
    base::Json& strategies = out["strategies"] = base::Json::object();
    for (const auto& s : plan.strategies)
        strategies[s.path.name] = {{"within_limit", s.limited},
                                   {"time_s", s.time_s},
                                   {"turns", s.turns},
                                   {"engagement_max_deg", s.engagement.max_deg},
                                   {"engagement_mean_deg", s.engagement.mean_deg},
                                   {"engagement_share_above_limit", s.engagement.share_above_limit},
                                   {"steps_above_limit", s.steps_over_limit},
                                   {"cut_mm", s.engagement.cut_length_mm},
                                   {"air_cut_mm", s.engagement.air_cut_mm},
                                   {"rapid_mm", s.engagement.rapid_mm},
                                   {"uncleared_area_mm2", s.uncleared_area_mm2},
                                   {"gouge_mm", s.gouge_mm}};
    const auto& chosen = plan.strategies[plan.chosen];
    out["chosen"] = {{"name", chosen.path.name},
                     {"time_s", chosen.time_s},
                     {"engagement_max_deg", chosen.engagement.max_deg},
                     {"steps_above_limit", chosen.steps_over_limit},
                     {"uncleared_area_mm2", chosen.uncleared_area_mm2},
                     {"unreachable_area_mm2", plan.area.unreachable_area_mm2}};
    out["path_search"] = {{"evaluations", plan.path_search.evaluations}, {"value", plan.path_search.value}};
    return out;
}

std::string toText(const pocket::PocketPlan& plan, const std::string& cl_file) {
    std::string out = fmt::format(
        "{}: {} in {} levels, ap {:.2f} mm, ae {:.2f} mm, {:.0f} rpm, fz {:.4f} mm, F {:.0f} mm/min, {:.1f} cm3/min\n",
        cl_file, plan.strategies[plan.chosen].path.name, plan.levels, plan.data.ap_mm, plan.data.ae_mm,
        plan.data.spindle_rpm, plan.data.fz_mm, plan.load.feed_mm_per_min, plan.load.mrr_mm3_per_min / 1000.0);
    out += fmt::format("  {:32} {:>8} {:>6} {:>8} {:>8} {:>7} {:>8} {:>9}\n", "strategy", "time s", "turns", "max deg",
                       "mean deg", "above", "air mm", "left mm2");
    for (const auto& s : plan.strategies)
        out += fmt::format("{} {:32} {:8.1f} {:6} {:8.1f} {:8.1f} {:7} {:8.1f} {:9.2f}\n",
                           &s == &plan.strategies[plan.chosen] ? '>' : ' ', s.path.name, s.time_s, s.turns,
                           s.engagement.max_deg, s.engagement.mean_deg, s.steps_over_limit, s.engagement.air_cut_mm,
                           s.uncleared_area_mm2);
    out += fmt::format(
        "  engagement limit {:.1f} deg; steps above it run at half the feed; {:.2f} mm2 in corners the tool does "
        "not fit into\n",
        plan.engagement_limit_deg, plan.area.unreachable_area_mm2);
    return out;
}

/// The decoded chromosome of the chosen path, one column of the paper's last table a line.
std::string decodedTable(const pocket::PocketPlan& plan) {
    const auto& chosen = plan.strategies[plan.chosen];
    std::string out = "step,x_mm,y_mm,move,engagement_deg,above_limit\n";
    out += fmt::format("0,{:.4f},{:.4f},start,0,0\n", chosen.path.start.x_mm, chosen.path.start.y_mm);
    constexpr const char* names[] = {"cut", "link", "rapid", "helix"};
    for (std::size_t i = 0; i < chosen.path.steps.size(); ++i) {
        const auto& step = chosen.path.steps[i];
        out += fmt::format("{},{:.4f},{:.4f},{},{:.2f},{}\n", i + 1, step.to.x_mm, step.to.y_mm,
                           names[static_cast<std::size_t>(step.kind)], chosen.engagement.step_max_deg[i],
                           step.over_limit ? 1 : 0);
    }
    return out;
}

base::Result<pocket::PocketPlan> plan(const Flags& flags, const pocket::PocketJob& job) {
    auto contours = job.polygons(flags.job_file);
    if (!contours) return base::fail(contours.error());
    auto table_file = findTable(job.cutting.table, flags.job_file);
    if (!table_file) return base::fail(table_file.error());
    auto table = pocket::readCuttingTableFile(*table_file);
    if (!table) return base::fail(table.error());
    std::optional<LoadedMachine> machine;
    if (!job.machine.name.empty()) {
        auto loaded = loadMachine(job.machine.name.ends_with(".toml") ? besideFile(flags.job_file, job.machine.name)
                                                                      : job.machine.name);
        if (!loaded) return base::fail(loaded.error());
        machine = *std::move(loaded);
    }
    StopOnSignal progress;
    auto done = pocket::planPocket(job, *contours, *table, machine ? &machine->model : nullptr, progress);
    if (!done) return done;
    if (flags.strategy == "best") return done;
    std::string names;
    for (std::size_t i = 0; i < done->strategies.size(); ++i) {
        names += (names.empty() ? "" : ", ") + done->strategies[i].path.name;
        if (done->strategies[i].path.name == flags.strategy) {
            done->chosen = i;
            return done;
        }
    }
    return base::fail("pocket.strategy",
                      fmt::format("there is no strategy \"{}\"; there are best, {}", flags.strategy, names));
}

ExitCode runPocket(const Flags& flags) {
    auto job = pocket::readPocketJobFile(flags.job_file);
    if (!job) return failWith(job.error());
    if (flags.seed) job->search.seed = *flags.seed;
    const auto done = plan(flags, *job);
    if (!done) return failWith(done.error());
    std::error_code failed;
    std::filesystem::create_directories(flags.folder, failed);
    const std::string cl_file = (std::filesystem::path(flags.folder) / "pocket.apt").string();
    const auto& chosen = done->strategies[done->chosen];
    const auto moves = pocket::movesOf(chosen.path, *job, done->data);
    const auto text = toolpath::clText(pocket::clFile(
        moves, *job, done->data, fmt::format("PLANNED BY CUSP {} SEED {}", base::version(), job->search.seed)));
    if (!text) return failWith(text.error());
    const auto report = base::jsonText(toJson(flags, *done, cl_file));
    if (!report) return failWith(report.error());
    const auto write = [&](const char* name, const std::string& content) {
        return base::writeWholeFile((std::filesystem::path(flags.folder) / name).string(), content);
    };
    for (const auto& [name, content] :
         {std::pair{"pocket.apt", *text}, std::pair{"pocket.json", *report},
          std::pair{"steps.csv", decodedTable(*done)},
          std::pair{"cutting_data.csv", optimizer::convergenceCsv(done->data_search.history)}})
        if (const auto written = write(name, content); !written) return failWith(written.error());
    if (flags.json)
        say(*report);
    else
        say(toText(*done, cl_file));
    return chosen.steps_over_limit > 0 ? ExitCode::FoundSomething : ExitCode::Done;
}

}  // namespace

void addPocketCommand(CLI::App& app, Action& action) {
    CLI::App* pocket = app.add_subcommand(
        "pocket",
        "Roughs a contour with islands: chooses cutting data and tool path together, compares strategies at the same engagement "
        "limit, and writes a CL file. Exit code 1 where steps above the limit could not be avoided.");
    const auto flags = std::make_shared<Flags>();
    pocket->add_option("JOB", flags->job_file, "Job file (TOML).")->required();
    pocket->add_option("-o,--output", flags->folder, "Folder for pocket.apt, pocket.json and tables.")->required();
    pocket->add_option("--strategy", flags->strategy,
                       "best (default), zig_zag, one_way, contour_parallel, constant_engagement, genetic.");
    pocket->add_option("--seed", flags->seed, "Seed of every random choice; else the job's.")
        ->check(CLI::NonNegativeNumber);
    pocket->add_flag("--json", flags->json, "One machine-readable summary on stdout.");
    pocket->callback([flags, &action] { action = [flags] { return runPocket(*flags); }; });
}

}  // namespace cusp::cli
