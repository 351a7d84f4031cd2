// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Block reading behind the line source.
#include "line_source.hpp"

#include <algorithm>
#include <limits>

namespace cusp::toolpath::detail {

LineSource::LineSource(std::istream& in, std::size_t block_bytes, std::size_t max_line_bytes)
    : in_(&in),
      buffer_(std::max<std::size_t>(block_bytes, 1)),
      block_bytes_(std::max<std::size_t>(block_bytes, 1)),
      max_line_bytes_(max_line_bytes) {}

bool LineSource::fill() {
    if (at_end_ || binary_) {
        return false;
    }
    if (begin_ > 0) {
        std::memmove(buffer_.data(), buffer_.data() + begin_, limit_ - begin_);
        limit_ -= begin_;
        begin_ = 0;
    }
    if (buffer_.size() < limit_ + block_bytes_) {
        buffer_.resize(limit_ + block_bytes_);
    }
    std::size_t got = 0;
    try {
        in_->read(buffer_.data() + limit_, static_cast<std::streamsize>(block_bytes_));
        got = static_cast<std::size_t>(in_->gcount());
    } catch (const std::exception&) {  // only when the owner of the stream asked for exceptions
        got = static_cast<std::size_t>(in_->gcount());
    }
    read_error_ = in_->bad();
    at_end_ = !in_->good();
    const void* const nul = std::memchr(buffer_.data() + limit_, '\0', got);
    if (nul != nullptr) {
        binary_ = true;
        got = static_cast<std::size_t>(static_cast<const char*>(nul) - (buffer_.data() + limit_));
    }
    limit_ += got;
    return got > 0;
}

std::string_view LineSource::peek(std::size_t bytes) {
    while (limit_ - begin_ < bytes && fill()) {
    }
    return {buffer_.data() + begin_, std::min(bytes, limit_ - begin_)};
}

LineSource::Status LineSource::deliver(std::size_t length, std::size_t end_length, std::string_view& line) {
    if (line_number_ == std::numeric_limits<std::uint32_t>::max()) {
        return Status::TooMany;
    }
    ++line_number_;
    if (length > max_line_bytes_) {
        return Status::TooLong;
    }
    line = {buffer_.data() + begin_, length};
    begin_ += length + end_length;
    if (!line.empty() && line.back() == '\r') {
        line.remove_suffix(1);
    }
    return Status::Line;
}

LineSource::Status LineSource::nextAcrossBlocks(std::string_view& line) {
    std::size_t searched = limit_ - begin_;
    while (searched <= max_line_bytes_ && fill()) {
        const char* const first = buffer_.data() + begin_;
        const void* const newline = std::memchr(first + searched, '\n', limit_ - begin_ - searched);
        if (newline != nullptr) {
            return deliver(static_cast<std::size_t>(static_cast<const char*>(newline) - first), 1, line);
        }
        searched = limit_ - begin_;
    }
    if (searched > max_line_bytes_) {
        return deliver(searched, 0, line);
    }
    if (binary_ || read_error_) {
        ++line_number_;
        return binary_ ? Status::Binary : Status::ReadError;
    }
    return searched == 0 ? Status::End : deliver(searched, 0, line);
}

}  // namespace cusp::toolpath::detail
