// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Lines of text to whoever has connected: what adapters for monitoring systems are made of.
#pragma once

#include <cusp/comm/link/transports.hpp>

#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace cusp::comm {

struct LineServerOptions {
    ListenOptions listen{};
    /// A client that has spoken once and then says nothing for so long is dropped; one that never speaks is not.
    double silence_s = 20.0;
    std::size_t max_line_bytes = 256;
    /// Of what a client does not fetch: beyond it the client is dropped.
    std::size_t max_pending_bytes = std::size_t{256} * 1024;
};

/// One thread. No client can hold up the caller or another client: nothing here waits for one.
class LineServer {
public:
    /// "127.0.0.1:7878", port 0 takes a free one. Errors: `link.url`, `link.not-loopback`, `io.link-open`.
    [[nodiscard]] static base::Result<LineServer> listen(std::string_view host_and_port,
                                                         const LineServerOptions& options = {});
    LineServer(LineServer&&) noexcept;
    LineServer& operator=(LineServer&&) noexcept;
    ~LineServer();

    /// Lets clients in, to whom `greeting` is said first, answers their lines (without end; "" answers nothing), and sends
    /// on what waits. Does not wait itself.
    void step(const std::function<std::string()>& greeting, const std::function<std::string(std::string_view)>& answer);
    /// Says `text` to everybody; it leaves with this and the next `step`.
    void say(std::string_view text);

    /// "127.0.0.1:40123".
    [[nodiscard]] const std::string& name() const;
    [[nodiscard]] std::size_t clients() const;

private:
    struct State;
    explicit LineServer(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

}  // namespace cusp::comm
