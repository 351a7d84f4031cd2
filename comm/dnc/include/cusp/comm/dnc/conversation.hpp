// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What every asking end needs: tags that tell which reply belongs to what, the round trip measured, the session known.
#pragma once

#include <cusp/comm/dnc/message.hpp>
#include <cusp/comm/link/link.hpp>

#include <array>
#include <cstdint>
#include <optional>

namespace cusp::comm {

/// Retransmission time by smoothed round trip and variance (Jacobson, Karels 1988; the constants of RFC 6298).
class RoundTrip {
public:
    RoundTrip(double initial_s, double least_s, double most_s);
    void sample(double round_trip_s);
    /// After a timeout: twice as long.
    void backOff();
    /// After progress: back to what was measured.
    void relax() { backoff_ = 1.0; }
    [[nodiscard]] double timeoutSeconds() const;
    [[nodiscard]] double smoothedSeconds() const { return smoothed_s_; }

private:
    double least_s_;
    double most_s_;
    double base_s_;
    double smoothed_s_ = 0.0;
    double variance_s_ = 0.0;
    double backoff_ = 1.0;
    bool sampled_ = false;
};

/// Makes requests and says which replies to believe: a link may bring late ones of a session that is over, and twice.
class Conversation {
public:
    Conversation(RoundTrip round_trip, std::uint16_t first_tag) : round_trip_(round_trip), next_tag_(first_tag) {
        first_tag_ = next_tag_;
    }

    [[nodiscard]] Request make(RequestType type, std::uint32_t argument, ByteView payload, bool reply_wanted,
                               double now_s);
    /// Nothing for a reply that is damaged, or answers what was sent before the last `enter`.
    [[nodiscard]] std::optional<Acknowledgement> accept(ByteView reply, double now_s);
    /// From now on the given protocol session counts, and only replies to what is sent from now on.
    void enter(std::uint32_t session);

    /// What the request with this tag was about; nothing when that is not remembered.
    [[nodiscard]] std::optional<std::uint32_t> argumentOf(std::uint16_t tag) const;

    [[nodiscard]] std::uint32_t session() const { return session_; }
    [[nodiscard]] double lastHeardSeconds() const { return last_heard_s_; }
    [[nodiscard]] std::uint64_t damagedReplies() const { return damaged_; }
    [[nodiscard]] RoundTrip& roundTrip() { return round_trip_; }
    [[nodiscard]] const RoundTrip& roundTrip() const { return round_trip_; }

private:
    struct Sent {
        std::uint16_t tag = 0;
        std::uint32_t argument = 0;
        double at_s = -1.0;  ///< negative: answered already
    };
    static constexpr std::size_t remembered = 512;
    static constexpr std::uint16_t half_of_all_tags = 32768;

    RoundTrip round_trip_;
    std::array<Sent, remembered> sent_{};
    std::uint16_t first_tag_ = 0;
    std::uint16_t next_tag_;
    std::uint32_t session_ = 0;
    std::uint64_t damaged_ = 0;
    double last_heard_s_ = 0.0;
};

/// One command on its way: sent again until its answer comes.
struct Exchange {
    RequestType type = RequestType::Status;
    std::uint32_t argument = 0;
    Bytes payload;
    double sent_s = -1.0;  ///< negative: not yet
    double not_before_s = 0.0;
    unsigned tries = 0;

    /// The request, when it is time for it (again).
    [[nodiscard]] std::optional<Request> poll(Conversation& conversation, double now_s);
    [[nodiscard]] double nextAtSeconds(const Conversation& conversation) const;
};

}  // namespace cusp::comm
