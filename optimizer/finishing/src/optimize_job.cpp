// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The field tables of an optimisation job.
#include <cusp/optimizer/finishing/optimize_job.hpp>

#include <fmt/format.h>
#include <utility>

namespace cusp::finishing {

using base::FieldRules;
using base::positive;
using base::Section;

namespace {

constexpr FieldRules not_negative{.min = 0.0};
constexpr FieldRules angle{.min = -80.0, .max = 80.0};

void checkRange(const std::array<double, 2>& ends, const char* key, const base::TomlNode& table,
                base::Diagnostics& report) {
    if (ends[0] < ends[1]) return;
    const auto node = table.at(key);
    report.error(
        "finishing.empty-range",
        "there is nothing to choose from: the first number must be below the second; to fix a value, give two that "
        "differ little",
        node ? node->where() : table.whereKey(key));
}

Section<SearchRanges> rangeSection() {
    using R = SearchRanges;
    Section<R> section("What is searched for, from … to.");
    section
        .field("step_over_percent", &R::step_over_share, "Paper mode: step-over, of the tool's diameter.", positive())
        .field("lead_deg", &R::lead_rad, "Paper mode: lead.", FieldRules{.min = 0.0, .max = 80.0})
        .field("tilt_deg", &R::tilt_rad, "Paper mode: tilt.", angle)
        .field("chord_tolerance_mm", &R::chord_tolerance_mm,
               "Paper mode: the paper's maximum discretisation step, taken as a chord tolerance.", positive())
        .field("depth_percent", &R::depth_share,
               "True mode: depth of the contacts along the normal, of the tolerance; below 0 into the surface.",
               FieldRules{.min = -100.0, .max = 100.0})
        .field("curvature_safety", &R::curvature_safety,
               "True mode: the adaptive lead takes the surface for so many times as hollow.", positive())
        .field("passes_percent", &R::passes_share,
               "True mode: number of passes, of that which the ridge alone asks for.", positive())
        .check([](const R& ranges, const base::TomlNode& table, base::Diagnostics& report) {
            checkRange(ranges.step_over_share, "step_over_percent", table, report);
            checkRange(ranges.lead_rad, "lead_deg", table, report);
            checkRange(ranges.tilt_rad, "tilt_deg", table, report);
            checkRange(ranges.chord_tolerance_mm, "chord_tolerance_mm", table, report);
            checkRange(ranges.depth_share, "depth_percent", table, report);
            checkRange(ranges.curvature_safety, "curvature_safety", table, report);
            checkRange(ranges.passes_share, "passes_percent", table, report);
        });
    return section;
}

Section<SearchJob> searchSection() {
    using S = SearchJob;
    using optimizer::Algorithm;
    Section<S> section("How it is searched.");
    section
        .choice("algorithm", &S::algorithm,
                {{"virus-evolutionary", Algorithm::VirusEvolutionary},
                 {"genetic", Algorithm::Genetic},
                 {"steady-state", Algorithm::SteadyState},
                 {"random", Algorithm::RandomSearch}},
                "virus-evolutionary: Fountas 2017; genetic: the same without viruses.")
        .field("seed", &S::seed, "The same seed gives the same result.", FieldRules{.min = 0.0})
        .field("population", &S::population, "Candidates in a generation.", FieldRules{.min = 4.0, .max = 10000.0})
        .field("evaluations", &S::evaluations, "Distinct candidates that are judged, those of viruses included.",
               FieldRules{.min = 4.0, .max = 1e7})
        .field("error_weight", &S::error_weight,
               "Paper mode: weight of the machining error against the number of points.",
               FieldRules{.min = 0.0, .max = 1.0})
        .field("search_grid_mm", &S::search_grid_mm, "True mode: grid of the looks while searching.", positive())
        .field("level_grid_mm", &S::level_grid_mm, "True mode: grid while passes are levelled.", positive())
        .field("proof_grid_mm", &S::proof_grid_mm, "True mode: grid of the proof at the end.", positive())
        .field("front_passes", &S::front_passes,
               "True mode: the best is levelled with so many passes fewer and more too, for time against deviation.",
               FieldRules{.min = 0.0, .max = 20.0});
    return section;
}

base::Result<OptimizeJob> fromDocument(const base::Result<base::TomlDocument>& document) {
    if (!document) return base::fail(document.error());
    base::Diagnostics report;
    OptimizeJob job = optimizeJobSection().read(document->root(), report);
    if (report.hasErrors()) return base::fail(std::move(report));
    return job;
}

}  // namespace

const Section<OptimizeJob>& optimizeJobSection() {
    using J = OptimizeJob;
    static const auto tools =
        Section<ToolChoice>("Tools to choose from.")
            .field("library", &ToolChoice::tool_library,
                   "Tool library file; beside the job file unless the path says otherwise.", base::required())
            .field("names", &ToolChoice::names, "Names of the tools; all of the library where the list is empty.")
            .field("spindle_rpm", &ToolChoice::spindle_rpm, "Spindle speed; 0 writes none.", not_negative)
            .field("coolant", &ToolChoice::coolant, "Whether coolant is switched on.")
            .field("edge_radius_mm", &ToolChoice::edge_radius_mm, "Of the inserts of flat cutters, for their undercut.",
                   not_negative);
    static const auto compare =
        Section<CompareJob>(
            "True mode: the grid of constant leads that the result is compared with; none without leads.")
            .field("leads_deg", &CompareJob::leads_rad, "Leads.", FieldRules{.min = 0.0, .max = 80.0})
            .field("tilts_deg", &CompareJob::tilts_rad, "Tilts.", angle);
    static const auto section =
        Section<J>("An optimisation job.")
            .field("schema", &J::schema, "Version of this file's form: 1.", base::required())
            .field("name", &J::name, "For people; goes to the CL file as PARTNO.")
            .choice(
                "mode", &J::mode, {{"paper", OptimizeMode::Paper}, {"true", OptimizeMode::True}},
                "paper: machining error against number of points, by the formulas of Fountas 2017; true: least time within "
                "the tolerance, by the exact envelope of the tool.",
                base::required())
            .table("part", &J::part, partSection(), base::required())
            .table("tools", &J::tools, tools, base::required())
            .table("machine", &J::machine, machineJobSection())
            .table("passes", &J::passes, passSection())
            .table("steps", &J::steps, stepSection())
            .table("links", &J::links, linkSection())
            .table("feed", &J::feed, feedSection())
            .table("ranges", &J::ranges, rangeSection())
            .table("search", &J::search, searchSection())
            .table("compare", &J::compare, compare)
            .check([](const J& job, const base::TomlNode& root, base::Diagnostics& report) {
                if (job.schema != 1)
                    report.error("finishing.schema-version",
                                 fmt::format("schema {} is not known; this version reads schema 1", job.schema),
                                 root.at("schema")->where());
                if (job.mode == OptimizeMode::True && job.machine.name.empty())
                    report.error("finishing.option",
                                 "true mode looks for the least time, on a machine: name one in [machine]",
                                 root.whereKey("machine"));
                if (job.mode == OptimizeMode::True && job.passes.family == PassOptions::Family::Planes &&
                    job.passes.placement == PassOptions::Placement::Even && !job.passes.places.empty())
                    report.error("finishing.option", "places need placement arc or scallop", root.whereKey("passes"));
                report.append(job.options().check());
            });
    return section;
}

PlanOptions OptimizeJob::options() const {
    PlanOptions out;
    out.passes = passes;
    out.steps = steps;
    out.links = links;
    out.links.approach_feed_mm_per_s = feed.approach_feed_mm_per_s;
    out.feed_mm_per_s = feed.feed_mm_per_s;
    return out;
}

optimizer::SearchOptions OptimizeJob::searchOptions() const {
    optimizer::SearchOptions out;
    out.algorithm = search.algorithm;
    out.seed = static_cast<std::uint64_t>(search.seed);
    out.population = static_cast<std::size_t>(search.population);
    out.max_evaluations = static_cast<std::size_t>(search.evaluations);
    return out;
}

PaperProblem OptimizeJob::paperProblem(std::vector<toolpath::Tool> from) const {
    PaperProblem out;
    out.tools = std::move(from);
    out.step_over_share = ranges.step_over_share;
    out.lead_rad = ranges.lead_rad;
    out.tilt_rad = ranges.tilt_rad;
    out.chord_tolerance_mm = ranges.chord_tolerance_mm;
    out.error_weight = search.error_weight;
    out.edge_radius_mm = tools.edge_radius_mm;
    out.options = options();
    return out;
}

TrueProblem OptimizeJob::trueProblem(std::vector<toolpath::Tool> from, const MachineSetting& setting) const {
    TrueProblem out;
    out.tools = std::move(from);
    out.setting = setting;
    out.tool_length_fixed = machine.tool_length_mm.has_value();
    out.options = options();
    out.tolerance_mm = part.tolerance_mm;
    out.depth_share = ranges.depth_share;
    out.width_share = ranges.passes_share;
    out.curvature_safety = ranges.curvature_safety;
    out.search_grid_mm = search.search_grid_mm;
    out.level_grid_mm = search.level_grid_mm;
    out.proof_grid_mm = search.proof_grid_mm;
    out.front_passes = search.front_passes;
    return out;
}

base::Result<OptimizeJob> readOptimizeJobFile(const std::string& path) {
    return fromDocument(base::TomlDocument::readFile(path));
}

base::Result<OptimizeJob> readOptimizeJob(std::string_view text, const std::string& file_name) {
    return fromDocument(base::TomlDocument::parse(text, file_name));
}

}  // namespace cusp::finishing
