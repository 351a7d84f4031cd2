// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The field tables of a pocket job.
#include <cusp/optimizer/pocket/pocket_job.hpp>

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace cusp::pocket {

using base::FieldRules;
using base::positive;
using base::required;
using base::requiredPositive;
using base::Section;

namespace {

constexpr FieldRules not_negative{.min = 0.0};

const Section<ContourJob>& contourSection() {
    static const auto section =
        Section<ContourJob>("A closed contour.")
            .choice(
                "kind", &ContourJob::kind,
                {{"stock", ContourKind::Stock}, {"pocket", ContourKind::Pocket}, {"island", ContourKind::Island}},
                "stock: the material there is. pocket: what is taken out of it; drawn beyond the stock it is open there. "
                "island: what stays.",
                required())
            .field("points_mm", &ContourJob::points_mm, "Corners [x, y] in order, either way round.", required())
            .field(
                "bulges", &ContourJob::bulges,
                "One for each corner: tan of a quarter of the angle of the arc that begins there, above 0 to the left; 0 is "
                "straight.");
    return section;
}

const Section<DepthJob>& depthSection() {
    static const auto section =
        Section<DepthJob>("Heights.")
            .field("top_mm", &DepthJob::top_mm, "Top of the stock.")
            .field("floor_mm", &DepthJob::floor_mm, "Floor of the pocket.", required())
            .field("allowance_mm", &DepthJob::allowance_mm, "Left on walls for finishing.", not_negative)
            .field("clearance_mm", &DepthJob::clearance_mm, "Height of rapid moves above the top.", positive())
            .field("approach_mm", &DepthJob::approach_mm, "Above the floor of a level, where rapid down moves end.",
                   positive())
            .field("ramp_deg", &DepthJob::ramp_rad, "Slope of helical entries.", {.min = 0.1, .max = 20.0})
            .check([](const DepthJob& depth, const base::TomlNode& node, base::Diagnostics& report) {
                if (depth.floor_mm >= depth.top_mm)
                    report.error(
                        "pocket.depth",
                        fmt::format("the floor at {} mm is not below the top at {} mm", depth.floor_mm, depth.top_mm),
                        node.whereKey("floor_mm"));
            });
    return section;
}

const Section<EndMillJob>& endMillSection() {
    static const auto section =
        Section<EndMillJob>("The end mill.")
            .field("number", &EndMillJob::number, "Tool number.", {.min = 1, .max = 99999})
            .field("name", &EndMillJob::name, "Tool name.", required())
            .field("diameter_mm", &EndMillJob::diameter_mm, "Diameter.", requiredPositive())
            .field("teeth", &EndMillJob::teeth, "Number of teeth.", {.min = 1, .max = 20})
            .field("cutting_height_mm", &EndMillJob::cutting_height_mm, "Length of the flutes.", positive())
            .field("overhang_mm", &EndMillJob::overhang_mm, "From the holder to the tip.", positive());
    return section;
}

void checkShare(const std::array<double, 2>& share, const char* key, const base::TomlNode& node,
                base::Diagnostics& report) {
    if (!(share[0] > 0.0) || share[0] >= share[1])
        report.error("pocket.range",
                     fmt::format("{} to {} is no range; the least comes first and is above 0", share[0], share[1]),
                     node.whereKey(key));
}

const Section<CuttingJob>& cuttingSection() {
    static const auto section =
        Section<CuttingJob>("Cutting data to choose from.")
            .field("table", &CuttingJob::table, "A table that ships with cusp, by name, or the path of a file.")
            .field("material", &CuttingJob::material, "Its number in the table.", required())
            .field("ae_share", &CuttingJob::ae_share,
                   "Radial depth of cut, least and most, as a share of the diameter.")
            .field("ap_share", &CuttingJob::ap_share, "Axial depth of cut, least and most, as a share of the diameter.")
            .field("engagement_limit_deg", &CuttingJob::engagement_limit_rad,
                   "Largest engagement angle on any step; 0: that of a straight cut at the largest radial depth.",
                   {.min = 0.0, .max = 180.0})
            .check([](const CuttingJob& cutting, const base::TomlNode& node, base::Diagnostics& report) {
                checkShare(cutting.ae_share, "ae_share", node, report);
                checkShare(cutting.ap_share, "ap_share", node, report);
                if (cutting.ae_share[1] > 1.0)
                    report.error("pocket.range", "the radial depth of cut cannot be more than the diameter",
                                 node.whereKey("ae_share"));
            });
    return section;
}

const Section<PocketMachineJob>& machineSection() {
    static const auto section =
        Section<PocketMachineJob>("The machine; without a name times are distance over feed.")
            .field("name", &PocketMachineJob::name, "A machine that ships with cusp, or the path of its file.")
            .field("origin_mm", &PocketMachineJob::origin_mm, "Work offset in the machine frame.")
            .field("max_spindle_rpm", &PocketMachineJob::max_spindle_rpm, "Spindle speed it reaches.", positive())
            .field("spindle_power_kw", &PocketMachineJob::spindle_power_kw, "Power of the spindle.", positive())
            .field("rapid_mm_per_min", &PocketMachineJob::rapid_mm_per_s, "Rapid speed, for estimates.", positive())
            .field("tolerance_mm", &PocketMachineJob::tolerance_mm, "By which the control may round corners.",
                   positive());
    return section;
}

const Section<PocketSearchJob>& searchSection() {
    static const auto section =
        Section<PocketSearchJob>("How much is searched.")
            .field("seed", &PocketSearchJob::seed, "Of every random choice.", not_negative)
            .field("population", &PocketSearchJob::population, "Sets of cutting data.", {.min = 2, .max = 1000})
            .field("iterations", &PocketSearchJob::iterations, "Populations of them.", {.min = 1, .max = 10000})
            .field("path_population", &PocketSearchJob::path_population, "Paths.", {.min = 4, .max = 1000})
            .field("path_generations", &PocketSearchJob::path_generations, "Generations of paths.",
                   {.min = 0, .max = 10000});
    return section;
}

base::Result<PocketJob> fromDocument(const base::Result<base::TomlDocument>& document) {
    if (!document) return base::fail(document.error());
    base::Diagnostics report;
    PocketJob job = pocketJobSection().read(document->root(), report);
    if (report.hasErrors()) return base::fail(std::move(report));
    return job;
}

}  // namespace

const Section<PocketJob>& pocketJobSection() {
    static const auto section =
        Section<PocketJob>("A job of `cusp pocket`.")
            .field("schema", &PocketJob::schema, "Version of this format.", {.min = 1, .max = 1})
            .field("name", &PocketJob::name, "Name of the part.")
            .tables("contour", &PocketJob::contours, contourSection())
            .table("depth", &PocketJob::depth, depthSection())
            .table("tool", &PocketJob::tool, endMillSection())
            .table("cutting", &PocketJob::cutting, cuttingSection())
            .table("machine", &PocketJob::machine, machineSection())
            .table("search", &PocketJob::search, searchSection());
    return section;
}

base::Result<PocketJob> readPocketJobFile(const std::string& path) {
    return fromDocument(base::TomlDocument::readFile(path));
}
base::Result<PocketJob> readPocketJob(std::string_view text, const std::string& file_name) {
    return fromDocument(base::TomlDocument::parse(text, file_name));
}

base::Result<PocketContours> PocketJob::polygons(const std::string& file_name) const {
    constexpr double chord_mm = 0.002;
    PocketContours out;
    base::Diagnostics report;
    for (std::size_t i = 0; i < contours.size(); ++i) {
        Contour contour{.points = {}, .bulges = contours[i].bulges};
        for (const auto& p : contours[i].points_mm) contour.points.push_back({p[0], p[1]});
        auto polygon = toPolygon(contour, chord_mm);
        if (!polygon) {
            for (base::Diagnostic problem : polygon.error()) {
                problem.where.file = file_name;
                problem.where.key = fmt::format("contour[{}]", i);
                report.add(std::move(problem));
            }
            continue;
        }
        (contours[i].kind == ContourKind::Stock    ? out.stock
         : contours[i].kind == ContourKind::Pocket ? out.pockets
                                                   : out.islands)
            .push_back(*std::move(polygon));
    }
    if (report.hasErrors()) return base::fail(std::move(report));
    return out;
}

double PocketJob::engagementLimitDeg() const {
    const double rad =
        cutting.engagement_limit_rad > 0.0 ? cutting.engagement_limit_rad : std::acos(1.0 - 2.0 * cutting.ae_share[1]);
    return rad * 180.0 / std::numbers::pi;
}

CutterLimits PocketJob::limits() const {
    CutterLimits out;
    out.diameter_mm = tool.diameter_mm;
    out.teeth = static_cast<int>(tool.teeth);
    out.overhang_mm = tool.overhang_mm;
    out.max_spindle_rpm = machine.max_spindle_rpm;
    out.spindle_power_kw = machine.spindle_power_kw;
    out.engagement_deg = engagementLimitDeg();
    return out;
}

}  // namespace cusp::pocket
