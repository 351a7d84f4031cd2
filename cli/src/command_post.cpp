// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp post`: a CL file becomes a Sinumerik 840D program, or nothing is written and the reason is told.
#include "command.hpp"
#include "console.hpp"
#include "cycle_time.hpp"
#include "input.hpp"
#include "job_file.hpp"
#include "machine_lookup.hpp"
#include "post_text.hpp"
#include "program_file.hpp"
#include "progress_bar.hpp"
#include "setup_lookup.hpp"
#include "setup_sheet.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/json_report.hpp>
#include <cusp/base/toml_node.hpp>
#include <cusp/base/units.hpp>
#include <cusp/base/version.hpp>
#include <cusp/post/writer/post_options.hpp>
#include <cusp/post/writer/program_planner.hpp>
#include <cusp/post/writer/sinumerik_writer.hpp>
#include <cusp/post/writer/travel_check.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cusp::cli {

namespace {

/// How often the progress bar is asked to look.
constexpr std::uint64_t records_per_look = 4096;

/// Without being asked cycle time is estimated up to here: some seconds.
constexpr std::size_t moves_estimated = 50'000;

struct Flags {
    std::string cl_file;
    std::string machine;
    std::string output;
    std::string config;
    std::string dialect;
    std::string units;
    std::optional<std::string> program_name;
    std::optional<std::string> work_offset;
    std::optional<std::string> setup;
    std::optional<double> spindle_rpm;
    std::string form;
    std::string feed_mode;
    std::optional<double> tap_pitch_mm;
    std::optional<double> tool_length_mm;
    std::vector<double> wcs_origin_mm;
    std::optional<double> orientation_tolerance_deg;
    std::optional<double> pole_cone_deg;
    std::string at_limit;
    std::optional<double> retract_mm;
    std::optional<double> retract_feed_mm_per_min;
    std::optional<double> engage_feed_mm_per_min;
    std::optional<double> chord_tolerance_mm;
    int threads = 2;
    bool cycle_time = false;
    bool no_cycle_time = false;
    std::string map;
    std::string setup_sheet;
    bool strict = false;
    bool json = false;
    bool print_config = false;
};

/// Flag > job file > default.
base::Result<post::PostOptions> optionsOf(const Flags& flags) {
    PostJob job;
    if (!flags.config.empty()) {
        const auto document = base::TomlDocument::readFile(flags.config);
        if (!document) return base::fail(document.error());
        base::Diagnostics report;
        job = postJobSection().read(document->root(), report);
        if (report.hasErrors()) return base::fail(std::move(report));
    }
    if (flags.program_name) job.post.program_name = *flags.program_name;
    if (flags.work_offset) job.post.work_offset = *flags.work_offset;
    if (flags.setup) job.post.setup = *flags.setup;
    if (flags.spindle_rpm) job.post.spindle_rpm = flags.spindle_rpm;
    for (const auto& [word, form] : post::programFormWords())
        if (flags.form == word) job.post.form = form;
    if (flags.feed_mode == "auto") job.post.feed_mode = post::PostOptions::FeedMode::Auto;
    if (flags.feed_mode == "per-minute") job.post.feed_mode = post::PostOptions::FeedMode::PerMinute;
    if (flags.feed_mode == "inverse-time") job.post.feed_mode = post::PostOptions::FeedMode::InverseTime;
    if (flags.tap_pitch_mm) job.post.tap_pitch_mm = flags.tap_pitch_mm;
    if (flags.tool_length_mm) job.post.tool_length_mm = flags.tool_length_mm;
    if (flags.wcs_origin_mm.size() == 3)
        job.post.wcs_origin_mm = {flags.wcs_origin_mm[0], flags.wcs_origin_mm[1], flags.wcs_origin_mm[2]};
    if (flags.orientation_tolerance_deg)
        job.post.orientation_tolerance_rad = base::radFromDeg(*flags.orientation_tolerance_deg);
    if (flags.pole_cone_deg) job.post.pole_cone_rad = base::radFromDeg(*flags.pole_cone_deg);
    if (!flags.at_limit.empty())
        job.post.at_limit =
            flags.at_limit == "refuse" ? post::PostOptions::AtLimit::Refuse : post::PostOptions::AtLimit::Retract;
    if (flags.retract_mm) job.post.retract_mm = *flags.retract_mm;
    if (flags.retract_feed_mm_per_min)
        job.post.retract_feed_mm_per_s = base::mmPerSFromMmPerMin(*flags.retract_feed_mm_per_min);
    if (flags.engage_feed_mm_per_min)
        job.post.engage_feed_mm_per_s = base::mmPerSFromMmPerMin(*flags.engage_feed_mm_per_min);
    if (flags.chord_tolerance_mm) job.post.chord_tolerance_mm = *flags.chord_tolerance_mm;
    if (flags.strict) job.post.strict = true;
    base::Diagnostics report;
    post::checkOptions(job.post, report);
    if (report.hasErrors()) return base::fail(std::move(report));
    if (job.post.program_name.empty()) job.post.program_name = post::programNameFromFile(flags.output);
    return job.post;
}

using Setup = std::optional<machine::SetupDefinition>;

base::Result<Setup> setupOf(const post::PostOptions& options) {
    if (options.setup.empty()) return Setup();
    auto setup = loadSetup(options.setup);
    if (!setup) return base::fail(std::move(setup).error());
    return Setup(*std::move(setup));
}

/// What X, Y, Z mean, for whoever opens the program at the machine.
std::string formRemark(post::ProgramForm form, const LoadedMachine& machine) {
    if (machine.model.rotaryCount() == 0) return "X Y Z are the tool tip";
    switch (form) {
        case post::ProgramForm::TraoriRotary: return "X Y Z are the tool tip (TRAORI)";
        case post::ProgramForm::TraoriVectors: return "X Y Z are the tool tip, A3 B3 C3 the tool axis (TRAORI)";
        case post::ProgramForm::Machine: return "no TRAORI: X Y Z hold for the tool lengths and origin posted with";
    }
    return {};
}

post::ProgramForm formOf(const post::PostOptions& options, const LoadedMachine& machine) {
    return options.form.value_or(machine.file.control.form);
}

post::ProgramHead headOf(const Flags& flags, const post::PostOptions& options, const LoadedMachine& machine,
                         const Setup& setup) {
    const auto value = [&](std::string_view name) -> std::string {
        if (name == "program") return options.program_name;
        if (name == "cl_file") return fileNameOf(flags.cl_file);
        if (name == "cusp") return "cusp " + std::string(base::version());
        if (name == "machine") return machine.file.machine.name;
        if (name == "form") return formRemark(formOf(options, machine), machine);
        if (name == "travel")
            return setup ? "linear travel kept in the setup: " + setup->name : "linear travel not checked";
        return std::string(name);
    };
    post::ProgramHead head{options.program_name, options.work_offset, {}};
    for (const std::string& line : machine.file.control.sequence.header)
        head.comments.push_back(post::expandPlaceholders(line, value));
    return head;
}

const std::string& workOffsetOf(const post::PostOptions& options, const LoadedMachine& machine) {
    return options.work_offset.empty() ? machine.file.control.work_offset : options.work_offset;
}

/// What a program without TRAORI takes from the setup, where no option says otherwise.
void takeFrom(const machine::SetupDefinition& setup, post::PostOptions& options) {
    for (const machine::SetupTool& tool : setup.tools) {
        if (!tool.name.empty()) options.tool_lengths_mm.try_emplace(tool.name, tool.length_mm);
        if (tool.number) options.tool_lengths_mm.try_emplace(std::to_string(*tool.number), tool.length_mm);
    }
    for (const auto& [name, offset] : setup.work_offsets) options.offset_origins_mm.try_emplace(name, offset.origin_mm);
}

/// What a setup holds and nothing here looks at is said, not passed over.
void tellFixtures(const machine::SetupDefinition& setup, const std::string& file, base::Diagnostics& report) {
    if (setup.fixtures.empty()) return;
    std::string names;
    for (const machine::Fixture& fixture : setup.fixtures) names += (names.empty() ? "" : ", ") + fixture.name;
    report.warning("post.fixtures", "the path is not checked against the fixtures of the setup: " + names,
                   {file, 0, 0, {}});
}

void tellTravel(post::TravelCheck& travel, PostOutcome& outcome) {
    travel.finish();
    outcome.report.append(travel.report());
    outcome.summary.limit_violations += travel.summary().violations;
    outcome.travel = travel.summary();
}

CycleTimeOptions cycleTimeOptions(const Flags& flags, const post::PostOptions& options, const LoadedMachine& machine,
                                  const Setup& setup) {
    CycleTimeOptions out;
    if (setup) out.setup = &*setup;
    out.work_offset = workOffsetOf(options, machine);
    if (options.tool_length_mm) out.tool_length_mm = *options.tool_length_mm;
    if (!flags.cycle_time) out.most_moves = moves_estimated;
    return out;
}

ExitCode finish(const Flags& flags, const PostOutcome& outcome, ProgramFile& file, Companions& companions) {
    if (!outcome.report.hasErrors()) {
        if (const auto done = file.commit(); !done) return failWith(done.error());
        if (const auto done = companions.commit(); !done) return failWith(done.error());
    }
    tell(outcome.report);
    if (flags.json)
        sayJson(toJson(outcome));
    else if (flags.output != "-")
        say(toText(outcome));
    if (!outcome.report.hasErrors()) return ExitCode::Done;
    return outcome.onlyLimits() ? ExitCode::FoundSomething : exitCodeOf(outcome.report);
}

ExitCode runPost(const Flags& flags) {
    auto options = optionsOf(flags);
    if (!options) return failWith(options.error());
    if (flags.print_config) {
        say(postJobSection().toToml({*options}));
        return ExitCode::Done;
    }
    auto machine = loadMachine(flags.machine);
    if (!machine) return failWith(machine.error());
    const auto setup = setupOf(*options);
    if (!setup) return failWith(setup.error());
    if (*setup) takeFrom(**setup, *options);
    auto input = ClInput::open(flags.cl_file, clReaderOptions(flags.dialect, flags.units, options->strict));
    if (!input) return failWith(input.error());
    auto target = base::OutputTarget::open(flags.output);
    if (!target) return failWith(target.error());
    ProgramFile file(*std::move(target));
    auto companions = Companions::open(flags.map, flags.setup_sheet);
    if (!companions) return failWith(companions.error());

    PostOutcome outcome{.cl_file = flags.cl_file, .output = flags.output, .machine = *machine};
    base::Diagnostics planning;
    machine->file.control.format = post::sufficientFormat(machine->file, formOf(*options, *machine), planning);
    post::BlockListener listener;
    if (companions->map)
        listener = [&map = *companions->map](const post::WrittenBlock& block) { map.write(mapLine(block)); };
    post::SinumerikWriter writer([&file](std::string_view text) { file.write(text); }, machine->file,
                                 headOf(flags, *options, *machine, *setup), listener);
    std::optional<post::TravelCheck> travel;
    if (*setup) travel.emplace(machine->model, **setup, workOffsetOf(*options, *machine), flags.cl_file, writer);
    post::NcSink& checked = travel ? static_cast<post::NcSink&>(*travel) : writer;
    std::optional<CycleTimeEstimate> time;
    if (!flags.no_cycle_time)
        time.emplace(machine->file, machine->model, cycleTimeOptions(flags, *options, *machine, *setup), checked);
    post::NcSink& steps = time ? static_cast<post::NcSink&>(*time) : checked;
    post::ProgramPlanner planner(machine->file, machine->model, *options, flags.cl_file, steps, planning);
    ProgressBar bar("posting");
    std::uint64_t records = 0;
    const auto source = [&](toolpath::ClRecord& record) {
        if (++records % records_per_look == 0) bar.show(input->text().position(), input->text().size());
        return !interrupted() && input->reader().next(record);
    };
    using Threads = post::ProgramPlanner::Threads;
    outcome.summary = planner.run(source, flags.threads == 1 ? Threads::One : Threads::Two);
    if (interrupted()) return ExitCode::Interrupted;
    outcome.blocks = writer.finish();
    outcome.report.append(input->reader().report());
    outcome.report.append(planning);
    if (travel) tellTravel(*travel, outcome);
    if (*setup) tellFixtures(**setup, options->setup, outcome.report);
    if (time && !outcome.report.hasErrors()) {
        outcome.cycle_time = time->finish();
        outcome.too_long_to_estimate = time->tooManyMoves();
    }
    outcome.dialect = toolpath::dialectName(input->reader().dialect());
    outcome.mm_per_unit = input->reader().mmPerUnit();
    if (companions->sheet) companions->sheet->write(setupSheet(outcome, options->program_name, *setup));
    return finish(flags, outcome, file, *companions);
}

}  // namespace

