// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The summary of a tilted path and the files it is left in.
#include "tilt_output.hpp"

#include "input.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/units.hpp>
#include <cusp/base/version.hpp>
#include <cusp/pages/render.hpp>
#include <cusp/toolpath/cl_writer.hpp>

#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace cusp::cli {

namespace {

base::Json finite(double value) { return std::isfinite(value) ? base::Json(value) : base::Json(); }

base::Json vectorJson(const geometry::Vector3& v) { return {v.x(), v.y(), v.z()}; }

base::Json fitnessJson(const tilt::TiltFitness& fitness) {
    return {{"range_excess", finite(fitness.range_excess)},
            {"collision_volume_mm3", finite(fitness.collision_volume_mm3)},
            {"harmony_s", finite(fitness.harmony_s)}};
}

base::Json contactJson(const tilt::ContactReport& contact) {
    return {
        {"speed_min_m_per_min", contact.speed_min_m_per_min}, {"speed_mean_m_per_min", contact.speed_mean_m_per_min},
        {"speed_max_m_per_min", contact.speed_max_m_per_min}, {"force_proxy_mean", contact.force_proxy_mean},
        {"force_proxy_max", contact.force_proxy_max},         {"places", contact.contacts}};
}

base::Json proofJson(const simulation::CollisionVolume& volume) {
    base::Json out{{"collision_volume_mm3", volume.volume_mm3},
                   {"depth_mm", volume.depth_mm},
                   {"collisions", volume.collisions.size()}};
    const simulation::Collision* deepest = nullptr;
    for (const auto& one : volume.collisions)
        if (deepest == nullptr || one.depth_mm > deepest->depth_mm) deepest = &one;
    out["deepest_at_mm"] = deepest ? vectorJson(deepest->position_mm) : base::Json();
    return out;
}

base::Json postedJson(const PostedProof& posted) {
    base::Json out{{"pass", posted.pass()}};
    out["not_posted"] = posted.not_posted.empty() ? base::Json() : base::Json(posted.not_posted);
    out["excursions"] = posted.excursions;
    out["verify_pass"] = posted.verification ? base::Json(posted.verification->pass) : base::Json();
    if (const auto& verified = posted.verification) {
        out["points"] = verified->points;
        out["matched"] = verified->matched;
        out["max_tip_error_mm"] = verified->max_tip_error_mm.value;
        out["max_axis_error_deg"] = base::degFromRad(verified->max_axis_error_rad.value);
        out["limit_violations"] = verified->limit_violations;
        out["diagnostics"] = base::diagnosticsToJson(verified->findings);
    }
    out["simulated"] = posted.collisions ? proofJson(*posted.collisions) : base::Json();
    return out;
}

std::string postedText(const PostedProof& posted) {
    if (!posted.not_posted.empty()) return "  no program         " + posted.not_posted + "\n";
    if (!posted.verification || !posted.collisions) return "  no program         the path is not free\n";
    const auto& verified = *posted.verification;
    return fmt::format("  posted program     {}: {} of {} points met, tip within {:.4f} mm, axis within {:.4f}°\n",
                       verified.pass ? "verified" : "NOT verified", verified.matched, verified.points,
                       verified.max_tip_error_mm.value, base::degFromRad(verified.max_axis_error_rad.value)) +
           fmt::format("  collision, program {:10.3f} mm³, {:.3f} mm deep (of the moves read back from it)\n",
                       posted.collisions->volume_mm3, posted.collisions->depth_mm) +
           (posted.excursions > 0
                ? fmt::format("  unwinding          the tool leaves the part {} times\n", posted.excursions)
                : std::string());
}

base::Json generations(const tilt::TiltOutcome& outcome) {
    return outcome.generations_to_collision_free ? base::Json(*outcome.generations_to_collision_free) : base::Json();
}

base::Json runsJson(const TiltResult& result) {
    base::Json out = base::Json::array();
    for (const auto& [seed, outcome] : result.runs) {
        base::Json points = base::Json::array();
        for (const auto& point : outcome.plan.points) points.push_back(vectorJson(point));
        out.push_back({{"seed", seed},
                       {"tilt_points_mm", points},
                       {"generations_to_collision_free", generations(outcome)},
                       {"evaluations", outcome.evaluations},
                       {"fitness", fitnessJson(outcome.fitness)}});
    }
    return out;
}

base::Result<void> writeText(const std::string& folder, const char* name, const std::string& text) {
    return base::writeWholeFile((std::filesystem::path(folder) / name).string(), text);
}

base::Result<std::string> clTextOf(std::vector<toolpath::ClRecord> records) {
    toolpath::ToolPath path;
    path.dialect = toolpath::Dialect::Apt;
    path.records = std::move(records);
    return toolpath::clText(path);
}

/// The summary, and behind it what the page draws.
base::Json pageJson(const TiltResult& result, const tilt::TiltCase& problem) {
    base::Json out = toJson(result, problem);
    base::Json curves = base::Json::array();
    for (const auto& [seed, outcome] : result.runs) {
        base::Json run{{"seed", seed},
                       {"best", base::Json::array()},
                       {"mean", base::Json::array()},
                       {"worst", base::Json::array()}};
        for (const auto& one : outcome.history) {
            run["best"].push_back(one.best);
            run["mean"].push_back(one.mean);
            run["worst"].push_back(one.worst);
        }
        curves.push_back(std::move(run));
    }
    out["curves"] = std::move(curves);
    return out;
}

}  // namespace

