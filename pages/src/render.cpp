// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Joins a bundled page with its document, which must be JSON and must not be able to end the element it stands in.
#include <cusp/pages/render.hpp>

#include "page_template.hpp"

#include <cusp/base/json_report.hpp>

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cusp::pages {

namespace {

/// Line and column, from 1, of the byte at `offset`.
base::Location locationOf(std::string_view text, std::size_t offset) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const auto line = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1;
    const std::size_t line_begin = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
    return {{}, line, before.size() - line_begin + 1, {}};
}

base::Result<void> checkJson(std::string_view json) {
    // The callback refuses every value, so that a document of a million points is checked without being built.
    const auto keep_nothing = [](int, base::Json::parse_event_t, base::Json&) { return false; };
    try {
        [[maybe_unused]] const base::Json nothing = base::Json::parse(json, keep_nothing);
    } catch (const base::Json::parse_error& error) {
        return base::fail("pages.json", "the document of the page is not JSON",
                          locationOf(json, error.byte > 0 ? error.byte - 1 : 0));
    }
    return {};
}

/// `<` occurs in JSON inside of strings only, where `\u003c` says the same; so no `</script>` or `<!--` is left.
void appendEscaped(std::string& out, std::string_view json) {
    for (const char character : json) {
        if (character == '<')
            out += "\\u003c";
        else
            out += character;
    }
}

}  // namespace

std::vector<std::string> pageNames() {
    std::vector<std::string> names;
    for (const PageTemplate& page : pageTemplates()) names.emplace_back(page.name);
    return names;
}

base::Result<std::string> renderPage(std::string_view page, std::string_view json) {
    const auto pages = pageTemplates();
    const auto found =
        std::find_if(pages.begin(), pages.end(), [page](const PageTemplate& known) { return known.name == page; });
    if (found == pages.end()) {
        return base::fail("pages.unknown-page",
                          fmt::format("there is no page '{}'; there are: {}", page, fmt::join(pageNames(), ", ")));
    }
    if (const auto checked = checkJson(json); !checked) return base::fail(checked.error());
    std::string out;
    for (const std::string_view piece : found->before) out += piece;
    appendEscaped(out, json);
    for (const std::string_view piece : found->after) out += piece;
    return out;
}

}  // namespace cusp::pages
