// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Links, then time, then the receiver.
#include <cusp/comm/controller/control_station.hpp>

#include <algorithm>
#include <random>
#include <thread>

namespace cusp::comm {

namespace {

/// What the control makes up for at once when this process was held up.
constexpr double most_behind_s = 0.25;
/// Of the control's time between two looks at the links.
constexpr double fast_slice_s = 0.05;
constexpr double idle_slice_s = 0.01;
/// Of the clock: what a sender whose connection broke has to come back.
constexpr double gone_s = 1.0;

std::uint64_t seedOf(const StationOptions& options) {
    if (options.boot_seed != 0) return options.boot_seed;
    std::random_device device;
    return (std::uint64_t{device()} << 32U) | device();
}

}  // namespace

ControlStation::ControlStation(VirtualControl& control, StationOptions options)
    : control_(control),
      options_(std::move(options)),
      host_(control, options_.host),
      receiver_(options_.receiver, host_, seedOf(options_)),
      service_(receiver_),
      begin_s_(transferClockSeconds() - control.status().time_s) {}

base::Result<std::string> ControlStation::listen(std::string_view url) {
    const auto parsed = parseLinkUrl(url);
    if (!parsed) return base::fail(parsed.error());
    auto server = openServer(*parsed, service_, options_.listen);
    if (!server) return base::fail(std::move(server).error());
    servers_.push_back(*std::move(server));
    return servers_.back()->name();
}

/// The sender has to be heard first; one that says nothing more is not waited for.
bool ControlStation::waitsForFeed(double now_s) {
    const bool fed = receiver_.program().mode == TransferMode::Drip && receiver_.state() == ReceiverState::Running &&
                     !receiver_.committed();
    if (receiver_.acceptedBytes() != seen_bytes_) {
        seen_bytes_ = receiver_.acceptedBytes();
        seen_s_ = now_s;
    }
    // Links without connections count none, ever.
    const std::size_t connected = clients();
    was_connected_ = was_connected_ || connected > 0;
    const double patience_s = was_connected_ && connected == 0 ? gone_s : options_.receiver.lease_s;
    return fed && now_s - seen_s_ < patience_s && control_.fifoFree() > control_.status().fifo_capacity / 2;
}

void ControlStation::passTime(double now_s) {
    if (options_.pace == Pace::AsFastAsPossible) {
        const bool active = control_.status().state == ChannelState::Active;
        hurries_ = active && !waitsForFeed(now_s);
        if (hurries_ || !active) control_.advance(hurries_ ? fast_slice_s : idle_slice_s);
        return;
    }
    const double due_s = now_s - begin_s_ - lost_s_ - control_.status().time_s;
    lost_s_ += std::max(0.0, due_s - most_behind_s);
    if (due_s > 0.0) control_.advance(std::min(due_s, most_behind_s));
}

base::Result<void> ControlStation::step(double wait_s) {
    const double share_s = hurries_ ? 0.0 : wait_s / static_cast<double>(std::max<std::size_t>(1, servers_.size()));
    if (servers_.empty()) std::this_thread::sleep_for(std::chrono::duration<double>(share_s));
    for (const auto& server : servers_)
        if (auto served = server->step(share_s); !served) return served;
    const double now_s = transferClockSeconds();
    passTime(now_s);
    receiver_.tick(now_s);
    host_.follow(receiver_);
    return {};
}

void ControlStation::reset() {
    control_.reset();
    receiver_.reset(true);
}

bool ControlStation::start() {
    if (receiver_.state() != ReceiverState::Armed) return control_.start();
    return receiver_.startLocally(transferClockSeconds()) == Reason::None;
}

std::size_t ControlStation::clients() const {
    std::size_t sum = 0;
    for (const auto& server : servers_) sum += server->clients();
    return sum;
}

}  // namespace cusp::comm
