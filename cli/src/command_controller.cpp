// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp controller`: a virtual 840D-like control behind the links, or a program run on it in virtual time.
#include "command.hpp"
#include "console.hpp"
#include "control_monitor.hpp"
#include "control_panel.hpp"
#include "input.hpp"
#include "machine_lookup.hpp"
#include "received_ledger.hpp"
#include "setup_lookup.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/json_report.hpp>
#include <cusp/base/units.hpp>
#include <cusp/comm/controller/control_station.hpp>
#include <cusp/comm/controller/shdr_adapter.hpp>

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cusp::cli {

namespace {

/// Between two looks at the links.
constexpr double look_s = 0.004;
constexpr double longest_run_s = 1e6;
constexpr std::size_t largest_program = std::size_t{256} << 20U;

struct Flags {
    std::string machine;
    std::vector<std::string> listen;
    std::string run;
    std::string store;
    std::string record;
    std::vector<std::string> allowed;
    std::vector<double> wcs_origin_mm;
    std::string setup;
    std::string monitor;
    std::string shdr;
    std::string ledger;
    std::string pace = "real";
    bool monitor_commands = false;
    double tool_length_mm = 100.0;
    double lift_mm = 2.0;
    double fifo_kb = 30.0;
    double seconds = 0.0;
    bool beyond_loopback = false;
    bool json = false;
};

comm::ControlOptions optionsOf(const Flags& flags) {
    comm::ControlOptions options;
    options.tool_length_mm = flags.tool_length_mm;
    options.lift_mm = flags.lift_mm;
    options.fifo_bytes = static_cast<std::size_t>(flags.fifo_kb * 1024.0);
    if (flags.wcs_origin_mm.size() == 3)
        options.wcs_origin_mm = {flags.wcs_origin_mm[0], flags.wcs_origin_mm[1], flags.wcs_origin_mm[2]};
    return options;
}

/// What the axes did, as a table: docs/controller.md.
class Record {
public:
    Record(base::OutputTarget target, const kinematics::Machine& machine)
        : target_(std::move(target)), machine_(machine) {
        std::string head = "time_s";
        for (const std::string& name : machine.linearNames()) head += "," + name + "_mm";
        for (const std::string& name : machine.rotaryNames()) head += "," + name + "_deg";
        write(head + ",tip_x_mm,tip_y_mm,tip_z_mm,axis_i,axis_j,axis_k,line\n");
    }

    void add(const comm::ControlSample& sample) {
        std::string row = fmt::format("{:.4f}", sample.time_s);
        for (std::size_t i = 0; i < 3; ++i) row += fmt::format(",{:.6f}", sample.axes[i]);
        for (std::size_t i = 0; i < machine_.rotaryCount(); ++i)
            row += fmt::format(",{:.6f}", base::degFromRad(sample.axes[3 + i]));
        const dynamics::ToolPlace& at = sample.tool;
        write(row + fmt::format(",{:.6f},{:.6f},{:.6f},{:.9f},{:.9f},{:.9f},{}\n", at.tip_mm.x(), at.tip_mm.y(),
                                at.tip_mm.z(), at.axis.x(), at.axis.y(), at.axis.z(), sample.line));
    }

    [[nodiscard]] base::Result<void> commit() {
        if (failure_.hasErrors()) return base::fail(failure_);
        return target_.commit();
    }

private:
    void write(const std::string& text) {
        if (failure_.hasErrors()) return;
        if (const auto done = target_.write(text); !done) failure_ = done.error();
    }
    base::OutputTarget target_;
    const kinematics::Machine& machine_;
    base::Diagnostics failure_;
};

base::Json toJson(const Flags& flags, const comm::ControlStatus& status) {
    base::Json out = base::jsonReport("controller", 1);
    out["program"] = flags.run;
    out["finished"] = status.finished;
    out["state"] = std::string(toText(status.state));
    out["waiting_for"] = status.waiting_for;
    out["time_s"] = status.time_s;
    out["completed_line"] = status.completed_line;
    out["resume_line"] = status.resume_line;
    out["blocks"] = status.planning.blocks;
    out["max_tip_off_path_mm"] = status.planning.largest_tip_mm;
    out["max_axis_off_path_deg"] = base::degFromRad(status.planning.largest_axis_rad);
    out["alarms"] = base::Json::array();
    for (const comm::Alarm& alarm : status.alarms)
        out["alarms"].push_back({{"number", alarm.number}, {"line", alarm.line}, {"text", alarm.text}});
    return out;
}

std::string toText(const Flags& flags, const comm::ControlStatus& status) {
    std::string out = status.finished ? fmt::format("{}: run in {:.3f} s\n", flags.run, status.time_s)
                                      : fmt::format("{}: {} after line {}, {:.3f} s{}\n", flags.run,
                                                    toText(status.state), status.completed_line, status.time_s,
                                                    status.waiting_for.empty() ? "" : ": " + status.waiting_for);
    for (const comm::Alarm& alarm : status.alarms)
        out += fmt::format("  alarm {} at line {}: {}\n", alarm.number, alarm.line, alarm.text);
    return out;
}

ExitCode runProgram(const Flags& flags, comm::VirtualControl& control) {
    auto text = base::readWholeFile(flags.run, largest_program);
    if (!text) return failWith(text.error());
    static_cast<void>(control.select(fileNameOf(flags.run), *std::move(text)));
    static_cast<void>(control.start());
    constexpr double slice_s = 60.0;
    for (double t = 0.0; t < longest_run_s; t += slice_s) {
        if (interrupted()) return ExitCode::Interrupted;
        control.runToRest(slice_s);
        if (control.status().state != comm::ChannelState::Active) break;
    }
    if (flags.json)
        sayJson(toJson(flags, control.status()));
    else
        say(toText(flags, control.status()));
    return control.status().finished ? ExitCode::Done : ExitCode::FoundSomething;
}

/// What watches the control beside its operator, each where asked for.
struct Watchers {
    std::unique_ptr<ControlMonitor> monitor;
    std::optional<comm::ShdrAdapter> shdr;
    std::optional<ReceivedLedger> ledger;

    [[nodiscard]] base::Result<void> step(const comm::ControlStation& station, const comm::ControlStatus& status) {
        if (ledger) {
            const auto changed = ledger->follow(station);
            if (!changed) return base::fail(changed.error());
            if (*changed && monitor) monitor->showLedger(ledger->ledger());
        }
        if (shdr) shdr->step(status);
        if (monitor) monitor->step();
        return {};
    }
};

base::Result<Watchers> openWatchers(const Flags& flags, const LoadedMachine& machine, comm::ControlStation& station,
                                    ControlMonitorOptions page) {
    Watchers out;
    if (!flags.shdr.empty()) {
        auto adapter = comm::ShdrAdapter::listen(flags.shdr, machine.model, page.listen);
        if (!adapter) return base::fail(adapter.error());
        sayNow("MTConnect adapter on " + adapter->name() + "\n");
        out.shdr.emplace(*std::move(adapter));
    }
    if (!flags.ledger.empty()) {
        auto ledger = ReceivedLedger::open(flags.ledger, machine.file.machine.name);
        if (!ledger) return base::fail(ledger.error());
        out.ledger.emplace(*std::move(ledger));
    }
    if (flags.monitor.empty()) return out;
    page.place = flags.monitor;
    page.commands = flags.monitor_commands;
    auto monitor = ControlMonitor::open(station, machine.file, machine.model, std::move(page));
    if (!monitor) return base::fail(monitor.error());
    out.monitor = *std::move(monitor);
    if (out.ledger) out.monitor->showLedger(out.ledger->ledger());
    sayNow("monitor page at " + out.monitor->url() + "\n");
    return out;
}

ExitCode serve(const Flags& flags, const LoadedMachine& machine, comm::VirtualControl& control,
               const comm::ControlOptions& control_options) {
    comm::StationOptions options;
    options.host.store_folder = flags.store;
    options.pace = flags.pace == "fast" ? comm::Pace::AsFastAsPossible : comm::Pace::RealTime;
    options.listen = {.beyond_loopback = flags.beyond_loopback, .allowed = flags.allowed};
    comm::ControlStation station(control, options);
    ControlMonitorOptions page;
    page.listen = options.listen;
    page.title = "Virtual control";
    page.setup = control_options.setup;
    page.tool_length_mm = control_options.tool_length_mm;
    page.wcs_origin_mm = control_options.wcs_origin_mm;
    for (const std::string& url : flags.listen) {
        const auto name = station.listen(url);
        if (!name) return failWith(name.error());
        sayNow("listening on " + *name + "\n");
        page.links.push_back(*name);
    }
    auto watchers = openWatchers(flags, machine, station, std::move(page));
    if (!watchers) return failWith(watchers.error());
    ControlPanel panel(station);
    const double begin_s = comm::transferClockSeconds();
    while (!interrupted()) {
        if (const auto done = station.step(look_s); !done) return failWith(done.error());
        if (const auto done = watchers->step(station, control.status()); !done) return failWith(done.error());
        const double now_s = comm::transferClockSeconds();
        panel.tellChanges();
        if (!panel.listen(now_s)) return ExitCode::Done;
        if (flags.seconds > 0.0 && now_s - begin_s > flags.seconds) return ExitCode::Done;
    }
    return ExitCode::Interrupted;
}

ExitCode runController(const Flags& flags) {
    const auto machine = loadMachine(flags.machine);
    if (!machine) return failWith(machine.error());
    if (!flags.store.empty() && !std::filesystem::is_directory(flags.store)) {
        base::Diagnostics report;
        report.error("io.store", "the store is no folder: " + flags.store);
        return failWith(report);
    }
    comm::ControlOptions options = optionsOf(flags);
    std::optional<machine::SetupDefinition> setup;
    if (!flags.setup.empty()) {
        auto read = loadSetup(flags.setup);
        if (!read) return failWith(read.error());
        setup = *std::move(read);
        options.setup = &*setup;
    }
    comm::VirtualControl control(machine->file, machine->model, options);
    std::optional<Record> record;
    if (!flags.record.empty()) {
        auto target = base::OutputTarget::open(flags.record);
        if (!target) return failWith(target.error());
        record.emplace(*std::move(target), machine->model);
        control.record([&record](const comm::ControlSample& sample) { record->add(sample); });
    }
    const ExitCode code = flags.run.empty() ? serve(flags, *machine, control, options) : runProgram(flags, control);
    if (record)
        if (const auto done = record->commit(); !done) return failWith(done.error());
    return code;
}

}  // namespace

void addControllerCommand(CLI::App& app, Action& action) {
    CLI::App* controller = app.add_subcommand(
        "controller", "A virtual 840D-like control: runs programs it is sent, on the axes of a machine file.");
    const auto flags = std::make_shared<Flags>();
    controller->add_option("-m,--machine", flags->machine, "Machine file, or the name of one that ships with cusp.")
        ->required();
    CLI::Option* listen = controller->add_option(
        "--listen", flags->listen, "Where to be reached: tcp://, modbus-tcp://, modbus-rtu://, serial://, can://.");
    CLI::Option* run = controller->add_option("--run", flags->run, "Runs this program in virtual time, and ends.");
    run->excludes(listen);
    controller->add_option("--store", flags->store, "Folder in which every accepted program is kept as NAME.MPF.")
        ->needs(listen);
    controller
        ->add_option("--ledger", flags->ledger,
                     "SQLite file that records every transfer and what became of its program.")
        ->needs(listen);
    CLI::Option* monitor = controller
                               ->add_option("--monitor", flags->monitor,
                                            "Serves a page to watch the control at HOST:PORT (port 0: a free one).")
                               ->needs(listen);
    controller
        ->add_flag("--monitor-commands", flags->monitor_commands,
                   "Whoever opens the page by the address that is said may stop, reset and override; never start.")
        ->needs(monitor);
    controller
        ->add_option("--shdr", flags->shdr, "Serves status to MTConnect agents (SHDR) at HOST:PORT, usually port 7878.")
        ->needs(listen);
    controller
        ->add_option("--pace", flags->pace,
                     "How time goes by while a program runs: real, or fast: as fast as this computer can.")
        ->check(CLI::IsMember({"real", "fast"}))
        ->capture_default_str()
        ->needs(listen);
    controller->add_option("--record", flags->record, "CSV of every sample of the axes and of the tool.");
    controller->add_flag("--beyond-loopback", flags->beyond_loopback, "Listens on other addresses than loopback.");
    controller->add_option("--allow", flags->allowed, "Address or network that may connect, besides loopback.");
    CLI::Option* setup = controller->add_option("--setup", flags->setup,
                                                "Setup file: how long the tools are and where the work offsets lie.");
    controller->add_option("--tool-length-mm", flags->tool_length_mm, "Of every tool, gauge point to tip (100).")
        ->check(CLI::NonNegativeNumber)
        ->excludes(setup);
    controller
        ->add_option("--wcs-origin-mm", flags->wcs_origin_mm,
                     "Origin of every work offset in machine coordinates, X Y Z (0 0 0).")
        ->expected(3)
        ->excludes(setup);
    controller->add_option("--lift-mm", flags->lift_mm, "Lift along the tool axis when the FIFO runs dry (2).")
        ->check(CLI::NonNegativeNumber);
    controller->add_option("--fifo-kb", flags->fifo_kb, "Reload FIFO of drip feeding (30).")
        ->check(CLI::Range(1.0, 1e5));
    controller->add_option("--seconds", flags->seconds, "Ends after so long.")->check(CLI::NonNegativeNumber);
    controller->add_flag("--json", flags->json, "With --run: one machine-readable summary on stdout.")->needs(run);
    controller->callback([flags, &action] {
        if (flags->run.empty() && flags->listen.empty())
            throw CLI::ValidationError("controller", "needs --listen or --run");
        action = [flags] { return runController(*flags); };
    });
}

}  // namespace cusp::cli
