// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The ledger of transfers: what went where, by whom, when, and how it ended. Nothing in it is ever changed or removed.
#pragma once

#include <cusp/base/result.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cusp::comm {

struct LedgerEntry {
    std::int64_t number = 0;  ///< set by the ledger
    std::string time_utc;     ///< "2026-05-01T12:34:56Z"
    std::string transfer;     ///< the same for all entries of one transfer
    std::string event;        ///< "begun", "delivered", "refused", "aborted" …
    std::string program;
    std::string digest;  ///< SHA-256 of the program, hexadecimal
    std::uint64_t bytes = 0;
    std::string machine;
    std::string operator_label;
    std::string link;
    std::string detail;
    std::string chain;  ///< set by the ledger: SHA-256 over this entry and the chain of the one before
};

/// A SQLite file. Its own triggers refuse changes and removals; whoever gets past them breaks the chain of digests, which
/// `firstBroken` finds.
class Ledger {
public:
    /// Creates the file when there is none. Errors: `io.ledger` with SQLite's reason.
    [[nodiscard]] static base::Result<Ledger> open(const std::string& path);
    Ledger(Ledger&&) noexcept;
    Ledger& operator=(Ledger&&) noexcept;
    ~Ledger();

    /// Appends one entry; it is on the disk when this returns. Several processes may write the same ledger.
    [[nodiscard]] base::Result<std::int64_t> append(const LedgerEntry& entry);
    /// The last `most` entries, oldest first.
    [[nodiscard]] base::Result<std::vector<LedgerEntry>> last(std::size_t most) const;
    /// Number of the first entry whose chain does not fit, 0 when all do. A ledger cut off at its end is not noticed.
    [[nodiscard]] base::Result<std::int64_t> firstBroken() const;

private:
    struct Connection;
    explicit Ledger(std::unique_ptr<Connection> connection);
    std::unique_ptr<Connection> connection_;
};

}  // namespace cusp::comm
