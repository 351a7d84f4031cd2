// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The field tables of a planning job.
#include <cusp/optimizer/finishing/plan_job.hpp>

#include <fmt/format.h>

namespace cusp::finishing {

using base::FieldRules;
using base::positive;
using base::Section;

namespace {

constexpr FieldRules not_negative{.min = 0.0};
constexpr FieldRules angle{.min = -80.0, .max = 80.0};
constexpr FieldRules positive_angle{.min = 0.0, .max = 80.0};

/// Options name their keys; here the keys have lines.
void appendAtKeys(const base::Diagnostics& problems, const base::TomlNode& root, base::Diagnostics& report) {
    for (base::Diagnostic problem : problems) {
        std::optional<base::TomlNode> node = root;
        std::string rest = problem.where.key;
        while (node && !rest.empty()) {
            const std::size_t dot = rest.find('.');
            const std::string key = rest.substr(0, dot);
            const auto next = node->at(key);
            problem.where = next ? next->where() : node->whereKey(rest);
            node = next;
            rest = dot == std::string::npos ? "" : rest.substr(dot + 1);
        }
        report.add(std::move(problem));
    }
}

base::Result<PlanJob> fromDocument(const base::Result<base::TomlDocument>& document) {
    if (!document) return base::fail(document.error());
    base::Diagnostics report;
    PlanJob job = planJobSection().read(document->root(), report);
    if (report.hasErrors()) return base::fail(std::move(report));
    return job;
}

}  // namespace

const Section<PartJob>& partSection() {
    static const auto section =
        Section<PartJob>("What is machined.")
            .field("nominal", &PartJob::nominal,
                   "File of the surface: .toml, .step, .iges; beside the job file unless the path says otherwise.",
                   base::required())
            .field("faces", &PartJob::faces, "Which faces of the file, counted from 1; all where the list is empty.")
            .field("tolerance_mm", &PartJob::tolerance_mm, "Deviation to each side that is in order.", positive());
    return section;
}

const Section<MachineJob>& machineJobSection() {
    static const auto section =
        Section<MachineJob>("The machine it is cut on; without one nothing is said of time and reach.")
            .field("name", &MachineJob::name, "Machine file, or the name of one that ships.")
            .field("block_time_ms", &MachineJob::block_time_s,
                   "The least time a block takes the control; 0 where that is not known.", not_negative)
            .field("tool_length_mm", &MachineJob::tool_length_mm,
                   "Tip to gauge point; the gauge length of the tool library where absent.", positive())
            .field("origin_mm", &MachineJob::origin_mm, "Of the part in the machine, all axes at zero.")
            .field("tolerance_mm", &MachineJob::tolerance_mm, "How far the control may round corners.", positive())
            .field("orientation_tolerance_deg", &MachineJob::orientation_tolerance_rad, "The same of the tool axis.",
                   positive());
    return section;
}

const Section<PassOptions>& passSection() {
    using P = PassOptions;
    static const auto section =
        Section<P>("Where the passes lie.")
            .choice("along", &P::family,
                    {{"planes", P::Family::Planes}, {"u", P::Family::ConstantV}, {"v", P::Family::ConstantU}},
                    "planes: where parallel planes cut the surface; u, v: along that parameter of the face.")
            .field("plane_normal", &P::plane_normal, "Across the planes; [0, 1, 0] makes passes along X.")
            .choice(
                "placement", &P::placement,
                {{"even", P::Placement::Even}, {"arc", P::Placement::Arc}, {"scallop", P::Placement::Scallop}},
                "even: planes exactly the step-over apart, as many as fit, centred, or equal steps of the parameter; "
                "arc: no farther apart than the step-over along the surface anywhere; scallop: so that the ridges have the "
                "same height, and no farther apart than the step-over.")
            .choice("order", &P::order, {{"zig-zag", P::Order::ZigZag}, {"one-way", P::Order::OneWay}},
                    "Whether every second pass runs the other way.")
            .field("step_over_mm", &P::step_over_mm, "Distance of two passes.", positive())
            .field("scallop_mm", &P::scallop_mm, "Height of the ridge between two passes, for placement scallop.",
                   positive())
            .field("count", &P::count, "That many passes for each face, whatever the step-over.",
                   FieldRules{.min = 1.0})
            .field(
                "places", &P::places,
                "Where each pass lies, 0 to 1 of the whole across the face, ascending; passes along u or v, arc or scallop.")
            .field("on_edges", &P::on_edges,
                   "First and last pass on the edges of the face, not half a distance inside (arc, scallop).")
            .field("from_last", &P::from_last, "Begins at the other side.")
            .field("reverse", &P::reverse, "Runs the first pass the other way.");
    return section;
}

const Section<OrientationOptions>& orientationSection() {
    using O = OrientationOptions;
    static const auto section =
        Section<O>("How the tool stands on the surface, against its normal in the frame of the feed.")
            .field("lead_deg", &O::lead_rad, "Towards the feed; with adaptive the least there is.", positive_angle)
            .field("tilt_deg", &O::tilt_rad, "To the left of the feed.", angle)
            .field(
                "adaptive", &O::adaptive,
                "The lead follows the surface: the smallest with which the cutter is no flatter than the surface is hollow.")
            .field("curvature_safety", &O::curvature_safety,
                   "Adaptive lead takes the surface for so many times as hollow.", positive())
            .field("pass_safety", &O::pass_safety, "For each pass a factor on curvature_safety.")
            .field("lead_max_deg", &O::lead_max_rad, "The most an adaptive lead may be.", positive_angle)
            .field("lead_change_deg_per_mm", &O::lead_change_rad_per_mm,
                   "The most an adaptive lead changes along a pass.", positive())
            .field("smoothing_mm", &O::smoothing_mm, "An adaptive lead is averaged over this length.", not_negative)
            .field("depth_offset_mm", &O::depth_offset_mm,
                   "Moves the tool along the normal; below 0 into the surface, by what may be cut too deep.");
    return section;
}

const Section<StepOptions>& stepSection() {
    using S = StepOptions;
    static const auto section =
        Section<S>("How far apart the points of a pass are.")
            .choice("method", &S::method, {{"greedy", S::Method::Greedy}, {"bisection", S::Method::Bisection}},
                    "greedy: each step as long as the tolerance allows; bisection: halves the pass until it holds.")
            .choice("measure", &S::measure,
                    {{"surface", S::Measure::Surface}, {"cutter-location", S::Measure::CutterLocation}},
                    "Chord error of the curve of contact points, or of that of tool tips.")
            .field("chord_tolerance_mm", &S::chord_tolerance_mm, "The most a step may miss the curve by.", positive())
            .field("step_max_mm", &S::most_mm, "No step is longer.", positive())
            .field("turn_max_deg", &S::most_turn_rad, "The tool axis turns by no more in a step.", positive());
    return section;
}

const Section<LinkOptions>& linkSection() {
    using L = LinkOptions;
    static const auto section =
        Section<L>("How the tool comes to a pass, leaves it and goes to the next.")
            .field("run_in_mm", &L::run_in_mm, "Straight on before a pass, at the feed.", not_negative)
            .field("run_out_mm", &L::run_out_mm,
                   "Straight on beyond the end of a pass: beside the contact a wide cutter lags behind it.",
                   not_negative)
            .field("lift_mm", &L::lift_mm, "Off the surface along the tool axis, before and after a pass.", positive())
            .field("clearance_mm", &L::clearance_mm,
                   "Above the highest place of the part: for the first approach, and links that cannot stay low.",
                   positive())
            .field("up", &L::up, "Which way is up, out of the part.");
    return section;
}

const Section<FeedJob>& feedSection() {
    static const auto section =
        Section<FeedJob>("How fast.")
            .field("feed_mm_per_min", &FeedJob::feed_mm_per_s, "Of the tool tip along passes.", positive())
            .field("approach_feed_mm_per_min", &FeedJob::approach_feed_mm_per_s, "Down to a pass.", positive())
            .field(
                "adapt", &FeedJob::adapt,
                "Lowers the feed of each move to what the block time, the axes and its curvature allow; needs a machine.")
            .field("acceleration_mm_per_s2", &FeedJob::acceleration_mm_per_s2,
                   "Allowed across the path where it curves, with adapt.", positive());
    return section;
}

const Section<PlanJob>& planJobSection() {
    static const auto tool =
        Section<ToolJob>("What it is machined with.")
            .field("library", &ToolJob::tool_library,
                   "Tool library file; beside the job file unless the path says otherwise.", base::required())
            .field("name", &ToolJob::name, "Name of the tool in the library.", base::required())
            .field("spindle_rpm", &ToolJob::spindle_rpm, "Spindle speed; 0 writes none.", not_negative)
            .field("coolant", &ToolJob::coolant, "Whether coolant is switched on.")
            .field("edge_radius_mm", &ToolJob::edge_radius_mm,
                   "Of the inserts of a flat cutter, for the undercut of their rounded edges.", not_negative);
    static const auto section =
        Section<PlanJob>("A planning job.")
            .field("schema", &PlanJob::schema, "Version of this file's form: 1.", base::required())
            .field("name", &PlanJob::name, "For people; goes to the CL file as PARTNO.")
            .table("part", &PlanJob::part, partSection(), base::required())
            .table("tool", &PlanJob::tool, tool, base::required())
            .table("machine", &PlanJob::machine, machineJobSection())
            .table("passes", &PlanJob::passes, passSection(), base::required())
            .table("orientation", &PlanJob::orientation, orientationSection())
            .table("steps", &PlanJob::steps, stepSection())
            .table("links", &PlanJob::links, linkSection())
            .table("feed", &PlanJob::feed, feedSection())
            .check([](const PlanJob& job, const base::TomlNode& root, base::Diagnostics& report) {
                if (job.schema != 1)
                    report.error("finishing.schema-version",
                                 fmt::format("schema {} is not known; this version reads schema 1", job.schema),
                                 root.at("schema")->where());
                if (job.feed.adapt && job.machine.name.empty())
                    report.error("finishing.option", "feed.adapt needs a machine: name one in [machine]",
                                 root.whereKey("machine"));
                appendAtKeys(job.options().check(), root, report);
            });
    return section;
}

PlanOptions PlanJob::options() const {
    PlanOptions out{passes, orientation, steps, links, feed.feed_mm_per_s};
    out.links.approach_feed_mm_per_s = feed.approach_feed_mm_per_s;
    return out;
}

base::Result<PlanJob> readPlanJobFile(const std::string& path) {
    return fromDocument(base::TomlDocument::readFile(path));
}

base::Result<PlanJob> readPlanJob(std::string_view text, const std::string& file_name) {
    return fromDocument(base::TomlDocument::parse(text, file_name));
}

}  // namespace cusp::finishing
