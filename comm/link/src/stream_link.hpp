// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Links and servers over streams of bytes: TCP, and serial devices.
#pragma once

#include "file_descriptor.hpp"

#include <cusp/comm/link/stream_framing.hpp>

#include <list>
#include <memory>

namespace cusp::comm {

class StreamLink : public Link {
public:
    /// `bytes_per_s` of the line, 0 for TCP.
    StreamLink(FileDescriptor descriptor, LinkUrl url, double bytes_per_s);

    LinkTraits traits() const override;
    bool ready() override;
    base::Result<void> send(const Request& request) override;
    base::Result<std::optional<Bytes>> receive(double timeout_s) override;
    std::string name() const override { return url_.text; }

private:
    [[nodiscard]] tl::unexpected<base::Diagnostics> lost() const;

    FileDescriptor descriptor_;
    LinkUrl url_;
    double bytes_per_s_;
    StreamDeframer deframer_;
    Bytes pending_;
};

class StreamServer : public LinkServer {
public:
    /// Of TCP clients.
    StreamServer(Listening listening, ListenOptions options, RequestHandler& handler);
    /// Of the one at the other end of a serial line.
    StreamServer(FileDescriptor device, LinkUrl url, RequestHandler& handler);

    base::Result<void> step(double timeout_s) override;
    std::string name() const override { return name_; }
    std::size_t clients() const override { return clients_.size(); }

private:
    struct Client {
        FileDescriptor descriptor;
        StreamDeframer deframer;
        Bytes pending;
        double seen_s = 0.0;
    };

    void acceptAll();
    void serveAll();
    /// False when the client is to be dropped.
    [[nodiscard]] bool serve(Client& client);
    void wait(double timeout_s);

    std::optional<Listening> listening_;
    ListenOptions options_;
    RequestHandler& handler_;
    std::string name_;
    std::list<Client> clients_;
};

}  // namespace cusp::comm
