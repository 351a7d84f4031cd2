// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The control's status for MTConnect agents: SHDR lines on a port of their own (MTConnect Part 1, adapters and agents).
#pragma once

#include <cusp/comm/controller/virtual_control.hpp>
#include <cusp/comm/link/line_server.hpp>

#include <chrono>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::comm {

/// Data items and their values as text, in SHDR's form. Sans-I/O.
class ShdrLines {
public:
    using Clock = std::chrono::system_clock;

    explicit ShdrLines(const kinematics::Machine& machine);

    /// Everything, for an agent that has just come.
    [[nodiscard]] std::string all(const ControlStatus& status, Clock::time_point now);
    /// What has changed since the last call of either; empty when nothing has.
    [[nodiscard]] std::string changes(const ControlStatus& status, Clock::time_point now);
    /// "* PONG 10000\n" to "* PING", nothing to anything else.
    [[nodiscard]] static std::string answer(std::string_view line);

private:
    struct Item {
        std::string name;
        std::string value;
    };
    [[nodiscard]] std::vector<Item> itemsOf(const ControlStatus& status) const;
    [[nodiscard]] std::string conditions(const ControlStatus& status, const std::string& time, bool all);

    std::vector<std::string> axis_names_;
    std::map<std::string, std::string> told_;
    std::vector<Alarm> told_alarms_;
};

/// The lines on a socket.
class ShdrAdapter {
public:
    /// As `LineServer::listen`. The names of the axes are those of the machine.
    [[nodiscard]] static base::Result<ShdrAdapter>
    listen(std::string_view host_and_port, const kinematics::Machine& machine, const ListenOptions& options);
    /// Call it often; changes are told ten times a second.
    void step(const ControlStatus& status);
    [[nodiscard]] const std::string& name() const { return server_.name(); }
    [[nodiscard]] std::size_t clients() const { return server_.clients(); }

private:
    ShdrAdapter(LineServer server, const kinematics::Machine& machine) : server_(std::move(server)), lines_(machine) {}
    LineServer server_;
    ShdrLines lines_;
    ShdrLines::Clock::time_point told_at_{};
};

}  // namespace cusp::comm
