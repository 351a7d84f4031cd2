// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// cpp-httplib, with a thread for each of a capped number of connections and a deadline over each of them.
#include "monitor_server.hpp"

#include <cusp/base/json_report.hpp>
#include <cusp/base/number_text.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <condition_variable>
#include <fmt/format.h>
#include <httplib.h>
#include <mutex>
#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

namespace cusp::cli {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t most_body_bytes = 1024;
/// Between looks at whether the server is closing.
constexpr int look_ms = 50;

thread_local bool refuse_connection = false;

/// A socket whose reads and writes all end by one moment.
class DeadlineStream : public httplib::Stream {
public:
    DeadlineStream(socket_t socket, Clock::time_point deadline, const std::atomic<bool>& closing)
        : socket_(socket), deadline_(deadline), closing_(closing) {}

    bool is_readable() const override { return at_ < filled_ || wait(POLLIN); }
    bool is_writable() const override { return wait(POLLOUT); }
    ssize_t read(char* data, size_t size) override {
        if (at_ == filled_) {
            if (!wait(POLLIN)) return -1;
            const ssize_t count = ::recv(socket_, buffer_.data(), buffer_.size(), 0);
            if (count <= 0) return count;
            at_ = 0;
            filled_ = static_cast<std::size_t>(count);
        }
        const std::size_t count = std::min(size, filled_ - at_);
        std::copy_n(buffer_.begin() + static_cast<std::ptrdiff_t>(at_), count, data);
        at_ += count;
        return static_cast<ssize_t>(count);
    }
    ssize_t write(const char* data, size_t size) override {
        if (!wait(POLLOUT)) return -1;
        return ::send(socket_, data, size, MSG_NOSIGNAL | MSG_DONTWAIT);
    }
    void get_remote_ip_and_port(std::string& ip, int& port) const override { address(::getpeername, ip, port); }
    void get_local_ip_and_port(std::string& ip, int& port) const override { address(::getsockname, ip, port); }
    socket_t socket() const override { return socket_; }

private:
    bool wait(short events) const {
        while (!closing_) {
            const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline_ - Clock::now()).count();
            if (left <= 0) return false;
            pollfd waiting{socket_, events, 0};
            if (::poll(&waiting, 1, static_cast<int>(std::min<std::int64_t>(left, look_ms))) > 0) return true;
        }
        return false;
    }
    template <class Ask>
    void address(const Ask& ask, std::string& ip, int& port) const {
        sockaddr_storage at{};
        socklen_t size = sizeof at;
        std::array<char, NI_MAXHOST> host{};
        std::array<char, NI_MAXSERV> service{};
        if (ask(socket_, reinterpret_cast<sockaddr*>(&at), &size) != 0 ||
            ::getnameinfo(reinterpret_cast<const sockaddr*>(&at), size, host.data(), host.size(), service.data(),
                          service.size(), NI_NUMERICHOST | NI_NUMERICSERV) != 0)
            return;
        ip = host.data();
        port = static_cast<int>(base::parseInteger(service.data()).value_or(0));
    }

    socket_t socket_;
    Clock::time_point deadline_;
    const std::atomic<bool>& closing_;
    std::array<char, 4096> buffer_{};
    std::size_t at_ = 0;
    std::size_t filled_ = 0;
};

/// A thread for each connection, up to a number: a pool would let slow viewers hold its threads against quick ones.
class ConnectionThreads : public httplib::TaskQueue {
public:
    explicit ConnectionThreads(std::size_t most) : most_(most) {}

    void enqueue(std::function<void()> serve) override {
        {
            const std::lock_guard lock(mutex_);
            if (active_ < most_) {
                ++active_;
                std::thread([this, serve = std::move(serve)] {
                    serve();
                    const std::lock_guard done(mutex_);
                    --active_;
                    idle_.notify_all();
                }).detach();
                return;
            }
        }
        refuse_connection = true;
        serve();
        refuse_connection = false;
    }
    void shutdown() override {
        std::unique_lock lock(mutex_);
        idle_.wait(lock, [this] { return active_ == 0; });
    }

private:
    std::size_t most_;
    std::mutex mutex_;
    std::condition_variable idle_;
    std::size_t active_ = 0;
};

