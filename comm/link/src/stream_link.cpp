// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Framed messages over a descriptor that never blocks.
#include "stream_link.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <utility>

namespace cusp::comm {

namespace {

constexpr std::size_t most_message_bytes = std::size_t{16} * 1024;
constexpr std::size_t tcp_request_bytes = 4096 + 64;
constexpr std::size_t tcp_pending_bytes = std::size_t{32} * 1024;
/// Of one client before the others have their turn.
constexpr int most_reads = 4;
/// Replies a client does not fetch.
constexpr std::size_t most_pending_bytes = std::size_t{256} * 1024;

}  // namespace

StreamLink::StreamLink(FileDescriptor descriptor, LinkUrl url, double bytes_per_s)
    : descriptor_(std::move(descriptor)),
      url_(std::move(url)),
      bytes_per_s_(bytes_per_s),
      deframer_(most_message_bytes) {}

LinkTraits StreamLink::traits() const {
    LinkTraits out;
    out.max_request_bytes = tcp_request_bytes;
    out.max_reply_bytes = tcp_request_bytes;
    out.useful_in_flight = 16;
    out.nominal_bytes_per_s = bytes_per_s_;
    return out;
}

bool StreamLink::ready() {
    if (bytes_per_s_ <= 0.0) return pending_.size() < tcp_pending_bytes;
    // On a slow line what waits in the system's buffer is time before the next message.
    int queued = 0;
    if (::ioctl(descriptor_.get(), TIOCOUTQ, &queued) != 0) queued = 0;
    const double waiting = static_cast<double>(pending_.size()) + queued;
    return waiting < std::max(64.0, bytes_per_s_ * 0.1);
}

tl::unexpected<base::Diagnostics> StreamLink::lost() const {
    return base::fail("io.link-lost", "the other end has closed", {url_.text, 0, 0, {}});
}

base::Result<void> StreamLink::send(const Request& request) {
    append(pending_, frameForStream(request.bytes));
    if (!writeSome(descriptor_.get(), pending_)) return lost();
    return {};
}

base::Result<std::optional<Bytes>> StreamLink::receive(double timeout_s) {
    const double until_s = steadySeconds() + timeout_s;
    const bool was_ready = ready();
    while (true) {
        if (auto message = deframer_.next()) return message;
        if (!writeSome(descriptor_.get(), pending_)) return lost();
        const double left_s = until_s - steadySeconds();
        if (left_s <= 0.0 || (!was_ready && ready())) return std::nullopt;
        // A serial line that drains tells nobody: look again soon.
        const double look_s = was_ready || bytes_per_s_ <= 0.0 ? left_s : std::min(left_s, 0.005);
        waitFor(descriptor_.get(), !pending_.empty(), look_s);
        const auto bytes = readSome(descriptor_.get());
        if (!bytes) return lost();
        deframer_.push(*bytes);
    }
}

StreamServer::StreamServer(Listening listening, ListenOptions options, RequestHandler& handler)
    : listening_(std::move(listening)), options_(std::move(options)), handler_(handler) {
    const bool v6 = listening_->host.find(':') != std::string::npos;
    name_ = fmt::format("tcp://{}{}{}:{}", v6 ? "[" : "", listening_->host, v6 ? "]" : "", listening_->port);
}

StreamServer::StreamServer(FileDescriptor device, LinkUrl url, RequestHandler& handler)
    : handler_(handler), name_(std::move(url.text)) {
    clients_.push_back({std::move(device), StreamDeframer(most_message_bytes), {}, steadySeconds()});
}

void StreamServer::acceptAll() {
    if (!listening_) return;
    while (auto client = acceptAllowed(*listening_, options_)) {
        // Those that are gone already do not keep a new one out.
        if (clients_.size() >= options_.max_clients) serveAll();
        if (clients_.size() >= options_.max_clients) continue;
        clients_.push_back({*std::move(client), StreamDeframer(most_message_bytes), {}, steadySeconds()});
    }
}

void StreamServer::wait(double timeout_s) {
    std::vector<pollfd> waiting;
    if (listening_) waiting.push_back({listening_->socket.get(), POLLIN, 0});
    for (const Client& client : clients_)
        waiting.push_back(
            {client.descriptor.get(), static_cast<short>(client.pending.empty() ? POLLIN : POLLIN | POLLOUT), 0});
    const double ms = std::clamp(timeout_s, 0.0, 3600.0) * 1000.0;
    static_cast<void>(::poll(waiting.data(), waiting.size(), static_cast<int>(ms)));
}

bool StreamServer::serve(Client& client) {
    const double now_s = steadySeconds();
    for (int reads = 0; reads < most_reads; ++reads) {
        const auto bytes = readSome(client.descriptor.get());
        if (!bytes) return false;
        if (bytes->empty()) break;
        client.seen_s = now_s;
        client.deframer.push(*bytes);
    }
    while (const auto message = client.deframer.next()) {
        const Bytes reply = handler_.handle(*message);
        if (!reply.empty()) append(client.pending, frameForStream(reply));
    }
    if (!writeSome(client.descriptor.get(), client.pending)) return false;
    return !listening_ || (client.pending.size() <= most_pending_bytes && now_s - client.seen_s <= options_.idle_s);
}

void StreamServer::serveAll() {
    for (auto client = clients_.begin(); client != clients_.end();)
        client = serve(*client) ? std::next(client) : clients_.erase(client);
}

base::Result<void> StreamServer::step(double timeout_s) {
    wait(timeout_s);
    acceptAll();
    serveAll();
    if (!listening_ && clients_.empty())
        return base::fail("io.link-lost", "the serial device is gone", {name_, 0, 0, {}});
    return {};
}

}  // namespace cusp::comm
