// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Sources: Siemens Job Planning 06/2009, chapters on jumps, check structures and subprograms.
#include "program_flow.hpp"

#include "word_tables.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cusp::post::reader {

namespace {

/// Program levels of the control (PM12, subprogram nesting).
constexpr std::size_t deepest_calls = 16;
constexpr double most_runs = 9999.0;

bool isJump(std::string_view name) {
    return name == "GOTO" || name == "GOTOF" || name == "GOTOB" || name == "GOTOC" || name == "GOTOS";
}

std::size_t findName(const Block& block, std::size_t first, std::size_t last, std::string_view name) {
    while (first < last && !(block.tokens[first].kind == TokenKind::Name && block.tokens[first].text == name)) ++first;
    return first;
}

std::size_t findJump(const Block& block, std::size_t first, std::size_t last) {
    while (first < last && !(block.tokens[first].kind == TokenKind::Name && isJump(block.tokens[first].text))) ++first;
    return first;
}

}  // namespace

bool ProgramFlow::error(std::string_view code, std::string message, std::size_t column) {
    report_.error(code, std::move(message), block_->at(column));
    return false;
}

bool ProgramFlow::takes(const Block& block) {
    for (const Word& word : block.words)
        if (word.kind == WordKind::Statement && isFlowStatement(word.name)) return true;
    return subprogram(block) != nullptr;
}

bool ProgramFlow::run(const Block& block) {
    block_ = &block;
    if (!source_.load(block.line, report_)) return false;
    if (const ProgramPart* part = subprogram(block)) return call(block.words.front(), *part);
    const Word& word = block.words.back();
    if (!alone(word)) return false;
    if (word.name == "PROC") return heading(word);
    if (word.name == "RET") {
        if (!inSubprogram()) return error("nc.structure", "RET stands outside a subprogram", word.column);
        leaveSubprogram();
        return true;
    }
    if (word.name == "CASE") return caseOf(word);
    if (word.name == "REPEAT" && word.first != word.last)
        return error("nc.unsupported", "REPEAT (a repetition of blocks) is not interpreted", word.column);
    std::size_t end = word.last;
    if (isJump(word.name)) {
        if (!jumpAt(word.first - 1, end)) return false;
        return end == word.last || error("nc.syntax", "more than a target follows the jump", word.column);
    }
    const std::size_t jump = findJump(block, word.first, word.last);
    if (word.name == "IF" && jump < word.last) return conditionalJump(word, jump);
    return structure(word);
}

bool ProgramFlow::alone(const Word& word) {
    if (block_->words.size() == 1) return true;
    return error("nc.syntax", fmt::format("{} stands in a block of its own", word.name), word.column);
}

std::optional<double> ProgramFlow::value(std::size_t first, std::size_t last) {
    return evaluate(*block_, first, last, variables_, report_);
}

std::optional<bool> ProgramFlow::condition(std::size_t first, std::size_t last) {
    const auto result = value(first, last);
    if (!result) return std::nullopt;
    return *result != 0.0;
}

/// `IF a GOTOF L IF b GOTOB M`: the first that holds jumps.
bool ProgramFlow::conditionalJump(const Word& word, std::size_t jump) {
    std::size_t first = word.first;
    while (true) {
        const auto holds = condition(first, jump);
        if (!holds) return false;
        std::size_t end = word.last;
        if (*holds) return jumpAt(jump, end);
        // Past a target: a name, or a letter and its number.
        end = jump + 1 < word.last && block_->tokens[jump + 1].kind == TokenKind::Name ? jump + 2 : jump + 3;
        if (end >= word.last) return true;
        if (block_->tokens[end].kind != TokenKind::Name || block_->tokens[end].text != "IF")
            return error("nc.syntax", "only another IF may follow a jump in its block", block_->tokens[end].column);
        first = end + 1;
        jump = findJump(*block_, first, word.last);
        if (jump == word.last) return error("nc.syntax", "this IF has no jump", word.column);
    }
}

bool ProgramFlow::jumpAt(std::size_t token, std::size_t& end) {
    const Token& jump = block_->tokens[token];
    if (jump.text == "GOTOS") {
        end = token + 1;
        source_.continueAt(source_.index()->partOf(block_->where.line).first);
        return true;
    }
    const Way way = jump.text == "GOTOF" ? Way::Forward : jump.text == "GOTOB" ? Way::Backward : Way::Either;
    std::string name;
    const auto line = target(token + 1, way, name, end);
    if (line) {
        source_.continueAt(*line);
        return true;
    }
    if (name.empty()) return false;
    if (jump.text == "GOTOC") return true;  // no target, no jump: what GOTOC is for
    const bool piped = source_.firstLine() > 1;
    return error(
        "nc.jump-target",
        fmt::format("{} {}: there is no such target {}{}", jump.text, name,
                    way == Way::Forward    ? "after this block"
                    : way == Way::Backward ? "before this block"
                                           : "in this program",
                    piped ? "; of a program that comes through a pipe only what follows its first jump is kept" : ""),
        jump.column);
}

