// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Draws the bar, and wipes it away at the end.
#include "progress_bar.hpp"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>
#include <utility>

namespace cusp::cli {

namespace {
constexpr std::size_t bar_cells = 32;
constexpr auto first_after = std::chrono::seconds(1);
constexpr auto redraw_after = std::chrono::milliseconds(100);
}  // namespace

ProgressBar::ProgressBar(std::string label)
    : label_(std::move(label)), terminal_(::isatty(STDERR_FILENO) == 1), next_(Clock::now() + first_after) {}

ProgressBar::~ProgressBar() {
    if (drawn_) std::fputs("\r\033[K", stderr);
}

void ProgressBar::show(std::uint64_t done, std::uint64_t total) {
    if (!terminal_) return;
    const auto now = Clock::now();
    if (now < next_) return;
    next_ = now + redraw_after;
    drawn_ = true;
    std::string text = "\r\033[K" + label_;
    if (total > 0) {
        const double share = std::min(1.0, static_cast<double>(done) / static_cast<double>(total));
        const auto cells = static_cast<std::size_t>(share * static_cast<double>(bar_cells));
        text += " [" + std::string(cells, '#') + std::string(bar_cells - cells, '.') +
                fmt::format("] {:3.0f} %", share * 100);
    } else {
        text += fmt::format(" {}", done);
    }
    std::fputs(text.c_str(), stderr);
    std::fflush(stderr);
}

}  // namespace cusp::cli
