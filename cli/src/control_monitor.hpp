// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What the monitor page shows of a virtual control, and what it may do to it.
#pragma once

#include "monitor_server.hpp"

#include <cusp/comm/controller/control_station.hpp>
#include <cusp/comm/dnc/ledger.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cusp::cli {

struct ControlMonitorOptions {
    std::string place;  ///< "127.0.0.1:8080"
    comm::ListenOptions listen{};
    bool commands = false;
    std::string title;
    /// Where the control's links listen, for the page to say.
    std::vector<std::string> links{};
    const machine::SetupDefinition* setup = nullptr;
    double tool_length_mm = 0.0;
    geometry::Vector3 wcs_origin_mm = geometry::Vector3::Zero();
};

/// Belongs to the thread that steps the station.
class ControlMonitor {
public:
    /// Errors: those of `MonitorServer::open`.
    [[nodiscard]] static base::Result<std::unique_ptr<ControlMonitor>> open(comm::ControlStation& station,
                                                                            const post::MachineFile& file,
                                                                            const kinematics::Machine& machine,
                                                                            ControlMonitorOptions options);
    /// After every step of the station: does what viewers asked for, and tells them what there is to see.
    void step();
    void showLedger(const comm::Ledger& ledger);
    [[nodiscard]] std::string url() const { return server_->url(); }

private:
    ControlMonitor(comm::ControlStation& station, const post::MachineFile& file, const kinematics::Machine& machine,
                   ControlMonitorOptions options)
        : station_(station), file_(file), machine_(machine), options_(std::move(options)) {}
    void obey(const MonitorCommand& command);
    void followProgram();
    void tellState(double now_s);
    void addSample(double now_s);
    [[nodiscard]] base::Json axes() const;
    [[nodiscard]] base::Json transfer() const;

    comm::ControlStation& station_;
    const post::MachineFile& file_;
    const kinematics::Machine& machine_;
    ControlMonitorOptions options_;
    MonitorFeed feed_;
    std::unique_ptr<MonitorServer> server_;
    base::Json ledger_ = base::Json::array();
    std::size_t chosen_ = 0;
    bool active_ = false;
    double told_s_ = 0.0;
    double sampled_s_ = 0.0;
    std::uint32_t bytes_ = 0;
    double bytes_per_s_ = 0.0;
};

/// The last entries, newest first: what both monitor pages show of a ledger.
[[nodiscard]] base::Json ledgerJson(const comm::Ledger& ledger);
/// A random word of 128 bits, hexadecimal.
[[nodiscard]] std::string randomToken();

}  // namespace cusp::cli
