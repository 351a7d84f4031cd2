// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The reject corpus: every program under reject/ gives exactly the problems its first lines announce.
#include "nc_recorder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

namespace cusp::post::reader::test {
namespace {

/// The texts behind `; expect: `, one problem each.
std::string expectedProblems(const std::string& text) {
    const std::string mark = "; expect: ";
    std::istringstream lines(text);
    std::string expected;
    for (std::string line; std::getline(lines, line) && line.starts_with(mark);)
        expected += line.substr(mark.size()) + "\n";
    return expected;
}

TEST(Reject, EveryFileGivesItsExactProblems) {
    const MachineFile machine = shippedMachine("head-c200-a95");
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(CUSP_SOURCE_DIR "/tests/post/reject")) {
        const std::string text = fileText(entry.path());
        const Recording out = run(text, machine);
        EXPECT_EQ(out.problems, expectedProblems(text)) << entry.path();
        EXPECT_TRUE(out.report.hasErrors()) << entry.path() << " is not rejected";
        ++files;
    }
    EXPECT_GE(files, 40U);
}

}  // namespace
}  // namespace cusp::post::reader::test
