// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What the rooms report of long work, as a bar on stderr; Ctrl-C as the request to stop.
#pragma once

#include "progress_bar.hpp"

#include <cusp/base/progress.hpp>

#include <cstdint>
#include <memory>
#include <mutex>
#include <string_view>

namespace cusp::cli {

/// Threads may advance it at once.
class ShownProgress : public base::Progress {
public:
    void begin(std::uint64_t total, std::string_view label) override;
    void advance(std::uint64_t steps) override;
    void end() override;
    [[nodiscard]] bool stopRequested() const override;

private:
    std::mutex mutex_;
    std::unique_ptr<ProgressBar> bar_;
    std::uint64_t total_ = 0;
    std::uint64_t done_ = 0;
};

}  // namespace cusp::cli
