// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Lines out of memory or FIFO.
#include "program_feed.hpp"

#include <sstream>

namespace cusp::comm {

void ProgramFeed::open(std::string text) {
    memory_ = std::make_unique<std::istringstream>(std::move(text));
    fifo_open_ = false;
    ended_ = true;
    fifo_.clear();
}

void ProgramFeed::openFifo(std::size_t capacity) {
    lines_ = std::make_unique<std::istream>(&line_);
    line_.set({});
    fifo_.clear();
    capacity_ = capacity;
    fifo_open_ = true;
    ended_ = false;
}

bool ProgramFeed::put(std::string_view lines) {
    if (!fifo_open_ || ended_ || lines.size() > free()) return false;
    fifo_ += lines;
    return true;
}

std::istream& ProgramFeed::stream() { return fifo_open_ ? *lines_ : *memory_; }

bool ProgramFeed::offerLine() {
    if (!fifo_open_) return true;
    const std::size_t end = fifo_.find('\n');
    if (end == std::string::npos && !(ended_ && !fifo_.empty())) return false;
    const std::size_t length = end == std::string::npos ? fifo_.size() : end + 1;
    line_.set(fifo_.substr(0, length));
    fifo_.erase(0, length);
    lines_->clear();
    return true;
}

}  // namespace cusp::comm
