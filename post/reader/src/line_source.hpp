// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Lines of a program, one at a time, with a bound on their length.
#pragma once

#include <cusp/base/diagnostics.hpp>

#include <cstddef>
#include <istream>
#include <string>
#include <vector>

namespace cusp::post::reader {

class LineSource {
public:
    LineSource(std::istream& in, std::string file_name, std::size_t max_line_bytes);

    /// The next line without its end. False at the end of the file or after a problem that ends the read: a line beyond
    /// the bound (`nc.line-too-long`), bytes no text has (`nc.binary`), a failing stream (`io.read`).
    [[nodiscard]] bool next(std::string& line, base::Diagnostics& report);

    [[nodiscard]] std::size_t lineNumber() const { return line_number_; }
    [[nodiscard]] base::Location where(std::size_t column = 0) const { return {file_name_, line_number_, column, {}}; }

private:
    [[nodiscard]] bool fill();
    [[nodiscard]] bool isText(const std::string& line, base::Diagnostics& report) const;

    std::istream& in_;
    std::string file_name_;
    std::size_t max_line_bytes_;
    std::size_t line_number_ = 0;
    std::vector<char> buffer_;
    std::size_t begin_ = 0;
    std::size_t end_ = 0;
};

}  // namespace cusp::post::reader
