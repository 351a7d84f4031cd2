// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Planned records on their way from one thread to the other, in batches, bounded.
#pragma once

#include "axis_stage.hpp"

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <utility>
#include <vector>

namespace cusp::post {

class BatchQueue {
public:
    static constexpr std::size_t batch_records = 256;

    /// Waits while the queue is full.
    void push(std::vector<PlannedRecord>&& batch) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return batches_.size() < most_batches; });
        batches_.push_back(std::move(batch));
        changed_.notify_all();
    }
    /// Waits for a batch; false when the queue is closed and empty.
    [[nodiscard]] bool pop(std::vector<PlannedRecord>& batch) {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return !batches_.empty() || closed_; });
        if (batches_.empty()) return false;
        batch = std::move(batches_.front());
        batches_.pop_front();
        changed_.notify_all();
        return true;
    }

    /// Closes the queue when it goes out of scope.
    class Closer {
    public:
        explicit Closer(BatchQueue& queue) : queue_(queue) {}
        ~Closer() { queue_.close(); }
        Closer(const Closer&) = delete;
        Closer& operator=(const Closer&) = delete;

    private:
        BatchQueue& queue_;
    };
    [[nodiscard]] Closer closeAtEnd() { return Closer(*this); }

private:
    void close() {
        const std::lock_guard lock(mutex_);
        closed_ = true;
        changed_.notify_all();
    }

    /// The branch planner decides half a window at once: with room for that, neither side waits for the other.
    static constexpr std::size_t most_batches = 96;

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::vector<PlannedRecord>> batches_;
    bool closed_ = false;
};

}  // namespace cusp::post
