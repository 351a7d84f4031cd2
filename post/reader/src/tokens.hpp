// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Cuts one block into tokens; knows the alphabet of the 840D, not its words.
#pragma once

#include <cusp/base/diagnostics.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::post::reader {

enum class TokenKind {
    Letter,  ///< one letter that a digit, sign or '=' may follow: an address
    Name,    ///< two or more characters, the first two letters, '_' or '$'
    Number,  ///< unsigned
    Text,    ///< between double quotes, without them
    Symbol,  ///< one of ( ) [ ] , = + - * / < > : % or a pair: == <> <= >=
    End
};

struct Token {
    TokenKind kind = TokenKind::End;
    std::string_view text;  ///< upper case, except Text
    double number = 0.0;
    bool integer = false;    ///< a Number written without point and exponent
    std::size_t column = 0;  ///< from 1
    bool joined = false;     ///< no space between this and the token before
    [[nodiscard]] bool is(std::string_view symbol) const { return kind == TokenKind::Symbol && text == symbol; }
};

/// Tokens of `line`, always with an End at the back; comments left out. `upper` receives the line in capitals; tokens
/// point into `line` and `upper`, which must outlive them. False, with `nc.syntax` or `nc.number` errors in `report`, when
/// the line cannot be cut.
[[nodiscard]] bool cutIntoTokens(const std::string& line, std::string& upper, std::vector<Token>& tokens,
                                 const base::Location& where, base::Diagnostics& report);

}  // namespace cusp::post::reader
