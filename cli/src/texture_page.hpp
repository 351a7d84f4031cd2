// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Stylus profiles as a web page: their JSON with the curves that JSON leaves out.
#pragma once

#include <cusp/base/json_report.hpp>
#include <cusp/inspect/texture_report.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace cusp::cli {

/// Indices that draw a curve as it looks with all its points: of each of at most `most`/2 equal stretches the lowest and the
/// highest, and both ends.
[[nodiscard]] std::vector<std::size_t> outlineOf(std::span<const double> values, std::size_t most);

/// The summary of `cusp texture`: docs/json.md.
[[nodiscard]] base::Json textureSummary(std::span<const inspect::TextureReport> reports);

/// texture.html; the document is `textureSummary` with `curves` in every profile (pages/web/pages/texture_input.ts).
[[nodiscard]] base::Result<std::string> texturePage(std::span<const inspect::TextureReport> reports);

}  // namespace cusp::cli
