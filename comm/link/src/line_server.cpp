// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A listening socket and its clients, none of which is ever waited for.
#include <cusp/comm/link/line_server.hpp>

#include "file_descriptor.hpp"

#include <fmt/format.h>
#include <iterator>
#include <list>

namespace cusp::comm {

struct LineServer::State {
    struct Client {
        FileDescriptor descriptor;
        std::string typed;
        Bytes pending;
        bool has_spoken = false;
        double seen_s = 0.0;
    };

    void put(Client& client, std::string_view text) const {
        client.pending.insert(client.pending.end(), text.begin(), text.end());
    }

    /// False when it is to be dropped.
    [[nodiscard]] bool serve(Client& client, const std::function<std::string(std::string_view)>& answer) const {
        const double now_s = steadySeconds();
        const auto bytes = readSome(client.descriptor.get());
        if (!bytes) return false;
        if (!bytes->empty()) {
            client.has_spoken = true;
            client.seen_s = now_s;
            client.typed.append(bytes->begin(), bytes->end());
        }
        for (std::size_t end = client.typed.find('\n'); end != std::string::npos; end = client.typed.find('\n')) {
            std::string line = client.typed.substr(0, end);
            client.typed.erase(0, end + 1);
            if (line.ends_with('\r')) line.pop_back();
            put(client, answer(line));
            if (client.pending.size() > options.max_pending_bytes) return false;
        }
        if (client.typed.size() > options.max_line_bytes) return false;
        if (!writeSome(client.descriptor.get(), client.pending)) return false;
        if (client.pending.size() > options.max_pending_bytes) return false;
        return !client.has_spoken || now_s - client.seen_s <= options.silence_s;
    }

    Listening listening;
    LineServerOptions options;
    std::string name;
    std::list<Client> clients;
};

LineServer::LineServer(std::unique_ptr<State> state) : state_(std::move(state)) {}
LineServer::LineServer(LineServer&&) noexcept = default;
LineServer& LineServer::operator=(LineServer&&) noexcept = default;
LineServer::~LineServer() = default;

base::Result<LineServer> LineServer::listen(std::string_view host_and_port, const LineServerOptions& options) {
    const auto url = parseLinkUrl(fmt::format("tcp://{}", host_and_port));
    if (!url) return base::fail(url.error());
    auto listening = listenTcp(*url, options.listen);
    if (!listening) return base::fail(std::move(listening).error());
    auto state = std::make_unique<State>();
    const bool v6 = listening->host.find(':') != std::string::npos;
    state->name = fmt::format("{}{}{}:{}", v6 ? "[" : "", listening->host, v6 ? "]" : "", listening->port);
    state->listening = *std::move(listening);
    state->options = options;
    return LineServer(std::move(state));
}

void LineServer::step(const std::function<std::string()>& greeting,
                      const std::function<std::string(std::string_view)>& answer) {
    State& state = *state_;
    while (auto client = acceptAllowed(state.listening, state.options.listen)) {
        if (state.clients.size() >= state.options.listen.max_clients) continue;
        state.clients.push_back({*std::move(client), {}, {}, false, steadySeconds()});
        state.put(state.clients.back(), greeting());
    }
    for (auto client = state.clients.begin(); client != state.clients.end();)
        client = state.serve(*client, answer) ? std::next(client) : state.clients.erase(client);
}

void LineServer::say(std::string_view text) {
    for (State::Client& client : state_->clients) state_->put(client, text);
}

const std::string& LineServer::name() const { return state_->name; }
std::size_t LineServer::clients() const { return state_->clients.size(); }

}  // namespace cusp::comm
