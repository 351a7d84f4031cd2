// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// One command a line.
#include "control_panel.hpp"

#include "console.hpp"

#include <cusp/base/units.hpp>

#include <cstdio>
#include <fmt/format.h>
#include <poll.h>
#include <sstream>
#include <unistd.h>

namespace cusp::cli {

namespace {

constexpr std::string_view commands =
    "start, stop, reset, enable SECONDS, override PERCENT, single on|off, optional on|off, search LINE, status, quit\n";
constexpr std::size_t longest_line = 256;

}  // namespace

bool ControlPanel::listen(double now_s) {
    pollfd input{STDIN_FILENO, POLLIN, 0};
    if (!typing_ || ::poll(&input, 1, 0) <= 0) return true;
    char bytes[longest_line];
    const ssize_t count = ::read(STDIN_FILENO, bytes, sizeof bytes);
    if (count <= 0) {
        typing_ = false;
        return true;
    }
    typed_.append(bytes, static_cast<std::size_t>(count));
    for (std::size_t end = typed_.find('\n'); end != std::string::npos; end = typed_.find('\n')) {
        const std::string line = typed_.substr(0, end);
        typed_.erase(0, end + 1);
        if (!act(line, now_s)) return false;
    }
    if (typed_.size() > longest_line) typed_.clear();
    return true;
}

bool ControlPanel::act(const std::string& line, double now_s) {
    std::istringstream in(line);
    std::string word;
    std::string argument;
    in >> word >> argument;
    double number = 0.0;
    std::istringstream digits(argument);
    const bool numeric = static_cast<bool>(digits >> number);
    if (word == "quit") return false;
    if (word == "start") {
        if (!station_.start()) sayNow("nothing to start\n");
    } else if (word == "stop")
        control_.stop();
    else if (word == "reset") {
        control_.reset();
        receiver_.reset(true);
    } else if (word == "enable" && numeric)
        receiver_.enableStart(now_s, number);
    else if (word == "override" && numeric)
        control_.setOverride(number / 100.0);
    else if (word == "single")
        control_.setSingleBlock(argument == "on");
    else if (word == "optional")
        control_.setOptionalStop(argument == "on");
    else if (word == "search" && numeric && number >= 1.0) {
        if (const auto found = control_.search(static_cast<std::size_t>(number)); !found) tell(found.error());
    } else if (word == "status")
        tellStatus();
    else if (!word.empty())
        sayNow(commands);
    return true;
}

void ControlPanel::tellStatus() const {
    const comm::ControlStatus& now = control_.status();
    std::string axes;
    for (std::size_t i = 0; i < now.axes.size(); ++i)
        axes += fmt::format(" {:.4f}", i < 3 ? now.axes[i] : base::degFromRad(now.axes[i]));
    sayNow(fmt::format("{} {} line {} feed {:.1f} mm/min override {:.0f} % FIFO {}/{} axes{}\n", toText(now.state),
                       now.program, now.executing_line, now.feed_mm_per_s * 60.0, now.override_share * 100.0,
                       now.fifo_bytes, now.fifo_capacity, axes));
}

void ControlPanel::tellChanges() {
    const comm::ControlStatus& now = control_.status();
    std::string text = fmt::format("control {}{}{}, transfer {}", toText(now.state),
                                   now.waiting_for.empty() ? "" : ": " + now.waiting_for,
                                   now.finished ? ", program finished" : "", toText(receiver_.state()));
    if (text != told_) sayNow(text + "\n");
    told_ = std::move(text);
    if (now.alarms.size() < alarms_told_) alarms_told_ = 0;
    for (; alarms_told_ < now.alarms.size(); ++alarms_told_) {
        const comm::Alarm& alarm = now.alarms[alarms_told_];
        sayNow(fmt::format("alarm {} at line {}: {}; resume at line {}\n", alarm.number, alarm.line, alarm.text,
                           now.resume_line));
    }
}

}  // namespace cusp::cli
