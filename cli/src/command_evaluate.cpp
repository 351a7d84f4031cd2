// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp evaluate`: what a CL file, whoever made it, leaves on a surface.
#include "command.hpp"
#include "console.hpp"
#include "finishing_input.hpp"
#include "input.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/json_report.hpp>
#include <cusp/base/number_text.hpp>
#include <cusp/base/units.hpp>
#include <cusp/optimizer/finishing/machine_time.hpp>
#include <cusp/optimizer/finishing/path_criteria.hpp>
#include <cusp/simulation/surface_envelope.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace cusp::cli {

namespace {

/// Of the chords that stand for arcs of the CL file: far below any tolerance that is asked for.
constexpr double chord_mm = 1e-4;
constexpr double seconds_per_minute = 60.0;
constexpr double infinite = std::numeric_limits<double>::infinity();

struct Flags {
    std::string cl_file;
    std::string nominal;
    std::string map;
    std::string dialect;
    std::string units;
    std::string machine;
    double tool_length_mm = 150.0;
    double edge_radius_mm = 0.0;
    double reach_mm = 0.05;
    simulation::EnvelopeOptions envelope;
    double tolerance_mm = 0.01;
    bool strict = false;
    bool json = false;
};

/// A path, and the feeds of its file: each holds from its line to the next.
struct TimedPath {
    simulation::CutterPath path;
    std::vector<std::pair<std::uint32_t, double>> feeds_mm_per_s;
};

struct Evaluation {
    simulation::CutterPath path;
    simulation::SurfaceEnvelope envelope;
    simulation::EnvelopeSummary summary;
    finishing::PathCriteria criteria;
    std::optional<finishing::MachineTime> time;