/// One request a connection.
class ShortServer : public httplib::Server {
public:
    ShortServer(double connection_s, const std::atomic<bool>& closing)
        : connection_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(connection_s))),
          closing_(closing) {}

    /// httplib lets five wait to be let in; whoever comes sixth would be late by a second.
    void widenQueue() { ::listen(svr_sock_, SOMAXCONN); }

private:
    bool process_and_close_socket(socket_t socket) override {
        bool done = false;
        if (!refuse_connection) {
            DeadlineStream stream(socket, Clock::now() + connection_, closing_);
            bool closed = false;
            done = process_request(stream, true, closed, nullptr);
        }
        ::shutdown(socket, SHUT_RDWR);
        ::close(socket);
        return done;
    }

    Clock::duration connection_;
    const std::atomic<bool>& closing_;
};

std::uint64_t numberOf(const httplib::Request& request, const char* name) {
    const auto value = base::parseInteger(request.get_param_value(name));
    return value && *value > 0 ? static_cast<std::uint64_t>(*value) : 0;
}

/// The host of a Host header, without its port.
std::string hostOf(const std::string& header) {
    const std::size_t bracket = header.rfind(']');
    const std::size_t colon = header.rfind(':');
    return colon != std::string::npos && (bracket == std::string::npos || colon > bracket) ? header.substr(0, colon)
                                                                                           : header;
}

std::optional<MonitorCommand> commandOf(const std::string& body) {
    const base::Json json = base::Json::parse(body, nullptr, false);
    if (!json.is_object() || !json.contains("do") || !json["do"].is_string()) return std::nullopt;
    MonitorCommand out{json["do"].get<std::string>(), 0.0};
    if (json.contains("value")) {
        if (!json["value"].is_number()) return std::nullopt;
        out.value = json["value"].get<double>();
    }
    static constexpr std::array<std::string_view, 4> known{"stop", "reset", "override", "single"};
    if (std::ranges::find(known, out.name) == known.end()) return std::nullopt;
    return out;
}

/// Takes as long whatever the difference is.
bool sameToken(const std::string& given, const std::string& wanted) {
    if (given.size() != wanted.size()) return false;
    unsigned differs = 0;
    for (std::size_t i = 0; i < given.size(); ++i)
        differs |= static_cast<unsigned>(static_cast<unsigned char>(given[i])) ^
                   static_cast<unsigned>(static_cast<unsigned char>(wanted[i]));
    return differs == 0;
}

}  // namespace

struct MonitorServer::State {
    State(std::string page_text, MonitorFeed& monitor_feed, MonitorOptions monitor_options)
        : page(std::move(page_text)),
          feed(monitor_feed),
          options(std::move(monitor_options)),
          server(options.connection_s, closing) {}

    void route();
    [[nodiscard]] bool admits(const httplib::Request& request) const;
    void command(const httplib::Request& request, httplib::Response& response);

    std::string page;
    MonitorFeed& feed;
    MonitorOptions options;
    std::atomic<bool> closing{false};
    ShortServer server;
    std::string host;
    int port = 0;
    std::thread thread;
};

/// Who is not on the list, and pages of other sites that call this server by a name of theirs (DNS rebinding), get nothing.
bool MonitorServer::State::admits(const httplib::Request& request) const {
    if (!comm::mayConnect(request.remote_addr, options.listen)) return false;
    const std::string asked = hostOf(request.get_header_value("Host"));
    const bool literal = asked.find_first_not_of("0123456789.") == std::string::npos || asked.starts_with('[');
    return asked == "localhost" || asked == host || literal;
}

