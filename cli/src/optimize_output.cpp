// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Files of an optimisation.
#include "optimize_output.hpp"

#include "finishing_input.hpp"
#include "input.hpp"
#include "optimize_page.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/number_text.hpp>
#include <cusp/base/units.hpp>
#include <cusp/base/version.hpp>
#include <cusp/optimizer/finishing/path_criteria.hpp>
#include <cusp/toolpath/cl_writer.hpp>

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>

namespace cusp::cli {

namespace {

finishing::PlanJob planJobOf(const std::string& job_file, const Optimized& done) {
    const auto absolute = [&](const std::string& named) {
        return std::filesystem::absolute(besideFile(job_file, named)).lexically_normal().string();
    };
    finishing::PlanJob out;
    out.name = done.job.name;
    out.part = done.job.part;
    out.part.nominal = absolute(done.job.part.nominal);
    out.tool = {absolute(done.job.tools.tool_library), done.tool.name, done.job.tools.spindle_rpm,
                done.job.tools.coolant, done.job.tools.edge_radius_mm};
    out.machine = done.job.machine;
    const finishing::PlanOptions& options = done.path.contacts.options;
    out.passes = options.passes;
    out.orientation = options.orientation;
    out.steps = options.steps;
    out.links = options.links;
    out.feed = done.job.feed;
    return out;
}

std::string mapText(const Optimized& done) {
    std::string out = "x_mm,y_mm,z_mm,nx,ny,nz,deviation_mm\n";
    for (std::size_t i = 0; i < done.envelope.points.size(); ++i) {
        const auto& at = done.envelope.grid.points[i];
        for (const double value :
             {at.position.x(), at.position.y(), at.position.z(), at.normal.x(), at.normal.y(), at.normal.z()})
            out += base::formatShortest(value) + ",";
        const auto& point = done.envelope.points[i];
        out += (point.reached() ? base::formatShortest(point.deviation_mm) : "") + "\n";
    }
    return out;
}

std::string frontText(const Optimized& done) {
    std::string out = "tool,passes,machining_time_s,deviation_mm,on_front\n";
    for (const auto& point : done.levelled) {
        out += fmt::format("{},{},{},{},{}\n", done.tool_names[point.tool], point.passes,
                           base::formatShortest(point.machining_time_s), base::formatShortest(point.deviation_mm),
                           isOnFront(done, point) ? 1 : 0);
    }
    return out;
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

}  // namespace

bool isOnFront(const Optimized& done, const finishing::FrontPoint& point) {
    return std::none_of(done.levelled.begin(), done.levelled.end(), [&](const auto& other) {
        return other.machining_time_s <= point.machining_time_s && other.deviation_mm <= point.deviation_mm &&
               (other.machining_time_s < point.machining_time_s || other.deviation_mm < point.deviation_mm);
    });
}

base::Json parametersOf(const Optimized& done) {
    base::Json out;
    out["tool"] = done.tool.name;
    if (!done.outside_cl.empty()) {
        out["step_over_mm"] = done.candidate->step_over_mm;
        out["lead_deg"] = base::degFromRad(done.candidate->lead_rad);
        out["tilt_deg"] = base::degFromRad(done.candidate->tilt_rad);
        out["chord_tolerance_mm"] = done.candidate->chord_tolerance_mm;
        return out;
    }
    const finishing::PlanOptions& options = done.path.contacts.options;
    out["passes"] = done.path.contacts.passes;
    out["chord_tolerance_mm"] = options.steps.chord_tolerance_mm;
    out["tilt_deg"] = base::degFromRad(options.orientation.tilt_rad);
    if (options.orientation.adaptive) {
        out["curvature_safety"] = options.orientation.curvature_safety;
        out["pass_safety"] = options.orientation.pass_safety;
        out["depth_offset_mm"] = options.orientation.depth_offset_mm;
        out["places"] = options.passes.places;
    } else {
        out["lead_deg"] = base::degFromRad(options.orientation.lead_rad);
        out["step_over_mm"] = options.passes.step_over_mm;
    }
    return out;
}

base::Json toJson(const std::string& folder, const std::string& job_file, const Optimized& done) {
    const std::vector<geometry::Cutter> cutters =
        done.outside_cl.empty() ? std::vector{done.tool.cutter()} : done.cut.cutters;
    const auto criteria = finishing::judgeContacts(done.contacts, cutters);
    const bool paper = done.job.mode == finishing::OptimizeMode::Paper;
    base::Json out = base::jsonReport("optimize", 1);
    out["job"] = job_file;
    out["folder"] = folder;
    out["name"] = done.job.name;
    out["mode"] = paper ? "paper" : "true";
    out["planner"] = done.outside_cl.empty() ? "cusp" : "outside";
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

std::string toText(const std::string& folder, const Optimized& done) {
    std::string out =
        fmt::format("{}: {}, {} contact points in {} passes, after {} evaluations\n", folder, done.tool.name,
                    done.contacts.size(), done.contacts.back().pass + 1, done.search.evaluations);
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

base::Result<void> writeFolder(const std::string& folder, const std::string& job_file, const Optimized& done) {
    std::vector<std::pair<std::string, std::string>> files;
    if (done.outside_cl.empty()) {
        const auto cl = toolpath::clText(finishing::clFile(
            done.path, {.part_name = done.job.name,
                        .remark = fmt::format("OPTIMIZED BY CUSP {} SEED {}", base::version(), done.job.search.seed),
                        .tool = done.tool,
                        .spindle_rpm = done.job.tools.spindle_rpm,
                        .coolant = done.job.tools.coolant}));
        if (!cl) return base::fail(cl.error());
        const std::string plan = finishing::planJobSection().toToml(planJobOf(job_file, done));
        files.emplace_back("best.apt", *cl);
        files.emplace_back("best.toml", "# Plans best.apt again: cusp plan best.toml -o P.apt\n" + plan);
    } else {
        files.emplace_back("best.apt", done.outside_cl);
    }
    const base::Json summary = toJson(folder, job_file, done);
    const auto text = base::jsonText(summary);
    if (!text) return base::fail(text.error());
    const auto page = optimizePage(summary, done);
    if (!page) return base::fail(page.error());
    files.emplace_back("convergence.csv", optimizer::convergenceCsv(done.search.history));
    files.emplace_back("front.csv", frontText(done));
    files.emplace_back("map.csv", mapText(done));
    files.emplace_back("summary.json", *text);
    files.emplace_back("report.html", *page);
    for (const auto& [name, content] : files)
        if (auto written = base::writeWholeFile(folder + "/" + name, content); !written)
            return base::fail(written.error());
    return {};
}

}  // namespace cusp::cli
