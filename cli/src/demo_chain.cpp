// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Plan, post, send, run, cut, measure, inspect, correct, and once more.
#include "demo_chain.hpp"

#include "calibration_output.hpp"
#include "inspect_output.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/version.hpp>
#include <cusp/geometry/cad/nominal_file.hpp>
#include <cusp/geometry/surface_file.hpp>
#include <cusp/loop/measurement_files.hpp>
#include <cusp/toolpath/cl_writer.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

namespace cusp::cli {

namespace {

namespace fs = std::filesystem;

/// Fountas 2017, eq. 14; the folder gets it as a file.
constexpr const char* benchmark_surface =
    R"(# The benchmark surface: eq. 14 of Fountas, Vaxevanidis, Stergiou, Benhadj-Djilali (2017), u, v in 0 … 1.
schema = 1
name = "Benchmark surface"
description = "Fountas et al. 2017, eq. 14"

[[face]]
form = "polynomial"
outward = "du x dv"
x_mm = { "1" = -94.4, "v" = 88.9, "v^2" = 5.6 }
y_mm = { "u" = -131.3, "u^2" = 28.1 }
z_mm = { "u^2 v^2" = 5.9, "u^2 v" = 5.9, "u v^2" = -3.9, "u^2" = 76.2, "v^2" = 6.7, "u v" = -27.3, "u" = -50.8, "v" = 25.0, "1" = 12.1 }
)";

constexpr double edge_margin_mm = 2.0;
constexpr double presetter_mm = 0.002;
constexpr double tram_deg = 0.0005;
/// Streams of the seed, one a purpose.
enum Stream : std::uint64_t { ErrorStream = 1, FirstPartStream, UncorrectedStream, SecondPartStream, ArtefactStream };

class Chain {
public:
    Chain(const DemoOptions& options, const DemoTold& told)
        : demo_(std::make_unique<Demo>()), told_(told), random_(options.seed) {
        demo_->options = options;
    }

    base::Result<std::unique_ptr<Demo>> run() {
        using Step = base::Result<void> (Chain::*)();
        constexpr Step steps[] = {&Chain::prepare,          &Chain::plan,          &Chain::sendAndRun,
                                  &Chain::firstPart,        &Chain::doNothing,     &Chain::correct,
                                  &Chain::calibrateMachine, &Chain::cutCalibrated, &Chain::whatRemains};
        for (const Step step : steps)
            if (const auto done = (this->*step)(); !done) return base::fail(done.error());
        return std::move(demo_);
    }

private:
    base::Result<void> tell(const std::string& what) {
        if (!told_(what)) return base::fail("demo.interrupted", "interrupted before: " + what);
        return {};
    }
    [[nodiscard]] std::string path(const std::string& name) const {
        return (fs::path(demo_->options.folder) / name).string();
    }
    base::Result<void> write(const std::string& name, const std::string& text) {
        std::error_code error;
        fs::create_directories(fs::path(path(name)).parent_path(), error);
        if (error) return base::fail("io.open", path(name) + ": " + error.message());
        return base::writeWholeFile(path(name), text);
    }
    base::Result<void> writeCl(const std::string& name, const toolpath::ToolPath& cl) {
        return toolpath::clText(cl).and_then([&](const std::string& text) { return write(name, text); });
    }
    [[nodiscard]] std::uint64_t seedOf(Stream stream) const { return random_.split(stream).next(); }

    base::Result<void> writePart(const std::string& folder, const loop::MeasuredPart& part, std::uint64_t seed) {
        const auto text = loop::measurementText(part.measurement.points, "csv",
                                                {fmt::format("cusp demo {}, seed {}", base::version(), seed)});
        if (auto done = write(folder + "/measured.csv", text); !done) return done;
        return writeInspection(path(folder), part.report);
    }

