// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Broken, huge and hostile files end in a clear error.
#include "nc_recorder.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace cusp::post::reader::test {
namespace {

TEST(Robustness, AHugeLineEndsTheReadAtItsBound) {
    const Recording out = run("G54\nX" + std::string(10'000'000, '1') + "\nM30\n", shippedMachine("three-axis"));
    EXPECT_EQ(out.problems,
              "2: error: this line is longer than 65536 bytes: this is not a program [nc.line-too-long]\n");
}

TEST(Robustness, BinaryBytesEndTheRead) {
    const Recording out = run(std::string("G54\nG0 X\0Y1\nM30\n", 16), shippedMachine("three-axis"));
    EXPECT_EQ(out.problems, "2:5: error: byte 0x00 has no place in a program: this is not a text file [nc.binary]\n");
}

TEST(Robustness, DeepNestingIsRefused) {
    const std::string deep = "R1=" + std::string(200, '(') + "1" + std::string(200, ')') + "\nM30\n";
    const Recording out = run(deep, shippedMachine("three-axis"));
    ASSERT_EQ(out.report.errorCount(), 1U);
    EXPECT_EQ(out.report.front().message, "parentheses are nested more than 64 deep");
}

TEST(Robustness, AnEmptyAndATruncatedFileHaveNoEnd) {
    const MachineFile machine = shippedMachine("three-axis");
    EXPECT_EQ(run("", machine).problems, "error: the program ends without M30, M2 or M17 [nc.no-end]\n");
    EXPECT_EQ(
        run("G54\nG0 X1 Y1 Z1\nG1 X", machine).problems,
        "3:4: error: X has no value [nc.syntax]\n3: error: the program ends without M30, M2 or M17 [nc.no-end]\n");
}

TEST(Robustness, ProblemsAreCountedBeyondTheirCap) {
    std::string program;
    for (int i = 0; i < 1000; ++i) program += "FOO\n";
    const Recording out = run(program + "M30\n", shippedMachine("three-axis"));
    EXPECT_EQ(out.report.errorCount(), 1000U);
    EXPECT_EQ(out.report.size(), base::Diagnostics::default_cap);
}

TEST(Robustness, LineEndsOfBothKindsAndNoneAtTheEnd) {
    const Recording out = run("G54\r\nG0 X1 Y2 Z3\r\nM30", shippedMachine("three-axis"));
    EXPECT_EQ(out.problems, "");
    EXPECT_EQ(out.motions.size(), 1U);
}

/// A stream that makes up a program as it is read: nothing to hold in memory.
class EndlessProgram : public std::streambuf {
public:
    explicit EndlessProgram(std::size_t repeats) : repeats_(repeats) {}

protected:
    int_type underflow() override {
        if (repeats_ == 0) return traits_type::eof();
        block_ = --repeats_ == 0 ? "M30\n" : "G1 X1.23456 Y2.34567 Z3.45678 F1000\n";
        setg(block_.data(), block_.data(), block_.data() + block_.size());
        return traits_type::to_int_type(*gptr());
    }

private:
    std::size_t repeats_;
    std::string block_;
};

class Counter : public ProgramSink {
public:
    void motion(const ExecutedMotion&) override { ++motions; }
    void event(const BlockPlace&, const ExecutedEvent&) override {}
    std::size_t motions = 0;
};

TEST(Robustness, ALongProgramStreams) {
    EndlessProgram buffer(200'001);
    std::istream in(&buffer);
    Counter counter;
    base::Diagnostics report;
    const ReadSummary summary = readProgram(in, "", shippedMachine("three-axis"), {}, counter, report);
    EXPECT_FALSE(report.hasErrors());
    EXPECT_EQ(counter.motions, 200'000U);
    EXPECT_EQ(summary.lines, 200'001U);
}

}  // namespace
}  // namespace cusp::post::reader::test