base::Json toJson(const TiltResult& result, const tilt::TiltCase& problem) {
    base::Json out = base::jsonReport("tilt", 1);
    out["job"] = result.job_file;
    out["name"] = problem.job().name;
    out["machine"] = result.machine;
    out["cl_file"] = (std::filesystem::path(result.folder) / "tilted.apt").string();
    out["cutter_locations"] = problem.path().locations.size();
    out["path_length_mm"] = problem.path().lengthMm();
    out["collision_free"] = result.isFree();
    out["tilt_points_mm"] = base::Json::array();
    for (const auto& point : result.plan.points) out["tilt_points_mm"].push_back(vectorJson(point));
    out["generations_to_collision_free"] =
        result.runs.empty() ? base::Json() : generations(result.runs[result.best_run].second);
    out["fitness"] = fitnessJson(result.fitness);
    out["rotary_travel_deg"] = {base::degFromRad(result.motion.rotary_travel_rad[0]),
                                base::degFromRad(result.motion.rotary_travel_rad[1])};
    out["rewinds"] = result.motion.rewinds;
    out["machining_time_s"] = result.machining_time_s ? base::Json(*result.machining_time_s) : base::Json();
    out["shortest_stick_out_mm"] = result.stick_out_mm ? base::Json(*result.stick_out_mm) : base::Json();
    out["stick_out_mm"] = problem.job().tool.stickOutMm();
    out["center_error_max_mm"] = result.center_error_mm;
    out["proof_resolution_mm"] = problem.job().search.proof_mm;
    out["start"] = {{"proof", proofJson(result.start_collisions)}, {"contact", contactJson(result.start_contact)}};
    out["tilted"] = {{"proof", proofJson(result.proof)}, {"contact", contactJson(result.contact)}};
    out["proven"] = result.isProven();
    out["program"] = result.posted.program.empty()
                         ? base::Json()
                         : base::Json((std::filesystem::path(result.folder) / "tilted.mpf").string());
    out["posted"] = postedJson(result.posted);
    out["seed"] = result.runs.empty() ? base::Json() : base::Json(result.runs[result.best_run].first);
    out["runs"] = runsJson(result);
    out["seconds"] = result.seconds;
    return out;
}

