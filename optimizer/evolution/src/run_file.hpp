// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The file of a checkpoint: what all kinds of searches have in common in it.
#pragma once

#include <cusp/base/json_report.hpp>
#include <cusp/optimizer/evolution/evaluation.hpp>

#include <functional>
#include <string>
#include <vector>

namespace cusp::optimizer {

/// Infinity is null: JSON has no word for it.
[[nodiscard]] base::Json numberJson(double value);
[[nodiscard]] double numberOf(const base::Json& json);
[[nodiscard]] base::Json numbersJson(const std::vector<double>& values);
[[nodiscard]] std::vector<double> numbersOf(const base::Json& json);

[[nodiscard]] base::Json entriesJson(const std::vector<Ledger::Entry>& entries);
/// Throws where an entry has not so many codes or objectives.
[[nodiscard]] std::vector<Ledger::Entry> entriesOf(const base::Json& json, std::size_t codes, std::size_t objectives,
                                                   const std::function<Values(const CandidateKey&)>& values_of);

/// `settings` is what a run that resumes must have in common with the one that wrote the file.
[[nodiscard]] base::Result<void> writeRun(const std::string& path, const base::Json& settings, base::Json run);
/// Hands the run of `path` to `take`, which may throw where it is not what it should be; does nothing where there is no such
/// file. Errors: `io.*`, `evolution.checkpoint` (no checkpoint, or damaged), `evolution.checkpoint-differs` (of another
/// problem, seed or setting, naming the first that differs).
[[nodiscard]] base::Result<void> readRun(const std::string& path, const base::Json& settings,
                                         const std::function<void(const base::Json&)>& take);

}  // namespace cusp::optimizer