/// A label or `N100`. `name` stays empty when there is no readable target.
std::optional<std::size_t> ProgramFlow::target(std::size_t token, Way way, std::string& name, std::size_t& end) {
    const Token& first = block_->tokens[token];
    const std::vector<std::size_t>* lines = nullptr;
    const ProgramIndex& index = *source_.index();
    if (first.kind == TokenKind::Name) {
        name = std::string(first.text);
        end = token + 1;
        if (const auto found = index.labels.find(first.text); found != index.labels.end()) lines = &found->second;
    } else if ((first.is(":") || (first.kind == TokenKind::Letter && first.text == "N")) &&
               block_->tokens[token + 1].kind == TokenKind::Number && block_->tokens[token + 1].integer) {
        name = fmt::format("{}{}", first.text, block_->tokens[token + 1].text);
        end = token + 2;
        const auto found = index.numbers.find(static_cast<std::uint64_t>(block_->tokens[token + 1].number));
        if (found != index.numbers.end()) lines = &found->second;
    } else {
        report_.error("nc.syntax", "a jump needs a label or a block number", block_->at(first.column));
        return std::nullopt;
    }
    if (lines == nullptr) return std::nullopt;
    const std::size_t here = block_->where.line;
    const ProgramPart& part = index.partOf(here);
    // The nearest target in the direction of the jump; GOTO looks ahead first.
    const auto after = std::upper_bound(lines->begin(), lines->end(), here);
    if (way != Way::Backward && after != lines->end() && *after <= part.last) return *after;
    if (way != Way::Forward && after != lines->begin() && *std::prev(after) >= part.first) return *std::prev(after);
    return std::nullopt;
}

/// `CASE(value) OF 1 GOTOF A 2 GOTOF B DEFAULT GOTOF C`
bool ProgramFlow::caseOf(const Word& word) {
    const std::size_t of = findName(*block_, word.first, word.last, "OF");
    if (of == word.last) return error("nc.syntax", "CASE has no OF", word.column);
    const auto wanted = value(word.first, of);
    if (!wanted) return false;
    std::size_t first = of + 1;
    while (first < word.last) {
        const std::size_t jump = findJump(*block_, first, word.last);
        if (jump == word.last) return error("nc.syntax", "this case has no jump", block_->tokens[first].column);
        const bool otherwise = block_->tokens[first].kind == TokenKind::Name && block_->tokens[first].text == "DEFAULT";
        const auto constant = otherwise ? wanted : value(first, jump);
        if (!constant) return false;
        std::size_t end = 0;
        if (*constant == *wanted) return jumpAt(jump, end);
        first = jump + 1 < word.last && block_->tokens[jump + 1].kind == TokenKind::Name ? jump + 2 : jump + 3;
    }
    return true;
}

bool ProgramFlow::structure(const Word& word) {
    const std::string_view name = word.name;
    const auto found = source_.index()->structures.find(block_->where.line);
    if (found == source_.index()->structures.end())
        return error("nc.structure", fmt::format("{} has no partner", name), word.column);
    const Structure& lines = found->second;
    if (name == "LOOP" || name == "REPEAT" || name == "ENDIF") return true;
    if (name == "ENDLOOP") {
        continueAfter(lines.begin);
        return true;
    }
    if (name == "ENDWHILE") {
        source_.continueAt(lines.begin);
        return true;
    }
    if (name == "ELSE") {
        continueAfter(lines.end);
        return true;
    }
    if (name == "FOR") return beginFor(word);
    if (name == "ENDFOR") return endFor(lines);
    const auto holds = condition(word.first, word.last);
    if (!holds) return false;
    if (name == "IF" && !*holds) continueAfter(lines.middle != 0 ? lines.middle : lines.end);
    if (name == "WHILE" && !*holds) continueAfter(lines.end);
    if (name == "UNTIL" && !*holds) continueAfter(lines.begin);
    return true;
}

/// `FOR variable = start TO end`: the counter is checked before each turn, the first included.
bool ProgramFlow::beginFor(const Word& word) {
    const std::size_t to = findName(*block_, word.first, word.last, "TO");
    std::size_t equals = word.first;
    while (equals < to && !block_->tokens[equals].is("=")) ++equals;
    if (to == word.last || equals == to)
        return error("nc.syntax", "FOR needs \"variable = start TO end\"", word.column);
    const auto start = value(equals + 1, to);
    if (!start || !assignCounter(*block_, word, *start)) return false;
    bool inside = false;
    if (!withinForRange(*block_, word, inside)) return false;
    if (!inside) continueAfter(source_.index()->structures.at(block_->where.line).end);
    return true;
}

bool ProgramFlow::endFor(const Structure& structure) {
    Block head;
    head.line = source_.text(structure.begin);
    head.where = block_->where;
    head.where.line = structure.begin;
    if (!parseBlock(head, report_) || head.words.empty()) return false;
    const Word& word = head.words.back();
    const auto now =
        evaluate(head, word.first, word.first + (head.tokens[word.first].kind == TokenKind::Letter ? 2 : 1), variables_,
                 report_);
    bool inside = false;
    if (!now || !assignCounter(head, word, *now + 1.0) || !withinForRange(head, word, inside)) return false;
    if (inside) continueAfter(structure.begin);
    return true;
}

