// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A search on disk: written whole after a generation, and taken up again.
#pragma once

#include "run_state.hpp"

#include <cusp/base/json_report.hpp>

#include <optional>
#include <string>

namespace cusp::optimizer {

/// What a checkpoint holds: the state after the last complete generation, and every candidate judged until then or since.
struct Checkpoint {
    RunState state;
    std::vector<Ledger::Entry> entries;
    std::size_t charged = 0;  ///< entries known when that generation ended
    std::size_t repeats = 0;
};

/// Everything of problem and options that the outcome depends on, limits excepted (a finished run may be carried on).
[[nodiscard]] base::Json fingerprint(const Encoding& encoding, const SearchOptions& options);

[[nodiscard]] base::Result<void> writeCheckpoint(const std::string& path, const base::Json& fingerprint,
                                                 const Checkpoint& checkpoint);
/// Nothing where there is no such file. Errors: `io.*`, `evolution.checkpoint` (no checkpoint, or damaged),
/// `evolution.checkpoint-differs` (of another problem, seed or setting, with the key that differs).
[[nodiscard]] base::Result<std::optional<Checkpoint>>
readCheckpoint(const std::string& path, const base::Json& fingerprint, const Encoding& encoding);

}  // namespace cusp::optimizer
