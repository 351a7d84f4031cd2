// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A stream as lines and as bytes, read in blocks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <string>
#include <string_view>

namespace cusp::inspect {

class ByteSource {
public:
    ByteSource(std::istream& in, std::size_t block_bytes) : in_(in), block_bytes_(block_bytes == 0 ? 1 : block_bytes) {}

    /// Up to `bytes` of what comes next, left where it is; valid until the next call.
    [[nodiscard]] std::string_view peek(std::size_t bytes);
    /// The next line without its end (LF, CR LF or CR); false at the end. `line` is valid until the next call.
    [[nodiscard]] bool nextLine(std::string_view& line);
    /// Exactly `bytes` bytes; false when fewer are left. `data` is valid until the next call.
    [[nodiscard]] bool take(std::size_t bytes, std::string_view& data);
    /// Number of the last line, counted from 1.
    [[nodiscard]] std::uint64_t lineNumber() const { return line_number_; }

private:
    /// Reads until `bytes` are there or the stream ends.
    void fill(std::size_t bytes);
    [[nodiscard]] std::string_view rest() const { return std::string_view(buffer_).substr(begin_); }

    std::istream& in_;
    std::size_t block_bytes_;
    std::string buffer_;
    std::size_t begin_ = 0;
    std::uint64_t line_number_ = 0;
    bool at_end_ = false;
};

}  // namespace cusp::inspect
