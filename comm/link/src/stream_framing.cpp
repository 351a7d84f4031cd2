// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Octet stuffing and its reverse.
#include <cusp/comm/link/stream_framing.hpp>

#include <utility>

namespace cusp::comm {

namespace {

constexpr std::uint8_t flag = 0x7E;
constexpr std::uint8_t escape = 0x7D;
constexpr std::uint8_t turned = 0x20;
constexpr std::uint8_t xon = 0x11;
constexpr std::uint8_t xoff = 0x13;
constexpr std::size_t most_ready = 1024;

}  // namespace

Bytes frameForStream(ByteView message) {
    Bytes out;
    out.reserve(message.size() + 8);
    // A flag in front as well: noise before it does not spoil this message.
    out.push_back(flag);
    for (const std::uint8_t byte : message) {
        if (byte == flag || byte == escape || byte == xon || byte == xoff) {
            out.push_back(escape);
            out.push_back(byte ^ turned);
        } else {
            out.push_back(byte);
        }
    }
    out.push_back(flag);
    return out;
}

void StreamDeframer::push(ByteView bytes) {
    for (const std::uint8_t byte : bytes) {
        if (byte == flag) {
            end();
        } else if (byte == escape) {
            escaped_ = true;
        } else if (byte == xon || byte == xoff) {
            continue;  // flow control of the line, never data
        } else if (message_.size() >= max_message_bytes_) {
            overlong_ = true;
        } else {
            message_.push_back(escaped_ ? byte ^ turned : byte);
            escaped_ = false;
        }
    }
}

void StreamDeframer::end() {
    const bool whole = !message_.empty() && !escaped_ && !overlong_ && ready_.size() < most_ready;
    if (whole) ready_.push_back(std::move(message_));
    message_.clear();
    escaped_ = false;
    overlong_ = false;
}

std::optional<Bytes> StreamDeframer::next() {
    if (ready_.empty()) return std::nullopt;
    Bytes out = std::move(ready_.front());
    ready_.pop_front();
    return out;
}

}  // namespace cusp::comm
