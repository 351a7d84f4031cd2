// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// CAN as a link: SocketCAN, with the kernel's ISO-TP where it has it and our own over raw frames where not.
#pragma once

#include "file_descriptor.hpp"

#include <cusp/comm/link/iso_tp.hpp>

#include <memory>
#include <string>

namespace cusp::comm {

/// Messages between two identifiers of a bus.
class CanChannel {
public:
    CanChannel() = default;
    CanChannel(const CanChannel&) = delete;
    CanChannel& operator=(const CanChannel&) = delete;
    CanChannel(CanChannel&&) = delete;
    CanChannel& operator=(CanChannel&&) = delete;
    virtual ~CanChannel() = default;

    [[nodiscard]] virtual bool ready() = 0;
    /// False: it was not taken.
    [[nodiscard]] virtual bool send(const Bytes& message) = 0;
    /// Moves frames, waiting at most `timeout_s` for one. Error `io.link-lost`: the interface is gone, or off the bus.
    [[nodiscard]] virtual base::Result<void> step(double timeout_s) = 0;
    [[nodiscard]] virtual std::optional<Bytes> next() = 0;
};

/// `send_id`, `receive_id` as the client sees them; a server swaps them.
[[nodiscard]] base::Result<std::unique_ptr<CanChannel>> openCan(const LinkUrl& url, bool server);

class CanLink : public Link {
public:
    CanLink(std::unique_ptr<CanChannel> channel, LinkUrl url) : channel_(std::move(channel)), url_(std::move(url)) {}
    LinkTraits traits() const override;
    bool ready() override { return channel_->ready(); }
    base::Result<void> send(const Request& request) override;
    base::Result<std::optional<Bytes>> receive(double timeout_s) override;
    std::string name() const override { return url_.text; }

private:
    std::unique_ptr<CanChannel> channel_;
    LinkUrl url_;
};

class CanServer : public LinkServer {
public:
    CanServer(std::unique_ptr<CanChannel> channel, LinkUrl url, RequestHandler& handler)
        : channel_(std::move(channel)), url_(std::move(url)), handler_(handler) {}
    base::Result<void> step(double timeout_s) override;
    std::string name() const override { return url_.text; }

private:
    std::unique_ptr<CanChannel> channel_;
    LinkUrl url_;
    RequestHandler& handler_;
};

}  // namespace cusp::comm
