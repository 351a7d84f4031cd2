// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The lexer. Where X10 ends and a name begins: names have a letter or '_' as their second character (PM12, names).
#include "tokens.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace cusp::post::reader {

namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isLetter(char c) { return c >= 'A' && c <= 'Z'; }
bool isNameStart(char c) { return isLetter(c) || c == '_' || c == '$'; }

class Lexer {
public:
    Lexer(const std::string& line, const std::string& upper, std::vector<Token>& tokens, const base::Location& where,
          base::Diagnostics& report)
        : line_(line), upper_(upper), tokens_(tokens), where_(where), report_(report) {}

    bool run() {
        while (true) {
            const std::size_t before = at_;
            while (peek() == ' ' || peek() == '\t') ++at_;
            joined_ = at_ == before && !tokens_.empty();
            if (at_ >= upper_.size() || peek() == ';') break;
            if (!one()) return false;
        }
        add(TokenKind::End, at_, 0);
        return true;
    }

private:
    [[nodiscard]] char peek(std::size_t ahead = 0) const {
        return at_ + ahead < upper_.size() ? upper_[at_ + ahead] : '\0';
    }

    void add(TokenKind kind, std::size_t begin, std::size_t length) {
        Token token;
        token.kind = kind;
        token.text = std::string_view(kind == TokenKind::Text ? line_ : upper_).substr(begin, length);
        token.column = begin + 1;
        token.joined = joined_;
        tokens_.push_back(token);
        at_ = begin + length;
    }

    bool one() {
        const char c = peek();
        if (isDigit(c) || (c == '.' && isDigit(peek(1)))) return number();
        if (isNameStart(c)) return word();
        if (c == '"') return text();
        return symbol();
    }

    bool word() {
        std::size_t length = 1;
        if (isNameStart(peek(1)) || !isLetter(peek()))
            while (isNameStart(peek(length)) || isDigit(peek(length))) ++length;
        add(length == 1 ? TokenKind::Letter : TokenKind::Name, at_, length);
        return true;
    }

    /// Digits, at most one point, and the exponent the 840D writes as EX (1.5EX-3).
    bool number() {
        const std::size_t begin = at_;
        std::size_t end = at_;
        bool integer = true;
        while (end < upper_.size() && (isDigit(upper_[end]) || (upper_[end] == '.' && integer)))
            integer = upper_[end++] != '.' && integer;
        double value = 0.0;
        bool in_range = std::from_chars(upper_.data() + begin, upper_.data() + end, value).ec == std::errc{};
        if (upper_.compare(end, 2, "EX") == 0) {
            std::size_t digits = end + 2;
            if (digits < upper_.size() && (upper_[digits] == '+' || upper_[digits] == '-')) ++digits;
            int exponent = 0;
            const std::size_t first = upper_[end + 2] == '+' ? digits : end + 2;
            const auto [stop, problem] =
                std::from_chars(upper_.data() + first, upper_.data() + upper_.size(), exponent);
            in_range = in_range && problem == std::errc{};
            value *= std::pow(10.0, exponent);
            end = static_cast<std::size_t>(stop - upper_.data());
            integer = false;
        }
        if (!in_range || !std::isfinite(value))
            return fail("nc.number",
                        fmt::format("\"{}\" is no number the control can hold", shortened(begin, end - begin)), begin);
        add(TokenKind::Number, begin, end - begin);
        tokens_.back().number = value;
        tokens_.back().integer = integer;
        return true;
    }

    [[nodiscard]] std::string shortened(std::size_t begin, std::size_t length) const {
        constexpr std::size_t shown = 20;
        return upper_.substr(begin, std::min(length, shown)) + (length > shown ? "…" : "");
    }

    bool text() {
        const std::size_t close = line_.find('"', at_ + 1);
        if (close == std::string::npos) return fail("nc.syntax", "the text has no closing quote", at_);
        add(TokenKind::Text, at_ + 1, close - at_ - 1);
        at_ = close + 1;
        return true;
    }

    bool symbol() {
        static constexpr std::string_view pairs[] = {"==", "<>", "<=", ">="};
        for (const std::string_view pair : pairs)
            if (upper_.compare(at_, 2, pair) == 0) {
                add(TokenKind::Symbol, at_, 2);
                return true;
            }
        if (std::string_view("()[],=+-*/<>:%").find(peek()) != std::string_view::npos) {
            add(TokenKind::Symbol, at_, 1);
            return true;
        }
        const auto byte = static_cast<unsigned char>(peek());
        const std::string shown =
            byte < 0x80 ? fmt::format("'{}'", peek()) : fmt::format("byte 0x{:02X}", static_cast<unsigned>(byte));
        return fail("nc.syntax", shown + " has no meaning in a block", at_);
    }

    bool fail(std::string_view code, std::string message, std::size_t begin) {
        base::Location place = where_;
        place.column = begin + 1;
        report_.error(code, std::move(message), std::move(place));
        return false;
    }

    const std::string& line_;
    const std::string& upper_;
    std::vector<Token>& tokens_;
    const base::Location& where_;
    base::Diagnostics& report_;
    std::size_t at_ = 0;
    bool joined_ = false;
};

}  // namespace

bool cutIntoTokens(const std::string& line, std::string& upper, std::vector<Token>& tokens, const base::Location& where,
                   base::Diagnostics& report) {
    upper = line;
    for (char& c : upper)
        if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
    tokens.clear();
    return Lexer(line, upper, tokens, where, report).run();
}

}  // namespace cusp::post::reader
