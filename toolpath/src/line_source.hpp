// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Turns a stream into lines, block by block; memory stays at one block whatever the file's size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <istream>
#include <string_view>
#include <vector>

namespace cusp::toolpath::detail {

class LineSource {
public:
    enum class Status : std::uint8_t { Line, End, TooLong, TooMany, Binary, ReadError };

    LineSource(std::istream& in, std::size_t block_bytes, std::size_t max_line_bytes);

    /// Up to `bytes` of what comes next, without consuming it; less only at the end of the file. Valid until `next`.
    [[nodiscard]] std::string_view peek(std::size_t bytes);

    /// Passes over bytes that `peek` showed.
    void skip(std::size_t bytes) { begin_ += bytes; }
    /// A NUL byte was met, at the end of what `peek` shows or behind it.
    [[nodiscard]] bool isBinary() const { return binary_; }

    /// The next line without its end (LF or CR LF). Valid until the next call.
    [[nodiscard]] Status next(std::string_view& line) {
        const char* const first = buffer_.data() + begin_;
        const void* const newline = std::memchr(first, '\n', limit_ - begin_);
        if (newline == nullptr) {
            return nextAcrossBlocks(line);
        }
        return deliver(static_cast<std::size_t>(static_cast<const char*>(newline) - first), 1, line);
    }

    /// Number of the line last delivered or asked for, from 1.
    [[nodiscard]] std::uint32_t lineNumber() const { return line_number_; }

private:
    [[nodiscard]] Status deliver(std::size_t length, std::size_t end_length, std::string_view& line);
    [[nodiscard]] Status nextAcrossBlocks(std::string_view& line);
    /// Appends one block to the buffer. False at the end of the stream, after a read error, or behind a NUL byte.
    bool fill();

    std::istream* in_;
    std::vector<char> buffer_;
    std::size_t block_bytes_;
    std::size_t max_line_bytes_;
    std::size_t begin_ = 0;  ///< first byte not yet delivered
    std::size_t limit_ = 0;  ///< end of the text in the buffer: its last byte, or the first NUL
    std::uint32_t line_number_ = 0;
    bool at_end_ = false;
    bool binary_ = false;
    bool read_error_ = false;
};

}  // namespace cusp::toolpath::detail
