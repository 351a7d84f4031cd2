// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The generated documentation pages say what the command reads today (`make docs` writes them anew).
#include "command_line.hpp"

#include <sstream>
#include <string>

namespace cusp::cli {
namespace {

using Documents = CommandLine;

TEST_F(Documents, PagesAreUpToDate) {
    std::istringstream pages(run({"schema"}).output);
    int found = 0;
    for (std::string page; std::getline(pages, page); ++found) {
        const auto outcome = run({"schema", page});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
        const auto committed =
            base::readWholeFile(std::string(CUSP_SOURCE_DIR) + "/docs/" + page + ".md", std::size_t{1} << 20U);
        ASSERT_TRUE(committed.has_value()) << "docs/" << page << ".md is missing; make docs";
        EXPECT_EQ(*committed, outcome.output) << "make docs";
    }
    EXPECT_GE(found, 3);
}

}  // namespace
}  // namespace cusp::cli
