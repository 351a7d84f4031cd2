// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A control on a real link: a server in a thread of its own, with a receiver and a program store behind it.
#pragma once

#include "memory_host.hpp"

#include <cusp/comm/dnc/run_transfer.hpp>
#include <cusp/comm/link/transports.hpp>

#include <atomic>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>

namespace cusp::comm::test {

class ServedControl {
public:
    explicit ServedControl(const std::string& url, const ListenOptions& listen = {}, ReceiverOptions options = {})
        : receiver_(std::move(options), host, 4711), service_(receiver_) {
        auto server = openServer(parseLinkUrl(url).value(), service_, listen);
        if (!server) throw std::runtime_error(base::toText(server.error()));
        server_ = *std::move(server);
        name_ = server_->name();
        thread_ = std::thread([this] {
            while (!stop_ && server_->step(0.02).has_value()) clients_ = server_->clients();
        });
    }
    ~ServedControl() { stop(); }
    ServedControl(const ServedControl&) = delete;
    ServedControl& operator=(const ServedControl&) = delete;

    /// Afterwards `host` may be looked at.
    void stop() {
        stop_ = true;
        if (thread_.joinable()) thread_.join();
    }
    const std::string& url() const { return name_; }
    std::uint16_t port() const { return parseLinkUrl(name_).value().port; }
    std::size_t clients() const { return clients_; }

    MemoryHost host;

private:
    Receiver receiver_;
    ReceiverService service_;
    std::unique_ptr<LinkServer> server_;
    std::string name_;
    std::atomic<bool> stop_{false};
    std::atomic<std::size_t> clients_{0};
    std::thread thread_;
};

}  // namespace cusp::comm::test
