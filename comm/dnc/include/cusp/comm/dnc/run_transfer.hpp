// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The protocol's state machines on real links and in real time.
#pragma once

#include <cusp/base/progress.hpp>
#include <cusp/comm/dnc/receiver.hpp>
#include <cusp/comm/dnc/sender.hpp>
#include <cusp/comm/link/link.hpp>

#include <functional>

namespace cusp::comm {

/// Runs `sender` over `link` to its end; the outcome is the sender's. `progress` counts acknowledged bytes; when it asks to
/// stop, the transfer is taken back. `watch`, when given, is called every now and then (a page, a log).
void runTransfer(Sender& sender, Link& link, base::Progress& progress,
                 const std::function<void(const Sender&)>& watch = {});

/// A receiver as what a `LinkServer` serves; the clock is the monotonic one.
class ReceiverService : public RequestHandler {
public:
    explicit ReceiverService(Receiver& receiver) : receiver_(receiver) {}
    Bytes handle(ByteView request) override;
    Bytes area(ReplyArea area) override { return receiver_.area(area); }

private:
    Receiver& receiver_;
};

/// Seconds of the monotonic clock that both of the above use.
[[nodiscard]] double transferClockSeconds();

}  // namespace cusp::comm
