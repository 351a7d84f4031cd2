// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Files of an optimisation.
#include "optimize_output.hpp"

#include "finishing_input.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/number_text.hpp>
#include <cusp/base/units.hpp>
#include <cusp/base/version.hpp>
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
    out.tool = {absolute(done.job.tools.library), done.tool.name, done.job.tools.spindle_rpm, done.job.tools.coolant,
                done.job.tools.edge_radius_mm};
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
        const bool beaten = std::any_of(done.levelled.begin(), done.levelled.end(), [&](const auto& other) {
            return other.machining_time_s <= point.machining_time_s && other.deviation_mm <= point.deviation_mm &&
                   (other.machining_time_s < point.machining_time_s || other.deviation_mm < point.deviation_mm);
        });
        out += fmt::format("{},{},{},{},{}\n", done.tool_names[point.tool], point.passes,
                           base::formatShortest(point.machining_time_s), base::formatShortest(point.deviation_mm),
                           beaten ? 0 : 1);
    }
    return out;
}

}  // namespace

base::Json parametersOf(const Optimized& done) {
    const finishing::PlanOptions& options = done.path.contacts.options;
    base::Json out;
    out["tool"] = done.tool.name;
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

base::Result<void> writeFolder(const std::string& folder, const std::string& job_file, const Optimized& done) {
    const auto cl = toolpath::clText(finishing::clFile(
        done.path, {.part_name = done.job.name,
                    .remark = fmt::format("OPTIMIZED BY CUSP {} SEED {}", base::version(), done.job.search.seed),
                    .tool = done.tool,
                    .spindle_rpm = done.job.tools.spindle_rpm,
                    .coolant = done.job.tools.coolant}));
    if (!cl) return base::fail(cl.error());
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (failure)
        return base::fail("io.create", "cannot make the folder: " + failure.message(),
                          {.file = folder, .line = 0, .column = 0, .key = {}});
    const std::string plan = finishing::planJobSection().toToml(planJobOf(job_file, done));
    for (const auto& [name, text] : {std::pair<std::string, std::string>{"best.apt", *cl},
                                     {"best.toml", "# Plans best.apt again: cusp plan best.toml -o P.apt\n" + plan},
                                     {"convergence.csv", optimizer::convergenceCsv(done.search.history)},
                                     {"front.csv", frontText(done)},
                                     {"map.csv", mapText(done)}})
        if (auto written = base::writeWholeFile(folder + "/" + name, text); !written)
            return base::fail(written.error());
    return {};
}

}  // namespace cusp::cli
