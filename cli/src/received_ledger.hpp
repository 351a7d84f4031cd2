// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The control's own record of what it was sent and what became of it.
#pragma once

#include <cusp/comm/controller/control_station.hpp>
#include <cusp/comm/dnc/ledger.hpp>

#include <string>

namespace cusp::cli {

class ReceivedLedger {
public:
    /// Errors: `io.ledger`.
    [[nodiscard]] static base::Result<ReceivedLedger> open(const std::string& path, std::string machine);
    /// After every step: writes an entry where the receiver's state or program has changed. True when it wrote one.
    [[nodiscard]] base::Result<bool> follow(const comm::ControlStation& station);
    [[nodiscard]] const comm::Ledger& ledger() const { return ledger_; }

private:
    ReceivedLedger(comm::Ledger ledger, std::string machine)
        : ledger_(std::move(ledger)), machine_(std::move(machine)) {}

    comm::Ledger ledger_;
    std::string machine_;
    comm::ReceiverState state_ = comm::ReceiverState::Idle;
    std::uint32_t session_ = 0;
};

}  // namespace cusp::cli
