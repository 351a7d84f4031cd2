// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Reader, look-ahead and interpolator put together, tick by tick.
#include "control_state.hpp"

#include <cmath>

namespace cusp::comm {

std::string_view toText(ChannelState state) {
    switch (state) {
        case ChannelState::Reset: return "reset";
        case ChannelState::Active: return "active";
        case ChannelState::Interrupted: return "interrupted";
    }
    return "";
}

VirtualControl::VirtualControl(const post::MachineFile& file, const kinematics::Machine& machine,
                               ControlOptions options)
    : state_(std::make_unique<State>(file, machine, options)) {}
VirtualControl::~VirtualControl() = default;

bool VirtualControl::select(std::string name, std::string text) {
    if (state_->status.state != ChannelState::Reset || !state_->clock.atRest()) return false;
    state_->text = std::move(text);
    state_->feed.open(state_->text);
    state_->choose(std::move(name));
    return true;
}

bool VirtualControl::selectFifo(std::string name) {
    if (state_->status.state != ChannelState::Reset || !state_->clock.atRest()) return false;
    state_->text.clear();
    state_->feed.openFifo(state_->options.fifo_bytes);
    state_->choose(std::move(name));
    return true;
}

const std::string& VirtualControl::programText() const { return state_->text; }
std::size_t VirtualControl::fifoFree() const { return state_->feed.free(); }
bool VirtualControl::feed(std::string_view lines) { return state_->feed.put(lines); }
void VirtualControl::endFeed() { state_->feed.end(); }
bool VirtualControl::start() { return state_->start(); }

void VirtualControl::stop() {
    State& state = *state_;
    if (state.status.state != ChannelState::Active) return;
    state.stopping = true;
    state.clock.setRate(0.0);
}

void VirtualControl::reset() {
    State& state = *state_;
    state.feed.empty();
    state.feed.end();
    state.resetting = true;
    state.clock.setRate(0.0);
    if (state.clock.atRest()) state.finishReset();
}

void VirtualControl::setOverride(double share) {
    if (!std::isfinite(share)) return;
    state_->status.override_share = std::clamp(share, 0.0, 1.2);
    state_->preparation.setOverride(state_->status.override_share);
}

void VirtualControl::setSingleBlock(bool on) { state_->single_block = on; }
void VirtualControl::setOptionalStop(bool on) { state_->optional_stop = on; }
base::Result<void> VirtualControl::search(std::size_t line) { return state_->search(line); }

void VirtualControl::advance(double seconds) {
    const double until = state_->status.time_s + seconds - 0.5 * state_->options.tick_s;
    while (state_->status.time_s < until) state_->tick();
}

void VirtualControl::runToRest(double most_s) {
    const double until = state_->status.time_s + most_s;
    do state_->tick();
    while (state_->status.time_s < until && !state_->idle());
}

const ControlStatus& VirtualControl::status() const { return state_->status; }
void VirtualControl::record(std::function<void(const ControlSample&)> sink) { state_->sink = std::move(sink); }

}  // namespace cusp::comm
