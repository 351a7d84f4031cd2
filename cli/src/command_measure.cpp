// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp measure`: cuts a path on a machine that has errors, and touches the part with a virtual measuring machine.
#include "command.hpp"
#include "console.hpp"
#include "cut_input.hpp"
#include "input.hpp"
#include "machine_lookup.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/json_report.hpp>
#include <cusp/base/number_text.hpp>
#include <cusp/base/version.hpp>
#include <cusp/geometry/cad/nominal_file.hpp>
#include <cusp/inspect/point_reader.hpp>
#include <cusp/loop/measurement_files.hpp>
#include <cusp/loop/virtual_cmm.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace cusp::cli {

namespace {

struct Flags {
    std::string cl_file;
    std::string machine;
    std::string nominal;
    std::string errors;
    std::string motion;
    std::string sections;
    std::string points;
    std::string approach = "normal";
    std::vector<std::string> outputs;
    std::string truth;
    SetupFlags setup;
    loop::SectionSteps steps;
    loop::CmmOptions cmm;
    bool json = false;
};

base::Result<loop::CmmPlan> planOf(const Flags& flags, const geometry::NominalShape& nominal) {
    if (flags.points.empty())
        return inspect::parseSectionPlan(flags.sections).and_then([&](const inspect::SectionPlan& plan) {
            return loop::sectionTargets(nominal, plan, flags.steps);
        });
    auto input = TextInput::open(flags.points);
    if (!input) return base::fail(input.error());
    base::Diagnostics remarks;
    inspect::PointReaderOptions options;
    options.kind = inspect::PointKind::Surface;
    const auto listed = inspect::readMeasuredPoints(input->stream(), input->name(), options, remarks);
    tell(remarks);
    if (!listed) return base::fail(listed.error());
    return loop::listedTargets(nominal, *listed);
}

base::Result<loop::AxisTrack> trackOf(const Flags& flags, const loop::CutJob& job, const LoadedMachine& machine) {
    if (flags.motion.empty()) return loop::idealTrack(job, machine.model, flags.setup.setup());
    auto input = TextInput::open(flags.motion);
    if (!input) return base::fail(input.error());
    return loop::readTrack(input->stream(), input->name(), machine.model);
}

base::Result<simulation::CutterPath> cutOf(const Flags& flags) {
    const auto machine = loadMachine(flags.machine);
    if (!machine) return base::fail(machine.error());
    loop::MachineErrors errors;
    if (!flags.errors.empty()) {
        auto read = loop::readMachineErrors(flags.errors, machine->model);
        if (!read) return base::fail(read.error());
        errors = *std::move(read);
    }
    const auto real = loop::realMachine(machine->file.machine, errors, flags.setup.setup());
    if (!real) return base::fail(real.error());
    const auto job = readWholeCl(flags.cl_file).and_then(loop::cutJob);
    if (!job) return base::fail(job.error());
    const auto track = trackOf(flags, *job, *machine);
    if (!track) return base::fail(track.error());
    return loop::realPath(*track, *real, job->cutter(), job->part_from_wcs);
}

base::Result<void> writeResults(const Flags& flags, const loop::CmmRun& run) {
    const loop::FileRemarks remarks{fmt::format("cusp measure {}, seed {}: noise {} mm, form {} mm, drift {} mm",
                                                base::version(), flags.cmm.seed, flags.cmm.noise_mm, flags.cmm.form_mm,
                                                flags.cmm.drift_mm)};
    // All formats are known before the first file appears.
    std::vector<std::pair<std::string, std::string>> files;
    for (const std::string& path : flags.outputs) {
        const auto format = loop::measurementFormat(path);
        if (!format) return base::fail(format.error());
        files.emplace_back(path, loop::measurementText(run.points, *format, remarks));
    }
    if (!flags.truth.empty()) {
        std::string text = "x_mm,y_mm,z_mm,deviation_mm\n";
        for (std::size_t i = 0; i < run.targets.size(); ++i)
            text += fmt::format("{},{},{},{}\n", base::formatShortest(run.targets[i].position.x()),
                                base::formatShortest(run.targets[i].position.y()),
                                base::formatShortest(run.targets[i].position.z()),
                                base::formatShortest(run.true_deviation_mm[i]));
        files.emplace_back(flags.truth, std::move(text));
    }
    for (const auto& [path, text] : files) {
        auto target = base::OutputTarget::open(path);
        if (!target) return base::fail(target.error());
        if (auto done = target->write(text); !done) return done;
        if (auto done = target->commit(); !done) return done;
    }
    return {};
}

double largest(const std::vector<double>& values) {
    double out = 0.0;
    for (const double value : values) out = std::max(out, std::abs(value));
    return out;
}

base::Json toJson(const Flags& flags, const loop::CmmRun& run) {
    base::Json out = base::jsonReport("measure", 1);
    out["cl_file"] = flags.cl_file;
    out["nominal"] = flags.nominal;
    out["errors"] = flags.errors.empty() ? base::Json() : base::Json(flags.errors);
    out["motion"] = flags.motion.empty() ? base::Json() : base::Json(flags.motion);
    out["points"] = run.points.size();
    out["not_cut"] = run.not_cut;
    out["sections"] = run.points.section_labels;
    out["probe_radius_mm"] = flags.cmm.probe_radius_mm;
    out["noise_mm"] = flags.cmm.noise_mm;
    out["form_mm"] = flags.cmm.form_mm;
    out["drift_mm"] = flags.cmm.drift_mm;
    out["seed"] = flags.cmm.seed;
    out["true_max_abs_deviation_mm"] = largest(run.true_deviation_mm);
    out["outputs"] = flags.outputs;
    return out;
}

ExitCode runMeasure(const Flags& flags) {
    base::Diagnostics remarks;
    const auto nominal = geometry::loadNominal(flags.nominal, remarks);
    tell(remarks);
    if (!nominal) return failWith(nominal.error());
    const auto plan = planOf(flags, **nominal);
    if (!plan) return failWith(plan.error());
    const auto cut = cutOf(flags);
    if (!cut) return failWith(cut.error());
    if (interrupted()) return ExitCode::Interrupted;
    const auto run = loop::measurePart(*cut, *plan, **nominal, flags.cmm);
    if (!run) return failWith(run.error());
    if (run->not_cut > 0) {
        base::Diagnostics missing;
        missing.warning("measure.not-cut",
                        fmt::format("{} of {} targets are left out: the tool leaves more than 1 mm there", run->not_cut,
                                    plan->targets.size()));
        tell(missing);
    }
    if (const auto done = writeResults(flags, *run); !done) return failWith(done.error());
    if (flags.json)
        sayJson(toJson(flags, *run));
    else if (std::ranges::find(flags.outputs, "-") == flags.outputs.end())
        say(fmt::format("{} points in {} sections, probe radius {} mm, seed {}\n", run->points.size(),
                        run->points.section_labels.size(), flags.cmm.probe_radius_mm, flags.cmm.seed));
    return ExitCode::Done;
}

void addProbeFlags(CLI::App& measure, Flags& flags) {
    measure.add_option("--probe-radius-mm", flags.cmm.probe_radius_mm, "Radius of the ball.")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    measure.add_option("--approach", flags.approach, "Where the probe comes from.")
        ->capture_default_str()
        ->check(CLI::IsMember({"normal", "x", "y", "z", "-x", "-y"}));
    measure.add_option("--noise-mm", flags.cmm.noise_mm, "Standard deviation of a touch.")
        ->capture_default_str()
        ->check(CLI::NonNegativeNumber);
    measure.add_option("--form-mm", flags.cmm.form_mm, "Form error of ball and trigger, full width.")
        ->capture_default_str()
        ->check(CLI::NonNegativeNumber);
    measure.add_option("--drift-mm", flags.cmm.drift_mm, "Drift from the first point to the last.")
        ->capture_default_str()
        ->check(CLI::NonNegativeNumber);
    measure.add_option("--seed", flags.cmm.seed, "Of noise, form and drift.")->capture_default_str();
}

std::optional<geometry::Vector3> approachOf(const std::string& word) {
    if (word == "normal") return std::nullopt;
    geometry::Vector3 out = geometry::Vector3::Zero();
    out[word.back() - 'x'] = word.front() == '-' ? -1.0 : 1.0;
    return out;
}

}  // namespace