void MonitorServer::State::command(const httplib::Request& request, httplib::Response& response) {
    if (options.token.empty() || !sameToken(request.get_header_value("X-Cusp-Token"), options.token)) {
        response.status = 403;
        return response.set_content("commands are not enabled here\n", "text/plain");
    }
    const auto wanted = commandOf(request.body);
    response.status = !wanted ? 400 : feed.give(*wanted) ? 202 : 503;
}

void MonitorServer::State::route() {
    server.new_task_queue = [this] { return new ConnectionThreads(options.most_connections); };
    // httplib would share the port with whoever has it already.
    server.set_socket_options([](socket_t socket) {
        const int on = 1;
        ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    });
    server.set_payload_max_length(most_body_bytes);
    server.set_keep_alive_max_count(1);
    server.set_default_headers({{"Cache-Control", "no-store"},
                                {"X-Content-Type-Options", "nosniff"},
                                {"Referrer-Policy", "no-referrer"},
                                {"X-Frame-Options", "DENY"}});
    server.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
        if (admits(request)) return httplib::Server::HandlerResponse::Unhandled;
        response.status = 403;
        return httplib::Server::HandlerResponse::Handled;
    });
    server.Get("/", [this](const httplib::Request&, httplib::Response& response) {
        response.set_content(page, "text/html; charset=utf-8");
    });
    server.Get("/state", [this](const httplib::Request& request, httplib::Response& response) {
        const MonitorCursor seen{numberOf(request, "sample"), numberOf(request, "run"), numberOf(request, "point")};
        response.set_content(feed.state(seen), "application/json");
    });
    server.Get("/path", [this](const httplib::Request&, httplib::Response& response) {
        response.set_content(feed.path(), "application/json");
    });
    server.Post("/command",
                [this](const httplib::Request& request, httplib::Response& response) { command(request, response); });
}

MonitorServer::MonitorServer(std::unique_ptr<State> state) : state_(std::move(state)) {}

MonitorServer::~MonitorServer() {
    state_->closing = true;
    state_->server.stop();
    if (state_->thread.joinable()) state_->thread.join();
}

base::Result<std::unique_ptr<MonitorServer>> MonitorServer::open(std::string_view host_and_port, std::string page,
                                                                 MonitorFeed& feed, MonitorOptions options) {
    const auto url = comm::parseLinkUrl(fmt::format("tcp://{}", host_and_port));
    if (!url) return base::fail(url.error());
    if (auto may = comm::checkListening(*url, options.listen); !may) return base::fail(std::move(may).error());
    auto state = std::make_unique<State>(std::move(page), feed, std::move(options));
    state->route();
    state->host = url->host;
    state->port = url->port;
    if (url->port == 0)
        state->port = state->server.bind_to_any_port(url->host);
    else if (!state->server.bind_to_port(url->host, url->port))
        state->port = -1;
    if (state->port <= 0)
        return base::fail("io.link-open", "cannot listen there; is the port taken?",
                          {std::string(host_and_port), 0, 0, {}});
    state->server.widenQueue();
    state->thread = std::thread([serving = state.get()] { serving->server.listen_after_bind(); });
    // `stop` has an effect only on a server that runs.
    while (!state->server.is_running()) std::this_thread::yield();
    return std::unique_ptr<MonitorServer>(new MonitorServer(std::move(state)));
}

std::string MonitorServer::url() const {
    const bool v6 = state_->host.find(':') != std::string::npos;
    return fmt::format("http://{}{}{}:{}/{}{}", v6 ? "[" : "", state_->host, v6 ? "]" : "", state_->port,
                       state_->options.token.empty() ? "" : "#", state_->options.token);
}

void MonitorServer::linger(double most_s) const {
    const auto until = Clock::now() + std::chrono::duration<double>(most_s);
    while (state_->feed.watched() && !state_->feed.lastStateSeen() && Clock::now() < until)
        std::this_thread::sleep_for(std::chrono::milliseconds(look_ms));
}

}  // namespace cusp::cli
