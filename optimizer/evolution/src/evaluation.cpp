// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The ledger of judged candidates, and batches on all cores.
#include <cusp/optimizer/evolution/evaluation.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <tbb/parallel_for.h>
#include <utility>

namespace cusp::optimizer {

EvaluateBatch inParallel(Evaluate evaluate) {
    return [evaluate = std::move(evaluate)](std::span<const Values> batch,
                                            base::Progress& progress) -> base::Result<std::vector<Evaluation>> {
        std::vector<std::optional<base::Result<Evaluation>>> results(batch.size());
        tbb::parallel_for(std::size_t{0}, batch.size(), [&](std::size_t i) {
            if (progress.stopRequested()) return;
            results[i].emplace(evaluate(batch[i]));
            progress.advance();
        });
        std::vector<Evaluation> out;
        out.reserve(batch.size());
        for (auto& result : results) {
            if (!result) break;  // stopped; what was judged behind the first gap is not used
            if (!*result) return tl::unexpected(std::move(result->error()));
            out.push_back(std::move(**result));
        }
        return out;
    };
}

EvaluateBatch inParallel(std::function<double(const Values&)> objective) {
    return inParallel(Evaluate([objective = std::move(objective)](const Values& values) -> base::Result<Evaluation> {
        return Evaluation{.objectives = {objective(values)}, .details = {}};
    }));
}

Ledger::Ledger(EvaluateBatch evaluate, std::size_t max_evaluations, std::size_t objective_count,
               base::Progress& progress)
    : evaluate_(std::move(evaluate)),
      max_evaluations_(max_evaluations),
      objective_count_(objective_count),
      progress_(progress) {}

void Ledger::restore(std::vector<Entry> entries, std::size_t charged, std::size_t repeats) {
    index_.clear();
    carried_.clear();
    charged = std::min(charged, entries.size());
    for (std::size_t i = 0; i < charged; ++i) index_.emplace(entries[i].key, i);
    for (std::size_t i = charged; i < entries.size(); ++i) carried_.emplace(entries[i].key, entries[i]);
    entries.erase(entries.begin() + static_cast<std::ptrdiff_t>(charged), entries.end());
    entries_ = std::move(entries);
    repeats_ = repeats;
}

base::Result<std::vector<std::size_t>> Ledger::evaluate(std::span<const CandidateKey> keys,
                                                        std::span<const Values> values) {
    std::vector<CandidateKey> new_keys;
    std::vector<Values> new_values;
    std::map<CandidateKey, std::size_t> pending;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (index_.contains(keys[i]) || !pending.emplace(keys[i], new_keys.size()).second) continue;
        if (entries_.size() + new_keys.size() >= max_evaluations_) {
            exhausted_ = true;
            continue;
        }
        new_keys.push_back(keys[i]);
        new_values.push_back(values[i]);
    }
    if (!new_keys.empty())
        if (auto taken = take(new_values, new_keys); !taken) return tl::unexpected(std::move(taken.error()));

    std::vector<std::size_t> out;
    out.reserve(keys.size());
    std::size_t answered = 0;
    for (const CandidateKey& key : keys) {
        const auto found = index_.find(key);
        out.push_back(found == index_.end() ? not_evaluated : found->second);
        if (found != index_.end()) ++answered;
    }
    repeats_ += answered - std::min(answered, new_keys.size());
    return out;
}

std::vector<Ledger::Entry> Ledger::known() const {
    std::vector<Entry> out = entries_;
    for (const auto& [key, entry] : carried_) out.push_back(entry);
    return out;
}

base::Result<std::vector<Evaluation>> Ledger::judge(std::span<const Values> values,
                                                    std::span<const CandidateKey> keys) {
    std::vector<Values> unknown;
    for (std::size_t i = 0; i < keys.size(); ++i)
        if (!carried_.contains(keys[i])) unknown.push_back(values[i]);
    std::vector<Evaluation> judged;
    if (!unknown.empty()) {
        auto answer = evaluate_(unknown, progress_);
        if (!answer) return tl::unexpected(std::move(answer.error()));
        judged = std::move(*answer);
        if (judged.size() > unknown.size() || (judged.size() < unknown.size() && !progress_.stopRequested()))
            return base::fail("evolution.evaluator",
                              fmt::format("the evaluator was given {} candidates and answered for {}", unknown.size(),
                                          judged.size()));
    }
    std::vector<Evaluation> out;
    std::size_t next = 0;
    for (const CandidateKey& key : keys) {
        if (const auto known = carried_.find(key); known != carried_.end()) {
            out.push_back(known->second.evaluation);
            continue;
        }
        if (next == judged.size()) break;  // stopped
        out.push_back(std::move(judged[next++]));
    }
    return out;
}

base::Result<void> Ledger::check(const Values& values, const Evaluation& evaluation) const {
    if (evaluation.objectives.size() != objective_count_)
        return base::fail("evolution.evaluator", fmt::format("the evaluator gave {} objectives where {} are expected",
                                                             evaluation.objectives.size(), objective_count_));
    for (const double objective : evaluation.objectives)
        if (std::isnan(objective))
            return base::fail("evolution.objective-nan",
                              fmt::format("the objective of candidate ({}) is not a number", fmt::join(values, ", ")));
    return {};
}

base::Result<void> Ledger::take(std::span<const Values> values, std::span<const CandidateKey> keys) {
    auto evaluations = judge(values, keys);
    if (!evaluations) return tl::unexpected(std::move(evaluations.error()));
    for (std::size_t i = 0; i < evaluations->size(); ++i) {
        if (auto good = check(values[i], (*evaluations)[i]); !good) return good;
        carried_.erase(keys[i]);
        index_.emplace(keys[i], entries_.size());
        entries_.push_back({keys[i], values[i], std::move((*evaluations)[i])});
    }
    return {};
}

}  // namespace cusp::optimizer
