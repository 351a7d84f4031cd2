// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// renderPage: the document arrives unchanged, cannot leave its element, and what is wrong is said.
#include <cusp/base/json_report.hpp>
#include <cusp/pages/render.hpp>

#include <algorithm>
#include <gtest/gtest.h>

namespace cusp::pages {
namespace {

/// The text of the element that carries the document.
std::string documentIn(const std::string& html) {
    const std::string open = R"(<script type="application/json" id="data">)";
    const std::size_t begin = html.find(open);
    if (begin == std::string::npos) return {};
    return html.substr(begin + open.size(), html.find("</script>", begin) - begin - open.size());
}

std::size_t occurrences(const std::string& text, const std::string& what) {
    std::size_t found = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
    return found;
}

TEST(RenderPage, EveryPageIsOneWholeHtmlFile) {
    ASSERT_FALSE(pageNames().empty());
    for (const std::string& name : pageNames()) {
        const auto html = renderPage(name, R"({"points": 0})");
        ASSERT_TRUE(html.has_value()) << name;
        EXPECT_TRUE(html->starts_with("<!doctype html>")) << name;
        EXPECT_TRUE(html->ends_with("</html>\n")) << name;
        EXPECT_EQ(occurrences(*html, "default-src 'none'"), 1U) << name;
        EXPECT_EQ(documentIn(*html), R"({"points": 0})") << name;
    }
}

TEST(RenderPage, LoadsNothing) {
    for (const std::string& name : pageNames()) {
        const std::string html = renderPage(name, "{}").value_or("");
        for (const std::string loader :
             {"src=\"http", "href=\"http", "@import", "url(http", "<link rel=\"stylesheet\""})
            EXPECT_EQ(occurrences(html, loader), 0U) << name << ": " << loader;
    }
}

TEST(RenderPage, CarriesTheLicencesOfWhatIsBundled) {
    const std::string html = renderPage("inspection", "{}").value_or("");
    EXPECT_EQ(occurrences(html, "three.js authors"), 1U);
    EXPECT_EQ(occurrences(html, "Leon Sorokin"), 1U);
    EXPECT_EQ(occurrences(html, "Permission is hereby granted, free of charge"), 2U);
}

TEST(RenderPage, ADocumentCannotEndItsElement) {
    const base::Json document = {{"title", "</script><script>alert(1)</script><!--"}, {"umlaut", "\xC3\xA4"}};
    const auto html = renderPage("inspection", document.dump());
    ASSERT_TRUE(html.has_value());
    const std::string plain = renderPage("inspection", "{}").value_or("");
    EXPECT_EQ(occurrences(*html, "<script"), occurrences(plain, "<script"));
    EXPECT_EQ(occurrences(*html, "<!--"), occurrences(plain, "<!--"));
    EXPECT_EQ(base::Json::parse(documentIn(*html)), document);
}

TEST(RenderPage, NamesThePagesThereAre) {
    const auto html = renderPage("inspektion", "{}");
    ASSERT_FALSE(html.has_value());
    EXPECT_EQ(
        base::toText(html.error()),
        "error: there is no page 'inspektion'; there are: capability, inspection, loop, monitor, optimization, simulation, texture, "
        "tilt [pages.unknown-page]\n");
    EXPECT_EQ(html.error().front().code, "pages.unknown-page");
}

TEST(RenderPage, SaysWhereADocumentIsNotJson) {
    const auto text = [](std::string_view json) {
        const auto html = renderPage("inspection", json);
        return html ? std::string("accepted") : base::toText(html.error());
    };
    EXPECT_EQ(text("{\"a\": 1,\n \"b\": nan}"), "2:8: error: the document of the page is not JSON [pages.json]\n");
    EXPECT_EQ(text(""), "1:1: error: the document of the page is not JSON [pages.json]\n");
    EXPECT_EQ(text("{\"a\": \"\xFF\"}"), "1:8: error: the document of the page is not JSON [pages.json]\n");
    EXPECT_EQ(text("{} {}"), "1:4: error: the document of the page is not JSON [pages.json]\n");
}

}  // namespace
}  // namespace cusp::pages
