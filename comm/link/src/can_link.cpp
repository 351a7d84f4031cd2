// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Client and server over a CAN channel.
#include "can_link.hpp"

#include <algorithm>

namespace cusp::comm {

LinkTraits CanLink::traits() const {
    LinkTraits out;
    out.max_request_bytes = IsoTpEndpoint::max_message_bytes;
    out.max_reply_bytes = IsoTpEndpoint::max_message_bytes;
    out.useful_in_flight = 4;
    out.reply_every = 2;
    return out;
}

base::Result<void> CanLink::send(const Request& request) {
    // What the channel does not take is lost, like a frame on the bus.
    static_cast<void>(channel_->send(request.bytes));
    return channel_->step(0.0);
}

base::Result<std::optional<Bytes>> CanLink::receive(double timeout_s) {
    const double until_s = steadySeconds() + timeout_s;
    const bool was_ready = channel_->ready();
    while (true) {
        if (auto message = channel_->next()) return message;
        const double left_s = until_s - steadySeconds();
        if (left_s <= 0.0 || (!was_ready && channel_->ready())) return std::nullopt;
        if (auto stepped = channel_->step(left_s); !stepped) return base::fail(std::move(stepped).error());
    }
}

base::Result<void> CanServer::step(double timeout_s) {
    if (auto stepped = channel_->step(timeout_s); !stepped) return stepped;
    while (const auto message = channel_->next()) {
        const Bytes reply = handler_.handle(*message);
        if (!reply.empty()) static_cast<void>(channel_->send(reply));
    }
    return channel_->step(0.0);
}

}  // namespace cusp::comm
