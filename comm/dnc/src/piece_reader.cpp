// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Pieces asked for, asked for again, and put where they belong.
#include <cusp/comm/dnc/piece_reader.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace cusp::comm {

PieceReader::PieceReader(std::string name, std::size_t piece_bytes, std::size_t window, std::uint32_t max_bytes)
    : name_(std::move(name)),
      piece_bytes_(std::clamp<std::size_t>(piece_bytes, 1, max_payload_bytes)),
      window_(std::max<std::size_t>(1, window)),
      max_bytes_(max_bytes),
      pieces_(1) {}

std::optional<Request> PieceReader::poll(Conversation& conversation, double now_s) {
    if (done()) return std::nullopt;
    const double timeout_s = conversation.roundTrip().timeoutSeconds();
    std::size_t looked_at = 0;
    for (std::size_t i = first_missing_; i < pieces_.size() && looked_at < window_; ++i) {
        Piece& piece = pieces_[i];
        if (piece.have) continue;
        ++looked_at;
        if (piece.asked_s >= 0.0 && now_s < piece.asked_s + timeout_s) continue;
        if (piece.asked_s >= 0.0) conversation.roundTrip().backOff();
        piece.asked_s = now_s;
        Bytes wanted;
        put16(wanted, static_cast<std::uint32_t>(piece_bytes_));
        append(wanted, bytesOf(name_));
        return conversation.make(RequestType::Read, static_cast<std::uint32_t>(i * piece_bytes_), wanted, true, now_s);
    }
    return std::nullopt;
}

double PieceReader::nextAtSeconds(const Conversation& conversation) const {
    double next_s = std::numeric_limits<double>::infinity();
    std::size_t looked_at = 0;
    for (std::size_t i = first_missing_; i < pieces_.size() && looked_at < window_; ++i) {
        if (pieces_[i].have) continue;
        ++looked_at;
        next_s = std::min(
            next_s, pieces_[i].asked_s < 0.0 ? 0.0 : pieces_[i].asked_s + conversation.roundTrip().timeoutSeconds());
    }
    return next_s;
}

bool PieceReader::accept(const UploadPiece& piece) {
    if (!total_) {
        if (piece.total > max_bytes_) return false;
        total_ = piece.total;
        bytes_.resize(piece.total);
        pieces_.resize((piece.total + piece_bytes_ - 1) / piece_bytes_);
    }
    if (piece.total != *total_) return false;
    const std::size_t index = piece.offset / piece_bytes_;
    if (piece.offset % piece_bytes_ != 0 || index >= pieces_.size() || pieces_[index].have) return true;
    // A shorter piece than was asked for would leave a hole.
    const std::size_t expected = std::min<std::size_t>(piece_bytes_, *total_ - piece.offset);
    if (piece.bytes.size() != expected) return true;
    std::copy(piece.bytes.begin(), piece.bytes.end(), bytes_.begin() + piece.offset);
    pieces_[index].have = true;
    ++have_;
    received_ += static_cast<std::uint32_t>(expected);
    while (first_missing_ < pieces_.size() && pieces_[first_missing_].have) ++first_missing_;
    return true;
}

}  // namespace cusp::comm
