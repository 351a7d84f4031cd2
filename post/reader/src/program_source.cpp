// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// From streaming to the whole text.
#include "program_source.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace cusp::post::reader {

namespace {

/// Programs with jumps are written by hand; this is far above any.
constexpr std::size_t most_kept_bytes = 256 * 1024 * 1024;

}  // namespace

ProgramSource::ProgramSource(std::istream& in, const std::string& file_name, std::size_t max_line_bytes)
    : in_(in),
      file_name_(file_name),
      max_line_bytes_(max_line_bytes),
      begin_(in.tellg()),
      stream_(in, file_name, max_line_bytes) {
    // A pipe cannot tell where it stands, and must not be left failed for that.
    if (begin_ == std::istream::pos_type(-1) && !in.eof()) in.clear();
}

bool ProgramSource::next(std::string& line, base::Diagnostics& report) {
    if (!index_) {
        if (!stream_.next(line, report)) {
            line_number_ = stream_.lineNumber();
            return false;
        }
        line_number_ = stream_.lineNumber();
        return true;
    }
    if (line_number_ + 1 >= first_line_ + lines_.size()) return false;
    ++line_number_;
    if (run_[line_number_ - first_line_]) ++repeated_lines_;
    run_[line_number_ - first_line_] = true;
    line = text(line_number_);
    return true;
}

void ProgramSource::continueAt(std::size_t line) { line_number_ = line - 1; }

bool ProgramSource::keep(const std::string& line) {
    kept_bytes_ += line.size() + sizeof(std::string);
    lines_.push_back(line);
    return kept_bytes_ <= most_kept_bytes;
}

bool ProgramSource::readAll(LineSource& source, base::Diagnostics& report) {
    const std::size_t errors_before = report.errorCount();
    std::string line;
    while (source.next(line, report))
        if (!keep(line)) {
            report.error("nc.too-long",
                         fmt::format("a program with jumps is kept whole, and this one has more than {} MB",
                                     most_kept_bytes / (1024 * 1024)),
                         source.where());
            return false;
        }
    return report.errorCount() == errors_before;
}

bool ProgramSource::load(const std::string& current, base::Diagnostics& report) {
    if (index_) return true;
    bool good = false;
    const bool seekable = begin_ != std::istream::pos_type(-1);
    if (seekable) {
        in_.clear();
        in_.seekg(begin_);
    }
    if (seekable && in_.good()) {
        LineSource again(in_, file_name_, max_line_bytes_);
        base::Diagnostics repeated;
        std::string line;
        for (std::size_t i = 0; i < line_number_ && again.next(line, repeated) && keep(line); ++i) continue;
        good = readAll(again, report);
    } else {
        first_line_ = line_number_;
        good = keep(current) && readAll(stream_, report);
    }
    if (!good) return false;
    index_.emplace();
    run_.assign(lines_.size(), false);
    std::fill(run_.begin(), run_.begin() + static_cast<std::ptrdiff_t>(line_number_ - first_line_ + 1), true);
    return buildIndex(lines_, first_line_, file_name_, *index_, report);
}

}  // namespace cusp::post::reader
