// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Judging candidates: many at once, none twice, all counted.
#pragma once

#include <cusp/base/progress.hpp>
#include <cusp/base/result.hpp>
#include <cusp/optimizer/evolution/encoding.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <span>
#include <vector>

namespace cusp::optimizer {

/// What is known of a candidate. `objectives` are minimised; the binary engines need exactly one, the strategy on real
/// vectors compares several lexicographically. +infinity means "not allowed"; NaN is an error. `details` (criteria, counts …)
/// are kept and handed back, nothing more.
struct Evaluation {
    std::vector<double> objectives;
    std::vector<double> details;
};

/// Judges one candidate. Called from several threads at once.
using Evaluate = std::function<base::Result<Evaluation>(const Values&)>;

/// Judges candidates in any way it likes (threads, machines). One evaluation per candidate, in order; fewer (the first ones)
/// only where `progress.stopRequested()`. Calls `progress.advance()` per candidate judged.
using EvaluateBatch =
    std::function<base::Result<std::vector<Evaluation>>(std::span<const Values>, base::Progress& progress)>;

/// Candidates of a batch at once, by TBB. The first error in the order of the batch is the batch's.
[[nodiscard]] EvaluateBatch inParallel(Evaluate evaluate);

/// For problems with one number and no details.
[[nodiscard]] EvaluateBatch inParallel(std::function<double(const Values&)> objective);

/// What tells candidates apart: gene codes, or the bytes of real values.
using CandidateKey = std::vector<std::uint64_t>;

/// Every candidate judged so far, in order of its first evaluation. A candidate is never evaluated twice, and the number of
/// distinct candidates is the count of evaluations every algorithm is charged with.
class Ledger {
public:
    static constexpr std::size_t not_evaluated = std::numeric_limits<std::size_t>::max();

    struct Entry {
        CandidateKey key;
        Values values;
        Evaluation evaluation;
    };

    /// Evaluations end at `max_evaluations`, whatever is asked for.
    Ledger(EvaluateBatch evaluate, std::size_t max_evaluations, std::size_t objective_count, base::Progress& progress);

    /// The index of each candidate's entry, or `not_evaluated` where the budget ended or a stop was asked for; the first
    /// new ones are taken. `keys` and `values` run in parallel.
    /// Errors: those of the problem; `evolution.evaluator` where it gives a wrong number of evaluations or objectives;
    /// `evolution.objective-nan`.
    [[nodiscard]] base::Result<std::vector<std::size_t>> evaluate(std::span<const CandidateKey> keys,
                                                                  std::span<const Values> values);

    [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
    /// `entries`, and behind them those judged but not charged yet.
    [[nodiscard]] std::vector<Entry> known() const;
    [[nodiscard]] double objective(std::size_t index) const { return entries_[index].evaluation.objectives.front(); }
    [[nodiscard]] std::size_t size() const { return entries_.size(); }
    /// Requests that were answered without an evaluation.
    [[nodiscard]] std::size_t repeats() const { return repeats_; }
    /// Whether an evaluation was refused because of the budget.
    [[nodiscard]] bool exhausted() const { return exhausted_; }

    /// Takes up what an earlier run knew. The first `charged` entries count as evaluated; the others were judged in a
    /// generation that did not end: they are charged when they are asked for again, without being judged again.
    void restore(std::vector<Entry> entries, std::size_t charged, std::size_t repeats);

private:
    [[nodiscard]] base::Result<void> take(std::span<const Values> values, std::span<const CandidateKey> keys);
    [[nodiscard]] base::Result<std::vector<Evaluation>> judge(std::span<const Values> values,
                                                              std::span<const CandidateKey> keys);
    [[nodiscard]] base::Result<void> check(const Values& values, const Evaluation& evaluation) const;

    EvaluateBatch evaluate_;
    std::size_t max_evaluations_;
    std::size_t objective_count_;
    base::Progress& progress_;
    std::vector<Entry> entries_;
    std::map<CandidateKey, std::size_t> index_;
    std::map<CandidateKey, Entry> carried_;
    std::size_t repeats_ = 0;
    bool exhausted_ = false;
};

}  // namespace cusp::optimizer
