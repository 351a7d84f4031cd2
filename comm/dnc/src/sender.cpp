// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The sender's phases, from the first question to the outcome.
#include <cusp/base/hash.hpp>
#include <cusp/comm/dnc/sender.hpp>

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace cusp::comm {

namespace {

constexpr double chunk_s = 0.15;
constexpr double ask_again_s = 0.5;
constexpr std::uint32_t fallback_chunk_bytes = 1024;

ProgramHeader headerOf(const Program& program, const SenderOptions& options) {
    ProgramHeader header;
    header.client = options.client;
    header.length = static_cast<std::uint32_t>(program.text.size());
    header.digest = sha256(bytesOf(program.text));
    header.blocks = program.blocks;
    header.start_block = program.start_block;
    header.mode = options.mode;
    header.jumps_backward = program.jumps_backward;
    header.name = program.name;
    return header;
}

std::uint32_t mostChunkBytes(const LinkTraits& link) {
    const std::size_t room =
        link.max_request_bytes > request_header_bytes ? link.max_request_bytes - request_header_bytes : std::size_t{1};
    return static_cast<std::uint32_t>(std::min(room, max_payload_bytes));
}

/// Long enough to be worth its header, short enough that a repetition does not cost much.
std::uint32_t firstChunkBytes(const LinkTraits& link, const SenderOptions& options) {
    const std::uint32_t most = mostChunkBytes(link);
    if (options.first_chunk_bytes > 0) return std::min(options.first_chunk_bytes, most);
    if (link.nominal_bytes_per_s <= 0.0) return std::min(most, fallback_chunk_bytes * 4);
    const double bytes = std::max(128.0, link.nominal_bytes_per_s * chunk_s);
    return static_cast<std::uint32_t>(std::min(static_cast<double>(most), bytes));
}

double firstTimeout(const LinkTraits& link, const SenderOptions& options) {
    if (link.nominal_bytes_per_s <= 0.0) return options.first_timeout_s;
    return options.first_timeout_s + (4.0 * firstChunkBytes(link, options) / link.nominal_bytes_per_s);
}

/// On a line whose rate is known, three chunks' time: the first round trips are measured on short messages.
double leastTimeout(const LinkTraits& link, const SenderOptions& options) {
    if (link.nominal_bytes_per_s <= 0.0) return options.least_timeout_s;
    return std::max(options.least_timeout_s, 3.0 * firstChunkBytes(link, options) / link.nominal_bytes_per_s);
}

}  // namespace

Sender::Sender(Program program, SenderOptions options, const LinkTraits& link)
    : program_(std::move(program)),
      options_(std::move(options)),
      link_(link),
      header_(headerOf(program_, options_)),
      conversation_(RoundTrip(firstTimeout(link, options_), leastTimeout(link, options_),
                              std::max(options_.most_timeout_s, firstTimeout(link, options_))),
                    static_cast<std::uint16_t>(options_.client)),
      nonce_(1 + (options_.client % 1'000'000'000U)),
      chunk_bytes_(firstChunkBytes(link, options_)),
      most_chunk_bytes_(std::max(chunk_bytes_, link.nominal_bytes_per_s > 0.0 ? chunk_bytes_ : mostChunkBytes(link))) {
    begin(Phase::Hello, RequestType::Status);
}

void Sender::begin(Phase phase, RequestType type, Bytes payload) {
    phase_ = phase;
    const std::uint32_t argument = type == RequestType::Status ? options_.client : ++nonce_;
    exchange_ = Exchange{type, argument, std::move(payload)};
}

std::optional<Request> Sender::poll(double now_s) {
    if (over()) return std::nullopt;
    if (!started_) {
        started_ = true;
        last_gain_s_ = now_s;
    }
    if (checkStandstill(now_s)) return std::nullopt;
    switch (phase_) {
        case Phase::Probe: return pollProbes(now_s);
        case Phase::Stream: return pollStream(now_s);
        case Phase::Compare: return reader_->poll(conversation_, now_s);
        default: return exchange_ ? exchange_->poll(conversation_, now_s) : std::nullopt;
    }
}

bool Sender::checkStandstill(double now_s) {
    const double heard_s = std::max(conversation_.lastHeardSeconds(), last_gain_s_);
    if (phase_ == Phase::Cancel && now_s > last_gain_s_ + 2.0) {
        finish(outcome_.end, outcome_.code, outcome_.message, outcome_.resumable);
        return true;
    }
    if (now_s > heard_s + options_.silence_s) {
        abort("dnc.no-answer", fmt::format("no answer for {:.0f} s {}", now_s - heard_s, place()));
        return true;
    }
    if (now_s > last_gain_s_ + options_.standstill_s) {
        abort("dnc.standstill", fmt::format("the control answers, but nothing was gained for {:.0f} s {}",
                                            now_s - last_gain_s_, place()));
        return true;
    }
    return false;
}

void Sender::receive(ByteView reply, double now_s) {
    if (over()) return;
    const auto read = conversation_.accept(reply, now_s);
    statistics_.damaged_replies = conversation_.damagedReplies();
    if (!read) return;
    if (read->reason == Reason::BadChecksum) ++statistics_.damaged_requests;
    if (phase_ == Phase::Hello) {
        last_gain_s_ = now_s;
        conversation_.enter(read->session);
        afterHello();
        return;
    }
    if (phase_ == Phase::Open) return onOpen(*read, now_s);
    if (read->session != conversation_.session()) return onReset(*read, now_s);
    control_state_ = read->state;
    if (const auto machine = decodeMachineStatus(reply)) machine_ = machine;
    switch (phase_) {
        case Phase::Probe: return onProbe(*read, now_s);
        case Phase::Stream: return onStream(*read, now_s);
        case Phase::Compare: return onCompare(*read, reply, now_s);
        default: return onCommand(*read, now_s);
    }
}

void Sender::afterHello() {
    if (options_.probes > 0 && !statistics_.link_bytes_per_s) {
        phase_ = Phase::Probe;
        exchange_.reset();
        return;
    }
    begin(Phase::Open, RequestType::Open, encode(header_));
}

void Sender::onOpen(const Acknowledgement& reply, double now_s) {
    const bool answered = reply.nonce == exchange_->argument;
    if (!answered && reply.session != conversation_.session()) return onReset(reply, now_s);
    if (!answered) return;
    last_gain_s_ = now_s;
    if (reply.command_result == Reason::Busy) {
        if (!busy_until_s_) busy_until_s_ = now_s + options_.busy_s;
        if (now_s < *busy_until_s_) {
            begin(Phase::Open, RequestType::Open, encode(header_));
            exchange_->not_before_s = now_s + ask_again_s;
            return;
        }
    }
    if (reply.command_result != Reason::None) {
        finish(TransferEnd::Refused, "dnc.refused",
               fmt::format("{} was refused: {}", header_.name, toText(reply.command_result)), false);
        return;
    }
    conversation_.enter(reply.session);
    conversation_.roundTrip().relax();
    window_.begin(reply.expected);
    sent_to_ = reply.expected;
    free_bytes_ = reply.free_bytes;
    checked_crc_ = base::crc32(std::string_view(program_.text).substr(0, reply.expected));
    if (checked_crc_ != reply.running_crc) {
        abort("dnc.kept-differs", "what the control kept of an earlier transfer is not this program", false);
        return;
    }
    prefilled_ = reply.prefilled;
    control_state_ = reply.state;
    phase_ = Phase::Stream;
    exchange_.reset();
    timer_s_.reset();
    judgeRate();
}

void Sender::judgeRate() {
    if (!options_.demand || !statistics_.link_bytes_per_s || options_.mode != TransferMode::Drip) return;
    statistics_.rate_check = checkRate(*options_.demand, *statistics_.link_bytes_per_s, free_bytes_);
    if (!statistics_.rate_check->starves_at_s || !options_.refuse_slow_link) return;
    close(TransferEnd::Refused, "dnc.link-too-slow", toText(*statistics_.rate_check), false);
}

void Sender::onReset(const Acknowledgement& reply, double now_s) {
    ++statistics_.resets_seen;
    last_gain_s_ = now_s;
    // What was armed may have been started: sending it once more by itself could make it run twice.
    const bool may_reopen = !arm_asked_ && phase_ != Phase::Cancel && phase_ != Phase::Interrupted;
    if (!may_reopen || reopens_ >= options_.reopen_limit) {
        abort("dnc.control-reset", fmt::format("the control was reset {}{}", place(),
                                               arm_asked_ ? "; the program may have been started before" : ""));
        return;
    }
    ++reopens_;
    conversation_.enter(reply.session);
    reader_.reset();
    begin(Phase::Open, RequestType::Open, encode(header_));
}

void Sender::onCommand(const Acknowledgement& reply, double now_s) {
    if (phase_ == Phase::Interrupted) {
        if (!machine_) return;
        outcome_.resume_block = machine_->resume_block;
        abort("dnc.interrupted",
              fmt::format("the control stopped at block {}, alarm {}, {} starvations; resume at block {}",
                          machine_->executing_block, machine_->alarm, machine_->starvations, machine_->resume_block));
        return;
    }
    if (reply.state == ReceiverState::Interrupted && phase_ != Phase::Cancel) {
        machine_.reset();
        return begin(Phase::Interrupted, RequestType::Status);
    }
    if (!exchange_ || reply.nonce != exchange_->argument) return;
    last_gain_s_ = now_s;
    const Reason result = reply.command_result;
    if (phase_ == Phase::Cancel) {
        finish(outcome_.end, outcome_.code, outcome_.message, outcome_.resumable);
        return;
    }
    if (result != Reason::None) {
        const bool wrong_content = result == Reason::DigestDiffers;
        return close(TransferEnd::Aborted, "dnc.failed", fmt::format("{}: {}", place(), toText(result)), wrong_content);
    }
    if (phase_ == Phase::Commit) return afterCommit();
    if (phase_ == Phase::Arm) return afterArm();
    outcome_.started = true;
    finish(TransferEnd::Delivered, "", "", false);
}

void Sender::afterCommit() {
    if (options_.compare && options_.mode == TransferMode::Store) {
        phase_ = Phase::Compare;
        exchange_.reset();
        const std::size_t room =
            link_.max_reply_bytes > upload_header_bytes ? link_.max_reply_bytes - upload_header_bytes : std::size_t{1};
        reader_.emplace(std::string(), std::min<std::size_t>(room, most_chunk_bytes_), link_.useful_in_flight,
                        header_.length);
        return;
    }
    afterCompare();
}

void Sender::onCompare(const Acknowledgement& read, ByteView reply, double now_s) {
    const auto piece = decodeUploadPiece(reply);
    if (read.reason != Reason::None || !piece || conversation_.argumentOf(read.tag) != piece->offset) return;
    const std::uint32_t before = reader_->received();
    const bool sane = reader_->accept(*piece);
    if (reader_->received() > before) {
        last_gain_s_ = now_s;
        conversation_.roundTrip().relax();
    }
    if (sane && !reader_->done()) return;
    if (!sane || textOf(reader_->bytes()) != program_.text) {
        abort("dnc.compare-differs", "what the control stored is not what was sent", true);
        return;
    }
    outcome_.compared = true;
    afterCompare();
}

void Sender::afterCompare() {
    if (options_.arm && !arm_asked_) {
        arm_asked_ = true;
        begin(Phase::Arm, RequestType::Arm);
        return;
    }
    afterArm();
}

void Sender::afterArm() {
    outcome_.armed = arm_asked_;
    if (options_.start && arm_asked_ && control_state_ == ReceiverState::Armed)
        return begin(Phase::Start, RequestType::Start);
    finish(TransferEnd::Delivered, "", "", false);
}

void Sender::linkLost(const std::string& reason) {
    if (!over()) abort("dnc.link-lost", fmt::format("the link broke {}: {}", place(), reason));
}

void Sender::cancel(double now_s) {
    if (over() || phase_ == Phase::Cancel) return;
    last_gain_s_ = now_s;
    if (phase_ == Phase::Hello || phase_ == Phase::Probe || phase_ == Phase::Open) {
        abort("dnc.cancelled", "cancelled before the transfer was opened");
        return;
    }
    close(TransferEnd::Aborted, "dnc.cancelled", fmt::format("cancelled {}", place()), true);
}

std::string Sender::place() const {
    switch (phase_) {
        case Phase::Hello:
        case Phase::Probe: return "before the transfer was opened";
        case Phase::Open: return "while the transfer was opened";
        case Phase::Commit: return "at the commit";
        case Phase::Compare: return "after the commit, while comparing";
        case Phase::Arm: return "after the commit, while arming";
        case Phase::Start: return "after arming, at the start";
        default: return fmt::format("after byte {} of {}", window_.acknowledged(), header_.length);
    }
}

void Sender::abort(std::string code, std::string message, bool resumable) {
    finish(TransferEnd::Aborted, std::move(code), std::move(message), resumable);
}

void Sender::close(TransferEnd end, std::string code, std::string message, bool resumable) {
    outcome_.end = end;
    outcome_.code = std::move(code);
    outcome_.message = std::move(message);
    outcome_.resumable = resumable;
    begin(Phase::Cancel, RequestType::Abort);
}

void Sender::finish(TransferEnd end, std::string code, std::string message, bool resumable) {
    outcome_.end = end;
    outcome_.code = std::move(code);
    outcome_.message = std::move(message);
    outcome_.confirmed_bytes = window_.acknowledged();
    outcome_.resumable = resumable;
    phase_ = Phase::Over;
    exchange_.reset();
}

double Sender::nextWakeSeconds(double now_s) const {
    if (over()) return std::numeric_limits<double>::infinity();
    double next_s = std::min(std::max(conversation_.lastHeardSeconds(), last_gain_s_) + options_.silence_s,
                             last_gain_s_ + options_.standstill_s);
    if (phase_ == Phase::Cancel) next_s = std::min(next_s, last_gain_s_ + 2.0);
    if (exchange_) next_s = std::min(next_s, exchange_->nextAtSeconds(conversation_));
    if (reader_) next_s = std::min(next_s, reader_->nextAtSeconds(conversation_));
    if (phase_ == Phase::Stream) {
        if (timer_s_) next_s = std::min(next_s, *timer_s_);
        if (window_.underWay() == 0) next_s = std::min(next_s, last_poll_s_ + options_.poll_s);
    }
    if (phase_ == Phase::Probe) next_s = std::min(next_s, last_probe_s_ + conversation_.roundTrip().timeoutSeconds());
    // Never the present moment itself: whoever waits until then must get on.
    constexpr double least_wait_s = 1e-4;
    return std::max(next_s, now_s) + least_wait_s;
}

}  // namespace cusp::comm
