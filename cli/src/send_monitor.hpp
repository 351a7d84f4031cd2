// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What the monitor page shows of a transfer while `cusp send` runs it.
#pragma once

#include "monitor_server.hpp"
#include "send_record.hpp"

#include <memory>
#include <optional>
#include <string>

namespace cusp::cli {

/// Belongs to the thread that runs the transfer.
class SendMonitor {
public:
    /// With a machine file (and a setup) the program's path is drawn, and the axes have their names.
    /// Errors: those of `MonitorServer::open`, and of the files named.
    [[nodiscard]] static base::Result<std::unique_ptr<SendMonitor>>
    open(const SendFlags& flags, const comm::Program& program, const SendRecord& record);
    /// From the watch of `runTransfer`.
    void look(const comm::Sender& sender);
    /// How it ended; gives viewers a moment to see it.
    void end(const comm::Sender& sender, const SendRecord& record);
    [[nodiscard]] std::string url() const { return server_->url(); }

private:
    SendMonitor() = default;
    void tell(const comm::Sender& sender);

    MonitorFeed feed_;
    std::unique_ptr<MonitorServer> server_;
    std::vector<std::string> axis_names_;
    std::string link_;
    base::Json ledger_ = base::Json::array();
    double begin_s_ = 0.0;
    double told_s_ = 0.0;
    double sampled_s_ = 0.0;
    std::uint32_t bytes_ = 0;
    double bytes_per_s_ = 0.0;
};

}  // namespace cusp::cli
