// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The sender while it measures and while it streams: windows, timers, chunk lengths.
#include <cusp/base/hash.hpp>
#include <cusp/comm/dnc/sender.hpp>

#include <algorithm>
#include <fmt/format.h>

namespace cusp::comm {

namespace {
/// After so many chunks without loss a longer one is tried.
constexpr unsigned good_chunks_to_grow = 16;
/// A chunk is taken for lost when a later one has arrived and it is older than so many round trips (as RACK, RFC 8985).
constexpr double reordering = 1.25;
}  // namespace

std::optional<Request> Sender::pollProbes(double now_s) {
    const double timeout_s = conversation_.roundTrip().timeoutSeconds();
    const bool waited_enough = probes_sent_ > 0 && now_s > last_probe_s_ + timeout_s;
    if (probes_sent_ < options_.probes) {
        const std::size_t under_way = probes_sent_ - probes_back_;
        const std::size_t window = std::max<std::size_t>(2, 2 * link_.useful_in_flight);
        if (under_way >= window && !waited_enough) return std::nullopt;
        if (probes_sent_ == 0) first_probe_s_ = now_s;
        ++probes_sent_;
        last_probe_s_ = now_s;
        return conversation_.make(RequestType::Probe, 0, Bytes(chunk_bytes_, 'P'), true, now_s);
    }
    if (!waited_enough) return std::nullopt;
    // What was lost is part of the measurement: the link is judged by what came through.
    last_gain_s_ = now_s;
    statistics_.link_bytes_per_s =
        probes_back_ > 1 ? static_cast<double>(probe_bytes_after_first_) / (now_s - first_probe_back_s_) : 0.0;
    afterHello();
    return exchange_->poll(conversation_, now_s);
}

void Sender::onProbe(const Acknowledgement&, double now_s) {
    last_gain_s_ = now_s;
    ++probes_back_;
    if (probes_back_ == 1)
        first_probe_back_s_ = now_s;
    else
        probe_bytes_after_first_ += chunk_bytes_;
    if (probes_back_ < options_.probes) return;
    // From the first reply to the last: the round trip before the first is no matter of the rate. Replies that come together
    // on a link quicker than this clock's use say nothing by their distance; then all counts, which is never too much.
    constexpr double least_span_s = 1e-3;
    const bool spread = probes_back_ > 1 && now_s - first_probe_back_s_ >= least_span_s;
    const double span_s = now_s - (spread ? first_probe_back_s_ : first_probe_s_);
    const double bytes = spread ? static_cast<double>(probe_bytes_after_first_) : probes_back_ * chunk_bytes_;
    statistics_.link_bytes_per_s = bytes / std::max(span_s, 1e-6);
    afterHello();
}

std::uint64_t Sender::limit() const {
    const std::uint64_t room = std::min<std::uint64_t>(options_.window_bytes, free_bytes_);
    return std::min<std::uint64_t>(header_.length, window_.acknowledged() + room);
}

bool Sender::mayArmNow() const {
    return options_.mode == TransferMode::Drip && options_.arm && prefilled_ && !arm_asked_;
}

/// A FIFO that is full takes nothing more until the program runs: the start cannot wait for the last byte.
bool Sender::mayStartNow() const {
    return options_.mode == TransferMode::Drip && options_.start && arm_asked_ && !start_asked_ && !exchange_ &&
           control_state_ == ReceiverState::Armed;
}

std::optional<Request> Sender::pollStream(double now_s) {
    if (timer_s_ && now_s >= *timer_s_) {
        ++statistics_.timeouts;
        conversation_.roundTrip().backOff();
        window_.rewind();
        lost();
        timer_s_.reset();
    }
    if (mayArmNow()) {
        arm_asked_ = true;
        exchange_ = Exchange{RequestType::Arm, ++nonce_, {}};
    }
    if (mayStartNow()) {
        start_asked_ = true;
        exchange_ = Exchange{RequestType::Start, ++nonce_, {}};
    }
    if (exchange_) {
        if (auto request = exchange_->poll(conversation_, now_s)) return request;
    }
    if (window_.acknowledged() == header_.length && !exchange_) {
        Bytes tag;
        if (!options_.commit_key.empty()) append(tag, commitTag(options_.commit_key, conversation_.session(), header_));
        begin(Phase::Commit, RequestType::Commit, std::move(tag));
        return exchange_->poll(conversation_, now_s);
    }
    if (auto request = nextChunk(now_s)) return request;
    // Chunks under way are waited for; but when no reply was asked of any of them yet, one is asked for now.
    const bool waits = window_.underWay() > 0 ? timer_s_.has_value() : now_s < last_poll_s_ + options_.poll_s;
    if (waits) return std::nullopt;
    last_poll_s_ = now_s;
    if (window_.underWay() > 0) startTimer(now_s);
    return conversation_.make(RequestType::Status, options_.client, {}, true, now_s);
}

std::optional<Request> Sender::nextChunk(double now_s) {
    if (!window_.hasLost() && window_.underWay() >= options_.window_chunks) return std::nullopt;
    const auto piece = window_.next(chunk_bytes_, limit());
    if (!piece) return std::nullopt;
    // A window that opens by a few bytes is not worth a chunk, unless it ends the program or nothing else moves.
    const bool ends = piece->offset + piece->size == header_.length;
    if (!window_.hasLost() && !ends && piece->size < chunk_bytes_ / 2 &&
        (window_.underWay() > 0 || now_s < last_poll_s_ + options_.poll_s))
        return std::nullopt;
    const bool repeated = piece->offset < sent_to_;
    sent_to_ = std::max(sent_to_, piece->offset + piece->size);
    ++statistics_.chunks_sent;
    if (repeated) ++statistics_.chunks_repeated;
    window_.sent(*piece, now_s);
    const bool more = window_.underWay() < options_.window_chunks && window_.next(chunk_bytes_, limit()).has_value();
    const bool reply_wanted = ++since_reply_ >= link_.reply_every || !more || repeated;
    if (reply_wanted) {
        since_reply_ = 0;
        if (!timer_s_) startTimer(now_s);
    }
    last_poll_s_ = now_s;
    const ByteView text(reinterpret_cast<const std::uint8_t*>(program_.text.data()), program_.text.size());
    return conversation_.make(RequestType::Chunk, piece->offset, text.subspan(piece->offset, piece->size), reply_wanted,
                              now_s);
}

void Sender::startTimer(double now_s) { timer_s_ = now_s + conversation_.roundTrip().timeoutSeconds(); }

void Sender::lost() {
    good_chunks_ = 0;
    chunk_bytes_ = std::max(std::min(options_.least_chunk_bytes, most_chunk_bytes_), chunk_bytes_ / 2);
}

void Sender::gained(std::uint32_t bytes, const Acknowledgement& reply, double now_s) {
    last_gain_s_ = now_s;
    conversation_.roundTrip().relax();
    checked_crc_ = base::crc32(std::string_view(program_.text).substr(reply.expected - bytes, bytes), checked_crc_);
    if (window_.underWay() > 0)
        startTimer(now_s);
    else
        timer_s_.reset();
    if (++good_chunks_ < good_chunks_to_grow) return;
    good_chunks_ = 0;
    chunk_bytes_ = std::min(most_chunk_bytes_, chunk_bytes_ * 2);
}

void Sender::onStream(const Acknowledgement& reply, double now_s) {
    if (exchange_ && reply.nonce == exchange_->argument) {
        const Reason result = reply.command_result;
        exchange_.reset();
        if (result != Reason::None && start_asked_)
            return close(TransferEnd::Aborted, "dnc.failed", fmt::format("the start failed: {}", toText(result)), true);
        if (result != Reason::None) return abort("dnc.failed", fmt::format("arming failed: {}", toText(result)));
        outcome_.started = start_asked_;
        last_gain_s_ = now_s;
    }
    if (reply.state == ReceiverState::Failed)
        return abort("dnc.failed", fmt::format("the control gave up {}: {}", place(), toText(reply.failure)));
    if (reply.state == ReceiverState::Interrupted) {
        machine_.reset();
        return begin(Phase::Interrupted, RequestType::Status);
    }
    if (reply.state == ReceiverState::Finished && !reply.committed)
        return abort("dnc.ended-early", fmt::format("the control ended the program {}", place()), false);
    if (reply.expected > header_.length)
        return abort("dnc.confused", "the control acknowledges more bytes than the program has", false);
    prefilled_ = prefilled_ || reply.prefilled;
    if (reply.expected < window_.acknowledged()) return;
    free_bytes_ = reply.free_bytes;
    const std::uint32_t bytes = window_.acknowledge(reply.expected);
    if (bytes > 0) gained(bytes, reply, now_s);
    if (checked_crc_ != reply.running_crc)
        return abort("dnc.crc-differs", fmt::format("the control's running checksum differs {}", place()), false);
    if (reply.reason == Reason::Full) {
        // Nothing that is under way is sure to have been taken; what was comes back as already had.
        window_.rewind();
        timer_s_.reset();
        last_poll_s_ = now_s;
    }
    const bool hole = reply.reason == Reason::Gap || reply.reason == Reason::BadChecksum;
    if (hole && window_.loseFirst(now_s - (reordering * conversation_.roundTrip().smoothedSeconds()))) lost();
    // A drip feed waits for the operator's start and for the FIFO: that is no standstill.
    const bool waits = options_.mode == TransferMode::Drip && free_bytes_ < chunk_bytes_;
    if (waits) last_gain_s_ = now_s;
}

}  // namespace cusp::comm
