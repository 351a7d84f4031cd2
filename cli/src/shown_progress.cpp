// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A new bar for every piece of work.
#include "shown_progress.hpp"

#include "console.hpp"

#include <string>

namespace cusp::cli {

void ShownProgress::begin(std::uint64_t total, std::string_view label) {
    const std::lock_guard lock(mutex_);
    bar_ = std::make_unique<ProgressBar>(std::string(label));
    total_ = total;
    done_ = 0;
}

void ShownProgress::advance(std::uint64_t steps) {
    const std::lock_guard lock(mutex_);
    done_ += steps;
    if (bar_) bar_->show(done_, total_);
}

void ShownProgress::end() {
    const std::lock_guard lock(mutex_);
    bar_.reset();
}

bool ShownProgress::stopRequested() const { return interrupted(); }

}  // namespace cusp::cli
