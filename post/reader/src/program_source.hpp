// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The lines of a program in the order they run: a stream, or the whole text once a jump needs it.
#pragma once

#include "line_source.hpp"
#include "program_index.hpp"

#include <cstddef>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace cusp::post::reader {

/// Plain programs stream, and memory stays flat. The first block that may leave the order of the file calls `load`: from
/// then on all lines are at hand, where the stream can be read again from its beginning; of a pipe, those from that block on.
class ProgramSource {
public:
    ProgramSource(std::istream& in, const std::string& file_name, std::size_t max_line_bytes);

    /// As `LineSource::next`.
    [[nodiscard]] bool next(std::string& line, base::Diagnostics& report);
    [[nodiscard]] base::Location where() const { return {file_name_, line_number_, 0, {}}; }
    [[nodiscard]] std::size_t lineNumber() const { return line_number_; }

    /// `current` is the line read last. False with an error (`nc.too-long`, those of `next`, those of `buildIndex`).
    [[nodiscard]] bool load(const std::string& current, base::Diagnostics& report);
    /// Present after `load`.
    [[nodiscard]] const ProgramIndex* index() const { return index_ ? &*index_ : nullptr; }
    /// The text of a line at hand, which must be one of the index.
    [[nodiscard]] const std::string& text(std::size_t line) const { return lines_[line - first_line_]; }
    [[nodiscard]] std::size_t firstLine() const { return first_line_; }
    /// The line that comes next.
    void continueAt(std::size_t line);
    /// How often a line was run that had run before.
    [[nodiscard]] std::size_t repeatedLines() const { return repeated_lines_; }

private:
    [[nodiscard]] bool keep(const std::string& line);
    [[nodiscard]] bool readAll(LineSource& source, base::Diagnostics& report);

    std::istream& in_;
    std::string file_name_;
    std::size_t max_line_bytes_;
    std::istream::pos_type begin_;
    LineSource stream_;
    std::optional<ProgramIndex> index_;
    std::vector<std::string> lines_;
    std::size_t first_line_ = 1;   ///< of lines_
    std::size_t line_number_ = 0;  ///< read last
    std::vector<bool> run_;        ///< of lines_: already run
    std::size_t kept_bytes_ = 0;
    std::size_t repeated_lines_ = 0;
};

}  // namespace cusp::post::reader
