// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Machine files whose [control] is broken, each with the diagnostics it must give in its first lines.
#include <cusp/post/control/control_definition.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace cusp::post {
namespace {

std::vector<std::filesystem::path> rejectFiles() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(CUSP_SOURCE_DIR "/tests/post/control/reject"))
        if (entry.path().extension() == ".toml") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

struct Reject {
    std::string expected;
    std::string text;
};

Reject readReject(const std::filesystem::path& path) {
    Reject out;
    std::ifstream in(path);
    const std::string mark = "# expect: ";
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with(mark)) out.expected += line.substr(mark.size()) + "\n";
        out.text += line + "\n";
    }
    return out;
}

class RejectedControl : public ::testing::TestWithParam<std::filesystem::path> {};

TEST_P(RejectedControl, SaysWhatIsWrongAndWhere) {
    const Reject reject = readReject(GetParam());
    const auto read = parseMachineFile(reject.text, GetParam().filename().string());
    ASSERT_FALSE(read.has_value());
    EXPECT_EQ(base::toText(read.error()), reject.expected);
}

INSTANTIATE_TEST_SUITE_P(Corpus, RejectedControl, ::testing::ValuesIn(rejectFiles()), [](const auto& file) {
    std::string name = file.param.stem().string();
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

TEST(Control, TheCorpusIsThere) { EXPECT_GT(rejectFiles().size(), 25U); }

}  // namespace
}  // namespace cusp::post
