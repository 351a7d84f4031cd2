// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Which bytes are acknowledged, under way, lost, and next: a chunk is its place in the program and nothing else.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

namespace cusp::comm {

class ChunkWindow {
public:
    struct Piece {
        std::uint32_t offset = 0;
        std::uint32_t size = 0;
        double sent_s = 0.0;
    };

    void begin(std::uint32_t acknowledged);
    /// A piece to send again, or the next new one of at most `most` bytes that ends at or before `limit`.
    [[nodiscard]] std::optional<Piece> next(std::uint32_t most, std::uint64_t limit) const;
    void sent(const Piece& piece, double now_s);
    /// Returns how many bytes are newly acknowledged; an older acknowledgement changes nothing.
    std::uint32_t acknowledge(std::uint32_t expected);
    /// Everything under way is taken for lost.
    void rewind();
    /// The first piece is taken for lost when it was sent before `sent_before_s`. True when it newly is.
    bool loseFirst(double sent_before_s);

    [[nodiscard]] std::uint32_t acknowledged() const { return acknowledged_; }
    [[nodiscard]] std::size_t underWay() const { return pieces_.size(); }
    [[nodiscard]] std::uint32_t nextNew() const { return next_; }
    [[nodiscard]] bool hasLost() const { return first_lost_; }

private:
    std::uint32_t acknowledged_ = 0;
    std::uint32_t next_ = 0;
    std::deque<Piece> pieces_;
    bool first_lost_ = false;
};

}  // namespace cusp::comm
