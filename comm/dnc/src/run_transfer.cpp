// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Asking the sender, feeding the link, waiting for whichever moves first.
#include <cusp/comm/dnc/run_transfer.hpp>

#include <algorithm>
#include <chrono>

namespace cusp::comm {

namespace {

/// Ctrl-C and watchers are looked after so often.
constexpr double most_wait_s = 0.1;

void tellProgress(const Sender& sender, base::Progress& progress, std::uint32_t& told) {
    const std::uint32_t now = sender.acknowledgedBytes();
    if (now > told) progress.advance(now - told);
    told = std::max(told, now);
}

std::string wordsOf(const base::Diagnostics& diagnostics) {
    return diagnostics.empty() ? "no reason given" : diagnostics.front().message;
}

}  // namespace

double transferClockSeconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void runTransfer(Sender& sender, Link& link, base::Progress& progress,
                 const std::function<void(const Sender&)>& watch) {
    progress.begin(sender.totalBytes(), "sending");
    std::uint32_t told = 0;
    while (!sender.over()) {
        if (progress.stopRequested()) sender.cancel(transferClockSeconds());
        while (link.ready()) {
            const auto request = sender.poll(transferClockSeconds());
            if (!request) break;
            if (auto sent = link.send(*request); !sent) sender.linkLost(wordsOf(sent.error()));
        }
        if (sender.over()) break;
        const double now_s = transferClockSeconds();
        // A link that is not ready wakes us when it is; the sender has nothing to say before.
        const double wait_s =
            link.ready() ? std::clamp(sender.nextWakeSeconds(now_s) - now_s, 0.0, most_wait_s) : most_wait_s;
        auto reply = link.receive(wait_s);
        if (!reply) {
            sender.linkLost(wordsOf(reply.error()));
        } else if (*reply) {
            sender.receive(**reply, transferClockSeconds());
        }
        // A link that is never ready would keep it from seeing that nobody answers.
        sender.tick(transferClockSeconds());
        tellProgress(sender, progress, told);
        if (watch) watch(sender);
    }
    progress.end();
}

Bytes ReceiverService::handle(ByteView request) { return receiver_.handle(request, transferClockSeconds()); }

}  // namespace cusp::comm
