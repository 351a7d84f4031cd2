// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Splitting lines into statements.
#include "statement.hpp"

#include <algorithm>

namespace cusp::toolpath::detail {

bool startsWithWord(std::string_view text, std::string_view word) {
    return text.size() >= word.size() &&
           std::equal(word.begin(), word.end(), text.begin(), [](char w, char t) { return w == upperCase(t); });
}

bool equalsWord(std::string_view text, std::string_view word) {
    return text.size() == word.size() && startsWithWord(text, word);
}

std::size_t freeTextWordLength(std::string_view text) {
    for (const std::string_view word :
         {std::string_view("PARTNO"), std::string_view("PPRINT"), std::string_view("INSERT")}) {
        if (startsWithWord(text, word) &&
            (text.size() == word.size() || isBlank(text[word.size()]) || text[word.size()] == '/')) {
            return word.size();
        }
    }
    return 0;
}

StatementHead::StatementHead(std::string_view text) {
    if (const std::size_t length = freeTextWordLength(text); length > 0) {
        std::transform(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(length), word_.begin(), upperCase);
        length_ = length;
        body_ = trimmed(text.substr(length));
        if (!body_.empty() && body_.front() == '/') {
            body_.remove_prefix(1);
        }
        return;
    }
    const std::size_t end = std::min(text.find_first_of("/,(=)'"), text.size());
    for (const char c : trimmed(text.substr(0, end))) {
        const bool second_blank = isBlank(c) && length_ > 0 && word_[length_ - 1] == ' ';
        if (length_ < word_.size() && !second_blank) {
            word_[length_++] = isBlank(c) ? ' ' : upperCase(c);
        }
    }
    plain_ = end == text.size() || text[end] == '/';
    body_ = text.substr(std::min(text.size(), end + (plain_ ? 1U : 0U)));
}

namespace {

StatementSplitter::Status fromLineStatus(LineSource::Status status) {
    switch (status) {
        case LineSource::Status::End: return StatementSplitter::Status::End;
        case LineSource::Status::TooLong: return StatementSplitter::Status::TooLong;
        case LineSource::Status::TooMany: return StatementSplitter::Status::TooMany;
        case LineSource::Status::Binary: return StatementSplitter::Status::Binary;
        case LineSource::Status::ReadError: return StatementSplitter::Status::ReadError;
        case LineSource::Status::Line: break;
    }
    return StatementSplitter::Status::Statement;
}

}  // namespace

StatementSplitter::Status StatementSplitter::next(Statement& statement) {
    std::string_view line;
    for (;;) {
        if (const LineSource::Status status = source_->next(line); status != LineSource::Status::Line) {
            statement.line = source_->lineNumber();
            return fromLineStatus(status);
        }
        line = trimmed(line);
        if (!line.empty()) {
            break;
        }
    }
    statement.line = source_->lineNumber();
    statement.is_comment = false;
    const void* const mark = std::memchr(line.data(), '$', line.size());
    if (mark == nullptr || freeTextWordLength(line) > 0) {
        statement.text = line;
        return Status::Statement;
    }
    const auto at = static_cast<std::size_t>(static_cast<const char*>(mark) - line.data());
    if (at + 1 < line.size() && line[at + 1] == '$') {
        statement.is_comment = at == 0;
        statement.text = statement.is_comment ? line.substr(2) : trimmed(line.substr(0, at));
        return Status::Statement;
    }
    return join(line.substr(0, at), statement);
}

StatementSplitter::Status StatementSplitter::join(std::string_view first_piece, Statement& statement) {
    joined_.assign(first_piece);
    std::string_view line;
    for (bool continued = true; continued;) {
        if (const LineSource::Status status = source_->next(line); status != LineSource::Status::Line) {
            return status == LineSource::Status::End ? Status::OpenContinuation : fromLineStatus(status);
        }
        // A single dollar continues the statement and hides the rest of its line; a double one ends it.
        const std::size_t mark = line.find('$');
        continued = mark != std::string_view::npos && (mark + 1 == line.size() || line[mark + 1] != '$');
        joined_.append(line.substr(0, mark));
        if (joined_.size() > max_statement_bytes_) {
            return Status::TooLong;
        }
    }
    statement.text = trimmed(joined_);
    return Status::Statement;
}

}  // namespace cusp::toolpath::detail
