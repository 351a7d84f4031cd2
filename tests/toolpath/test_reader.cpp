// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What holds for every file: lines, ends, caps, unknown statements, streams that break, and any block size.
#include "cl_text.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>
#include <random>
#include <sstream>
#include <stdexcept>
#include <streambuf>

namespace cusp::toolpath::test {
namespace {

const std::string good = "UNITS/MM\nGOTO/1,2,3\nFINI\n";
const std::string good_text = "2 go 1 2 3 axis 0 0 1\n3 end\n";

TEST(Lines, EveryEndingAndAByteOrderMark) {
    EXPECT_EQ(readOut(good).text, good_text);
    EXPECT_EQ(readOut("UNITS/MM\r\nGOTO/1,2,$\r\n3\r\nFINI").text, "2 go 1 2 3 axis 0 0 1\n4 end\n");
    EXPECT_EQ(readOut("\xEF\xBB\xBF" + good).text, good_text);
    EXPECT_EQ(readOut("\n  \n" + good + "\n\x1A").text, "4 go 1 2 3 axis 0 0 1\n5 end\n");
}

TEST(Preamble, FreeTextBeforeTheFirstStatement) {
    const ReadOut out = readOut("Listing of 12/3/2026\nsecond line\n" + good);
    EXPECT_EQ(out.text, "4 go 1 2 3 axis 0 0 1\n5 end\n");
    EXPECT_EQ(out.problems,
              "1: note: text before the first statement is passed over: 'Listing of 12/3/2026' [cl.preamble]\n");
}

TEST(Unknown, IsAWarningOrUnderStrictAnError) {
    const std::string text = "UNITS/MM\nPPFUN/15,1318046,OFF\nGOTO/1,2,3\nwhat is this\nFINI\n";
    EXPECT_EQ(
        readOut(text).problems,
        "2: warning: 'PPFUN/15,1318046,OFF' is not known to the reader and is passed over [cl.unknown-statement]\n"
        "4: warning: 'what is this' is not known to the reader and is passed over [cl.unknown-statement]\n");
    ClReaderOptions strict;
    strict.strict = true;
    EXPECT_EQ(readOut(text, strict).report.errorCount(), 2U);
    EXPECT_EQ(readOut("SWITCH/3\n" + good).problems,
              "1: warning: 'SWITCH/3' is not known to the reader and is passed over [cl.unknown-statement]\n");
    const std::string longer = "W/" + std::string(57, 'x') + "\xC3\xA4" + std::string(99, 'y');
    EXPECT_EQ(readOut("UNITS/MM\n" + longer + "\n" + good).report.front().message,
              "'W/" + std::string(57, 'x') + "…' is not known to the reader and is passed over");
}

TEST(End, OfAPathOfTheProgramAndOfTheFile) {
    EXPECT_EQ(readOut("UNITS/MM\nTOOL PATH/A,TOOL,B\nGOTO/1,2,3\nEND-OF-PATH\nTool Path Listing has 4 lines.").text,
              "2 operation 'A'\n3 tool - 'B'\n3 go 1 2 3 axis 0 0 1\n5 end\n");
    EXPECT_EQ(readOut("UNITS/MM\nTOOL PATH/A,TOOL,B\nGOTO/1,2,3\nEND-OF-PATH\nTool Path Listing has 4 lines.").problems,
              "");
    EXPECT_EQ(readOut("UNITS/MM\nGOTO/1,2,3\nEND\n$$ done\nREWIND/0\nFINI\n").problems, "");
    EXPECT_EQ(readOut("UNITS/MM\nGOTO/1,2,3\nEND\nY43e\nmore\n").problems,
              "4: warning: text behind the end of the program is not read: 'Y43e' [cl.after-end]\n");
    EXPECT_EQ(readOut(good + "GOTO/4,5,6\nGOTO/4,5,6\n").problems,
              "4: error: GOTO behind the end of the program is not read [cl.after-end]\n");
    EXPECT_EQ(
        readOut("UNITS/MM\nGOTO/1,2,3\n").problems,
        "2: error: the file ends without FINI, END or END-OF-PATH: it has been cut short; if it is whole, add FINI "
        "[cl.no-end]\n");
}

TEST(End, WithoutMotionOrInsideAStatement) {
    const std::string no_motion = "error: the file moves no tool: no GOTO in it [cl.no-motion]\n";
    EXPECT_EQ(readOut("").problems, no_motion);
    EXPECT_EQ(readOut("PARTNO 1\nFINI\n").problems, "2: " + no_motion);
    EXPECT_EQ(readOut("UNITS/MM\nGOTO/1,2,3\nGOTO/1,2,$\n").problems,
              "3: error: the file ends inside a statement that $ continues [cl.continuation]\n");
}

TEST(Caps, StatementBytes) {
    ClReaderOptions options;
    options.max_statement_bytes = 100;
    const std::string message =
        "2: error: a statement of more than 100 bytes; this does not look like a CL file [cl.line-too-long]\n";
    EXPECT_EQ(readOut("UNITS/MM\nPPRINT " + std::string(93, 'x') + "\nGOTO/1,2,3\nFINI\n", options).problems, "");
    EXPECT_EQ(readOut("UNITS/MM\nPPRINT " + std::string(94, 'x') + "\nGOTO/1,2,3\nFINI\n", options).problems, message);
    EXPECT_EQ(readOut("UNITS/MM\nPPRINT " + std::string(200, 'x'), options).problems, message);
    std::string continued = "UNITS/MM\n";
    for (int i = 0; i < 30; ++i) {
        continued += "GOTO,$\n";
    }
    EXPECT_EQ(readOut(continued + "GOTO/1,2,3\nFINI\n", options).problems, message);
}

TEST(Caps, ErrorsAreCountedNotFlooded) {
    std::string text = "UNITS/MM\n";
    for (int i = 0; i < 1000; ++i) {
        text += "GOTO/1\n";
    }
    const ReadOut out = readOut(text);
    EXPECT_EQ(out.report.size(), base::Diagnostics::default_cap);
    EXPECT_EQ(out.report.errorCount(), 1000U);
}

TEST(Binary, IsRefusedAtOnce) {
    const std::string binary("UNITS/MM\nGOTO/1,2,3\n\0\1\2", 23);
    const ReadOut at_once = readOut(binary);
    EXPECT_EQ(at_once.text, "");
    EXPECT_EQ(at_once.problems, "1: error: this is not a text file: it contains NUL bytes [cl.binary]\n");
    // Behind the look-ahead the lines before the byte are read.
    std::string long_text = "UNITS/MM\n";
    while (long_text.size() < 1100000) {
        long_text += "GOTO/1,2,3\n";
    }
    const std::size_t lines = (long_text.size() - 9) / 11;
    const ReadOut later = readOut(long_text + std::string("x\0y\n", 4));
    EXPECT_EQ(later.records.size(), lines);
    EXPECT_EQ(later.problems,
              fmt::format("{}: error: this is not a text file: it contains NUL bytes [cl.binary]\n", lines + 2));
}

/// Gives `text` in pieces of random length, then ends or fails.
class Pieces : public std::streambuf {
public:
    Pieces(std::string text, std::uint64_t seed, bool fails) : text_(std::move(text)), random_(seed), fails_(fails) {}

protected:
    int_type underflow() override {
        if (at_ == text_.size()) {
            if (fails_) {
                throw std::runtime_error("the disk is gone");
            }
            return traits_type::eof();
        }
        const std::size_t length = std::min<std::size_t>(text_.size() - at_, 1 + random_() % 7);
        setg(&text_[at_], &text_[at_], &text_[at_] + length);
        at_ += length;
        return traits_type::to_int_type(*gptr());
    }

private:
    std::string text_;
    std::mt19937_64 random_;
    bool fails_;
    std::size_t at_ = 0;
};

TEST(Stream, AReadErrorIsNotAnEndOfFile) {
    Pieces pieces("UNITS/MM\nGOTO/1,2,3\nGOTO/1,2,", 1, true);
    std::istream in(&pieces);
    EXPECT_EQ(readOut(in).problems, "1: error: the file could not be read to its end [io.read]\n");
    Pieces again("UNITS/MM\nGOTO/1,2,3\n", 1, true);
    std::istream throwing(&again);
    throwing.exceptions(std::ios_base::badbit);
    EXPECT_EQ(readOut(throwing).problems, "1: error: the file could not be read to its end [io.read]\n");
}

TEST(Stream, AnyBlockSizeGivesTheSameRecords) {
    const std::string text =
        "\xEF\xBB\xBF$$     CATIA APT VERSION 1.0\r\n$$*CATIA0\r\n$$ name\r\n$$ 1 0 0 0\r\n$$ 0 1 0 0\n"
        "$$ 0 0 1 4\nPPRINT text $ $$ more\nCUTTER/ 16,$\n 3, 5,$ hidden\r\n 3\nTOOLNO/1\nLOADTL/1\n"
        "RAPID\nGOTO  / 1.00000, 2.00000, 3.00000, 0.0000000, 0.0000000, 1.0000000\nFEDRAT/100,MMPM\n"
        "MULTAX\nNONSENSE/1\nGOTO/1,2\nCIRCLE/1\nGOTO/-4.25,5e1,$\n$\n.5 $$ remark\n\n\nFINI\nafter";
    const ReadOut whole = readOut(text);
    EXPECT_EQ(whole.records.size(), 7U) << whole.text;
    for (std::size_t block = 1; block < 120; ++block) {
        ClReaderOptions options;
        options.block_bytes = block;
        const ReadOut out = readOut(text, options);
        ASSERT_EQ(out.text, whole.text) << "block " << block;
        ASSERT_EQ(out.problems, whole.problems) << "block " << block;
        Pieces pieces(text, block, false);
        std::istream in(&pieces);
        ASSERT_EQ(readOut(in, options).text, whole.text) << "block and seed " << block;
    }
}

TEST(WholePath, ReadsAFileOrSaysWhyNot) {
    base::Diagnostics warnings;
    std::istringstream in(good);
    const base::Result<ToolPath> path = readToolPath(in, "P.apt", {}, warnings);
    ASSERT_TRUE(path.has_value());
    EXPECT_EQ(path->records.size(), 2U);
    EXPECT_EQ(path->dialect, Dialect::Apt);
    EXPECT_EQ(path->file_name, "P.apt");
    EXPECT_TRUE(warnings.empty());

    const base::Result<ToolPath> missing = readToolPathFile("/no/such/P.apt", {}, warnings);
    ASSERT_FALSE(missing.has_value());
    EXPECT_EQ(base::toText(missing.error().front()),
              "/no/such/P.apt: error: cannot open the file: No such file or directory [io.open]");

    std::istringstream cut_short("UNITS/MM\nGOTO/1,2,3\n");
    EXPECT_FALSE(readToolPath(cut_short, "P.apt", {}, warnings).has_value());

    std::istringstream odd("UNITS/MM\nODD/1\nGOTO/1,2,3\nFINI\n");
    EXPECT_TRUE(readToolPath(odd, "P.apt", {}, warnings).has_value());
    EXPECT_EQ(warnings.warningCount(), 1U);
}

}  // namespace
}  // namespace cusp::toolpath::test