void addMeasureCommand(CLI::App& app, Action& action) {
    CLI::App* measure = app.add_subcommand(
        "measure", "Cuts a path on a virtual machine with errors, and measures the part with a virtual CMM.");
    const auto flags = std::make_shared<Flags>();
    measure->add_option("FILE", flags->cl_file, "CL file: the path, and the cutter.")->required();
    measure->add_option("--nominal", flags->nominal, "Nominal surface, in the frame of the part.")->required();
    measure->add_option("-m,--machine", flags->machine, "Machine file, or the name of one that ships with cusp.")
        ->required();
    measure->add_option("--errors", flags->errors,
                        "TOML file with what the machine really has wrong; absent: a perfect machine.");
    measure->add_option("--motion", flags->motion,
                        "What the axes did: the CSV of cusp controller --record; absent: they follow the CL file.");
    addSetupFlags(*measure, flags->setup);
    CLI::Option* sections = measure->add_option("--sections", flags->sections, "Sections, e.g. X=-5,-30,-60,-90.");
    CLI::Option* points =
        measure->add_option("--points", flags->points, "Points to touch instead: a table of points of the nominal.");
    points->excludes(sections);
    measure->add_option("--step-mm", flags->steps.step_mm, "Between the points of a section.")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    measure->add_option("--edge-margin-mm", flags->steps.edge_margin_mm, "Points stay so far from edges.")
        ->capture_default_str()
        ->check(CLI::NonNegativeNumber);
    addProbeFlags(*measure, *flags);
    measure
        ->add_option(
            "-o,--output", flags->outputs,
            "File of probe centres: .csv, .dmo (DMIS output) or .qif; - for CSV on stdout; may come several times.")
        ->required();
    measure->add_option("--truth", flags->truth, "CSV of the true deviations, which no measurement knows.");
    measure->add_flag("--json", flags->json, "One machine-readable summary on stdout.");
    measure->callback([flags, &action] {
        if (flags->sections.empty() && flags->points.empty())
            throw CLI::ValidationError("measure", "needs --sections or --points");
        flags->cmm.approach = approachOf(flags->approach);
        action = [flags] { return runMeasure(*flags); };
    });
}

}  // namespace cusp::cli
