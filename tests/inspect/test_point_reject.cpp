// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The reject corpus of measured points: every file ends with exactly the problems its first lines announce.
#include "points_text.hpp"

#include <gtest/gtest.h>

#include <cusp/base/atomic_file.hpp>

#include <filesystem>

namespace cusp::inspect::test {
namespace {

/// Lines "## expect: …" at the head; what is read begins behind them, with line 1.
struct Case {
    std::string expected;
    std::string text;
};

Case caseOf(std::string text) {
    const std::string mark = "## expect: ";
    Case out;
    while (text.starts_with(mark)) {
        const std::size_t end = text.find('\n') + 1;
        out.expected += text.substr(mark.size(), end - mark.size());
        text.erase(0, end);
    }
    out.text = text;
    return out;
}

TEST(PointReject, EveryFileGivesItsExactProblems) {
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(CUSP_SOURCE_DIR "/tests/inspect/reject_points")) {
        const auto text = base::readWholeFile(entry.path(), 1000000);
        ASSERT_TRUE(text.has_value());
        const Case wanted = caseOf(*text);
        EXPECT_EQ(readText(wanted.text).errors, wanted.expected) << entry.path();
        EXPECT_NE(wanted.expected, "") << entry.path() << " belongs elsewhere: it is not rejected";
        ++files;
    }
    EXPECT_GE(files, 20U);
}

TEST(PointReject, OptionsThatDoNotFit) {
    EXPECT_EQ(readText("1,2,3\n", {.columns = "x,y,w"}).errors,
              "error: --columns: 'w' is none of x, y, z, i, j, k, section, weight, id, - [points.columns]\n");
    EXPECT_EQ(readText("1,2,3\n", {.columns = "x,y"}).errors,
              "1: error: the header has no column z; its columns are x, y; say with --columns which is which "
              "[points.header]\n");
    EXPECT_EQ(readText("1,2,3,4\n", {.columns = "x,y,z"}).errors,
              "1: error: 4 columns where the table has 3 [points.columns]\n");
}

}  // namespace
}  // namespace cusp::inspect::test
