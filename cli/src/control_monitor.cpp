// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The control's status as the page's document, ten times a second; curves five times; the track at every step.
#include "control_monitor.hpp"

#include "monitor_path.hpp"

#include <cusp/base/units.hpp>
#include <cusp/pages/render.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <random>

namespace cusp::cli {

namespace {

constexpr double tell_every_s = 0.1;
constexpr double sample_every_s = 0.2;
constexpr std::size_t ledger_entries = 20;
constexpr double override_most = 120.0;

double rounded(double value, double places) { return std::round(value * places) / places; }

base::Json jsonOf(const geometry::Vector3& v, double places) {
    return {rounded(v.x(), places), rounded(v.y(), places), rounded(v.z(), places)};
}

base::Json limitOf(double value) { return std::isfinite(value) ? base::Json(value) : base::Json(); }

}  // namespace

std::string randomToken() {
    std::random_device device;
    return fmt::format("{:08x}{:08x}{:08x}{:08x}", device(), device(), device(), device());
}

base::Json ledgerJson(const comm::Ledger& ledger) {
    base::Json out = base::Json::array();
    auto entries = ledger.last(ledger_entries);
    if (!entries) return out;
    std::ranges::reverse(*entries);
    for (const comm::LedgerEntry& entry : *entries)
        out.push_back({{"number", entry.number},
                       {"time_utc", entry.time_utc},
                       {"event", entry.event},
                       {"program", entry.program},
                       {"bytes", entry.bytes},
                       {"digest", entry.digest},
                       {"operator", entry.operator_label},
                       {"detail", entry.detail}});
    return out;
}

base::Result<std::unique_ptr<ControlMonitor>> ControlMonitor::open(comm::ControlStation& station,
                                                                   const post::MachineFile& file,
                                                                   const kinematics::Machine& machine,
                                                                   ControlMonitorOptions options) {
    std::unique_ptr<ControlMonitor> out(new ControlMonitor(station, file, machine, std::move(options)));
    base::Json input = base::jsonReport("controller", 1);
    input["title"] = out->options_.title;
    input["kind"] = "control";
    input["machine"] = file.machine.name;
    input["links"] = out->options_.links;
    input["commands"] = out->options_.commands;
    const auto page = pages::renderPage("monitor", input.dump());
    if (!page) return base::fail(page.error());
    MonitorOptions serving;
    serving.listen = out->options_.listen;
    if (out->options_.commands) serving.token = randomToken();
    out->tellState(comm::transferClockSeconds());
    auto server = MonitorServer::open(out->options_.place, *page, out->feed_, std::move(serving));
    if (!server) return base::fail(std::move(server).error());
    out->server_ = *std::move(server);
    return out;
}

void ControlMonitor::showLedger(const comm::Ledger& ledger) { ledger_ = ledgerJson(ledger); }

void ControlMonitor::obey(const MonitorCommand& command) {
    comm::VirtualControl& control = station_.control();
    if (command.name == "stop") control.stop();
    if (command.name == "reset") station_.reset();
    if (command.name == "override") control.setOverride(std::clamp(command.value, 0.0, override_most) / 100.0);
    if (command.name == "single") control.setSingleBlock(command.value != 0.0);
}

/// What is drawn ahead of the tool is read again from the text, by whichever viewer asks first.
void ControlMonitor::followProgram() {
    const comm::ControlStatus& now = station_.control().status();
    if (now.chosen != chosen_) {
        chosen_ = now.chosen;
        post::reader::MachineSetup setup;
        setup.definition = options_.setup;
        if (options_.setup == nullptr) {
            setup.tool_length_mm = options_.tool_length_mm;
            setup.wcs_origin_mm = {options_.wcs_origin_mm.x(), options_.wcs_origin_mm.y(), options_.wcs_origin_mm.z()};
        }
        feed_.offerPath([text = station_.control().programText(), name = now.program, &file = file_, setup] {
            return programPath(text, name, file, setup);
        });
    }
    const bool active = now.state != comm::ChannelState::Reset;
    if (active && !active_) feed_.beginTrack();
    active_ = active;
    if (active) feed_.track(now.tool.tip_mm, !now.rapid);
}

base::Json ControlMonitor::axes() const {
    const comm::ControlStatus& now = station_.control().status();
    base::Json out = base::Json::array();
    for (std::size_t i = 0; i < 3 + machine_.rotaryCount(); ++i) {
        const bool linear = i < 3;
        const auto& range = linear ? machine_.linearRange(i) : machine_.rotaryRange(i - 3);
        const auto shown = [&](double value) { return linear ? value : base::degFromRad(value); };
        out.push_back({{"name", linear ? machine_.linearNames()[i] : machine_.rotaryNames()[i - 3]},
                       {"unit", linear ? "mm" : "deg"},
                       {"value", rounded(shown(now.axes[i]), 1e4)},
                       {"min", limitOf(shown(range.min))},
                       {"max", limitOf(shown(range.max))}});
    }
    return out;
}

base::Json ControlMonitor::transfer() const {
    const comm::Receiver& receiver = station_.receiver();
    base::Json out = {{"state", std::string(toText(receiver.state()))}};
    if (receiver.program().length == 0) return out;
    out["name"] = receiver.program().name;
    out["bytes"] = receiver.acceptedBytes();
    out["total_bytes"] = receiver.program().length;
    out["digest"] = comm::toHex(receiver.program().digest);
    out["drip"] = receiver.program().mode == comm::TransferMode::Drip;
    return out;
}

void ControlMonitor::tellState(double now_s) {
    told_s_ = now_s;
    const comm::ControlStatus& now = station_.control().status();
    base::Json out;
    out["time_s"] = rounded(now.time_s, 1e3);
    out["state"] = std::string(toText(now.state));
    out["waiting_for"] = now.waiting_for;
    out["program"] = now.program;
    out["line"] = now.executing_line;
    out["completed_line"] = now.completed_line;
    out["resume_line"] = now.resume_line;
    out["finished"] = now.finished;
    out["rapid"] = now.rapid;
    out["override_percent"] = rounded(now.override_share * 100.0, 10.0);
    out["feed_mm_per_min"] = rounded(now.feed_mm_per_s * 60.0, 10.0);
    out["axes"] = axes();
    out["tool"] = {{"tip_mm", jsonOf(now.tool.tip_mm, 1e4)}, {"axis", jsonOf(now.tool.axis, 1e6)}};
    out["queue"] = {{"blocks", now.queued_blocks}, {"starvations", now.starvations}};
    if (now.fifo_capacity > 0) out["fifo"] = {{"bytes", now.fifo_bytes}, {"capacity_bytes", now.fifo_capacity}};
    out["link"] = {{"clients", station_.clients()}, {"bytes_per_s", rounded(bytes_per_s_, 1.0)}};
    out["transfer"] = transfer();
    out["alarms"] = base::Json::array();
    for (const comm::Alarm& alarm : now.alarms)
        out["alarms"].push_back({{"number", alarm.number}, {"line", alarm.line}, {"text", alarm.text}});
    out["ledger"] = ledger_;
    feed_.tell(out);
}

void ControlMonitor::addSample(double now_s) {
    const std::uint32_t bytes = station_.receiver().acceptedBytes();
    const double elapsed_s = now_s - sampled_s_;
    bytes_per_s_ = sampled_s_ > 0.0 && bytes > bytes_ ? (bytes - bytes_) / elapsed_s : 0.0;
    bytes_ = bytes;
    sampled_s_ = now_s;
    const comm::ControlStatus& now = station_.control().status();
    CurveSample sample;
    sample.time_s = now.time_s;
    sample.feed_mm_per_min = now.feed_mm_per_s * 60.0;
    sample.override_percent = now.override_share * 100.0;
    if (now.fifo_capacity > 0)
        sample.fifo_percent = 100.0 * static_cast<double>(now.fifo_bytes) / static_cast<double>(now.fifo_capacity);
    sample.link_bytes_per_s = bytes_per_s_;
    feed_.add(sample);
}

void ControlMonitor::step() {
    while (const auto command = feed_.takeCommand()) obey(*command);
    followProgram();
    const double now_s = comm::transferClockSeconds();
    if (now_s - sampled_s_ >= sample_every_s) addSample(now_s);
    if (now_s - told_s_ >= tell_every_s) tellState(now_s);
}

}  // namespace cusp::cli
