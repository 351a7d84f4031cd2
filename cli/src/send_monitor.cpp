// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The sender's state and the control's status as the page's document.
#include "send_monitor.hpp"

#include "control_monitor.hpp"
#include "machine_lookup.hpp"
#include "monitor_path.hpp"
#include "setup_lookup.hpp"

#include <cusp/comm/dnc/run_transfer.hpp>
#include <cusp/pages/render.hpp>

#include <array>
#include <cmath>

namespace cusp::cli {

namespace {

constexpr double tell_every_s = 0.1;
constexpr double sample_every_s = 0.2;
/// For those who watch to fetch the last state.
constexpr double linger_s = 2.0;
/// The protocol's units: 0.1 µm and 1e-4 degree.
constexpr double protocol_unit = 1e-4;

std::string_view phaseWord(comm::Sender::Phase phase) {
    static constexpr std::array<std::string_view, 11> words{"asking",      "measuring",  "opening",   "sending",
                                                            "interrupted", "committing", "comparing", "arming",
                                                            "starting",    "cancelling", "over"};
    const auto index = static_cast<std::size_t>(phase);
    return index < words.size() ? words[index] : "";
}

}  // namespace

base::Result<std::unique_ptr<SendMonitor>> SendMonitor::open(const SendFlags& flags, const comm::Program& program,
                                                             const SendRecord& record) {
    std::unique_ptr<SendMonitor> out(new SendMonitor());
    out->link_ = flags.to;
    out->begin_s_ = comm::transferClockSeconds();
    base::Json input = base::jsonReport("send", 1);
    input["title"] = program.name;
    input["kind"] = "transfer";
    input["links"] = {flags.to};
    input["commands"] = false;
    if (!flags.machine.empty()) {
        auto loaded = loadMachine(flags.machine);
        if (!loaded) return base::fail(std::move(loaded).error());
        input["machine"] = loaded->file.machine.name;
        for (std::size_t i = 0; i < 3; ++i) out->axis_names_.push_back(loaded->model.linearNames()[i]);
        for (std::size_t i = 0; i < loaded->model.rotaryCount(); ++i)
            out->axis_names_.push_back(loaded->model.rotaryNames()[i]);
        auto setup = std::make_shared<machine::SetupDefinition>();
        if (!flags.setup.empty()) {
            auto read = loadSetup(flags.setup);
            if (!read) return base::fail(std::move(read).error());
            *setup = *std::move(read);
        }
        auto machine = std::make_shared<LoadedMachine>(*std::move(loaded));
        out->feed_.offerPath([text = program.text, name = program.name, machine, setup] {
            post::reader::MachineSetup placed;
            placed.definition = setup.get();
            return programPath(text, name, machine->file, placed);
        });
    }
    if (record.ledger() != nullptr) out->ledger_ = ledgerJson(*record.ledger());
    const auto page = pages::renderPage("monitor", input.dump());
    if (!page) return base::fail(page.error());
    auto server = MonitorServer::open(flags.monitor, *page, out->feed_, {});
    if (!server) return base::fail(std::move(server).error());
    out->server_ = *std::move(server);
    return out;
}

void SendMonitor::tell(const comm::Sender& sender) {
    told_s_ = comm::transferClockSeconds();
    const comm::SenderStatistics& statistics = sender.statistics();
    base::Json out;
    out["time_s"] = told_s_ - begin_s_;
    out["program"] = sender.header().name;
    out["over"] = sender.over();
    base::Json transfer;
    transfer["state"] = sender.over() ? wordFor(sender.outcome().end) : phaseWord(sender.phase());
    transfer["control_state"] = toText(sender.controlState());
    transfer["name"] = sender.header().name;
    transfer["bytes"] = sender.acknowledgedBytes();
    transfer["total_bytes"] = sender.totalBytes();
    transfer["digest"] = comm::toHex(sender.header().digest);
    transfer["drip"] = sender.header().mode == comm::TransferMode::Drip;
    transfer["chunks_sent"] = statistics.chunks_sent;
    transfer["chunks_repeated"] = statistics.chunks_repeated;
    transfer["timeouts"] = statistics.timeouts;
    if (sender.over() && !sender.outcome().message.empty()) transfer["message"] = sender.outcome().message;
    out["transfer"] = std::move(transfer);
    out["link"] = {{"name", link_}, {"bytes_per_s", std::round(bytes_per_s_)}};
    if (statistics.link_bytes_per_s) out["link"]["measured_bytes_per_s"] = std::round(*statistics.link_bytes_per_s);
    if (const auto& machine = sender.machine()) {
        out["line"] = machine->executing_block;
        out["completed_line"] = machine->completed_block;
        out["override_percent"] = machine->override_permille / 10.0;
        out["queue"] = {{"blocks", machine->queued_blocks}, {"starvations", machine->starvations}};
        base::Json axes = base::Json::array();
        const std::size_t count = std::min<std::size_t>(machine->axis_count, machine->axes.size());
        for (std::size_t i = 0; i < (axis_names_.empty() ? count : std::min(count, axis_names_.size())); ++i)
            axes.push_back({{"name", axis_names_.empty() ? "axis " + std::to_string(i + 1) : axis_names_[i]},
                            {"unit", i < 3 ? "mm" : "deg"},
                            {"value", machine->axes[i] * protocol_unit}});
        out["axes"] = std::move(axes);
        out["alarms"] = base::Json::array();
        if (machine->alarm != 0)
            out["alarms"].push_back({{"number", machine->alarm}, {"line", 0}, {"text", "see the control"}});
    }
    out["ledger"] = ledger_;
    feed_.tell(out);
}

void SendMonitor::look(const comm::Sender& sender) {
    const double now_s = comm::transferClockSeconds();
    if (now_s - sampled_s_ >= sample_every_s) {
        const std::uint32_t bytes = sender.acknowledgedBytes();
        bytes_per_s_ = sampled_s_ > 0.0 && bytes > bytes_ ? (bytes - bytes_) / (now_s - sampled_s_) : 0.0;
        bytes_ = bytes;
        sampled_s_ = now_s;
        CurveSample sample;
        sample.time_s = now_s - begin_s_;
        if (sender.machine()) sample.override_percent = sender.machine()->override_permille / 10.0;
        sample.link_bytes_per_s = bytes_per_s_;
        feed_.add(sample);
    }
    if (now_s - told_s_ >= tell_every_s) tell(sender);
}

void SendMonitor::end(const comm::Sender& sender, const SendRecord& record) {
    if (record.ledger() != nullptr) ledger_ = ledgerJson(*record.ledger());
    tell(sender);
    server_->linger(linger_s);
}

}  // namespace cusp::cli
