// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A page's name and a JSON document in, one HTML file out that needs nothing else.
#pragma once

#include <cusp/base/result.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace cusp::pages {

/// The names `renderPage` knows.
[[nodiscard]] std::vector<std::string> pageNames();

/// The HTML text of a page: styles, scripts and `json` inside it, nothing loaded from anywhere, by a content security
/// policy that would refuse it. Which keys a page reads is said in `pages/README.md`; what is not there is not shown.
/// Errors: `pages.unknown-page`; `pages.json` when `json` is no JSON document (with line and column).
[[nodiscard]] base::Result<std::string> renderPage(std::string_view page, std::string_view json);

}  // namespace cusp::pages
