// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The page of an optimisation.
#pragma once

#include "optimize_output.hpp"

namespace cusp::cli {

/// The summary, and behind it what the page draws: pages/web/pages/optimization_input.ts. Errors: those of `jsonText` and
/// `renderPage`.
[[nodiscard]] base::Result<std::string> optimizePage(const base::Json& summary, const Optimized& done);

}  // namespace cusp::cli
