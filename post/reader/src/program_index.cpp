// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// One pass over the text; blocks that cannot be parsed are left to the run, which says so if it comes there.
#include "program_index.hpp"

#include "block.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace cusp::post::reader {

namespace {

struct Pair {
    std::string_view begin;
    std::string_view end;
};
constexpr std::array<Pair, 5> pairs = {
    {{"IF", "ENDIF"}, {"WHILE", "ENDWHILE"}, {"FOR", "ENDFOR"}, {"LOOP", "ENDLOOP"}, {"REPEAT", "UNTIL"}}};

/// "_N_NAME_SPF" → "NAME".
std::string partName(std::string_view heading) {
    if (heading.starts_with("_N_")) heading.remove_prefix(3);
    if (heading.ends_with("_MPF") || heading.ends_with("_SPF")) heading.remove_suffix(4);
    return std::string(heading);
}

class Indexer {
public:
    Indexer(ProgramIndex& index, base::Diagnostics& report) : index_(index), report_(report) {}

    void add(const Block& block) {
        const std::size_t line = block.where.line;
        if (block.is_header) return newPart(block.tokens.size() > 1 ? block.tokens[1].text : "", block.where);
        if (block.number) index_.numbers[*block.number].push_back(line);
        if (!block.label.empty()) index_.labels[std::string(block.label)].push_back(line);
        for (const Word& word : block.words)
            if (word.kind == WordKind::Statement) structureWord(block, word);
    }

    bool finish(std::size_t last_line) {
        closePart(last_line);
        return good_;
    }

    void newPart(std::string_view heading, const base::Location& where) {
        if (!index_.parts.empty()) closePart(where.line - 1);
        index_.parts.push_back({partName(heading), where.line + 1, where.line});
    }

private:
    struct Open {
        std::string_view word;
        std::size_t middle = 0;
        base::Location where;
    };

    void closePart(std::size_t last_line) {
        if (index_.parts.empty()) return;
        index_.parts.back().last = last_line;
        for (const Open& open : open_) {
            const auto* const pair =
                std::find_if(pairs.begin(), pairs.end(), [&](const Pair& p) { return p.begin == open.word; });
            error("nc.structure", fmt::format("{} has no {}", pair->begin, pair->end), open.where);
        }
        open_.clear();
    }

    void structureWord(const Block& block, const Word& word) {
        const base::Location place = block.at(word.column);
        for (const Pair& pair : pairs) {
            if (word.name == pair.begin && opens(block, word)) {
                open_.push_back({pair.begin, 0, place});
                if (open_.size() == deepest_structures + 1)
                    error("nc.nesting", fmt::format("structures are nested more than {} deep", deepest_structures),
                          place);
            }
            if (word.name == pair.end) return close(pair, place);
        }
        if (word.name != "ELSE") return;
        if (open_.empty() || open_.back().word != "IF" || open_.back().middle != 0)
            return error("nc.structure", "ELSE has no IF", place);
        open_.back().middle = place.line;
    }

    /// `IF … GOTOF …` is a jump, `REPEAT LABEL` a repetition of blocks.
    static bool opens(const Block& block, const Word& word) {
        if (word.name == "REPEAT") return word.first == word.last;
        if (word.name != "IF") return true;
        return std::none_of(block.tokens.begin() + static_cast<std::ptrdiff_t>(word.first),
                            block.tokens.begin() + static_cast<std::ptrdiff_t>(word.last), [](const Token& token) {
                                return token.kind == TokenKind::Name && token.text.starts_with("GOTO");
                            });
    }

    void close(const Pair& pair, const base::Location& place) {
        if (open_.empty() || open_.back().word != pair.begin)
            return error("nc.structure", fmt::format("{} has no {}", pair.end, pair.begin), place);
        const Open open = open_.back();
        open_.pop_back();
        const Structure structure{open.where.line, open.middle, place.line};
        index_.structures[structure.begin] = structure;
        index_.structures[structure.end] = structure;
        if (structure.middle != 0) index_.structures[structure.middle] = structure;
    }

    void error(std::string_view code, std::string message, const base::Location& where) {
        report_.error(code, std::move(message), where);
        good_ = false;
    }

    ProgramIndex& index_;
    base::Diagnostics& report_;
    std::vector<Open> open_;
    bool good_ = true;
};

}  // namespace

const ProgramPart& ProgramIndex::partOf(std::size_t line) const {
    for (const ProgramPart& part : parts)
        if (line <= part.last) return part;
    return parts.back();
}

const ProgramPart* ProgramIndex::find(std::string_view name) const {
    const auto found =
        std::find_if(parts.begin(), parts.end(), [&](const ProgramPart& part) { return part.name == name; });
    return found == parts.end() ? nullptr : &*found;
}

bool buildIndex(const std::vector<std::string>& lines, std::size_t first_line, const std::string& file_name,
                ProgramIndex& index, base::Diagnostics& report) {
    Indexer indexer(index, report);
    index.parts.push_back({{}, first_line, first_line});
    Block block;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        block.line = lines[i];
        block.where = {file_name, first_line + i, 0, {}};
        base::Diagnostics left_to_the_run;
        if (parseBlock(block, left_to_the_run)) indexer.add(block);
    }
    return indexer.finish(first_line + lines.size() - 1);
}

}  // namespace cusp::post::reader
