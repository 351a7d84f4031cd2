// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Blocks of a stream, and the lines in them.
#include "points/byte_source.hpp"

namespace cusp::inspect {

void ByteSource::fill(std::size_t bytes) {
    if (buffer_.size() - begin_ >= bytes || at_end_) return;
    buffer_.erase(0, begin_);
    begin_ = 0;
    while (buffer_.size() < bytes && !at_end_) {
        const std::size_t old_size = buffer_.size();
        buffer_.resize(old_size + block_bytes_);
        in_.read(buffer_.data() + old_size, static_cast<std::streamsize>(block_bytes_));
        const auto got = static_cast<std::size_t>(in_.gcount());
        buffer_.resize(old_size + got);
        at_end_ = got < block_bytes_;
    }
}

std::string_view ByteSource::peek(std::size_t bytes) {
    fill(bytes);
    return rest().substr(0, bytes);
}

bool ByteSource::nextLine(std::string_view& line) {
    std::size_t searched = 0;
    for (;;) {
        const std::string_view text = rest();
        const std::size_t end = text.find_first_of("\r\n", searched);
        // A CR at the very end of what was read may have its LF still to come.
        const bool complete = end != std::string_view::npos && (text[end] == '\n' || end + 1 < text.size());
        if (complete || at_end_) {
            if (text.empty()) return false;
            ++line_number_;
            line = text.substr(0, end);
            if (end == std::string_view::npos)
                begin_ = buffer_.size();
            else
                begin_ += end + (text.substr(end, 2) == "\r\n" ? 2 : 1);
            return true;
        }
        searched = end == std::string_view::npos ? text.size() : end;
        fill(text.size() + 1);
    }
}

bool ByteSource::take(std::size_t bytes, std::string_view& data) {
    fill(bytes);
    if (buffer_.size() - begin_ < bytes) return false;
    data = rest().substr(0, bytes);
    begin_ += bytes;
    return true;
}

}  // namespace cusp::inspect
