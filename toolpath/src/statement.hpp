// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Joins lines into APT statements: comments, continuation, the leading word and what follows it.
#pragma once

#include "line_source.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace cusp::toolpath::detail {

/// One statement. The views hold until the next one is read.
struct Statement {
    std::string_view text;   ///< without surrounding blanks, trailing comment and continuation marks
    std::uint32_t line = 0;  ///< where it begins
    bool is_comment = false;
};

/// The leading word of a statement in upper case ("GOTO", "TOOL PATH", "TLON") and the text behind its slash.
class StatementHead {
public:
    explicit StatementHead(std::string_view text);
    [[nodiscard]] std::string_view word() const { return {word_.data(), length_}; }
    [[nodiscard]] std::string_view body() const { return body_; }
    /// `WORD` or `WORD/…`; false when something else follows the word.
    [[nodiscard]] bool isPlain() const { return plain_; }

private:
    // Longer words than any dialect has are cut: they compare unequal to every known one.
    std::array<char, 32> word_{};
    std::size_t length_ = 0;
    std::string_view body_;
    bool plain_ = true;
};

class StatementSplitter {
public:
    enum class Status : std::uint8_t { Statement, End, OpenContinuation, TooLong, TooMany, Binary, ReadError };

    StatementSplitter(LineSource& source, std::size_t max_statement_bytes)
        : source_(&source), max_statement_bytes_(max_statement_bytes) {}

    [[nodiscard]] Status next(Statement& statement);

private:
    [[nodiscard]] Status join(std::string_view first_piece, Statement& statement);

    LineSource* source_;
    std::size_t max_statement_bytes_;
    std::string joined_;
};

[[nodiscard]] inline bool isBlank(char c) { return static_cast<unsigned char>(c) <= ' '; }
[[nodiscard]] inline std::string_view trimmed(std::string_view text) {
    while (!text.empty() && isBlank(text.front())) {
        text.remove_prefix(1);
    }
    while (!text.empty() && isBlank(text.back())) {
        text.remove_suffix(1);
    }
    return text;
}
[[nodiscard]] constexpr char upperCase(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }
/// Compares with a word given in upper case.
[[nodiscard]] bool equalsWord(std::string_view text, std::string_view word);
[[nodiscard]] bool startsWithWord(std::string_view text, std::string_view word);
/// PARTNO, PPRINT and INSERT take the rest of their line as it stands; `$` means nothing in it. Returns the length of the
/// word, or 0.
[[nodiscard]] std::size_t freeTextWordLength(std::string_view text);

}  // namespace cusp::toolpath::detail
