// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The receiver's bytes: put in order, each accepted once, whole lines to an interpreter, proven at the end.
#include <cusp/comm/dnc/receiver.hpp>

#include <algorithm>
#include <utility>

namespace cusp::comm {

bool Receiver::prefilled() const {
    return open_ && (expected_ >= options_.prefill_bytes || expected_ == program_.length);
}

std::uint32_t Receiver::freeBytes() const {
    if (!transferOpen()) return 0;
    const std::uint32_t free = host_.freeBytes();
    const auto waiting = static_cast<std::uint32_t>(partial_line_.size());
    return free > waiting ? free - waiting : 0;
}

Reason Receiver::chunk(std::uint32_t offset, ByteView bytes) {
    if (bytes.empty()) return Reason::Malformed;
    const std::uint64_t end = std::uint64_t{offset} + bytes.size();
    if (end > program_.length) return Reason::Malformed;
    if (end <= expected_) return Reason::AlreadyHad;
    if (!transferOpen()) return Reason::WrongState;
    if (offset > expected_) return hold(offset, bytes);
    const ByteView rest = bytes.subspan(expected_ - offset);
    if (rest.size() > freeBytes()) return Reason::Full;
    const Reason reason = deliver(rest);
    return reason == Reason::None ? releaseHeld() : reason;
}

Reason Receiver::hold(std::uint32_t offset, ByteView bytes) {
    const std::uint64_t beyond = std::uint64_t{offset} - expected_ + bytes.size();
    if (beyond > freeBytes()) return Reason::Full;
    const bool room =
        held_.size() < options_.reassembly_chunks && held_bytes_ + bytes.size() <= options_.reassembly_bytes;
    if (room && held_.try_emplace(offset, bytes.begin(), bytes.end()).second) held_bytes_ += bytes.size();
    return Reason::Gap;
}

Reason Receiver::releaseHeld() {
    while (!held_.empty() && held_.begin()->first <= expected_) {
        const auto node = held_.extract(held_.begin());
        const Bytes& bytes = node.mapped();
        held_bytes_ -= bytes.size();
        const std::size_t had = expected_ - node.key();
        if (had >= bytes.size()) continue;
        const ByteView rest = ByteView(bytes).subspan(had);
        // What finds no room now is sent again: nothing is acknowledged before it is handed over.
        if (rest.size() > freeBytes()) continue;
        if (const Reason reason = deliver(rest); reason != Reason::None) return reason;
    }
    return Reason::None;
}

Reason Receiver::deliver(ByteView bytes) {
    const Reason reason = program_.mode == TransferMode::Drip ? deliverLines(bytes)
                          : host_.accept(bytes)               ? Reason::None
                                                              : Reason::Storage;
    if (reason != Reason::None) return fail(reason);
    expected_ += static_cast<std::uint32_t>(bytes.size());
    running_crc_ = base::crc32(bytes, running_crc_);
    running_digest_.update(bytes);
    return Reason::None;
}

Reason Receiver::deliverLines(ByteView bytes) {
    append(partial_line_, bytes);
    const auto last = std::find(partial_line_.rbegin(), partial_line_.rend(), std::uint8_t{'\n'});
    const auto whole = static_cast<std::size_t>(partial_line_.rend() - last);
    if (partial_line_.size() - whole > options_.max_line_bytes) return Reason::LineTooLong;
    if (whole == 0) return Reason::None;
    if (!host_.accept(ByteView(partial_line_).first(whole))) return Reason::Storage;
    partial_line_.erase(partial_line_.begin(), partial_line_.begin() + static_cast<std::ptrdiff_t>(whole));
    return Reason::None;
}

Reason Receiver::commit(const RequestMessage& message) {
    if (!transferOpen()) return Reason::WrongState;
    if (!message.payload.empty() && message.payload.size() != Digest().size()) return Reason::Malformed;
    if (!options_.commit_key.empty() && !sameTag(message.payload, commitTag(options_.commit_key, session_, program_)))
        return Reason::NotAuthentic;
    if (expected_ != program_.length) return Reason::Incomplete;
    if (running_digest_.hex() != toHex(program_.digest)) return fail(Reason::DigestDiffers);
    if (!partial_line_.empty() && !host_.accept(partial_line_)) return fail(Reason::Storage);
    partial_line_.clear();
    if (const Reason reason = host_.commit(); reason != Reason::None) return fail(reason);
    committed_ = true;
    if (state_ == ReceiverState::Receiving) state_ = ReceiverState::Verified;
    return Reason::None;
}

bool Receiver::rebuild(std::uint32_t kept_bytes) {
    if (kept_bytes > program_.length || (kept_bytes > 0 && program_.mode == TransferMode::Drip)) return false;
    if (kept_bytes > 0 && host_.select("") != Reason::None) return false;
    Bytes block(max_payload_bytes);
    while (expected_ < kept_bytes) {
        const std::size_t wanted = std::min<std::size_t>(block.size(), kept_bytes - expected_);
        if (host_.read(expected_, std::span(block).first(wanted)) != wanted) return false;
        const ByteView bytes = ByteView(block).first(wanted);
        running_crc_ = base::crc32(bytes, running_crc_);
        running_digest_.update(bytes);
        expected_ += static_cast<std::uint32_t>(wanted);
    }
    return true;
}

Reason Receiver::fail(Reason reason) {
    failure_ = reason;
    host_.abandon(false);
    open_ = false;
    held_.clear();
    held_bytes_ = 0;
    partial_line_.clear();
    state_ = ReceiverState::Failed;
    return reason;
}

void Receiver::closeTransfer() {
    open_ = false;
    committed_ = false;
    expected_ = 0;
    running_crc_ = 0;
    running_digest_ = base::Sha256();
    partial_line_.clear();
    held_.clear();
    held_bytes_ = 0;
}

}  // namespace cusp::comm
