// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Segmentation and flow control of ISO 15765-2:2016, sections 9.6 (frame types) and 9.7 (timing).
#include <cusp/comm/link/iso_tp.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace cusp::comm {

namespace {

constexpr std::uint8_t kind_single = 0x0;
constexpr std::uint8_t kind_first = 0x1;
constexpr std::uint8_t kind_consecutive = 0x2;
constexpr std::uint8_t kind_flow_control = 0x3;
constexpr std::uint8_t flow_continue = 0x0;
constexpr std::uint8_t flow_wait = 0x1;
constexpr std::uint8_t padding = 0xCC;
constexpr std::size_t classic_bytes = 8;
constexpr std::size_t most_ready = 64;

/// STmin (table 20): 0x00–0x7F milliseconds, 0xF1–0xF9 hundreds of microseconds, all else reserved and taken as longest.
double separationTime(std::uint8_t value) {
    if (value <= 0x7F) return value * 1e-3;
    if (value >= 0xF1 && value <= 0xF9) return (value - 0xF0) * 1e-4;
    return 0.127;
}

}  // namespace

bool IsoTpEndpoint::send(Bytes message) {
    if (!ready() || message.empty() || message.size() > max_message_bytes) return false;
    queue_.push_back(std::move(message));
    return true;
}

CanPayload IsoTpEndpoint::padded(CanPayload frame) const {
    constexpr std::array<std::size_t, 8> fd_lengths{8, 12, 16, 20, 24, 32, 48, 64};
    if (frame.size() <= classic_bytes) return frame;
    const auto length = std::ranges::lower_bound(fd_lengths, frame.size());
    frame.resize(*length, padding);
    return frame;
}

void IsoTpEndpoint::dropSent() {
    queue_.pop_front();
    sending_ = Sending::Idle;
}

CanPayload IsoTpEndpoint::singleFrame() {
    const Bytes& message = queue_.front();
    CanPayload frame;
    if (message.size() < classic_bytes) {
        frame.push_back(static_cast<std::uint8_t>(message.size()));
    } else {
        frame.push_back(0);
        frame.push_back(static_cast<std::uint8_t>(message.size()));
    }
    append(frame, message);
    dropSent();
    return padded(std::move(frame));
}

CanPayload IsoTpEndpoint::startMessage(double now_s) {
    const Bytes& message = queue_.front();
    const std::size_t most_single = options_.fd ? frameBytes() - 2 : classic_bytes - 1;
    if (message.size() <= most_single) return singleFrame();
    CanPayload frame;
    put16(frame, 0x1000U | static_cast<std::uint32_t>(message.size()));
    sent_bytes_ = frameBytes() - 2;
    append(frame, ByteView(message).first(sent_bytes_));
    send_number_ = 1;
    sending_ = Sending::AwaitingFlowControl;
    flow_control_due_s_ = now_s + options_.flow_control_timeout_s;
    return frame;
}

CanPayload IsoTpEndpoint::nextConsecutive(double now_s) {
    const Bytes& message = queue_.front();
    CanPayload frame{static_cast<std::uint8_t>(0x20U | send_number_)};
    const std::size_t size = std::min(frameBytes() - 1, message.size() - sent_bytes_);
    append(frame, ByteView(message).subspan(sent_bytes_, size));
    sent_bytes_ += size;
    send_number_ = (send_number_ + 1U) & 0x0FU;
    next_frame_s_ = now_s + separation_s_;
    if (sent_bytes_ == message.size()) {
        dropSent();
    } else if (block_limited_ && --block_left_ == 0) {
        sending_ = Sending::AwaitingFlowControl;
        flow_control_due_s_ = now_s + options_.flow_control_timeout_s;
    }
    return padded(std::move(frame));
}

std::optional<CanPayload> IsoTpEndpoint::poll(double now_s) {
    if (incoming_bytes_ > 0 && now_s >= incoming_due_s_) incoming_bytes_ = 0;
    if (flow_control_) return std::exchange(flow_control_, std::nullopt);
    if (sending_ == Sending::AwaitingFlowControl) {
        if (now_s < flow_control_due_s_) return std::nullopt;
        dropSent();
    }
    if (sending_ == Sending::Consecutive) {
        if (now_s < next_frame_s_) return std::nullopt;
        return nextConsecutive(now_s);
    }
    if (queue_.empty()) return std::nullopt;
    return startMessage(now_s);
}

