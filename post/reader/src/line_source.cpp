// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Reads in blocks of the stream, so that neither a huge line nor a huge file costs memory.
#include "line_source.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>

namespace cusp::post::reader {

namespace {

constexpr std::size_t buffer_bytes = 64 * 1024;
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// Tab, and a stray carriage return before the line end, are the only control characters a program has.
bool isControlCharacter(char character) {
    const auto byte = static_cast<unsigned char>(character);
    return (byte < 0x20 && character != '\t') || byte == 0x7F;
}

}  // namespace

LineSource::LineSource(std::istream& in, std::string file_name, std::size_t max_line_bytes)
    : in_(in), file_name_(std::move(file_name)), max_line_bytes_(max_line_bytes), buffer_(buffer_bytes) {}

bool LineSource::fill() {
    in_.read(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    begin_ = 0;
    end_ = static_cast<std::size_t>(in_.gcount());
    return end_ > 0;
}

bool LineSource::isText(const std::string& line, base::Diagnostics& report) const {
    const auto bad = std::find_if(line.begin(), line.end(), isControlCharacter);
    if (bad == line.end()) return true;
    const auto column = static_cast<std::size_t>(bad - line.begin()) + 1;
    report.error("nc.binary",
                 fmt::format("byte 0x{:02X} has no place in a program: this is not a text file",
                             static_cast<unsigned>(static_cast<unsigned char>(*bad))),
                 where(column));
    return false;
}

bool LineSource::next(std::string& line, base::Diagnostics& report) {
    line.clear();
    bool ended = false;
    bool any = false;
    while (!ended && (begin_ < end_ || fill())) {
        any = true;
        const auto first = buffer_.begin() + static_cast<std::ptrdiff_t>(begin_);
        const auto last = buffer_.begin() + static_cast<std::ptrdiff_t>(end_);
        const auto stop = std::find(first, last, '\n');
        line.append(first, stop);
        ended = stop != last;
        begin_ = static_cast<std::size_t>(stop - buffer_.begin()) + (ended ? 1 : 0);
        if (line.size() > max_line_bytes_) {
            ++line_number_;
            report.error("nc.line-too-long",
                         fmt::format("this line is longer than {} bytes: this is not a program", max_line_bytes_),
                         where());
            return false;
        }
    }
    if (in_.bad()) {
        report.error("io.read", "the program could not be read to its end", where());
        return false;
    }
    if (!any) return false;
    ++line_number_;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line_number_ == 1 && line.starts_with(byte_order_mark)) {
        line.erase(0, byte_order_mark.size());
        report.warning("nc.byte-order-mark", "the file begins with a byte order mark, which a control may refuse",
                       where());
    }
    return isText(line, report);
}

}  // namespace cusp::post::reader