    base::Result<void> prepare() {
        auto machine = loadMachine(demo_->options.machine);
        if (!machine) return base::fail(machine.error());
        demo_->machine = std::make_unique<LoadedMachine>(*std::move(machine));
        std::string nominal = demo_->options.nominal;
        if (nominal.empty()) {
            nominal = path("surface.toml");
            if (auto done = write("surface.toml", benchmark_surface); !done) return done;
        }
        base::Diagnostics remarks;
        auto shape = geometry::loadNominal(nominal, remarks);
        if (!shape) return base::fail(shape.error());
        auto* faces = dynamic_cast<geometry::ParametricSurface*>(shape->get());
        if (faces == nullptr || faces->trimmedFaces() > 0)
            return base::fail("demo.nominal", "the nominal must be made of untrimmed faces", {nominal, 0, 0, {}});
        demo_->nominal = std::make_unique<geometry::ParametricSurface>(std::move(*faces));
        demo_->tool.number = 1;
        demo_->tool.name = "TOROID_D16_R3";
        demo_->tool.shape = toolpath::Tool::Shape::Toroidal;
        demo_->tool.diameter_mm = 16.0;
        demo_->tool.corner_radius_mm = 3.0;
        demo_->tool.cutting_height_mm = 50.0;
        demo_->tool.gauge_length_mm = 120.0;
        demo_->setup.tool_length_mm = demo_->tool.gauge_length_mm;
        demo_->setup.wcs_origin_mm = originInTheMiddle();
        task_.file = &demo_->machine->file;
        task_.machine = &demo_->machine->model;
        task_.setup = demo_->setup;
        task_.nominal = demo_->nominal.get();
        task_.link = demo_->options.link;
        task_.inspection.nominal = demo_->nominal.get();
        task_.inspection.nominal_file = nominal;
        return planSections();
    }

    base::Result<void> planSections() {
        const auto sections = inspect::parseSectionPlan(demo_->options.sections);
        if (!sections) return base::fail(sections.error());
        loop::SectionSteps steps;
        steps.edge_margin_mm = edge_margin_mm;
        auto plan = loop::sectionTargets(*demo_->nominal, *sections, steps);
        if (!plan) return base::fail(plan.error());
        task_.inspection.plan = *std::move(plan);
        task_.inspection.inspection.sections = *sections;
        task_.inspection.inspection.limits =
            inspect::ToleranceLimits{-demo_->options.limit_mm, demo_->options.limit_mm};
        task_.inspection.inspection.judge_in_datum = true;
        return {};
    }

    /// The part in the middle of the linear axes' travel, the tool above it well below their upper end.
    [[nodiscard]] geometry::Vector3 originInTheMiddle() const {
        geometry::Vector3 out = geometry::Vector3::Zero();
        for (std::size_t i = 0; i < 3; ++i) {
            const auto& range = demo_->machine->model.linearRange(i);
            const auto& axis = demo_->machine->file.machine.linear.at(demo_->machine->model.linearNames().at(i));
            const geometry::Vector3 direction(axis.direction[0], axis.direction[1], axis.direction[2]);
            const double share = std::abs(direction.z()) > 0.7 ? 0.3 : 0.5;
            out += (range.endless ? 0.0 : range.min + share * (range.max - range.min)) * direction;
        }
        const auto& gauge = demo_->machine->file.machine.spindle.gauge_point_mm;
        return out + geometry::Vector3(gauge[0], gauge[1], gauge[2]) -
               demo_->setup.tool_length_mm * geometry::Vector3::UnitZ();
    }

    base::Result<void> plan() {
        if (auto go = tell("planning a path within ±" + fmt::format("{}", demo_->options.budget_mm) + " mm"); !go)
            return go;
        loop::BudgetOptions options;
        options.budget_mm = demo_->options.budget_mm;
        auto plan = loop::planWithinBudget(*demo_->nominal, demo_->tool, options);
        if (!plan) return base::fail(plan.error());
        demo_->plan = *std::move(plan);
        task_.path = &demo_->plan.path;
        task_.inspection.inspection.planned_step_over_mm = demo_->plan.step_over_mm;
        auto job = loop::cutJob(demo_->plan.path);
        if (!job) return base::fail(job.error());
        job_ = *std::move(job);
        return writeCl("first.apt", demo_->plan.path);
    }

    base::Result<void> sendAndRun() {
        if (auto go = tell("posting, and sending over " + demo_->options.link); !go) return go;
        base::Diagnostics warnings;
        auto program = loop::postPath(demo_->plan.path, *task_.file, *task_.machine, "FIRST", warnings);
        if (!program) return base::fail(program.error());
        demo_->program = *std::move(program);
        if (auto done = write("first.MPF", demo_->program.text); !done) return done;
        auto run = loop::runProgram(demo_->program, *task_.file, *task_.machine, task_.setup, task_.link);
        if (!run) return base::fail(run.error());
        demo_->run = *std::move(run);
        return {};
    }