void addPostCommand(CLI::App& app, Action& action) {
    CLI::App* post = app.add_subcommand(
        "post", "Turns a CL file (APT from NX, CATIA or SolidWorks CAM) into a Sinumerik 840D program.");
    const auto flags = std::make_shared<Flags>();
    post->add_option("FILE", flags->cl_file, "CL file; - for standard input.")->required();
    post->add_option("-m,--machine", flags->machine, "Machine file, or the name of one that ships with cusp.")
        ->required();
    post->add_option("-o,--output", flags->output, "Program to write; - for standard output.")->required();
    post->add_option("--config", flags->config, "Job file with a [post] table; flags win over it.");
    post->add_option("--dialect", flags->dialect, "Who wrote the CL file, when it cannot be told from the text.")
        ->check(CLI::IsMember({"nx", "catia", "solidworks", "apt"}));
    post->add_option("--units", flags->units, "Unit of lengths, when the CL file does not say.")
        ->check(CLI::IsMember({"mm", "inch"}));
    post->add_option("--name", flags->program_name, "Program name, at most 24 letters, digits, underscores.");
    post->add_option("--work-offset", flags->work_offset, "Work offset, e.g. G54 or G505.");
    post->add_option("--setup", flags->setup,
                     "Setup file: where the workpiece lies in the machine and how long the tools are. Linear travel is "
                     "checked with it.");
    post->add_option("--map", flags->map,
                     "CSV to write: which CL line each block stands for (block number, program line, CL line).");
    post->add_option("--setup-sheet", flags->setup_sheet,
                     "Markdown page to write for the machine: work offsets, tools, operations with extents and times.");
    post->add_option("--spindle-rpm", flags->spindle_rpm, "Spindle speed, clockwise, until the CL file gives one.");
    post->add_option(
            "--form", flags->form,
            "traori-rotary (TRAORI, tip and rotary axes), traori-vectors (TRAORI, tip and A3 B3 C3) or machine (no "
            "TRAORI: positions of all axes); the machine file's when left out.")
        ->check(CLI::IsMember({"traori-rotary", "traori-vectors", "machine"}));
    post->add_option("--feed-mode", flags->feed_mode,
                     "auto (G93 where rotary axes turn without TRAORI), per-minute, or inverse-time (G93 everywhere).")
        ->check(CLI::IsMember({"auto", "per-minute", "inverse-time"}));
    post->add_option("--tap-pitch-mm", flags->tap_pitch_mm,
                     "Pitch of tapped threads where the CL file gives no feed to take it from.")
        ->check(CLI::PositiveNumber);
    post->add_option("--tool-length-mm", flags->tool_length_mm,
                     "Length of every tool from the gauge point: a program without TRAORI holds it.")
        ->check(CLI::NonNegativeNumber);
    post->add_option(
            "--wcs-origin-mm", flags->wcs_origin_mm,
            "Origin of the work offset in machine coordinates, X Y Z: for a program without TRAORI on a machine "
            "with a rotary table.")
        ->expected(3);
    post->add_option(
        "--orientation-tolerance-deg", flags->orientation_tolerance_deg,
        "While cutting, how far the tool axis may leave its way between two CL points (0.05); near the pole "
        "blocks are inserted.");
    post->add_option(
        "--pole-cone-deg", flags->pole_cone_deg,
        "Where rotary limits force a change of branch in a cut, it may be made this close to the pole, the "
        "tool axis swinging off its way by up to as much (0: never).");
    post->add_option(
            "--at-limit", flags->at_limit,
            "Where rotary limits would force a cut off its way: the tool retracts, the axes unwind and it comes "
            "back (retract), or there is no program (refuse).")
        ->check(CLI::IsMember({"retract", "refuse"}));
    post->add_option("--retract-mm", flags->retract_mm, "How far the tool then leaves the part along its axis (50).");
    post->add_option("--retract-feed-mm-per-min", flags->retract_feed_mm_per_min, "Feed off the part (5000).")
        ->check(CLI::PositiveNumber);
    post->add_option("--engage-feed-mm-per-min", flags->engage_feed_mm_per_min,
                     "Feed back to the part (the feed of the cut).")
        ->check(CLI::PositiveNumber);
    post->add_option(
        "--tolerance,--chord-tolerance-mm", flags->chord_tolerance_mm,
        "How far the tip may be from its way between block ends, in mm (0.005): on straight moves that stand "
        "for an arc, and without TRAORI on every move.");
    CLI::Option* cycle_time =
        post->add_flag("--cycle-time", flags->cycle_time,
                       "Estimates how long the program runs; left out, only where it has up to 50000 moves.");
    post->add_option("--threads", flags->threads, "1 or 2: reading beside writing. The program is the same.")
        ->capture_default_str()
        ->check(CLI::Range(1, 2));
    post->add_flag("--no-cycle-time", flags->no_cycle_time, "Estimates no cycle time.")->excludes(cycle_time);
    post->add_flag("--strict", flags->strict,
                   "Statements that are not understood, and cuts with the spindle off, are errors.");
    CLI::Option* json = post->add_flag("--json", flags->json, "One machine-readable summary on stdout.");
    post->add_flag("--print-config", flags->print_config, "Prints the job as cusp understood it, and stops.");
    post->callback([flags, json, &action] {
        if (*json && flags->output == "-")
            throw CLI::ValidationError("--json", "cannot share standard output with -o -");
        action = [flags] { return runPost(*flags); };
    });
}

}  // namespace cusp::cli
