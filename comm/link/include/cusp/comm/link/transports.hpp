// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Opening a link to a control, and listening as one, over each of the transports.
#pragma once

#include <cusp/comm/link/link.hpp>
#include <cusp/comm/link/link_url.hpp>

#include <memory>
#include <string>
#include <vector>

namespace cusp::comm {

/// Errors: `io.link-open` with the system's reason; `link.url` for file://, which is no link but a folder
/// (`deliverFile`).
[[nodiscard]] base::Result<std::unique_ptr<Link>> openLink(const LinkUrl& url);

struct ListenOptions {
    /// Without it only loopback addresses are listened on.
    bool beyond_loopback = false;
    /// Numeric addresses that may connect, besides loopback: "192.168.0.17", "192.168.0.0/24".
    std::vector<std::string> allowed{};
    std::size_t max_clients = 16;
    /// A client that says nothing for so long is dropped.
    double idle_s = 120.0;
};

/// Whether a client at this numeric address may connect.
[[nodiscard]] bool mayConnect(const std::string& numeric_address, const ListenOptions& options);
/// Whether a server may listen at host and port of `url`: for those that open their sockets themselves.
/// Errors: `link.not-loopback`, `link.allow`, `io.link-open` (no such host).
[[nodiscard]] base::Result<void> checkListening(const LinkUrl& url, const ListenOptions& options);

/// What listens. One thread calls `step`; nobody is served between.
class LinkServer {
public:
    LinkServer() = default;
    LinkServer(const LinkServer&) = delete;
    LinkServer& operator=(const LinkServer&) = delete;
    LinkServer(LinkServer&&) = delete;
    LinkServer& operator=(LinkServer&&) = delete;
    virtual ~LinkServer() = default;

    /// Serves what has come, waiting at most `timeout_s` for it. No client can hold it up: nothing here waits for one.
    /// Errors: `io.link-…` when listening itself has become impossible.
    [[nodiscard]] virtual base::Result<void> step(double timeout_s) = 0;
    /// With the port that was really taken: "tcp://127.0.0.1:40123".
    [[nodiscard]] virtual std::string name() const = 0;
    [[nodiscard]] virtual std::size_t clients() const { return 0; }
};

/// Port 0 takes a free one. Errors: `link.not-loopback`, `link.url`, `io.link-open`.
[[nodiscard]] base::Result<std::unique_ptr<LinkServer>> openServer(const LinkUrl& url, RequestHandler& handler,
                                                                   const ListenOptions& options = {});

}  // namespace cusp::comm
