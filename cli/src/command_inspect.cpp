// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp inspect`: measured points against a nominal shape, to a decision and a report.
#include "command.hpp"
#include "console.hpp"
#include "input.hpp"
#include "inspect_flags.hpp"
#include "inspect_output.hpp"
#include "inspect_text.hpp"
#include "inspection_page.hpp"
#include "qif_schema.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/geometry/cad/nominal_file.hpp>
#include <cusp/geometry/turned_shape.hpp>
#include <cusp/inspect/reference_alignment.hpp>
#include <cusp/inspect/scan/scan_registration.hpp>

#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <string>

namespace cusp::cli {

namespace {

base::Result<inspect::MeasuredPoints> readPoints(const InspectFlags& flags) {
    auto input = TextInput::open(flags.points_file);
    if (!input) return base::fail(input.error());
    base::Diagnostics remarks;
    auto points = inspect::readMeasuredPoints(input->stream(), input->name(), readerOptions(flags), remarks);
    tell(remarks);
    return points;
}

base::Result<inspect::RigidTransform> startFromReferences(const std::string& file) {
    constexpr std::size_t most_bytes = std::size_t{1} << 24U;
    return base::readWholeFile(file, most_bytes)
        .and_then([&](const std::string& text) { return inspect::readReferences(text, file); })
        .and_then([](const auto& references) { return inspect::alignToReferences(references); })
        .map([](const inspect::ReferenceAlignment& found) { return found.nominal_from_measured; });
}

/// cusp-scan lies beside cusp.
std::string scanProgram() {
    std::error_code ignored;
    const std::filesystem::path command = std::filesystem::read_symlink("/proc/self/exe", ignored);
    return (command.parent_path() / "cusp-scan").string();
}

base::Result<inspect::RigidTransform> startFromScan(const InspectFlags& flags, const inspect::MeasuredPoints& points,
                                                    const geometry::NominalShape& nominal) {
    inspect::ScanOptions options;
    options.program = scanProgram();
    if (points.kind != inspect::PointKind::Surface)
        options.offset_mm = flags.probe_radius_mm.value_or(points.probe_radius_mm.value_or(0.0));
    const auto found = inspect::findScanStart(points.positions, nominal, options);
    if (!found) return base::fail(found.error());
    base::Diagnostics remark;
    base::Location where;
    where.file = points.source;
    remark.note(
        "scan.start",
        fmt::format("start found by {} (coarse rms {:.3g} mm); of {} points looked at {} are outliers by distance to "
                    "their neighbours",
                    found->from_features ? "features" : "trying all orientations", found->rms_mm, found->sampled,
                    found->outliers),
        where);
    tell(remark);
    return found->nominal_from_measured;
}

/// Where the fit begins: as the file says, from reference points, or anywhere.
base::Result<inspect::RigidTransform> startOf(const InspectFlags& flags, const inspect::MeasuredPoints& points,
                                              const geometry::NominalShape& nominal) {
    if (!flags.references.empty()) return startFromReferences(flags.references);
    if (flags.start == "scan") return startFromScan(flags, points, nominal);
    return inspect::RigidTransform::Identity();
}

base::Result<void> writeResults(const InspectFlags& flags, const inspect::InspectionReport& report) {
    if (flags.output.empty()) return {};
    if (auto done = writeInspection(flags.output, report); !done) return done;
    if (flags.qif_schema.empty()) return {};
    return checkAgainstQifSchema((std::filesystem::path(flags.output) / "report.qif").string(), flags.qif_schema);
}

ExitCode exitCodeFor(const inspect::InspectionReport& report) {
    const inspect::Verdict verdict = report.judged().decision.verdict;
    const bool sound = verdict == inspect::Verdict::Accept || verdict == inspect::Verdict::NotAsked;
    return sound && report.doubts.empty() ? ExitCode::Done : ExitCode::FoundSomething;
}

ExitCode runInspect(const InspectFlags& flags) {
    auto options = inspectionOptions(flags);
    if (!options) return failWith(options.error());
    base::Diagnostics remarks;
    auto nominal = geometry::loadNominal(flags.nominal, remarks);
    if (!nominal) return failWith(nominal.error());
    if (flags.flip_nominal) nominal = std::make_unique<geometry::TurnedShape>(*std::move(nominal));
    auto points = readPoints(flags);
    if (!points) return failWith(points.error());
    const auto start = startOf(flags, *points, **nominal);
    if (!start) return failWith(start.error());
    options->start = *start;
    if (interrupted()) return ExitCode::Interrupted;
    auto report = inspect::inspectPoints(*std::move(points), **nominal, *options, remarks);
    tell(remarks);
    if (!report) return failWith(report.error());
    report->nominal_file = flags.nominal;
    report->nominal_flipped = flags.flip_nominal;
    if (interrupted()) return ExitCode::Interrupted;
    if (const auto done = writeResults(flags, *report); !done) return failWith(done.error());
    if (flags.json)
        sayJson(inspectionJson(*report));
    else
        say(inspectionText(*report));
    return exitCodeFor(*report);
}

void addPointFlags(CLI::App& inspect, InspectFlags& flags) {
    inspect
        .add_option(
            "POINTS", flags.points_file,
            "Measured points: CSV, XYZ, ASC, DMIS output, PC-DMIS or Calypso text, PCD, PLY, QIF; - for standard input.")
        ->required();
    inspect.add_option("--format", flags.format, "Format of the points, when it cannot be told from the text.")
        ->check(CLI::IsMember({"table", "dmis", "pc-dmis", "calypso", "pcd", "ply", "qif"}));
    inspect.add_option("--columns", flags.columns, "Columns of a table, e.g. id,x,y,z,i,j,k,section,-.");
    inspect.add_option("--units", flags.units, "Unit of the points; goes before what the file says.")
        ->check(CLI::IsMember({"mm", "inch", "m"}));
    inspect.add_option("--decimal", flags.decimal, "Decimal mark of a table, when it cannot be told.")
        ->check(CLI::IsMember({"point", "comma"}));
    inspect.add_option("--points", flags.kind, "What the points are; otherwise as the file says, or found by fitting.")
        ->check(CLI::IsMember({"centre", "surface"}));
    inspect.add_option("--probe-radius-mm", flags.probe_radius_mm, "Radius of the probe's ball.")
        ->check(CLI::NonNegativeNumber);
    inspect.add_option("--probe-form-mm", flags.probe_form_mm, "Form error of the probe's ball, full width.")
        ->check(CLI::NonNegativeNumber);
}

void addFitFlags(CLI::App& inspect, InspectFlags& flags) {
    inspect.add_option("--fit", flags.fit, "Best fit of the points to the nominal.")
        ->capture_default_str()
        ->check(CLI::IsMember({"least-squares", "minimax", "none"}));
    inspect.add_option("--lock", flags.lock, "Freedoms that stay as they are: tx, ty, tz, rx, ry, rz.")
        ->delimiter(',')
        ->check(CLI::IsMember({"tx", "ty", "tz", "rx", "ry", "rz"}));
    inspect.add_option("--loss", flags.loss, "How strongly far points pull in least squares.")
        ->capture_default_str()
        ->check(CLI::IsMember({"squared", "huber", "cauchy", "tukey"}));
    inspect.add_option("--loss-scale-mm", flags.loss_scale_mm, "Scale of the loss; 0 takes it from the residuals.")
        ->check(CLI::NonNegativeNumber);
    inspect.add_flag("--weights", flags.weights, "Points count in the fit by the column \"weight\" of the table.");
    inspect.add_option("--start", flags.start, "Where the points lie to begin with: as given, or anywhere (scan).")
        ->capture_default_str()
        ->check(CLI::IsMember({"given", "scan"}));
    inspect.add_option(
        "--references", flags.references,
        "Datums from reference points (3-2-1, RPS): a CSV of measured and nominal points with directions.");
}

void addDecisionFlags(CLI::App& inspect, InspectFlags& flags) {
    inspect.add_option("--sections", flags.sections, "Profile sections, e.g. X=-5,-30,-60,-90.");
    inspect.add_option("--section-width-mm", flags.section_width_mm, "Full width of the band a section is cut from.")
        ->check(CLI::PositiveNumber);
    inspect
        .add_option("--step-over-mm", flags.step_over_mm,
                    "Planned distance of neighbouring passes: scallops are counted and measured against it.")
        ->check(CLI::PositiveNumber);
    CLI::Option* limits =
        inspect.add_option("--limits-mm", flags.limits_mm, "Limits of the deviation, e.g. --limits-mm=-0.01,0.01.")
            ->delimiter(',')
            ->expected(2);
    inspect
        .add_option("--profile-t-mm", flags.profile_t_mm,
                    "Profile tolerance t of ISO 1101: the total width of the zone, half of it on either side.")
        ->check(CLI::PositiveNumber)
        ->excludes(limits);
    inspect
        .add_option("--uncertainty-mm", flags.uncertainty_mm,
                    "Standard uncertainty of a deviation; otherwise computed from the points.")
        ->check(CLI::NonNegativeNumber);
    inspect.add_option("--rule", flags.rule, "ISO 14253-1:2017 (probability), or limits shrunk and widened by U = 2u.")
        ->capture_default_str()
        ->check(CLI::IsMember({"probability", "guard-band"}));
    inspect.add_option("--judge", flags.judge, "Where the decision is taken: best-fit (default), or the fixed datums.")
        ->check(CLI::IsMember({"best-fit", "datum"}));
}

}  // namespace

void addInspectCommand(CLI::App& app, Action& action) {
    CLI::App* inspect = app.add_subcommand(
        "inspect",
        "Compares measured points with a nominal surface: alignment, deviations, sections, decision, report.");
    const auto flags = std::make_shared<InspectFlags>();
    addPointFlags(*inspect, *flags);
    inspect->add_option("--nominal", flags->nominal, "Nominal surface.")->required();
    inspect->add_flag("--flip-nominal", flags->flip_nominal,
                      "The outward normal of the nominal is the opposite of what its file says.");
    addFitFlags(*inspect, *flags);
    addDecisionFlags(*inspect, *flags);
    CLI::Option* output = inspect->add_option(
        "-o,--output", flags->output,
        "Folder for report.json, report.html, report.qif, points.csv, sections.csv and deviations.ply.");
    inspect->add_option("--qif-schema", flags->qif_schema, "Folder of the QIF 3.0 schema, to check report.qif against.")
        ->needs(output);
    inspect->add_flag("--json", flags->json, "One machine-readable summary on stdout.");
    inspect->callback([flags, &action] { action = [flags] { return runInspect(*flags); }; });
}

}  // namespace cusp::cli
