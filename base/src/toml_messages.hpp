// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What surrounds the TOML parser: a check before it runs, and its complaints in a machinist's words.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace cusp::base {

/// The line of the first dotted key of more than 32 parts. toml++ 3.3 builds one nested table per part and destroys
/// them recursively, so a line of a million dots would overflow the stack.
[[nodiscard]] std::optional<std::size_t> lineWithTooDeepKey(std::string_view text);

/// "Error while parsing key-value pair: expected '=', saw 'x'" → "expected '=', found 'x' (in a key-value pair)".
[[nodiscard]] std::string cleanTomlMessage(std::string_view message);

}  // namespace cusp::base
