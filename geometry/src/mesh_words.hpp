// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A text cut into words, with the line each stands on.
#pragma once

#include <cusp/base/number_text.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>

namespace cusp::geometry::detail {

class MeshWords {
public:
    explicit MeshWords(std::string_view text, std::size_t line = 1) : text_(text), line_(line) {}

    /// The next word, empty at the end; `line()` is then its line.
    std::string_view next() {
        while (at_ < text_.size() && isBlank(text_[at_])) {
            if (text_[at_] == '\n') ++line_;
            ++at_;
        }
        const std::size_t start = at_;
        while (at_ < text_.size() && !isBlank(text_[at_])) ++at_;
        return text_.substr(start, at_ - start);
    }
    std::optional<double> number() { return base::parseDouble(next()); }
    /// The rest of the line, without blanks around it; the line break is passed.
    std::string_view restOfLine() {
        const std::size_t end = std::min(text_.find('\n', at_), text_.size());
        std::string_view rest = text_.substr(at_, end - at_);
        at_ = std::min(end + 1, text_.size());
        if (end < text_.size()) ++line_;
        while (!rest.empty() && isBlank(rest.front())) rest.remove_prefix(1);
        while (!rest.empty() && isBlank(rest.back())) rest.remove_suffix(1);
        return rest;
    }
    [[nodiscard]] std::size_t line() const { return line_; }
    /// Bytes behind the word read last.
    [[nodiscard]] std::size_t position() const { return at_; }

private:
    static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v'; }

    std::string_view text_;
    std::size_t at_ = 0;
    std::size_t line_;
};

}  // namespace cusp::geometry::detail
