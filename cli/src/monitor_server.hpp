// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The monitor page's web server: small answers to polls, every connection short, no viewer able to keep out another.
#pragma once

#include "monitor_feed.hpp"

#include <cusp/base/result.hpp>
#include <cusp/comm/link/transports.hpp>

#include <memory>
#include <string>
#include <string_view>

namespace cusp::cli {

struct MonitorOptions {
    comm::ListenOptions listen{};
    /// Not empty: whoever shows it may give commands; empty: nobody may.
    std::string token{};
    /// Connections at the same time; those beyond it are closed at once and may come again.
    std::size_t most_connections = 64;
    /// A connection, whole request and answer, is over after so long, however slowly it is fed.
    double connection_s = 5.0;
};

/// Serves in threads of its own; none of them ever waits for whoever writes the feed.
class MonitorServer {
public:
    /// "127.0.0.1:8080", port 0 takes a free one. The feed must outlive the server.
    /// Errors: `link.url`, `link.not-loopback`, `link.allow`, `io.link-open`.
    [[nodiscard]] static base::Result<std::unique_ptr<MonitorServer>>
    open(std::string_view host_and_port, std::string page, MonitorFeed& feed, MonitorOptions options);
    MonitorServer(const MonitorServer&) = delete;
    MonitorServer& operator=(const MonitorServer&) = delete;
    ~MonitorServer();

    /// "http://127.0.0.1:40123/", with the token behind a # where there is one.
    [[nodiscard]] std::string url() const;
    /// Waits until those who watch have had the last state, at most so long.
    void linger(double most_s) const;

private:
    struct State;
    explicit MonitorServer(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace cusp::cli
