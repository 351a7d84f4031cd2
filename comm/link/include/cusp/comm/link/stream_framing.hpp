// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Messages in a stream of bytes (TCP, serial): flags around them, and no byte inside that a serial line would act on.
#pragma once

#include <cusp/comm/link/bytes.hpp>

#include <deque>
#include <optional>

namespace cusp::comm {

/// The octet-stuffed framing of RFC 1662 section 4: a message between flags 0x7E; 0x7E, 0x7D, XON and XOFF inside are
/// replaced by 0x7D and the byte with bit 5 turned over. Text of an NC program passes as it is.
[[nodiscard]] Bytes frameForStream(ByteView message);

/// Finds messages in whatever comes. Noise between flags becomes a message as well, for the checksum above to refuse;
/// memory is bounded by one message of the largest size and what was not fetched yet.
class StreamDeframer {
public:
    explicit StreamDeframer(std::size_t max_message_bytes) : max_message_bytes_(max_message_bytes) {}
    void push(ByteView bytes);
    [[nodiscard]] std::optional<Bytes> next();

private:
    void end();

    std::size_t max_message_bytes_;
    Bytes message_;
    bool escaped_ = false;
    bool overlong_ = false;
    std::deque<Bytes> ready_;
};

}  // namespace cusp::comm
