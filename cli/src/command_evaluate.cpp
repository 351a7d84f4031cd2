// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp evaluate`: what a CL file, whoever made it, leaves on a surface.
#include "command.hpp"
#include "console.hpp"
#include "input.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/json_report.hpp>
#include <cusp/base/number_text.hpp>
#include <cusp/geometry/surface_file.hpp>
#include <cusp/simulation/surface_envelope.hpp>

#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>

namespace cusp::cli {

namespace {

/// Of the chords that stand for arcs of the CL file: far below any tolerance that is asked for.
constexpr double chord_mm = 1e-4;

struct Flags {
    std::string cl_file;
    std::string nominal;
    std::string map;
    std::string dialect;
    std::string units;
    simulation::EnvelopeOptions envelope;
    double tolerance_mm = 0.01;
    bool strict = false;
    bool json = false;
};

struct Evaluation {
    simulation::CutterPath path;
    simulation::SurfaceEnvelope envelope;
    simulation::EnvelopeSummary summary;

    [[nodiscard]] const simulation::ToolMove& moveAt(std::size_t point) const {
        return path.moves[envelope.points[point].move];
    }
};

base::Result<simulation::CutterPath> readMoves(const Flags& flags) {
    auto input = ClInput::open(flags.cl_file, clReaderOptions(flags.dialect, flags.units, flags.strict));
    if (!input) return base::fail(input.error());
    base::Diagnostics report;
    simulation::PathCollector collector(input->text().name(), chord_mm, report);
    for (toolpath::ClRecord record; input->reader().next(record);) collector.take(record);
    base::Diagnostics all = input->reader().report();
    all.append(report);
    if (all.hasErrors()) return base::fail(std::move(all));
    tell(all);
    return collector.finish();
}

base::Json placeOf(const Evaluation& done, std::size_t point, double value_mm) {
    if (value_mm <= 0.0) return {};
    const auto& at = done.envelope.grid.points[point];
    return {{"position_mm", {at.position.x(), at.position.y(), at.position.z()}}, {"cl_line", done.moveAt(point).line}};
}

base::Json toJson(const Flags& flags, const Evaluation& done) {
    const auto& sum = done.summary;
    base::Json out = base::jsonReport("evaluate", 1);
    out["cl_file"] = flags.cl_file;
    out["nominal"] = flags.nominal;
    out["cutter_locations"] = done.path.locations;
    out["moves"] = done.path.moves.size();
    out["grid_mm"] = flags.envelope.spacing_mm;
    out["band_mm"] = flags.envelope.band_mm;
    out["tolerance_mm"] = flags.tolerance_mm;
    out["points"] = sum.points;
    out["reached_percent"] = sum.reached_percent;
    out["overcut_max_mm"] = sum.overcut_max_mm;
    out["undercut_max_mm"] = sum.undercut_max_mm;
    out["mean_mm"] = sum.mean_mm;
    out["within_tolerance_percent"] = sum.within_tolerance_percent;
    out["beyond_band"] = sum.beyond;
    out["overcut_max_at"] = placeOf(done, sum.deepest, sum.overcut_max_mm);
    out["undercut_max_at"] = placeOf(done, sum.highest, sum.undercut_max_mm);
    return out;
}

std::string placeText(const Evaluation& done, std::size_t point) {
    const auto& at = done.envelope.grid.points[point].position;
    return fmt::format("at X{:.3f} Y{:.3f} Z{:.3f}, CL line {}", at.x(), at.y(), at.z(), done.moveAt(point).line);
}

std::string toText(const Flags& flags, const Evaluation& done) {
    const auto& sum = done.summary;
    std::string out =
        fmt::format("{} on {}: {} cutter locations, {} grid points at {} mm\n", fileNameOf(flags.cl_file),
                    fileNameOf(flags.nominal), done.path.locations, sum.points, flags.envelope.spacing_mm);
    out += fmt::format("  reached            {:8.2f} % of the surface\n", sum.reached_percent);
    if (sum.reached == 0) return out + "The tool comes nowhere near the surface: another frame, or another unit?\n";
    out += fmt::format("  within ±{:<8} mm {:8.2f} % of what is reached\n", flags.tolerance_mm,
                       sum.within_tolerance_percent);
    if (sum.overcut_max_mm > 0.0)
        out += fmt::format("  deepest overcut    {:8.4f} mm {}\n", sum.overcut_max_mm, placeText(done, sum.deepest));
    if (sum.undercut_max_mm > 0.0)
        out += fmt::format("  most material left {:8.4f} mm {}\n", sum.undercut_max_mm, placeText(done, sum.highest));
    out += fmt::format("  mean               {:+8.4f} mm\n", sum.mean_mm);
    if (sum.beyond > 0)
        out += fmt::format("  {} points are cut deeper than the {} mm looked at (--band-mm)\n", sum.beyond,
                           flags.envelope.band_mm);
    return out;
}

/// One row a grid point; what the tool does not reach has no deviation and no line.
std::string mapText(const Evaluation& done) {
    std::string out = "x_mm,y_mm,z_mm,nx,ny,nz,deviation_mm,cl_line\n";
    for (std::size_t i = 0; i < done.envelope.points.size(); ++i) {
        const auto& at = done.envelope.grid.points[i];
        for (const double value :
             {at.position.x(), at.position.y(), at.position.z(), at.normal.x(), at.normal.y(), at.normal.z()})
            out += base::formatShortest(value) + ",";
        const auto& point = done.envelope.points[i];
        out += point.reached() ? fmt::format("{},{}\n", base::formatShortest(point.deviation_mm), done.moveAt(i).line)
                               : ",\n";
    }
    return out;
}

ExitCode runEvaluate(const Flags& flags) {
    auto path = readMoves(flags);
    if (!path) return failWith(path.error());
    const auto faces = geometry::readSurfaceFile(flags.nominal);
    if (!faces) return failWith(faces.error());
    auto envelope = simulation::surfaceEnvelope(*path, *faces, flags.envelope);
    if (!envelope) return failWith(envelope.error());
    Evaluation done{*std::move(path), *std::move(envelope), {}};
    done.summary = simulation::summaryOf(done.envelope, flags.tolerance_mm);
    if (!flags.map.empty())
        if (const auto written = base::writeWholeFile(flags.map, mapText(done)); !written)
            return failWith(written.error());
    if (flags.json)
        sayJson(toJson(flags, done));
    else
        say(toText(flags, done));
    const bool within = done.summary.reached > 0 && done.summary.overcut_max_mm <= flags.tolerance_mm &&
                        done.summary.undercut_max_mm <= flags.tolerance_mm;
    return within ? ExitCode::Done : ExitCode::FoundSomething;
}

}  // namespace

void addEvaluateCommand(CLI::App& app, Action& action) {
    CLI::App* evaluate = app.add_subcommand(
        "evaluate",
        "Says what a CL file leaves on a surface: overcut and material left, along the normal, by the exact envelope.");
    const auto flags = std::make_shared<Flags>();
    evaluate->add_option("FILE", flags->cl_file, "CL file, from any CAM; - for standard input.")->required();
    evaluate->add_option("--nominal", flags->nominal, "Surface file (TOML), in the frame of the part.")->required();
    evaluate->add_option("--grid-mm", flags->envelope.spacing_mm, "Spacing of the points looked at.")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    evaluate
        ->add_option("--band-mm", flags->envelope.band_mm,
                     "How far to each side of the surface is looked; beyond counts as not reached.")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    evaluate->add_option("--tolerance-mm", flags->tolerance_mm, "Deviation to each side that is in order.")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    evaluate->add_option("--map", flags->map, "CSV file to write: every point with its deviation and CL line.");
    evaluate->add_option("--dialect", flags->dialect, "Who wrote the CL file, when it cannot be told from the text.")
        ->check(CLI::IsMember({"nx", "catia", "solidworks", "apt"}));
    evaluate->add_option("--units", flags->units, "Unit of lengths, when the CL file does not say.")
        ->check(CLI::IsMember({"mm", "inch"}));
    evaluate->add_flag("--strict", flags->strict, "Statements that are not understood are errors.");
    evaluate->add_flag("--json", flags->json, "One machine-readable summary on stdout.");
    evaluate->callback([flags, &action] { action = [flags] { return runEvaluate(*flags); }; });
}

}  // namespace cusp::cli