std::string toText(const TiltResult& result, const tilt::TiltCase& problem) {
    std::string out = fmt::format("{}: {} cutter locations on {}\n", problem.job().name,
                                  problem.path().locations.size(), result.machine);
    for (const auto& point : result.plan.points)
        out += fmt::format("  tilt point         X{:.3f} Y{:.3f} Z{:.3f}\n", point.x(), point.y(), point.z());
    if (!result.runs.empty()) {
        const auto& best = result.runs[result.best_run].second;
        out += best.generations_to_collision_free
                   ? fmt::format("  collision-free     from generation {} on, seed {}\n",
                                 *best.generations_to_collision_free, result.runs[result.best_run].first)
                   : "  collision-free     never\n";
    }
    if (result.fitness.range_excess > 0.0)
        out += fmt::format("  the machine does not reach it: its axes lack {:.3f} (deg and mm, mean along the path)\n",
                           result.fitness.range_excess);
    out += fmt::format("  collision, upright {:10.3f} mm³, {:.3f} mm deep\n", result.start_collisions.volume_mm3,
                       result.start_collisions.depth_mm);
    out += fmt::format("  collision, tilted  {:10.3f} mm³, {:.3f} mm deep (simulated at {} mm, all motion included)\n",
                       result.proof.volume_mm3, result.proof.depth_mm, problem.job().search.proof_mm);
    out += postedText(result.posted);
    out += fmt::format("  rotary travel      {:10.1f}° and {:.1f}°\n",
                       base::degFromRad(result.motion.rotary_travel_rad[0]),
                       base::degFromRad(result.motion.rotary_travel_rad[1]));
    if (result.machining_time_s) out += fmt::format("  machining time     {:10.1f} s\n", *result.machining_time_s);
    if (result.stick_out_mm)
        out += fmt::format("  stick-out          {:10.1f} mm is the shortest that is safe; the tool has {:.1f} mm\n",
                           *result.stick_out_mm, problem.job().tool.stickOutMm());
    out += fmt::format("  contact speed      {:10.1f} m/min mean, {:.1f} at least; upright {:.1f} and {:.1f}\n",
                       result.contact.speed_mean_m_per_min, result.contact.speed_min_m_per_min,
                       result.start_contact.speed_mean_m_per_min, result.start_contact.speed_min_m_per_min);
    out += fmt::format("  force proxy        {:10.3f} mean; upright {:.3f}\n", result.contact.force_proxy_mean,
                       result.start_contact.force_proxy_mean);
    return out;
}

base::Result<std::string> tiltedText(const tilt::TiltCase& problem, const tilt::TiltPlan& plan) {
    return clTextOf(tilt::tiltedRecords(problem.path(), plan));
}

base::Result<void> writeFiles(const TiltResult& result, const tilt::TiltCase& problem) {
    std::error_code error;
    std::filesystem::create_directories(result.folder, error);
    if (error)
        return base::fail("io.open", fmt::format("cannot make the folder: {}", error.message()),
                          {result.folder, 0, 0, {}});
    const auto start = clTextOf(problem.path().records);
    if (!start) return base::fail(start.error());
    const auto tilted = tiltedText(problem, result.plan);
    if (!tilted) return base::fail(tilted.error());
    const auto summary = base::jsonText(toJson(result, problem));
    if (!summary) return base::fail(summary.error());
    const auto document = base::jsonText(pageJson(result, problem));
    if (!document) return base::fail(document.error());
    const auto page = pages::renderPage("tilt", *document);
    if (!page) return base::fail(page.error());
    for (const auto& [name, text] : {std::pair<const char*, const std::string*>{"start.apt", &*start},
                                     {"tilted.apt", &*tilted},
                                     {"report.json", &*summary},
                                     {"report.html", &*page}})
        if (auto done = writeText(result.folder, name, *text); !done) return done;
    if (!result.posted.program.empty())
        if (auto done = writeText(result.folder, "tilted.mpf", result.posted.program); !done) return done;
    if (result.runs.empty()) return {};
    return writeText(result.folder, "convergence.csv", tilt::convergenceCsv(result.runs));
}

}  // namespace cusp::cli
