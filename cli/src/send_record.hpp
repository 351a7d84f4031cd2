// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// One transfer's entries in the ledger.
#pragma once

#include "send_delivery.hpp"

#include <cusp/comm/dnc/ledger.hpp>

#include <optional>
#include <string>

namespace cusp::cli {

/// "2026-05-01T12:34:56Z", as the ledger has it.
[[nodiscard]] std::string nowUtc();

class SendRecord {
public:
    /// Writes that the transfer begins: a transfer that cannot be recorded does not take place.
    /// Errors: `io.ledger`.
    [[nodiscard]] static base::Result<SendRecord> begin(const SendFlags& flags, const comm::Program& program);
    /// Writes how it ended. A ledger that fails now is told, the transfer stands.
    void end(const std::string& event, const std::string& detail);
    /// Empty without a ledger.
    [[nodiscard]] const std::string& transfer() const { return entry_.transfer; }
    /// Null without a ledger.
    [[nodiscard]] const comm::Ledger* ledger() const { return ledger_ ? &*ledger_ : nullptr; }
    [[nodiscard]] const std::string& path() const { return path_; }

private:
    std::optional<comm::Ledger> ledger_;
    comm::LedgerEntry entry_;
    std::string path_;
};

}  // namespace cusp::cli
