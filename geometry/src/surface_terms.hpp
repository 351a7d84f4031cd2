// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The terms of a polynomial as people write them: "1", "u", "v^2", "u^2 v".
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace cusp::geometry::detail {

struct Powers {
    std::size_t of_u = 0;
    std::size_t of_v = 0;
};

/// Powers of u and v in a term; each variable at most once, exponents 0 to 25, blanks between factors and nowhere else.
[[nodiscard]] std::optional<Powers> parseTerm(std::string_view term);

}  // namespace cusp::geometry::detail
