// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// From tokens to words.
#include "block.hpp"

#include "expression.hpp"
#include "word_tables.hpp"

#include <fmt/format.h>

namespace cusp::post::reader {

base::Location Block::at(std::size_t column) const {
    base::Location place = where;
    place.column = column;
    return place;
}

std::string Block::textOf(std::size_t first, std::size_t last) const {
    if (first >= last) return {};
    const std::size_t begin = tokens[first].column - 1;
    const std::size_t end = last < tokens.size() ? tokens[last].column - 1 : line.size();
    std::string text = line.substr(begin, end - begin);
    while (!text.empty() && text.back() == ' ') text.pop_back();
    return text;
}

namespace {

constexpr double largest_code = 9999.0;
constexpr double largest_block_number = 99'999'999.0;

class Parser {
public:
    Parser(Block& block, base::Diagnostics& report) : block_(block), report_(report) {}

    bool run() {
        if (here().is("%")) {
            block_.is_header = true;
            return true;
        }
        if (here().is("/")) skipSign();
        if (!blockNumber()) return false;
        if (here().kind == TokenKind::Name && ahead(1).is(":")) {
            block_.label = here().text;
            at_ += 2;
        }
        while (here().kind != TokenKind::End)
            if (!word()) return false;
        return true;
    }

private:
    [[nodiscard]] const Token& here() const { return block_.tokens[at_]; }
    [[nodiscard]] const Token& ahead(std::size_t count) const {
        return block_.tokens[std::min(at_ + count, block_.tokens.size() - 1)];
    }

    bool fail(std::string_view code, std::string message, std::size_t column) {
        report_.error(code, std::move(message), block_.at(column));
        return false;
    }

    void skipSign() {
        block_.may_be_skipped = true;
        ++at_;
        if (here().kind == TokenKind::Number && here().joined) ++at_;
    }

    bool blockNumber() {
        const bool main_block = here().is(":");
        if (!main_block && !(here().kind == TokenKind::Letter && here().text == "N")) return true;
        const Token& digits = ahead(1);
        if (digits.kind != TokenKind::Number || !digits.integer || digits.number > largest_block_number)
            return fail("nc.syntax", "a block number is N and up to eight digits", here().column);
        block_.number = static_cast<std::uint64_t>(digits.number);
        at_ += 2;
        return true;
    }

    bool word() {
        const Token& token = here();
        if (token.kind == TokenKind::Letter) return address();
        if (token.kind == TokenKind::Name) return named();
        return fail("nc.syntax", fmt::format("a word cannot begin with \"{}\"", token.text), token.column);
    }

    /// G1, M30, X10, X-10, X=…, A3=…
    bool address() {
        const Token letter = here();
        if (letter.text == "N") return fail("nc.syntax", "N must be the first word of its block", letter.column);
        const Token next = ahead(1);
        if (next.kind == TokenKind::Number && next.joined && next.integer && ahead(2).is("=")) {
            const std::size_t length = next.column - letter.column + next.text.size();
            const std::string_view name(letter.text.data(), length);
            at_ += 3;
            return value(name, letter.column);
        }
        if (next.is("=")) {
            at_ += 2;
            return value(letter.text, letter.column);
        }
        if (letter.text == "G" || letter.text == "M") return code(letter, next);
        const bool has_sign = next.is("-") || next.is("+");
        const Token& digits = has_sign ? ahead(2) : next;
        if (digits.kind != TokenKind::Number)
            return fail("nc.syntax", fmt::format("{} has no value", letter.text), letter.column);
        const std::size_t first = at_ + 1;
        at_ += has_sign ? 3 : 2;
        add(WordKind::Value, letter.text, letter.column, first, at_);
        return true;
    }

    bool code(const Token& letter, const Token& digits) {
        if (digits.kind != TokenKind::Number || !digits.integer || digits.number > largest_code)
            return fail("nc.syntax", fmt::format("{} must be followed by a whole number", letter.text), letter.column);
        at_ += 2;
        add(WordKind::Code, letter.text, letter.column, at_, at_);
        block_.words.back().number = static_cast<int>(digits.number);
        return true;
    }

