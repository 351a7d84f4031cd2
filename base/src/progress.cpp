// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The two kinds of progress a library needs to know.
#include <cusp/base/progress.hpp>

namespace cusp::base {
namespace {

class NoProgress final : public Progress {
public:
    void begin(std::uint64_t /*total*/, std::string_view /*label*/) override {}
    void advance(std::uint64_t /*steps*/) override {}
    void end() override {}
    [[nodiscard]] bool stopRequested() const override { return false; }
};

}  // namespace

Progress& noProgress() {
    static NoProgress instance;
    return instance;
}

void CountingProgress::begin(std::uint64_t total, std::string_view /*label*/) {
    total_.store(total, std::memory_order_relaxed);
    done_.store(0, std::memory_order_relaxed);
}

}  // namespace cusp::base
