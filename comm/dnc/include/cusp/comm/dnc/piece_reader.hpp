// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Reads a program back from the control, piece by piece, in whatever order the pieces come.
#pragma once

#include <cusp/comm/dnc/conversation.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cusp::comm {

class PieceReader {
public:
    /// The program `name`, or with an empty name that of the present transfer. `piece_bytes` a reply can carry, `window`
    /// pieces asked for at the same time, at most `max_bytes` in all.
    PieceReader(std::string name, std::size_t piece_bytes, std::size_t window, std::uint32_t max_bytes);

    [[nodiscard]] std::optional<Request> poll(Conversation& conversation, double now_s);
    /// False: the control says it has more than `max_bytes`, or changes its mind about how many.
    [[nodiscard]] bool accept(const UploadPiece& piece);
    [[nodiscard]] bool done() const { return total_ && have_ == pieces_.size(); }
    [[nodiscard]] const Bytes& bytes() const { return bytes_; }
    [[nodiscard]] std::uint32_t received() const { return received_; }
    [[nodiscard]] double nextAtSeconds(const Conversation& conversation) const;

private:
    struct Piece {
        bool have = false;
        double asked_s = -1.0;
    };
    std::string name_;
    std::size_t piece_bytes_;
    std::size_t window_;
    std::uint32_t max_bytes_;
    std::optional<std::uint32_t> total_;
    std::vector<Piece> pieces_;  ///< one before the total is known
    std::size_t first_missing_ = 0;
    std::size_t have_ = 0;
    std::uint32_t received_ = 0;
    Bytes bytes_;
};

}  // namespace cusp::comm
