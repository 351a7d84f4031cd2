// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Status as "time|key|value|key|value" lines; conditions each on a line of its own.
#include <cusp/comm/controller/shdr_adapter.hpp>

#include <cusp/base/units.hpp>

#include <algorithm>
#include <fmt/chrono.h>
#include <fmt/format.h>

namespace cusp::comm {

namespace {

/// Heartbeat the agent is asked to keep, and how long it may be silent before it counts as gone.
constexpr int heartbeat_ms = 10'000;
constexpr auto told_every = std::chrono::milliseconds(100);

std::string timeText(ShdrLines::Clock::time_point now) {
    const auto ms = std::chrono::duration_cast<std::chrono::milliseconds>(now.time_since_epoch()).count();
    return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03d}Z", fmt::gmtime(static_cast<std::time_t>(ms / 1000)), ms % 1000);
}

/// Bars and line ends divide fields.
std::string plain(std::string text) {
    std::ranges::replace_if(text, [](char c) { return c == '|' || static_cast<unsigned char>(c) < 0x20U; }, ' ');
    return text;
}

/// Values of MTConnect's EXECUTION.
std::string executionOf(const ControlStatus& status) {
    switch (status.state) {
        case ChannelState::Reset: return status.finished ? "PROGRAM_COMPLETED" : "READY";
        case ChannelState::Active: return status.override_share > 0.0 ? "ACTIVE" : "FEED_HOLD";
        case ChannelState::Interrupted: break;
    }
    if (status.waiting_for == "M0") return "PROGRAM_STOPPED";
    if (status.waiting_for == "M1") return "OPTIONAL_STOP";
    return status.waiting_for == "NC stop" ? "FEED_HOLD" : "INTERRUPTED";
}

bool same(const Alarm& a, const Alarm& b) { return a.number == b.number && a.line == b.line && a.text == b.text; }

}  // namespace

ShdrLines::ShdrLines(const kinematics::Machine& machine) {
    for (std::size_t i = 0; i < 3; ++i) axis_names_.push_back(machine.linearNames()[i]);
    for (std::size_t i = 0; i < machine.rotaryCount(); ++i) axis_names_.push_back(machine.rotaryNames()[i]);
}

std::vector<ShdrLines::Item> ShdrLines::itemsOf(const ControlStatus& status) const {
    std::vector<Item> items{{"avail", "AVAILABLE"}, {"mode", "AUTOMATIC"}, {"execution", executionOf(status)}};
    items.push_back({"program", status.program.empty() ? "UNAVAILABLE" : plain(status.program)});
    items.push_back({"line", std::to_string(status.executing_line)});
    for (std::size_t i = 0; i < axis_names_.size(); ++i)
        items.push_back(
            {axis_names_[i] + "act", fmt::format("{:.4f}", i < 3 ? status.axes[i] : base::degFromRad(status.axes[i]))});
    const geometry::Vector3& tip = status.tool.tip_mm;
    items.push_back({"path_position", fmt::format("{:.4f} {:.4f} {:.4f}", tip.x(), tip.y(), tip.z())});
    items.push_back({"path_feedrate", fmt::format("{:.3f}", status.feed_mm_per_s)});
    items.push_back({"feed_override", fmt::format("{:.0f}", status.override_share * 100.0)});
    items.push_back({"fifo_bytes", std::to_string(status.fifo_bytes)});
    return items;
}

/// A condition's FAULT is added by its code and cleared by NORMAL: with the code of one of several, without for all.
std::string ShdrLines::conditions(const ControlStatus& status, const std::string& time, bool all) {
    std::string out;
    const auto holds = [](const std::vector<Alarm>& alarms, const Alarm& wanted) {
        return std::ranges::any_of(alarms, [&](const Alarm& alarm) { return same(alarm, wanted); });
    };
    if (status.alarms.empty() && (all || !told_alarms_.empty())) out += time + "|channel|NORMAL||||\n";
    for (const Alarm& alarm : told_alarms_)
        if (!status.alarms.empty() && !holds(status.alarms, alarm))
            out += fmt::format("{}|channel|NORMAL|{}|||\n", time, alarm.number);
    for (const Alarm& alarm : status.alarms)
        if (all || !holds(told_alarms_, alarm))
            out += fmt::format("{}|channel|FAULT|{}|||{}\n", time, alarm.number,
                               plain(alarm.line > 0 ? fmt::format("line {}: {}", alarm.line, alarm.text) : alarm.text));
    told_alarms_ = status.alarms;
    return out;
}

std::string ShdrLines::all(const ControlStatus& status, Clock::time_point now) {
    const std::string time = timeText(now);
    std::string line = time;
    for (const Item& item : itemsOf(status)) line += "|" + item.name + "|" + item.value;
    // What the others have been told stays as it is: they still miss what has changed since.
    const std::vector<Alarm> told = told_alarms_;
    line += "\n" + conditions(status, time, true);
    told_alarms_ = told;
    return line;
}

std::string ShdrLines::changes(const ControlStatus& status, Clock::time_point now) {
    const std::string time = timeText(now);
    std::string fields;
    for (const Item& item : itemsOf(status)) {
        std::string& told = told_[item.name];
        if (told == item.value) continue;
        told = item.value;
        fields += "|" + item.name + "|" + item.value;
    }
    return (fields.empty() ? "" : time + fields + "\n") + conditions(status, time, false);
}

std::string ShdrLines::answer(std::string_view line) {
    return line == "* PING" ? fmt::format("* PONG {}\n", heartbeat_ms) : std::string();
}

base::Result<ShdrAdapter> ShdrAdapter::listen(std::string_view host_and_port, const kinematics::Machine& machine,
                                              const ListenOptions& options) {
    auto server = LineServer::listen(host_and_port, {.listen = options, .silence_s = 2e-3 * heartbeat_ms});
    if (!server) return base::fail(std::move(server).error());
    return ShdrAdapter(*std::move(server), machine);
}

void ShdrAdapter::step(const ControlStatus& status) {
    const auto now = ShdrLines::Clock::now();
    if (now - told_at_ >= told_every || now < told_at_) {
        server_.say(lines_.changes(status, now));
        told_at_ = now;
    }
    server_.step([&] { return lines_.all(status, now); }, ShdrLines::answer);
}

}  // namespace cusp::comm
