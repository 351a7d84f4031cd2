// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp calibrate`: what the machine definition has wrong, from measured parts; or a part to find it with.
#include "calibration_output.hpp"
#include "command.hpp"
#include "console.hpp"
#include "cut_input.hpp"
#include "input.hpp"
#include "machine_lookup.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/toml_node.hpp>
#include <cusp/base/units.hpp>
#include <cusp/geometry/cad/nominal_file.hpp>
#include <cusp/inspect/point_reader.hpp>
#include <cusp/loop/artefact.hpp>
#include <cusp/loop/calibration_job.hpp>
#include <cusp/toolpath/cl_writer.hpp>

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace cusp::cli {

namespace {

namespace fs = std::filesystem;

struct Flags {
    std::string job;
    std::string output;
    bool plan = false;
    double ball_mm = 10.0;
    double tilt_deg = 50.0;
    bool json = false;
};

/// Everything a part of the calibration points to.
struct LoadedPart {
    loop::CutJob job;
    loop::AxisTrack track;
    std::unique_ptr<geometry::NominalShape> nominal;
    inspect::MeasuredPoints points;
    double probe_radius_mm = 0.0;
};

base::Result<loop::CalibrationJob> readJob(const std::string& path) {
    const auto document = base::TomlDocument::readFile(path);
    if (!document) return base::fail(document.error());
    base::Diagnostics report;
    loop::CalibrationJob job = loop::calibrationJobSection().read(document->root(), report);
    if (report.hasErrors()) return base::fail(std::move(report));
    return job;
}

base::Result<double> probeRadius(const loop::CalibrationPartJob& part, const inspect::MeasuredPoints& points,
                                 const std::string& file) {
    if (part.probe_radius_mm) return *part.probe_radius_mm;
    if (points.kind == inspect::PointKind::Surface) return 0.0;
    if (points.probe_radius_mm) return *points.probe_radius_mm;
    return base::fail("calibrate.radius",
                      "the file does not state the probe's radius; give probe_radius_mm for this part "
                      "(0 for surface points)",
                      {file, 0, 0, {}});
}

base::Result<LoadedPart> loadPart(const std::string& job_file, const loop::CalibrationJob& job,
                                  const loop::CalibrationPartJob& part, const LoadedMachine& machine) {
    LoadedPart out;
    auto cut = readWholeCl(besideFile(job_file, part.cl_file)).and_then(loop::cutJob);
    if (!cut) return base::fail(cut.error());
    out.job = *std::move(cut);
    base::Diagnostics remarks;
    auto nominal = geometry::loadNominal(besideFile(job_file, part.nominal), remarks);
    if (!nominal) return base::fail(nominal.error());
    out.nominal = *std::move(nominal);
    const std::string points_file = besideFile(job_file, part.points);
    auto input = TextInput::open(points_file);
    if (!input) return base::fail(input.error());
    auto points = inspect::readMeasuredPoints(input->stream(), input->name(), {}, remarks);
    if (!points) return base::fail(points.error());
    out.points = *std::move(points);
    const auto radius = probeRadius(part, out.points, points_file);
    if (!radius) return base::fail(radius.error());
    out.probe_radius_mm = *radius;
    tell(remarks);
    const loop::CuttingSetup setup{.tool_length_mm = job.tool_length_mm,
                                   .wcs_origin_mm = geometry::toVector(job.wcs_origin_mm)};
    if (part.motion.empty()) {
        auto track = loop::idealTrack(out.job, machine.model, setup);
        if (!track) return base::fail(track.error());
        out.track = *std::move(track);
        return out;
    }
    auto record = TextInput::open(besideFile(job_file, part.motion));
    if (!record) return base::fail(record.error());
    auto track = loop::readTrack(record->stream(), record->name(), machine.model);
    if (!track) return base::fail(track.error());
    out.track = *std::move(track);
    return out;
}

base::Result<loop::CalibrationResult> calibrateParts(const Flags& flags, const loop::CalibrationJob& job,
                                                     const LoadedMachine& machine) {
    std::vector<LoadedPart> loaded;
    for (const loop::CalibrationPartJob& part : job.parts) {
        auto next = loadPart(flags.job, job, part, machine);
        if (!next) return base::fail(next.error());
        loaded.push_back(*std::move(next));
    }
    std::vector<loop::CalibrationPart> parts;
    for (std::size_t i = 0; i < loaded.size(); ++i)
        parts.push_back({.name = fileNameOf(job.parts[i].points),
                         .job = &loaded[i].job,
                         .track = &loaded[i].track,
                         .nominal = loaded[i].nominal.get(),
                         .points = &loaded[i].points,
                         .probe_radius_mm = loaded[i].probe_radius_mm,
                         .fixed_datums = job.parts[i].datums == loop::CalibrationPartJob::Datums::Fixed});
    loop::CalibrationOptions options{.noise_mm = job.noise_mm, .drift = job.drift, .lobes = job.lobes, .known = {}};
    for (const loop::KnownJob& known : job.known) options.known.push_back({known.name, known.value, known.uncertainty});
    return loop::calibrate(
        machine.file.machine,
        {.tool_length_mm = job.tool_length_mm, .wcs_origin_mm = geometry::toVector(job.wcs_origin_mm)}, parts, options);
}

base::Result<void> writeFolder(const std::string& folder,
                               const std::vector<std::pair<std::string, std::string>>& files) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) return base::fail("io.open", folder + ": " + error.message());
    for (const auto& [name, text] : files)
        if (auto done = base::writeWholeFile((fs::path(folder) / name).string(), text); !done) return done;
    return {};
}

