// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Choosing, starting, searching and resetting programs; reading them line by line.
#include "control_state.hpp"

#include <cmath>
#include <fmt/format.h>

namespace cusp::comm {

using dynamics::AxisVector;

namespace {

AxisVector homeOf(const kinematics::Machine& machine) {
    AxisVector home{};
    for (std::size_t i = 0; i < 3; ++i) home[i] = machine.definition().linear.at(machine.linearNames()[i]).home_mm;
    for (std::size_t i = 0; i < machine.rotaryCount(); ++i) home[3 + i] = machine.rotaryHome()[i];
    return home;
}

constexpr double share_of_limits = 0.95;

}  // namespace

VirtualControl::State::State(const post::MachineFile& machine_file, const kinematics::Machine& machine_model,
                             const ControlOptions& control_options)
    : file(machine_file),
      machine(machine_model),
      options(control_options),
      preparation(file, machine, options),
      clock(dynamics::limitsOf(machine), options.tick_s, homeOf(machine)) {
    status.axes = clock.axes();
    preparation.begin(status.axes);
    placement = preparation.placement();
    status.tool = toolPath().placeOf(status.axes);
    newPlanner();
}

void VirtualControl::State::newPlanner() {
    planner_ = std::make_unique<dynamics::MotionPlanner>(
        dynamics::limitsOf(machine),
        dynamics::PlannerOptions{.window_blocks = options.look_ahead_blocks, .limit_use = share_of_limits},
        [this](const AxisVector& axes) { return toolPath().placeOf(axes); });
    blocks_.clear();
    barrier_.reset();
    added_since_plan_ = false;
}

void VirtualControl::State::choose(std::string name) {
    status.program = std::move(name);
    ++status.chosen;
    status.finished = false;
    status.executing_line = status.completed_line = status.read_line = status.resume_line = 0;
    chosen_ = true;
    searched_.reset();
}

void VirtualControl::State::openProgram() {
    report_ = base::Diagnostics();
    post::reader::ReaderOptions reading;
    reading.setup.definition = options.setup;
    if (options.setup == nullptr) {
        reading.setup.tool_length_mm = options.tool_length_mm;
        reading.setup.wcs_origin_mm = {options.wcs_origin_mm.x(), options.wcs_origin_mm.y(), options.wcs_origin_mm.z()};
    }
    if (!feed.isFifo()) feed.open(text);
    run_ =
        std::make_unique<post::reader::ProgramRun>(feed.stream(), status.program, file, reading, preparation, report_);
    preparation.begin(status.axes);
    placement = preparation.placement();
    status.tool = toolPath().placeOf(status.axes);
    read_out_ = false;
    status.finished = false;
    status.least_queued_blocks = options.look_ahead_blocks;
    next_preparation_s_ = status.time_s;
}

bool VirtualControl::State::start() {
    if (!chosen_ || needs_reset_ || resetting || status.state == ChannelState::Active) return false;
    if (status.state == ChannelState::Reset) {
        newPlanner();
        if (searched_)
            approach();
        else
            openProgram();
    }
    status.state = ChannelState::Active;
    status.waiting_for.clear();
    stopping = false;
    clock.setRate(wantedRate());
    return true;
}

void VirtualControl::State::finishReset() {
    resetting = stopping = needs_reset_ = false;
    clock.clear();
    newPlanner();
    run_.reset();
    preparation.begin(status.axes);
    searched_.reset();
    read_out_ = in_contact_ = false;
    status.state = ChannelState::Reset;
    status.waiting_for.clear();
    status.alarms.clear();
    status.fifo_bytes = 0;
    dwell_until_s_ = 0.0;
    if (feed.isFifo()) chosen_ = false;
}

/// Runs the lines before the wanted one on paper.
base::Result<void> VirtualControl::State::search(std::size_t line) {
    if (!chosen_ || feed.isFifo() || status.state != ChannelState::Reset)
        return base::fail("control.search", "block search needs a chosen program in program memory, and reset");
    openProgram();
    while (run_->line() + 1 < line && run_->step()) preparation.items().clear();
    preparation.items().clear();
    if (const auto bad = readAlarm()) return base::fail("control.search", bad->text);
    if (run_->line() + 1 < line || line == 0)
        return base::fail("control.search", fmt::format("the program ends before line {}", line));
    searched_ = line;
    return {};
}

/// To where the searched block starts: the retract axis home, the others over the place, and down.
void VirtualControl::State::approach() {
    const std::size_t line = *searched_;
    const AxisVector target = preparation.axes();
    AxisVector up = status.axes;
    AxisVector over = target;
    const AxisVector home = homeOf(machine);
    for (std::size_t i = 0; i < 3; ++i)
        if (machine.linearNames()[i] == file.control.retract_axis) up[i] = over[i] = home[i];
    placement = preparation.placement();
    const dynamics::ToolPath tool = toolPath();
    status.tool = tool.placeOf(status.axes);
    for (const auto& [from, to] : {std::pair{status.axes, up}, std::pair{up, over}, std::pair{over, target}}) {
        dynamics::PathBlock block = tool.axesLine(from, to);
        block.exact_stop = true;
        addBlock(std::move(block), line);
    }
    searched_.reset();
}

std::optional<Alarm> VirtualControl::State::readAlarm() const {
    if (preparation.alarm()) return preparation.alarm();
    for (const base::Diagnostic& diagnostic : report_)
        if (diagnostic.severity == base::Severity::Error)
            return Alarm{alarm::program, diagnostic.where.line, diagnostic.message + " [" + diagnostic.code + "]"};
    return std::nullopt;
}

bool VirtualControl::State::dry() const {
    return feed.isFifo() && !feed.ended() && !read_out_ && preparation.items().empty();
}

/// False when there is none to read now.
bool VirtualControl::State::readLine() {
    if (read_out_) return false;
    const bool offered = feed.offerLine();
    if (!offered && !feed.ended()) return false;
    const bool more = offered && run_->step();
    if (!more && !run_->ended()) run_->finish();
    read_out_ = !more;
    status.read_line = run_->line();
    if (auto bad = readAlarm()) fault(*std::move(bad));
    return true;
}

void VirtualControl::State::prepare() {
    while (status.time_s >= next_preparation_s_ && !barrier_ && planner_->waiting() < options.look_ahead_blocks) {
        if (preparation.items().empty() && !readLine()) {
            next_preparation_s_ = status.time_s;
            return;
        }
        if (!barrier_ && !preparation.items().empty()) takeItem();
    }
}

void VirtualControl::State::takeItem() {
    PreparedItem item = std::move(preparation.items().front());
    preparation.items().pop_front();
    next_preparation_s_ += options.preparation_s;
    if (auto* event = std::get_if<RestEvent>(&item)) {
        planner_->stop();
        barrier_ = Barrier{Barrier::Kind::Event, std::move(*event), {}};
        return;
    }
    auto& block = std::get<dynamics::PathBlock>(item);
    const std::size_t line = block.id;
    addBlock(std::move(block), line);
    if (!single_block) return;
    planner_->stop();
    barrier_ = Barrier{Barrier::Kind::SingleBlock, {}, {}};
}

void VirtualControl::State::addBlock(dynamics::PathBlock block, std::size_t line) {
    block.id = next_id_++;
    blocks_.push_back({block.id, line, std::max(1.0, status.override_share), !std::isfinite(block.feed_mm_per_s)});
    planner_->add(block);
    added_since_plan_ = true;
}

/// What was prepared before is still run.
void VirtualControl::State::fault(Alarm alarm) {
    planner_->stop();
    barrier_ = Barrier{Barrier::Kind::Alarm, {}, std::move(alarm)};
}

}  // namespace cusp::comm
