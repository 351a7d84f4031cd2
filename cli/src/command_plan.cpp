// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp plan`: a finishing path with given parameters.
#include "command.hpp"
#include "console.hpp"
#include "finishing_input.hpp"
#include "input.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/json_report.hpp>
#include <cusp/base/units.hpp>
#include <cusp/base/version.hpp>
#include <cusp/optimizer/finishing/feasibility.hpp>
#include <cusp/optimizer/finishing/feed_adaption.hpp>
#include <cusp/optimizer/finishing/finishing_path.hpp>
#include <cusp/optimizer/finishing/path_criteria.hpp>
#include <cusp/toolpath/cl_writer.hpp>

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace cusp::cli {

namespace {

struct Flags {
    std::string job_file;
    std::string output;
    bool json = false;
    bool print_config = false;
};

struct Planned {
    finishing::PlanJob job;
    toolpath::Tool tool;
    finishing::FinishingPath path;
    finishing::PathCriteria criteria;
    std::optional<finishing::FeedChange> feeds;
    std::optional<finishing::MachineTime> time;
};

base::Result<Planned> planJob(const Flags& flags) {
    auto job = finishing::readPlanJobFile(flags.job_file);
    if (!job) return base::fail(job.error());
    Planned out;
    out.job = *std::move(job);
    auto tool = loadTool(besideFile(flags.job_file, out.job.tool.tool_library), out.job.tool.name);
    if (!tool) return base::fail(tool.error());
    out.tool = *std::move(tool);
    auto setting = loadSetting(out.job.machine, flags.job_file);
    if (!setting) return base::fail(setting.error());
    const auto part = loadPart(besideFile(flags.job_file, out.job.part.nominal), out.job.part.faces);
    if (!part) return base::fail(part.error());
    const auto workpiece = part->workpiece();
    const geometry::Cutter cutter = out.tool.cutter();
    auto feasible = finishing::checkFeasible(workpiece, cutter, out.job.orientation);
    if (feasible.hasErrors()) return base::fail(std::move(feasible));
    tell(feasible);
    auto contacts = finishing::planContacts(workpiece, cutter, out.job.options());
    if (!contacts) return base::fail(contacts.error());
    out.path = finishing::joinPasses(*std::move(contacts), workpiece);
    const std::array cutters{cutter};
    out.criteria =
        finishing::judgeContacts(finishing::contactsOf(out.path.contacts), cutters, out.job.tool.edge_radius_mm);
    if (*setting) {
        if (!out.job.machine.tool_length_mm) (*setting)->setting.tool_length_mm = out.tool.gauge_length_mm;
        if (out.job.feed.adapt) {
            auto change = finishing::adaptFeeds(out.path, (*setting)->setting,
                                                {.acceleration_mm_per_s2 = out.job.feed.acceleration_mm_per_s2});
            if (!change) return base::fail(change.error());
            out.feeds = *change;
        }
        auto time = finishing::machineTime(finishing::timedMoves(out.path), (*setting)->setting);
        if (!time) return base::fail(time.error());
        out.time = *time;
    }
    return out;
}

base::Json spreadJson(const finishing::Spread& spread) {
    if (spread.count == 0) return {};
    return {{"least", spread.least}, {"mean", spread.mean}, {"most", spread.most}};
}

base::Json toJson(const Flags& flags, const Planned& done) {
    const auto& criteria = done.criteria;
    base::Json out = base::jsonReport("plan", 1);
    out["job"] = flags.job_file;
    out["cl_file"] = flags.output;
    out["tool"] = done.tool.name;
    out["cc_points"] = criteria.cc_points;
    out["passes"] = criteria.passes;
    out["mean_chord_error_mm"] = criteria.chord_error_mm.mean;
    out["chord_error_max_mm"] = criteria.chord_error_mm.most;
    out["step_over_mm"] = spreadJson(criteria.step_over_mm);
    out["scallop_mm"] = spreadJson(criteria.scallop_mm);
    out["effective_radius_mm"] = spreadJson(criteria.effective_radius_mm);
    out["lead_min_deg"] = base::degFromRad(criteria.lead_rad.least);
    out["lead_max_deg"] = base::degFromRad(criteria.lead_rad.most);
    out["undercut_edge_mm"] = criteria.undercut_edge_mm;
    out["cutter_locations"] = done.path.moves.size();
    out["cutting_length_mm"] = criteria.cutting_length_mm;
    out["long_links"] = done.path.long_links;
    out["machining_time_s"] = done.time ? base::Json(done.time->total_s) : base::Json();
    out["rotary_travel_deg"] = done.time ? base::Json{base::degFromRad(done.time->rotary_travel_rad[0]),
                                                      base::degFromRad(done.time->rotary_travel_rad[1])}
                                         : base::Json();
    if (done.feeds)
        out["feeds_lowered"] = {{"moves", done.feeds->lowered},
                                {"by_block_time", done.feeds->by_block_time},
                                {"by_axes", done.feeds->by_axes},
                                {"by_curvature", done.feeds->by_curvature},
                                {"lowest_mm_per_min", base::mmPerMinFromMmPerS(done.feeds->lowest_mm_per_s)}};
    return out;
}

std::string toText(const Flags& flags, const Planned& done) {
    const auto& criteria = done.criteria;
    std::string out =
        fmt::format("{}: {} contact points in {} passes with {}, {} cutter locations\n", fileNameOf(flags.output),
                    criteria.cc_points, criteria.passes, done.tool.name, done.path.moves.size());
    out += fmt::format("  chord error        {:8.4f} mm mean, {:.4f} mm at most\n", criteria.chord_error_mm.mean,
                       criteria.chord_error_mm.most);
    out += fmt::format("  step-over          {:8.4f} mm mean, {:.4f} mm at most\n", criteria.step_over_mm.mean,
                       criteria.step_over_mm.most);
    if (criteria.scallop_mm.count > 0)
        out +=
            fmt::format("  scallop (eq. 4)    {:8.4f} to {:.4f} mm; below 0 the cutter is flatter than the surface\n",
                        criteria.scallop_mm.least, criteria.scallop_mm.most);
    out += fmt::format("  lead               {:8.3f} to {:.3f}°\n", base::degFromRad(criteria.lead_rad.least),
                       base::degFromRad(criteria.lead_rad.most));
    out += fmt::format("  cutting length     {:8.1f} mm\n", criteria.cutting_length_mm);
    if (done.feeds)
        out += fmt::format(
            "  feed lowered       {:8} moves, to {:.0f} mm/min at least: {} by block time, {} by axes, {} by curvature\n",
            done.feeds->lowered, base::mmPerMinFromMmPerS(done.feeds->lowest_mm_per_s), done.feeds->by_block_time,
            done.feeds->by_axes, done.feeds->by_curvature);
    if (done.time) out += fmt::format("  machining time     {:8.2f} s\n", done.time->total_s);
    return out;
}

ExitCode runPlan(const Flags& flags) {
    if (flags.print_config) {
        const auto job = finishing::readPlanJobFile(flags.job_file);
        if (!job) return failWith(job.error());
        say(finishing::planJobSection().toToml(*job));
        return ExitCode::Done;
    }
    const auto done = planJob(flags);
    if (!done) return failWith(done.error());
    const auto text =
        toolpath::clText(finishing::clFile(done->path, {.part_name = done->job.name,
                                                        .remark = fmt::format("PLANNED BY CUSP {}", base::version()),
                                                        .tool = done->tool,
                                                        .spindle_rpm = done->job.tool.spindle_rpm,
                                                        .coolant = done->job.tool.coolant}));
    if (!text) return failWith(text.error());
    if (flags.output == "-") {
        say(*text);
        return ExitCode::Done;
    }
    if (const auto written = base::writeWholeFile(flags.output, *text); !written) return failWith(written.error());
    if (flags.json)
        sayJson(toJson(flags, *done));
    else
        say(toText(flags, *done));
    return ExitCode::Done;
}

}  // namespace

void addPlanCommand(CLI::App& app, Action& action) {
    CLI::App* plan = app.add_subcommand(
        "plan",
        "Plans a five-axis finishing path over a surface: passes, points and tool axis as the job says. Writes a CL file.");
    const auto flags = std::make_shared<Flags>();
    plan->add_option("JOB", flags->job_file, "Job file (TOML); `cusp schema plan-job` lists its keys.")->required();
    auto* output = plan->add_option("-o,--output", flags->output, "CL file to write (APT); - for standard output.");
    auto* print =
        plan->add_flag("--print-config", flags->print_config, "Prints the job with every default, and plans nothing.");
    output->excludes(print);
    plan->add_flag("--json", flags->json, "One machine-readable summary on stdout.");
    plan->callback([flags, &action] {
        if (flags->output.empty() && !flags->print_config) throw CLI::RequiredError("--output");
        if (flags->output == "-" && flags->json)
            throw CLI::ValidationError("--json", "the CL file goes to standard output already");
        action = [flags] { return runPlan(*flags); };
    });
}

}  // namespace cusp::cli