    base::Result<void> firstPart() {
        if (auto go = tell("cutting on a machine with hidden errors, measuring, inspecting"); !go) return go;
        base::Random errors = random_.split(ErrorStream);
        task_.inspection.cmm.seed = seedOf(FirstPartStream);
        auto first = loop::firstPartOut(task_, demo_->run.track, job_, loop::drawErrors(*task_.machine, errors),
                                        demo_->options.out_mm);
        if (!first) return base::fail(first.error());
        demo_->first = *std::move(first);
        if (auto done = write("hidden_errors.toml", loop::toToml(demo_->first.hidden)); !done) return done;
        return writePart("before", demo_->first.part, task_.inspection.cmm.seed);
    }

    base::Result<void> doNothing() {
        if (auto go = tell("cutting a second part with nothing done"); !go) return go;
        const auto real = loop::realMachine(task_.file->machine, demo_->first.hidden, task_.setup);
        if (!real) return base::fail(real.error());
        loop::InspectionTask again = task_.inspection;
        again.cmm.seed = seedOf(UncorrectedStream);
        auto part = loop::cutAndMeasure(demo_->run.track, job_, *real, again);
        if (!part) return base::fail(part.error());
        demo_->uncorrected = *std::move(part);
        return writePart("uncorrected", demo_->uncorrected, again.cmm.seed);
    }

    base::Result<void> correct() {
        if (auto go = tell("mirroring the deviation into the path, sending, cutting, measuring"); !go) return go;
        const std::uint64_t seed = seedOf(SecondPartStream);
        auto second = loop::secondPart(task_, demo_->first.hidden, demo_->first.part, seed);
        if (!second) return base::fail(second.error());
        demo_->second = *std::move(second);
        if (auto done = writeCl("corrected.apt", demo_->second.corrected.path); !done) return done;
        if (auto done = write("corrected.MPF", demo_->second.program.text); !done) return done;
        return writePart("after", demo_->second.part, seed);
    }

    base::Result<void> calibrateMachine() {
        if (!demo_->options.calibrate) return {};
        if (auto go = tell("cutting the artefact and finding what the machine has wrong"); !go) return go;
        const auto artefact = loop::planArtefact({});
        if (!artefact) return base::fail(artefact.error());
        if (auto done = write("calibration/artefact.toml", artefact->surface_toml); !done) return done;
        if (auto done = writeCl("calibration/artefact.apt", artefact->path); !done) return done;
        auto faces = geometry::readSurface(artefact->surface_toml, "artefact.toml");
        if (!faces) return base::fail(faces.error());
        const geometry::ParametricSurface nominal(*std::move(faces));
        const auto job = loop::cutJob(artefact->path);
        if (!job) return base::fail(job.error());
        base::Diagnostics warnings;
        const auto program = loop::postPath(artefact->path, *task_.file, *task_.machine, "ARTEFACT", warnings);
        if (!program) return base::fail(program.error());
        const auto run = loop::runProgram(*program, *task_.file, *task_.machine, task_.setup, {});
        if (!run) return base::fail(run.error());
        const auto real = loop::realMachine(task_.file->machine, demo_->first.hidden, task_.setup);
        if (!real) return base::fail(real.error());
        loop::CmmOptions cmm;
        cmm.seed = seedOf(ArtefactStream);
        const auto cut = loop::realPath(run->track, *real, job->cutter(), job->part_from_wcs);
        const auto measured = loop::measurePart(cut, artefact->plan, nominal, cmm);
        if (!measured) return base::fail(measured.error());
        const auto table =
            loop::measurementText(measured->points, "csv", {fmt::format("cusp demo {}", base::version())});
        if (auto done = write("calibration/artefact.csv", table); !done) return done;
        const loop::CalibrationPart part{.name = "artefact",
                                         .job = &*job,
                                         .track = &run->track,
                                         .nominal = &nominal,
                                         .points = &measured->points,
                                         .probe_radius_mm = cmm.probe_radius_mm};
        loop::CalibrationOptions options;
        base::Random presetter = random_.split(ArtefactStream);
        options.known.push_back({"tool_length_mm",
                                 demo_->first.hidden.at("tool_length_mm") + presetter.normal(0.0, presetter_mm),
                                 presetter_mm});
        if (task_.machine->rotaryCount() > 0) {
            const std::string zero = "zero_" + task_.machine->rotaryNames().back() + "_deg";
            options.known.push_back({zero, demo_->first.hidden.at(zero) + presetter.normal(0.0, tram_deg), tram_deg});
        }
        auto found = loop::calibrate(task_.file->machine, task_.setup, {part}, options);
        if (!found) return base::fail(found.error());
        demo_->calibration = *std::move(found);
        return writeCalibration();
    }

