// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Messages in CAN frames, classic and FD, by ISO 15765-2 (ISO-TP), sans-I/O: what the kernel does where it has it.
#pragma once

#include <cusp/comm/link/bytes.hpp>

#include <deque>
#include <optional>

namespace cusp::comm {

/// The payload of one frame: up to 8 bytes, or up to 64 in one of the lengths CAN FD has.
using CanPayload = Bytes;

struct IsoTpOptions {
    bool fd = false;
    double flow_control_timeout_s = 0.25;       ///< N_Bs: no answer to a first frame
    double consecutive_frame_timeout_s = 0.25;  ///< N_Cr: a message stopped coming
    std::size_t queue_messages = 4;             ///< waiting to be sent
};

/// One end of a pair. Not reliable, as ISO-TP is not: a lost frame loses its message, and nobody is told; a frame that
/// was doubled or overtaken as well.
class IsoTpEndpoint {
public:
    /// Of the 12-bit length, which every implementation takes.
    static constexpr std::size_t max_message_bytes = 4095;

    explicit IsoTpEndpoint(IsoTpOptions options) : options_(options) {}

    /// False, and nothing is sent, when the queue is full or the message empty or too long.
    [[nodiscard]] bool send(Bytes message);
    [[nodiscard]] bool ready() const { return queue_.size() < options_.queue_messages; }
    /// The next frame to put on the bus, when one may go now.
    [[nodiscard]] std::optional<CanPayload> poll(double now_s);
    void receive(ByteView frame, double now_s);
    [[nodiscard]] std::optional<Bytes> next();
    /// When `poll` is to be called again though no frame came: a separation time or a timeout.
    [[nodiscard]] double nextWakeSeconds() const;
    [[nodiscard]] bool sending() const { return !queue_.empty() || flow_control_.has_value(); }

private:
    enum class Sending { Idle, AwaitingFlowControl, Consecutive };

    void firstFrame(ByteView frame, double now_s);
    void consecutiveFrame(ByteView frame, double now_s);
    void flowControl(ByteView frame, double now_s);
    [[nodiscard]] CanPayload singleFrame();
    [[nodiscard]] CanPayload startMessage(double now_s);
    [[nodiscard]] CanPayload nextConsecutive(double now_s);
    void dropSent();
    [[nodiscard]] std::size_t frameBytes() const { return options_.fd ? 64U : 8U; }
    [[nodiscard]] CanPayload padded(CanPayload frame) const;

    IsoTpOptions options_;
    std::deque<Bytes> queue_;
    Sending sending_ = Sending::Idle;
    std::size_t sent_bytes_ = 0;
    std::uint8_t send_number_ = 0;
    unsigned block_left_ = 0;  ///< frames before the next flow control; 0: no limit
    bool block_limited_ = false;
    double separation_s_ = 0.0;
    double next_frame_s_ = 0.0;
    double flow_control_due_s_ = 0.0;

    std::optional<CanPayload> flow_control_;  ///< ours, to be sent
    Bytes incoming_;
    std::size_t incoming_bytes_ = 0;  ///< 0: nothing is coming
    std::uint8_t incoming_number_ = 0;
    double incoming_due_s_ = 0.0;
    std::deque<Bytes> ready_;
};

}  // namespace cusp::comm
