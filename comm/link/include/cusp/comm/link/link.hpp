// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What every transport is to those above it: requests out, replies in. Nobody above knows which one it is.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/comm/link/bytes.hpp>

#include <cstddef>
#include <optional>
#include <string>

namespace cusp::comm {

/// Which of the two things a peer can be asked for. Links that carry messages do not need to know; links that read
/// registers read another range of them.
enum class ReplyArea { Status, Upload };

/// One message to the peer. A link may lose, double, reorder, corrupt or delay it, and its reply as well.
struct Request {
    Bytes bytes;
    /// False: no reply is needed. Links on which a reply costs a turn of the medium save it; on others one may come all
    /// the same.
    bool reply_wanted = true;
    ReplyArea area = ReplyArea::Status;
    std::size_t reply_bytes = 0;  ///< the longest reply of use; links that read registers read so many
};

/// What a sender adapts itself to.
struct LinkTraits {
    std::size_t max_request_bytes = 0;
    std::size_t max_reply_bytes = 0;
    /// Requests under way at the same time that bring something; 1 on a link that takes turns.
    std::size_t useful_in_flight = 1;
    /// A reply costs the time of a request: ask for one every so many requests.
    std::size_t reply_every = 1;
    /// 0 when not known.
    double nominal_bytes_per_s = 0.0;
};

/// The client's end of a transport. Calls come from one thread.
class Link {
public:
    Link() = default;
    Link(const Link&) = delete;
    Link& operator=(const Link&) = delete;
    Link(Link&&) = delete;
    Link& operator=(Link&&) = delete;
    virtual ~Link() = default;

    [[nodiscard]] virtual LinkTraits traits() const = 0;
    /// True when `send` would take a request now without keeping it waiting long.
    [[nodiscard]] virtual bool ready() = 0;
    /// Errors: `io.link-…` when the transport is gone for good (connection closed, device unplugged). A request that got
    /// lost is no error: nobody can know.
    [[nodiscard]] virtual base::Result<void> send(const Request& request) = 0;
    /// The next reply; nothing when none came within `timeout_s`, or when the link became ready meanwhile.
    [[nodiscard]] virtual base::Result<std::optional<Bytes>> receive(double timeout_s) = 0;
    /// "tcp://127.0.0.1:5000", for messages.
    [[nodiscard]] virtual std::string name() const = 0;
};

/// The control's end: what answers.
class RequestHandler {
public:
    RequestHandler() = default;
    RequestHandler(const RequestHandler&) = delete;
    RequestHandler& operator=(const RequestHandler&) = delete;
    RequestHandler(RequestHandler&&) = delete;
    RequestHandler& operator=(RequestHandler&&) = delete;
    virtual ~RequestHandler() = default;

    /// The reply to one message; empty when none is due.
    [[nodiscard]] virtual Bytes handle(ByteView request) = 0;
    /// What a reader of registers sees just now, without having written anything.
    [[nodiscard]] virtual Bytes area(ReplyArea area) = 0;
};

}  // namespace cusp::comm