    base::Result<void> writeCalibration() {
        const auto& found = *demo_->calibration;
        post::MachineFile corrected = *task_.file;
        corrected.machine = loop::correctedMachine(corrected.machine, found.corrections());
        if (auto done = write("calibration/machine.toml", post::toToml(corrected)); !done) return done;
        if (auto done = write("calibration/errors.toml", loop::toToml(found.corrections())); !done) return done;
        return base::jsonText(calibrationJson("", task_.file->machine, found)).and_then([&](const std::string& text) {
            return write("calibration/calibration.json", text);
        });
    }

    /// The first path again, on a control with the data found entered: machine file, tool length, zeros of rotary axes.
    base::Result<void> cutCalibrated() {
        if (!demo_->calibration) return {};
        if (auto go = tell("cutting with the machine's data corrected"); !go) return go;
        const loop::MachineErrors corrections = demo_->calibration->corrections();
        post::MachineFile file = *task_.file;
        file.machine = loop::correctedMachine(file.machine, corrections);
        const kinematics::Machine machine(file.machine);
        loop::CuttingSetup setup = task_.setup;
        if (const auto length = corrections.find("tool_length_mm"); length != corrections.end())
            setup.tool_length_mm += length->second;
        base::Diagnostics warnings;
        const auto program = loop::postPath(demo_->plan.path, file, machine, "CALIBRATED", warnings);
        if (!program) return base::fail(program.error());
        auto run = loop::runProgram(*program, file, machine, setup, {});
        if (!run) return base::fail(run.error());
        const auto zeros = loop::realMachine(task_.file->machine, corrections, task_.setup);
        if (!zeros) return base::fail(zeros.error());
        for (dynamics::AxisVector& axes : run->track.axes)
            for (std::size_t i = 0; i < 2; ++i) axes.at(3 + i) -= zeros->zero_rad.at(i);
        const auto real = loop::realMachineBehind(task_.file->machine, task_.setup, demo_->first.hidden, file.machine,
                                                  setup, zeros->zero_rad);
        if (!real) return base::fail(real.error());
        loop::InspectionTask again = task_.inspection;
        again.cmm.seed = seedOf(ArtefactStream);
        auto part = loop::cutAndMeasure(run->track, job_, *real, again);
        if (!part) return base::fail(part.error());
        demo_->calibrated = *std::move(part);
        return writePart("calibrated", *demo_->calibrated, again.cmm.seed);
    }

    /// The path alone, then the control's way with it, both on a machine without errors.
    base::Result<void> whatRemains() {
        const auto largest = [](const std::vector<std::optional<double>>& values) {
            double out = 0.0;
            for (const auto& value : values)
                if (value) out = std::max(out, std::abs(*value));
            return out;
        };
        const auto alone = loop::trueDeviations(job_.path, task_.inspection.plan.targets);
        if (!alone) return base::fail(alone.error());
        const auto exact = loop::realMachine(task_.file->machine, {}, task_.setup);
        if (!exact) return base::fail(exact.error());
        const auto driven = loop::trueDeviations(
            loop::realPath(demo_->run.track, *exact, job_.cutter(), job_.part_from_wcs), task_.inspection.plan.targets);
        if (!driven) return base::fail(driven.error());
        demo_->path_remains_mm = largest(*alone);
        for (std::size_t i = 0; i < alone->size(); ++i)
            if ((*alone)[i] && (*driven)[i])
                demo_->control_mm = std::max(demo_->control_mm, std::abs(*(*driven)[i] - *(*alone)[i]));
        return {};
    }

    std::unique_ptr<Demo> demo_;
    const DemoTold& told_;
    base::Random random_;
    loop::LoopTask task_;
    loop::CutJob job_;
};

}  // namespace

base::Result<std::unique_ptr<Demo>> runDemo(const DemoOptions& options, const DemoTold& told) {
    return Chain(options, told).run();
}

}  // namespace cusp::cli