ExitCode runCalibrate(const Flags& flags) {
    const auto job = readJob(flags.job);
    if (!job) return failWith(job.error());
    // A machine file beside the job goes before one that ships.
    std::error_code ignored;
    const std::string near = besideFile(flags.job, job->machine);
    const auto machine = loadMachine(fs::exists(near, ignored) ? near : job->machine);
    if (!machine) return failWith(machine.error());
    const auto result = calibrateParts(flags, *job, *machine);
    if (!result) return failWith(result.error());
    if (interrupted()) return ExitCode::Interrupted;
    post::MachineFile corrected = machine->file;
    corrected.machine = loop::correctedMachine(machine->file.machine, result->corrections());
    const base::Json json = calibrationJson(flags.job, machine->file.machine, *result);
    const auto json_text = base::jsonText(json);
    if (!json_text) return failWith(json_text.error());
    const auto done = writeFolder(flags.output, {{"machine.toml", post::toToml(corrected)},
                                                 {"errors.toml", loop::toToml(result->corrections())},
                                                 {"calibration.json", *json_text}});
    if (!done) return failWith(done.error());
    if (flags.json)
        sayJson(json);
    else
        say(calibrationText(machine->file.machine, *result));
    return result->converged ? ExitCode::Done : ExitCode::FoundSomething;
}

base::Result<std::string> lastRotaryOf(const std::string& machine) {
    const auto loaded = loadMachine(machine);
    if (!loaded) return base::fail(loaded.error());
    const auto& rotary = loaded->model.rotaryNames();
    if (rotary.size() < 2)
        return base::fail("calibrate.machine",
                          machine + ": the artefact is cut with tilts to all sides, which needs two rotary axes");
    return rotary.back();
}

/// The job that goes with the artefact. `last_rotary` is the axis next to the tool: a ball hides how the tool leans, which is that
/// axis's zero.
std::string planJob(const std::string& machine, const std::string& last_rotary) {
    return fmt::format(R"(schema = 1
machine = "{}"
# As the control has them when the artefact is cut.
tool_length_mm = 100.0
wcs_origin_mm = [0.0, 0.0, 0.0]

[[part]]
cl_file = "artefact.apt"
nominal = "artefact.toml"
points = "artefact.csv"

# Pivot and tool length act as a sum: the presetter's word.
[[known]]
name = "tool_length_mm"
value = 0.0
uncertainty = 0.002

# A ball hides how the tool leans: an indicator's word, the spindle trammed.
[[known]]
name = "zero_{}_deg"
value = 0.0
uncertainty = 0.0005
)",
                       machine, last_rotary);
}

ExitCode runPlan(const Flags& flags) {
    const std::string machine = flags.job.empty() ? "fooke-endura-ca" : flags.job;
    const auto last_rotary = lastRotaryOf(machine);
    if (!last_rotary) return failWith(last_rotary.error());
    loop::ArtefactOptions options;
    options.ball_diameter_mm = flags.ball_mm;
    options.largest_tilt_rad = base::radFromDeg(flags.tilt_deg);
    const auto artefact = loop::planArtefact(options);
    if (!artefact) return failWith(artefact.error());
    const auto cl = toolpath::clText(artefact->path);
    if (!cl) return failWith(cl.error());
    const auto done = writeFolder(flags.output, {{"artefact.apt", *cl},
                                                 {"artefact.toml", artefact->surface_toml},
                                                 {"targets.csv", loop::planTable(artefact->plan)},
                                                 {"job.toml", planJob(machine, *last_rotary)}});
    if (!done) return failWith(done.error());
    if (flags.json) {
        base::Json out = base::jsonReport("calibrate", 1);
        out["plan"] = flags.output;
        out["grooves"] = artefact->grooves;
        out["points"] = artefact->plan.targets.size();
        out["locations"] = artefact->path.records.size();
        sayJson(out);
    } else {
        say(fmt::format(
            "{}: {} grooves, {} points to measure\n  artefact.apt   the path, for cusp post\n  artefact.toml  the "
            "nominal\n  targets.csv    points to touch, for cusp measure or a real machine\n  job.toml       for "
            "cusp calibrate, once artefact.csv is measured\n",
            flags.output, artefact->grooves, artefact->plan.targets.size()));
    }
    return ExitCode::Done;
}

}  // namespace

void addCalibrateCommand(CLI::App& app, Action& action) {
    CLI::App* calibrate = app.add_subcommand(
        "calibrate", "Finds what the machine definition has wrong, from measured parts, with its uncertainty.");
    const auto flags = std::make_shared<Flags>();
    calibrate->add_option("JOB", flags->job, "Job file (TOML); with --plan: the machine, or nothing.");
    calibrate
        ->add_option(
            "-o,--output", flags->output,
            "Folder for machine.toml (corrected), errors.toml, calibration.json; with --plan: for the artefact.")
        ->required();
    calibrate->add_flag("--plan", flags->plan,
                        "Writes a part that shows the errors: its path, its nominal, its points, its job.");
    calibrate->add_option("--ball-mm", flags->ball_mm, "Diameter of the ball mill, with --plan.")
        ->capture_default_str();
    calibrate->add_option("--tilt-deg", flags->tilt_deg, "Largest tilt from the vertical, with --plan.")
        ->capture_default_str();
    calibrate->add_flag("--json", flags->json, "One machine-readable summary on stdout.");
    calibrate->callback([flags, &action] {
        if (!flags->plan && flags->job.empty()) throw CLI::RequiredError("JOB");
        action = [flags] { return flags->plan ? runPlan(*flags) : runCalibrate(*flags); };
    });
}

}  // namespace cusp::cli
