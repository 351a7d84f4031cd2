// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// No block is longer than an 840D takes, whatever texts the CL file holds; the texts never become words.
#include "posted_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fmt/format.h>
#include <random>
#include <sstream>

namespace cusp::post::test {
namespace {

constexpr std::uint32_t first_seed = 20261126;
/// With its line feed a block has 512.
constexpr std::size_t longest_block = 511;

class Texts {
public:
    explicit Texts(std::uint32_t seed) : random_(seed) {}

    /// Up to 2000 characters, some of which mean something to one of the two readers, some of which are no ASCII.
    std::string any(const std::string& without) {
        static constexpr std::string_view odd = "\";()$%=/*<>&'\\\xC3\xA4\xE2\x82\xAC\t";
        std::string out;
        const int length = number(1, number(0, 3) == 0 ? 2000 : 80);
        for (int i = 0; i < length; ++i) {
            const char c = number(0, 4) == 0
                               ? odd[static_cast<std::size_t>(number(0, static_cast<int>(odd.size()) - 1))]
                               : static_cast<char>(number(' ', '~'));
            out += without.find(c) == std::string::npos ? c : 'x';
        }
        return out;
    }
    int number(int low, int high) { return std::uniform_int_distribution(low, high)(random_); }

private:
    std::mt19937 random_;
};

std::string wordyPath(std::uint32_t seed) {
    Texts texts(seed);
    std::string cl = "TOOL PATH/" + texts.any("/,$\"") + ",TOOL," + texts.any("/,$\"") +
                     "\nTLDATA/MILL,6.0,3.0,50.0,0.0,0.0\nMSYS/0,0,0,1,0,0,0,1,0\nSPINDL/RPM,9000,CLW\n"
                     "FEDRAT/MMPM,3000.0\nGOTO/0,0,50,0,0,1\n";
    for (int i = 0; i < 20; ++i) {
        cl += (texts.number(0, 1) == 0 ? "PPRINT/" : "INSERT/") + texts.any("$") + "\n";
        cl += fmt::format("GOTO/{}.12345,{}.98765,-123456.78901,0.1234568,-0.3456789,0.9302081\n",
                          texts.number(-999999, 999999), texts.number(-999999, 999999));
    }
    return cl + "END-OF-PATH\n";
}

TEST(BlockLength, NoTextMakesABlockTooLong) {
    const MachineFile machine = shippedMachine("fooke-endura-ca");
    std::size_t longest = 0;
    for (std::uint32_t seed = first_seed; seed < first_seed + 60; ++seed)
        for (const auto& [word, form] : programFormWords()) {
            SCOPED_TRACE(fmt::format("seed {}, {}", seed, word));
            PostOptions options;
            options.form = form;
            options.tool_length_mm = 100.0;
            const Posted posted = post(wordyPath(seed), machine, options);
            std::istringstream lines(posted.program);
            for (std::string line; std::getline(lines, line);) {
                longest = std::max(longest, line.size());
                ASSERT_LE(line.size(), longest_block) << line;
                for (const char c : line) ASSERT_TRUE(c >= ' ' && c <= '~') << line;
            }
        }
    EXPECT_GT(longest, 100U) << "nothing long was tried";
}

}  // namespace
}  // namespace cusp::post::test
