// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// How long work tells how far it is, and hears that it should stop; drawing is the application's business.
#pragma once

#include <atomic>
#include <cstdint>
#include <string_view>

namespace cusp::base {

/// Libraries call this. `begin` and `end` come from one thread and do not nest; `advance` and `stopRequested` from any.
class Progress {
public:
    Progress() = default;
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    virtual ~Progress() = default;

    /// `total` steps lie ahead, 0 when their number is not known.
    virtual void begin(std::uint64_t total, std::string_view label) = 0;
    virtual void advance(std::uint64_t steps = 1) = 0;
    virtual void end() = 0;
    /// The work should end soon, leaving nothing half-done behind (the user pressed Ctrl-C).
    [[nodiscard]] virtual bool stopRequested() const = 0;
};

/// For callers that do not want to know: does nothing and never stops. One object for all threads.
[[nodiscard]] Progress& noProgress();

/// Counts, without locks; whoever draws reads `done` and `total` when it pleases.
class CountingProgress : public Progress {
public:
    void begin(std::uint64_t total, std::string_view label) override;
    void advance(std::uint64_t steps = 1) override { done_.fetch_add(steps, std::memory_order_relaxed); }
    void end() override {}
    [[nodiscard]] bool stopRequested() const override { return stop_.load(std::memory_order_relaxed); }

    [[nodiscard]] std::uint64_t done() const { return done_.load(std::memory_order_relaxed); }
    [[nodiscard]] std::uint64_t total() const { return total_.load(std::memory_order_relaxed); }
    /// Safe in a signal handler.
    void requestStop() noexcept { stop_.store(true, std::memory_order_relaxed); }

private:
    std::atomic<std::uint64_t> done_{0};
    std::atomic<std::uint64_t> total_{0};
    std::atomic<bool> stop_{false};
};

}  // namespace cusp::base
