// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The sender's book of bytes under way.
#include <cusp/comm/dnc/chunk_window.hpp>

#include <algorithm>

namespace cusp::comm {

void ChunkWindow::begin(std::uint32_t acknowledged) {
    acknowledged_ = acknowledged;
    next_ = acknowledged;
    pieces_.clear();
    first_lost_ = false;
}

std::optional<ChunkWindow::Piece> ChunkWindow::next(std::uint32_t most, std::uint64_t limit) const {
    // As it was: cut shorter it would leave a gap before the next one under way.
    if (first_lost_) return pieces_.front();
    if (limit <= next_) return std::nullopt;
    const auto size = static_cast<std::uint32_t>(std::min<std::uint64_t>(most, limit - next_));
    return size == 0 ? std::nullopt : std::optional<Piece>({next_, size, 0.0});
}

void ChunkWindow::sent(const Piece& piece, double now_s) {
    if (first_lost_) {
        pieces_.front() = {piece.offset, piece.size, now_s};
        first_lost_ = false;
        return;
    }
    pieces_.push_back({piece.offset, piece.size, now_s});
    next_ = piece.offset + piece.size;
}

std::uint32_t ChunkWindow::acknowledge(std::uint32_t expected) {
    if (expected <= acknowledged_) return 0;
    const std::uint32_t gained = expected - acknowledged_;
    acknowledged_ = expected;
    next_ = std::max(next_, expected);
    while (!pieces_.empty() && pieces_.front().offset < expected) {
        first_lost_ = false;
        pieces_.pop_front();
    }
    // The receiver took part of a piece (it held bytes cut otherwise): go on from the acknowledged byte.
    if (pieces_.empty() ? next_ != expected : pieces_.front().offset != expected) rewind();
    return gained;
}

void ChunkWindow::rewind() {
    pieces_.clear();
    next_ = acknowledged_;
    first_lost_ = false;
}

bool ChunkWindow::loseFirst(double sent_before_s) {
    if (first_lost_ || pieces_.empty() || pieces_.front().sent_s >= sent_before_s) return false;
    first_lost_ = true;
    return true;
}

}  // namespace cusp::comm
