// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A term is "1" or one or two factors u, v, each with an optional ^exponent.
#include "surface_terms.hpp"

#include <cusp/base/number_text.hpp>
#include <cusp/geometry/bezier_patch.hpp>

namespace cusp::geometry::detail {
namespace {

/// The exponent of a factor "u", "u^3"; nothing when it is none.
std::optional<std::size_t> exponentOf(std::string_view factor) {
    if (factor.size() == 1) return 1;
    if (factor.size() < 3 || factor.size() > 4 || factor[1] != '^') return std::nullopt;
    const std::string_view digits = factor.substr(2);
    if (digits.find_first_not_of("0123456789") != std::string_view::npos) return std::nullopt;
    const auto value = base::parseInteger(digits);
    if (!value || *value > max_surface_degree) return std::nullopt;
    return static_cast<std::size_t>(*value);
}

}  // namespace

std::optional<Powers> parseTerm(std::string_view term) {
    Powers powers;
    if (term == "1") return powers;
    bool has_u = false;
    bool has_v = false;
    while (true) {
        const std::size_t blank = term.find(' ');
        const std::string_view factor = term.substr(0, blank);
        const char name = factor.empty() ? '\0' : factor.front();
        bool& seen = name == 'u' ? has_u : has_v;
        if ((name != 'u' && name != 'v') || seen) return std::nullopt;
        seen = true;
        const auto exponent = exponentOf(factor);
        if (!exponent) return std::nullopt;
        (name == 'u' ? powers.of_u : powers.of_v) = *exponent;
        if (blank == std::string_view::npos) return powers;
        term.remove_prefix(blank + 1);
    }
}

}  // namespace cusp::geometry::detail
