// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Result<T>: a value, or the diagnostics that say why there is none.
#pragma once

#include <cusp/base/diagnostics.hpp>

#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>

namespace cusp::base {

/// Whatever input can cause is a value, never an abort. A function that can also warn while succeeding takes a
/// `Diagnostics&` for that.
template <class T>
using Result = tl::expected<T, Diagnostics>;

/// `return fail("toml.syntax", "…", where);` from any function that returns a Result.
[[nodiscard]] inline tl::unexpected<Diagnostics> fail(std::string_view code, std::string message, Location where = {}) {
    Diagnostics diagnostics;
    diagnostics.error(code, std::move(message), std::move(where));
    return tl::unexpected<Diagnostics>(std::move(diagnostics));
}

[[nodiscard]] inline tl::unexpected<Diagnostics> fail(Diagnostics diagnostics) {
    return tl::unexpected<Diagnostics>(std::move(diagnostics));
}

}  // namespace cusp::base
