// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// One entry a change of the receiver's state.
#include "received_ledger.hpp"

#include "send_record.hpp"

#include <fmt/format.h>

namespace cusp::cli {

base::Result<ReceivedLedger> ReceivedLedger::open(const std::string& path, std::string machine) {
    auto ledger = comm::Ledger::open(path);
    if (!ledger) return base::fail(std::move(ledger).error());
    return ReceivedLedger(*std::move(ledger), std::move(machine));
}

base::Result<bool> ReceivedLedger::follow(const comm::ControlStation& station) {
    const comm::Receiver& receiver = station.receiver();
    const bool begins = receiver.session() != session_ && receiver.state() == comm::ReceiverState::Receiving;
    const bool changed = receiver.state() != state_;
    session_ = receiver.session();
    if (!changed && !begins) return false;
    const comm::ReceiverState before = state_;
    state_ = receiver.state();
    // Back to idle after an end that is written already says nothing new.
    const bool over = before == comm::ReceiverState::Finished || before == comm::ReceiverState::Interrupted ||
                      before == comm::ReceiverState::Failed || before == comm::ReceiverState::Verified;
    if (state_ == comm::ReceiverState::Idle && over) return false;
    const comm::ProgramHeader& program = receiver.program();
    const comm::ControlStatus& now = station.control().status();
    comm::LedgerEntry entry;
    entry.time_utc = nowUtc();
    entry.transfer = fmt::format("{:08x}", receiver.session());
    entry.event = begins ? "begun" : std::string(toText(state_));
    entry.program = program.name;
    entry.digest = comm::toHex(program.digest);
    entry.bytes = begins ? program.length : receiver.acceptedBytes();
    entry.machine = machine_;
    entry.link = fmt::format("client {:08x}", program.client);
    if (program.mode == comm::TransferMode::Drip) entry.detail = "drip";
    if (state_ == comm::ReceiverState::Interrupted && !now.alarms.empty())
        entry.detail = fmt::format("alarm {}: {}; resume at line {}", now.alarms.back().number, now.alarms.back().text,
                                   now.resume_line);
    if (auto written = ledger_.append(entry); !written) return base::fail(std::move(written).error());
    return true;
}

}  // namespace cusp::cli
