// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The receiver's gate: sessions, leases, commands that act once, and who may start what.
#include <cusp/comm/dnc/receiver.hpp>

#include <algorithm>
#include <utility>

namespace cusp::comm {

Receiver::Receiver(ReceiverOptions options, ReceiverHost& host, std::uint64_t boot_seed)
    : options_(std::move(options)), host_(host), random_(boot_seed) {
    newSession();
}

void Receiver::newSession() {
    const std::uint32_t before = session_;
    while (session_ == before || session_ == 0) session_ = static_cast<std::uint32_t>(random_.next() >> 32U);
    opened_from_session_ = 0;
    open_nonce_ = 0;
    last_nonce_ = 0;
    last_result_ = Reason::None;
}

Bytes Receiver::handle(ByteView request, double now_s) {
    tick(now_s);
    const DecodedRequest decoded = decodeRequest(request);
    if (decoded.reason != Reason::None) {
        // Nothing in it can be trusted, its tag and its wish for a reply neither.
        last_reason_ = decoded.reason;
        return encode(acknowledgement());
    }
    const RequestMessage& message = decoded.message;
    last_tag_ = message.tag;
    last_reason_ = withinRate(request.size(), now_s) ? act(message, now_s) : Reason::TooFast;
    const bool harmless = last_reason_ == Reason::None || last_reason_ == Reason::AlreadyHad;
    if (!message.reply_wanted && harmless) return {};
    switch (message.type) {
        case RequestType::Chunk:
        case RequestType::Probe: return encode(acknowledgement());
        case RequestType::Read: return area(ReplyArea::Upload);
        default: return area(ReplyArea::Status);
    }
}

Bytes Receiver::area(ReplyArea area) const {
    Bytes out = encode(acknowledgement());
    append(out, area == ReplyArea::Status ? encode(host_.status()) : upload_);
    return out;
}

Acknowledgement Receiver::acknowledgement() const {
    Acknowledgement out;
    out.state = state_;
    out.reason = last_reason_;
    out.session = session_;
    out.expected = expected_;
    out.free_bytes = freeBytes();
    out.running_crc = running_crc_;
    out.tag = last_tag_;
    out.drip = program_.mode == TransferMode::Drip;
    out.start_enabled = now_s_ < start_enabled_until_s_;
    out.key_demanded = !options_.commit_key.empty();
    out.prefilled = prefilled();
    out.committed = committed_;
    out.nonce = last_nonce_;
    out.command_result = last_result_;
    out.failure = state_ == ReceiverState::Failed ? failure_ : Reason::None;
    return out;
}

bool Receiver::withinRate(std::size_t bytes, double now_s) {
    if (options_.max_bytes_per_s <= 0.0) return true;
    const double earned = (now_s - rate_seen_s_) * options_.max_bytes_per_s;
    rate_credit_bytes_ = std::min(options_.max_bytes_per_s, rate_credit_bytes_ + std::max(0.0, earned));
    rate_seen_s_ = now_s;
    if (rate_credit_bytes_ < static_cast<double>(bytes)) return false;
    rate_credit_bytes_ -= static_cast<double>(bytes);
    return true;
}

Reason Receiver::act(const RequestMessage& message, double now_s) {
    switch (message.type) {
        case RequestType::Status:
            // The sender's number in it keeps its lease; anybody may ask without one.
            if (message.argument != 0 && message.argument == program_.client && message.session == session_)
                lease_until_s_ = now_s + options_.lease_s;
            return Reason::None;
        case RequestType::Probe: return Reason::None;
        case RequestType::Read: return readPiece(message);
        case RequestType::Open: return open(message, now_s);
        default: break;
    }
    if (message.session != session_) return Reason::StaleSession;
    lease_until_s_ = now_s + options_.lease_s;
    if (message.type == RequestType::Chunk) return chunk(message.argument, message.payload);
    // A command acts once: when it comes again its answer is repeated, and one overtaken by a later one does nothing.
    if (message.argument == last_nonce_) return last_result_;
    if (message.argument < last_nonce_) return Reason::OldCommand;
    last_result_ = command(message, now_s);
    last_nonce_ = message.argument;
    return last_result_;
}

Reason Receiver::command(const RequestMessage& message, double now_s) {
    if (message.type == RequestType::Commit) return commit(message);
    if (!message.payload.empty()) return Reason::Malformed;
    switch (message.type) {
        case RequestType::Arm: return arm(now_s);
        case RequestType::Start: return startRemotely(now_s);
        case RequestType::Abort: return abort();
        default: return Reason::Malformed;
    }
}

Reason Receiver::admit(const ProgramHeader& header, double now_s) const {
    const bool drip = header.mode == TransferMode::Drip;
    if (state_ == ReceiverState::Running) return Reason::WrongState;
    const bool occupied = transferOpen() || state_ == ReceiverState::Armed;
    if (occupied && header.client != program_.client && now_s < lease_until_s_) return Reason::Busy;
    if (header.length == 0) return Reason::Malformed;
    if (header.length > options_.max_program_bytes) return Reason::TooLong;
    if (drip && header.jumps_backward) return Reason::JumpsBackward;
    if (drip && !options_.commit_key.empty()) return Reason::NotAuthentic;
    return Reason::None;
}

Reason Receiver::open(const RequestMessage& message, double now_s) {
    if (opened_from_session_ != 0 && message.session == opened_from_session_ && message.argument == open_nonce_)
        return Reason::None;
    if (message.session != session_) return Reason::StaleSession;
    const auto header = decodeProgramHeader(message.payload);
    last_nonce_ = message.argument;
    last_result_ = header ? admit(*header, now_s) : Reason::Malformed;
    if (last_result_ != Reason::None) return last_result_;

    if (transferOpen()) host_.abandon(true);
    closeTransfer();
    state_ = ReceiverState::Idle;
    const OpenAnswer answer = host_.open(*header);
    last_result_ = answer.reason;
    if (answer.reason != Reason::None) return answer.reason;
    program_ = *header;
    if (!rebuild(answer.kept_bytes)) {
        host_.abandon(false);
        last_result_ = Reason::Storage;
        return last_result_;
    }
    open_ = true;
    state_ = ReceiverState::Receiving;
    lease_until_s_ = now_s + options_.lease_s;
    newSession();
    opened_from_session_ = message.session;
    open_nonce_ = message.argument;
    last_nonce_ = message.argument;
    return Reason::None;
}

Reason Receiver::arm(double now_s) {
    const bool stored = state_ == ReceiverState::Verified ||
                        (state_ == ReceiverState::Finished && committed_ && program_.mode == TransferMode::Store);
    const bool dripping = state_ == ReceiverState::Receiving && program_.mode == TransferMode::Drip && prefilled();
    if (!stored && !dripping) return Reason::WrongState;
    const Reason reason = host_.arm();
    if (reason != Reason::None) return reason;
    state_ = ReceiverState::Armed;
    armed_until_s_ = now_s + options_.armed_s;
    return Reason::None;
}

void Receiver::enableStart(double now_s, double seconds) {
    start_enabled_until_s_ = now_s + std::clamp(seconds, 0.0, options_.max_enable_s);
}

Reason Receiver::startRemotely(double now_s) {
    if (state_ != ReceiverState::Armed) return Reason::WrongState;
    if (now_s >= start_enabled_until_s_) return Reason::NotEnabled;
    revokeStart();
    return startLocally(now_s);
}

Reason Receiver::startLocally(double now_s) {
    tick(now_s);
    if (state_ != ReceiverState::Armed) return Reason::WrongState;
    const Reason reason = host_.start();
    if (reason == Reason::None) state_ = ReceiverState::Running;
    return reason;
}

Reason Receiver::abort() {
    // The sender may take back what it sent, not stop what runs: that is the operator's and the control's own affair.
    if (state_ == ReceiverState::Running) return Reason::WrongState;
    if (transferOpen()) host_.abandon(true);
    closeTransfer();
    state_ = ReceiverState::Idle;
    return Reason::None;
}

Reason Receiver::readPiece(const RequestMessage& message) {
    upload_.clear();
    if (message.payload.size() < 2) return Reason::Malformed;
    const std::string name = textOf(message.payload.subspan(2));
    if (!name.empty() && !isProgramName(name)) return Reason::NotFound;
    if (const Reason reason = host_.select(name); reason != Reason::None) return reason;
    Bytes bytes(std::min<std::size_t>(get16(message.payload, 0), max_payload_bytes));
    bytes.resize(host_.read(message.argument, bytes));
    upload_ = encode(UploadPiece{message.argument, host_.selectedLength(), bytes});
    return Reason::None;
}

void Receiver::tick(double now_s) {
    now_s_ = now_s;
    const bool dripping = transferOpen() && program_.mode == TransferMode::Drip;
    if (state_ == ReceiverState::Armed && now_s >= armed_until_s_)
        state_ = dripping ? ReceiverState::Receiving : ReceiverState::Verified;
    if (state_ == ReceiverState::Receiving && now_s >= lease_until_s_) reset(true);
}

void Receiver::reset(bool keep) {
    if (transferOpen()) host_.abandon(keep);
    closeTransfer();
    state_ = ReceiverState::Idle;
    revokeStart();
    upload_.clear();
    newSession();
}

void Receiver::programFinished() {
    // A drip feed that ends before all of it came (M30 amid the text) is finished too; the rest is not wanted. When all
    // came, the commit that proves it may still be on its way.
    if (transferOpen() && expected_ != program_.length) {
        host_.abandon(false);
        open_ = false;
    }
    if (state_ == ReceiverState::Running) state_ = ReceiverState::Finished;
}

void Receiver::programInterrupted() {
    if (transferOpen()) host_.abandon(false);
    open_ = false;
    state_ = ReceiverState::Interrupted;
}

}  // namespace cusp::comm
