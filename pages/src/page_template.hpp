// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The bundled pages as bytes: what stands before and after the JSON document of each.
#pragma once

#include <span>
#include <string_view>

namespace cusp::pages {

struct PageTemplate {
    std::string_view name;
    std::span<const std::string_view> before;
    std::span<const std::string_view> after;
};

/// All pages, in the order of web/pages.json; made at build time by tools/bundle.mjs.
[[nodiscard]] std::span<const PageTemplate> pageTemplates();

}  // namespace cusp::pages