    [[nodiscard]] const simulation::ToolMove& moveAt(std::size_t point) const {
        return path.moves[envelope.points[point].move];
    }
};

base::Result<TimedPath> readMoves(const Flags& flags) {
    auto input = ClInput::open(flags.cl_file, clReaderOptions(flags.dialect, flags.units, flags.strict));
    if (!input) return base::fail(input.error());
    base::Diagnostics report;
    simulation::PathCollector collector(input->text().name(), chord_mm, report);
    TimedPath out;
    double turns_per_s = 0.0;
    for (toolpath::ClRecord record; input->reader().next(record);) {
        collector.take(record);
        if (const auto* spindle = std::get_if<toolpath::SpindleCommand>(&record.statement);
            spindle != nullptr && spindle->speed && spindle->unit == toolpath::SpindleCommand::Unit::Rpm)
            turns_per_s = *spindle->speed / seconds_per_minute;
        if (const auto* feed = std::get_if<toolpath::FeedRate>(&record.statement)) {
            const bool per_turn = feed->unit == toolpath::FeedRate::Unit::MmPerRev;
            out.feeds_mm_per_s.emplace_back(record.line, per_turn ? feed->value * turns_per_s : feed->value);
        }
    }
    base::Diagnostics all = input->reader().report();
    all.append(report);
    if (all.hasErrors()) return base::fail(std::move(all));
    tell(all);
    out.path = collector.finish();
    return out;
}

/// Error `evaluate.feed` where a feed move has none.
base::Result<std::vector<finishing::TimedMove>> timedMovesOf(const TimedPath& timed) {
    std::vector<finishing::TimedMove> out;
    const auto& moves = timed.path.moves;
    if (!moves.empty()) out.push_back({moves.front().from, infinite, moves.front().line});
    for (const simulation::ToolMove& move : moves) {
        double feed = infinite;
        if (move.kind == toolpath::MotionKind::Feed) {
            const auto next = std::upper_bound(timed.feeds_mm_per_s.begin(), timed.feeds_mm_per_s.end(), move.line,
                                               [](std::uint32_t line, const auto& at) { return line < at.first; });
            feed = next == timed.feeds_mm_per_s.begin() ? 0.0 : (next - 1)->second;
            if (!(feed > 0.0))
                return base::fail(
                    "evaluate.feed",
                    "a move at feed, and no feed is known there: FEDRAT before it (with SPINDL where it is per "
                    "turn) would say how long it takes",
                    {.file = {}, .line = move.line, .column = 0, .key = {}});
        }
        out.push_back({move.to, feed, move.line});
    }
    return out;
}

base::Json placeOf(const Evaluation& done, std::size_t point, double value_mm) {
    if (value_mm <= 0.0) return {};
    const auto& at = done.envelope.grid.points[point];
    return {{"position_mm", {at.position.x(), at.position.y(), at.position.z()}}, {"cl_line", done.moveAt(point).line}};
}

base::Json spreadJson(const finishing::Spread& spread) {
    if (spread.count == 0) return {};
    return {{"least", spread.least}, {"mean", spread.mean}, {"most", spread.most}};
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
    const auto& criteria = done.criteria;
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
    out["cutting_length_mm"] = criteria.cutting_length_mm;
    out["machining_time_s"] = done.time ? base::Json(done.time->total_s) : base::Json();
    out["rotary_travel_deg"] = done.time ? base::Json{base::degFromRad(done.time->rotary_travel_rad[0]),
                                                      base::degFromRad(done.time->rotary_travel_rad[1])}
                                         : base::Json();
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
    const auto& criteria = done.criteria;
    out += fmt::format("  contact points     {:8} in {} passes over {:.1f} mm\n", criteria.cc_points, criteria.passes,
                       criteria.cutting_length_mm);
    out += fmt::format("  chord error        {:8.4f} mm mean, {:.4f} mm at most\n", criteria.chord_error_mm.mean,
                       criteria.chord_error_mm.most);
    if (criteria.scallop_mm.count > 0)
        out +=
            fmt::format("  scallop (eq. 4)    {:8.4f} to {:.4f} mm; below 0 the cutter is flatter than the surface\n",
                        criteria.scallop_mm.least, criteria.scallop_mm.most);
    if (done.time) out += fmt::format("  machining time     {:8.2f} s\n", done.time->total_s);
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
    auto timed = readMoves(flags);
    if (!timed) return failWith(timed.error());
    const auto part = loadPart(flags.nominal, {});
    if (!part) return failWith(part.error());
    auto envelope = simulation::surfaceEnvelope(timed->path, part->chosen, flags.envelope);
    if (!envelope) return failWith(envelope.error());
    Evaluation done;
    if (!flags.machine.empty()) {
        const auto machine = loadMachine(flags.machine);
        if (!machine) return failWith(machine.error());
        const auto moves = timedMovesOf(*timed);
        if (!moves) return failWith(moves.error());
        finishing::MachineSetting setting;
        setting.machine = &machine->model;
        setting.tool_length_mm = flags.tool_length_mm;
        setting.tolerance_mm = machine->file.control.cycle832_tolerance_mm;
        setting.orientation_tolerance_rad = machine->file.control.cycle832_orientation_tolerance_rad;
        auto time = finishing::machineTime(*moves, setting);
        if (!time) return failWith(time.error());
        done.time = *time;
    }
    done.criteria =
        finishing::judgeContacts(finishing::findContacts(timed->path, *part->shape, {.reach_mm = flags.reach_mm}),
                                 timed->path.cutters, flags.edge_radius_mm);
    done.path = std::move(timed->path);
    done.envelope = *std::move(envelope);
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
    evaluate->add_option("--nominal", flags->nominal, "The surface, in the frame of the part: .toml, .step or .iges.")
        ->required();
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
    evaluate->add_option("-m,--machine", flags->machine,
                         "Machine file, or the name of one that ships: how long the path takes on it.");
    evaluate->add_option("--tool-length-mm", flags->tool_length_mm, "Tip to gauge point, for the time.")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    evaluate
        ->add_option("--contact-reach-mm", flags->reach_mm,
                     "A location is a contact where the cutter comes this near to the surface, at feed.")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    evaluate
        ->add_option("--edge-radius-mm", flags->edge_radius_mm, "Of the inserts of flat cutters, for their undercut.")
        ->check(CLI::NonNegativeNumber);
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