bool ProgramFlow::withinForRange(const Block& block, const Word& word, bool& inside) {
    const std::size_t counter = block.tokens[word.first].kind == TokenKind::Letter ? 2 : 1;
    const auto now = evaluate(block, word.first, word.first + counter, variables_, report_);
    const auto last = evaluate(block, findName(block, word.first, word.last, "TO") + 1, word.last, variables_, report_);
    if (!now || !last) return false;
    inside = *now <= *last;
    return true;
}

bool ProgramFlow::assignCounter(const Block& block, const Word& word, double value) {
    const Token& token = block.tokens[word.first];
    const Token& next = block.tokens[word.first + 1];
    if (token.kind == TokenKind::Letter && token.text == "R" && next.kind == TokenKind::Number && next.integer &&
        next.number <= 99'999.0) {
        variables_.setParameter(static_cast<int>(next.number), value);
        return true;
    }
    if (token.kind == TokenKind::Name && variables_.isDeclared(token.text)) {
        variables_.set(token.text, value);
        return true;
    }
    return error("nc.undeclared", fmt::format("{} is not declared", token.text), token.column);
}

/// A block that is nothing but the name of another program of the file, with arguments or a number of runs.
const ProgramPart* ProgramFlow::subprogram(const Block& block) {
    if (block.words.empty() || block.words.size() > 2) return nullptr;
    const Word& word = block.words.front();
    std::string name(word.name);
    if (word.kind == WordKind::Value && name == "L" && block.tokens[word.first].integer)
        name = "L" + std::string(block.tokens[word.first].text);
    else if ((word.kind != WordKind::Keyword && word.kind != WordKind::Call) || isVocabulary(word.name))
        return nullptr;
    if (block.words.size() == 2 && block.words[1].name != "P") return nullptr;
    if (!source_.load(block.line, report_)) return nullptr;
    return source_.index()->find(name);
}

bool ProgramFlow::call(const Word& word, const ProgramPart& part) {
    if (calls_.size() + 1 >= deepest_calls)
        return error("nc.nesting", fmt::format("programs call one another more than {} deep", deepest_calls),
                     word.column);
    Call added;
    added.name = part.name;
    added.back_to = block_->where.line + 1;
    added.runs_left = 1;
    if (block_->words.size() == 2) {
        const auto runs = value(block_->words[1].first, block_->words[1].last);
        if (!runs) return false;
        if (*runs < 1.0 || *runs > most_runs || *runs != std::floor(*runs))
            return error("nc.syntax", "P takes a whole number from 1 to 9999", block_->words[1].column);
        added.runs_left = static_cast<std::size_t>(*runs);
    }
    if (word.kind == WordKind::Call)
        for (const auto& [first, last] : splitAtCommas(*block_, word.first, word.last)) {
            const auto argument = first == last ? std::optional<double>(0.0) : value(first, last);
            if (!argument) return false;
            added.arguments.push_back(*argument);
        }
    calls_.push_back(std::move(added));
    variables_.enterSubprogram();
    source_.continueAt(part.first);
    return true;
}

/// `PROC NAME(REAL A, INT B)`: arguments by value; an argument left out is zero.
bool ProgramFlow::heading(const Word& word) {
    std::size_t at = word.first + 1;
    if (at >= word.last) return true;
    if (!block_->tokens[at].is("(") || !block_->tokens[word.last - 1].is(")"))
        return error("nc.unsupported",
                     fmt::format("{} (an attribute of a subprogram) is not interpreted", block_->tokens[at].text),
                     block_->tokens[at].column);
    if (at + 2 == word.last) return true;
    std::size_t number = 0;
    for (const auto& [first, last] : splitAtCommas(*block_, at + 1, word.last - 1)) {
        const std::string_view type = first < last ? block_->tokens[first].text : std::string_view();
        const bool integer = type == "INT" || type == "BOOL";
        if (last != first + 2 || (!integer && type != "REAL"))
            return error("nc.unsupported", "a parameter that is not a number passed by value is not interpreted",
                         block_->tokens[std::min(first, word.last - 1)].column);
        const std::string_view name = block_->tokens[first + 1].text;
        if (!variables_.declare(name, integer))
            return error("nc.declared-twice", fmt::format("{} is declared already", name),
                         block_->tokens[first + 1].column);
        if (inSubprogram() && number < calls_.back().arguments.size())
            variables_.set(name, calls_.back().arguments[number]);
        ++number;
    }
    return true;
}

void ProgramFlow::leaveSubprogram() {
    Call& call = calls_.back();
    variables_.leaveSubprogram();
    if (--call.runs_left > 0) {
        variables_.enterSubprogram();
        source_.continueAt(source_.index()->find(call.name)->first);
        return;
    }
    source_.continueAt(call.back_to);
    calls_.pop_back();
}

bool ProgramFlow::ranOut() const {
    const ProgramIndex* index = source_.index();
    return index != nullptr && inSubprogram() && source_.lineNumber() > index->find(calls_.back().name)->last;
}

}  // namespace cusp::post::reader
