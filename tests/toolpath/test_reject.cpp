// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The reject corpus: every file under reject/ ends with exactly the problems its first lines announce.
#include "cl_text.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

namespace cusp::toolpath::test {
namespace {

/// The texts behind `$$ expect: `, one problem each.
std::string expectedProblems(const std::string& text) {
    const std::string mark = "$$ expect: ";
    std::istringstream lines(text);
    std::string expected;
    for (std::string line; std::getline(lines, line) && line.starts_with(mark);) {
        expected += line.substr(mark.size()) + "\n";
    }
    return expected;
}

TEST(Reject, EveryFileGivesItsExactProblems) {
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(CUSP_SOURCE_DIR "/tests/toolpath/reject")) {
        const std::string text = fileText(entry.path());
        const ReadOut out = readOut(text);
        EXPECT_EQ(out.problems, expectedProblems(text)) << entry.path();
        EXPECT_TRUE(out.report.hasErrors()) << entry.path() << " belongs elsewhere: it is not rejected";
        ++files;
    }
    EXPECT_GE(files, 10U);
}

}  // namespace
}  // namespace cusp::toolpath::test