double IsoTpEndpoint::nextWakeSeconds() const {
    double next_s = std::numeric_limits<double>::infinity();
    if (incoming_bytes_ > 0) next_s = incoming_due_s_;
    if (flow_control_) return 0.0;
    switch (sending_) {
        case Sending::Idle: return queue_.empty() ? next_s : 0.0;
        case Sending::AwaitingFlowControl: return std::min(next_s, flow_control_due_s_);
        case Sending::Consecutive: return std::min(next_s, next_frame_s_);
    }
    return next_s;
}

void IsoTpEndpoint::receive(ByteView frame, double now_s) {
    if (frame.empty()) return;
    const auto kind = static_cast<std::uint8_t>(frame[0] >> 4U);
    if (kind == kind_single) {
        const bool escaped = frame.size() > classic_bytes && frame[0] == 0;
        const std::size_t header = escaped ? 2 : 1;
        const std::size_t size = escaped ? frame[1] : frame[0];
        if (size == 0 || header + size > frame.size() || ready_.size() >= most_ready) return;
        ready_.emplace_back(frame.begin() + static_cast<std::ptrdiff_t>(header),
                            frame.begin() + static_cast<std::ptrdiff_t>(header + size));
    } else if (kind == kind_first) {
        firstFrame(frame, now_s);
    } else if (kind == kind_consecutive) {
        consecutiveFrame(frame, now_s);
    } else if (kind == kind_flow_control) {
        flowControl(frame, now_s);
    }
}

void IsoTpEndpoint::firstFrame(ByteView frame, double now_s) {
    if (frame.size() < classic_bytes) return;
    const std::size_t size = get16(frame, 0) & 0x0FFFU;
    // A length that would have fitted into one frame is no first frame (and 0 is the 32-bit form, which is not spoken).
    if (size <= frame.size() - 2) return;
    incoming_.assign(frame.begin() + 2, frame.end());
    incoming_bytes_ = size;
    incoming_number_ = 1;
    incoming_due_s_ = now_s + options_.consecutive_frame_timeout_s;
    // All of it, without pauses.
    flow_control_ = CanPayload{0x30, 0, 0};
}

void IsoTpEndpoint::consecutiveFrame(ByteView frame, double now_s) {
    if (incoming_bytes_ == 0) return;
    if ((frame[0] & 0x0FU) != incoming_number_) {
        incoming_bytes_ = 0;  // a frame is missing or doubled: the message is lost
        return;
    }
    incoming_number_ = (incoming_number_ + 1U) & 0x0FU;
    incoming_due_s_ = now_s + options_.consecutive_frame_timeout_s;
    const std::size_t size = std::min(frame.size() - 1, incoming_bytes_ - incoming_.size());
    append(incoming_, frame.subspan(1, size));
    if (incoming_.size() < incoming_bytes_) return;
    incoming_bytes_ = 0;
    if (ready_.size() < most_ready) ready_.push_back(std::move(incoming_));
    incoming_.clear();
}

void IsoTpEndpoint::flowControl(ByteView frame, double now_s) {
    if (sending_ != Sending::AwaitingFlowControl || frame.size() < 3) return;
    const std::uint8_t status = frame[0] & 0x0FU;
    if (status == flow_wait) {
        flow_control_due_s_ = now_s + options_.flow_control_timeout_s;
        return;
    }
    if (status != flow_continue) return dropSent();  // overflow, or reserved
    block_left_ = frame[1];
    block_limited_ = frame[1] != 0;
    separation_s_ = separationTime(frame[2]);
    next_frame_s_ = now_s;
    sending_ = Sending::Consecutive;
}

std::optional<Bytes> IsoTpEndpoint::next() {
    if (ready_.empty()) return std::nullopt;
    Bytes out = std::move(ready_.front());
    ready_.pop_front();
    return out;
}

}  // namespace cusp::comm
