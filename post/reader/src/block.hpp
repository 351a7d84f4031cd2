// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// One block as words with their places: what is written, before anything is evaluated or done.
#pragma once

#include "tokens.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cusp::post::reader {

enum class WordKind {
    Code,       ///< G1, M30: a letter whose integer names a function
    Value,      ///< an address or variable with a value: X10, X=R1+2, A3=0.5, CR=4, _HOME=0, T="MILL"
    Indexed,    ///< NAME[…]=…
    Keyword,    ///< TRAORI, SUPA
    Call,       ///< CYCLE832(…)
    Statement,  ///< DEF, IF, GOTOF …: takes the rest of the block
};

struct Word {
    WordKind kind = WordKind::Keyword;
    std::string_view name;  ///< "G1" and "G01" are both "G" with number 1; "A3" for A3=
    std::size_t column = 0;
    int number = 0;  ///< of a Code
    /// Tokens of the value, the arguments (without parentheses) or the rest of the statement.
    std::size_t first = 0;
    std::size_t last = 0;
};

struct Block {
    std::string line;   ///< as written
    std::string upper;  ///< in capitals; names point here
    std::vector<Token> tokens;
    std::vector<Word> words;
    std::optional<std::uint64_t> number;
    std::string_view label;       ///< "NAME" of "NAME:"; points into `upper`
    bool may_be_skipped = false;  ///< begins with '/'
    bool is_header = false;       ///< %_N_NAME_MPF
    base::Location where;

    [[nodiscard]] base::Location at(std::size_t column) const;
    /// What stands between two tokens, as written.
    [[nodiscard]] std::string textOf(std::size_t first, std::size_t last) const;
};

/// Parses `block.line`. False when it cannot be cut into words (`nc.syntax`, `nc.number`, `nc.missing-equals`); the block
/// is then to be left out.
[[nodiscard]] bool parseBlock(Block& block, base::Diagnostics& report);

/// Ends of the comma-separated parts of the tokens [first, last), parentheses respected.
[[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> splitAtCommas(const Block& block, std::size_t first,
                                                                             std::size_t last);

}  // namespace cusp::post::reader
