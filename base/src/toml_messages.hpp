// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What surrounds the TOML parser: a check before it runs, and its complaints in a machinist's words.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace cusp::base {

struct TextProblem {
    std::size_t line = 0;
    std::string_view message;
};

/// What toml++ 3.3 cannot be trusted with. A dotted key of more than 32 parts: it builds one nested table per part and
/// destroys them recursively, so a line of a million dots would overflow the stack. A character beyond ASCII outside
/// texts and comments (TOML 1.0 has none there) or as the first behind a line-ending backslash: its question whether
/// such a character is blank runs into undefined behaviour.
[[nodiscard]] std::optional<TextProblem> findTextProblem(std::string_view text);

/// "Error while parsing key-value pair: expected '=', saw 'x'" → "expected '=', found 'x' (in a key-value pair)".
[[nodiscard]] std::string cleanTomlMessage(std::string_view message);

}  // namespace cusp::base
