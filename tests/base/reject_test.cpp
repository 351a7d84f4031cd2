// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The reject corpus: each file in reject/ begins with the exact diagnostic it must give.
#include "everything.hpp"

#include <cusp/base/atomic_file.hpp>

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace {

using namespace cusp::base;
using namespace cusp::base::testing;
namespace fs = std::filesystem;

constexpr std::string_view mark = "# expect: ";

TEST(Reject, EveryFileGivesExactlyItsDiagnostics) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(fs::path(CUSP_SOURCE_DIR) / "tests/base/reject"))
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    EXPECT_GE(files.size(), 40U);
    for (const fs::path& path : files) {
        const auto text = readWholeFile(path.string(), 1U << 20U);
        ASSERT_TRUE(text.has_value()) << path;
        // One expectation per line, as many lines as there are diagnostics.
        std::string expected;
        std::string_view rest = *text;
        while (rest.starts_with(mark)) {
            const std::size_t end = std::min(rest.find('\n'), rest.size() - 1);
            expected += rest.substr(mark.size(), end + 1 - mark.size());
            rest.remove_prefix(end + 1);
        }
        EXPECT_NE(expected, "") << path << " does not say what it expects";
        Diagnostics report;
        static_cast<void>(readEverything(*text, report, path.filename().string()));
        EXPECT_EQ(toText(report), expected);
    }
}

}  // namespace