    bool named() {
        const Token name = here();
        ++at_;
        if (isStatement(name.text)) {
            const std::size_t first = at_;
            at_ = block_.tokens.size() - 1;
            add(WordKind::Statement, name.text, name.column, first, at_);
            return true;
        }
        if (here().is("=")) {
            ++at_;
            return value(name.text, name.column);
        }
        if (here().is("(")) return bracketed(WordKind::Call, name, "(", ")");
        if (here().is("[")) return indexed(name);
        if (isAddressWithoutEquals(name.text))
            return fail("nc.missing-equals",
                        fmt::format("{}: an address of more than one letter needs '=' before its value", name.text),
                        name.column);
        add(WordKind::Keyword, name.text, name.column, at_, at_);
        return true;
    }

    bool indexed(const Token& name) {
        if (!bracketed(WordKind::Indexed, name, "[", "]")) return false;
        if (!here().is("=")) return fail("nc.syntax", fmt::format("{}[…] has no value", name.text), name.column);
        ++at_;
        return skipExpression(name.text, name.column);
    }

    bool bracketed(WordKind kind, const Token& name, std::string_view open, std::string_view close) {
        const std::size_t first = at_ + 1;
        int depth = 0;
        do {
            if (here().kind == TokenKind::End)
                return fail("nc.syntax", fmt::format("\"{}\" after {} is never closed", open, name.text), name.column);
            if (here().is(open)) ++depth;
            if (here().is(close)) --depth;
            ++at_;
        } while (depth > 0);
        add(kind, name.text, name.column, first, at_ - 1);
        return true;
    }

    bool value(std::string_view name, std::size_t column) {
        const std::size_t first = at_;
        if (!skipExpression(name, column)) return false;
        add(WordKind::Value, name, column, first, at_);
        return true;
    }

    /// An expression ends where an operator could stand and none does: `X=R1 Y=2` are two words, `X=R1 -2` is one.
    bool skipExpression(std::string_view name, std::size_t column) {
        while (true) {
            while (here().is("-") || here().is("+") || isNot(here())) ++at_;
            if (!skipOperand()) return fail("nc.syntax", fmt::format("the value of {} cannot be read", name), column);
            if (!isBinaryOperator(here())) return true;
            ++at_;
        }
    }

    static bool isNot(const Token& token) { return token.kind == TokenKind::Name && token.text == "NOT"; }

    bool skipOperand() {
        const TokenKind kind = here().kind;
        if (kind == TokenKind::Number || kind == TokenKind::Text) {
            ++at_;
            return true;
        }
        if (here().is("(")) return skipParentheses();
        if (kind == TokenKind::Letter) {
            ++at_;
            if (here().kind != TokenKind::Number || !here().joined) return false;
            ++at_;
            return true;
        }
        if (kind != TokenKind::Name) return false;
        ++at_;
        return here().is("(") ? skipParentheses() : true;
    }

    bool skipParentheses() {
        int depth = 0;
        do {
            if (here().kind == TokenKind::End) return false;
            if (here().is("(")) ++depth;
            if (here().is(")")) --depth;
            ++at_;
        } while (depth > 0);
        return true;
    }

    void add(WordKind kind, std::string_view name, std::size_t column, std::size_t first, std::size_t last) {
        Word word;
        word.kind = kind;
        word.name = name;
        word.column = column;
        word.first = first;
        word.last = last;
        block_.words.push_back(word);
    }

    Block& block_;
    base::Diagnostics& report_;
    std::size_t at_ = 0;
};

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> splitAtCommas(const Block& block, std::size_t first,
                                                               std::size_t last) {
    std::vector<std::pair<std::size_t, std::size_t>> parts;
    int depth = 0;
    std::size_t begin = first;
    for (std::size_t i = first; i < last; ++i) {
        const Token& token = block.tokens[i];
        if (token.is("(")) ++depth;
        if (token.is(")")) --depth;
        if (depth > 0 || !token.is(",")) continue;
        parts.emplace_back(begin, i);
        begin = i + 1;
    }
    parts.emplace_back(begin, last);
    return parts;
}

bool parseBlock(Block& block, base::Diagnostics& report) {
    block.words.clear();
    block.number.reset();
    block.label = {};
    block.may_be_skipped = false;
    block.is_header = false;
    if (!cutIntoTokens(block.line, block.upper, block.tokens, block.where, report)) return false;
    return Parser(block, report).run();
}

}  // namespace cusp::post::reader
