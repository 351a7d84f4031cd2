// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Programs with one thing wrong, each wrong thing at many places: all must be caught, the unharmed program must not.
#include "program_pair.hpp"

#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>

namespace cusp::post::verify::test {
namespace {

constexpr std::uint32_t seed = 20240607;
constexpr int points = 120;

using Lines = std::vector<std::string>;
/// Harms the program at line `at`; false when there is nothing there to harm.
using Mutation = std::function<bool(Lines& program, std::size_t at)>;

bool replace(std::string& line, const std::string& from, const std::string& to) {
    const std::size_t at = line.find(from);
    if (at == std::string::npos) return false;
    line.replace(at, from.size(), to);
    return true;
}

bool isMotion(const std::string& line) {
    return line.find(" X") != std::string::npos && line.find(" Z") != std::string::npos;
}

struct Number {
    std::size_t begin = 0;
    std::size_t size = 0;
    double value = 0.0;
};

std::optional<Number> numberOf(const std::string& line, char address) {
    const std::size_t at = line.find(std::string(" ") + address);
    if (!isMotion(line) || at == std::string::npos) return std::nullopt;
    const std::size_t end = line.find(' ', at + 2);
    return Number{at + 2, (end == std::string::npos ? line.size() : end) - at - 2,
                  std::strtod(line.c_str() + at + 2, nullptr)};
}

Mutation changed(char address, std::function<double(double)> change) {
    return [address, change](Lines& program, std::size_t at) {
        const auto number = numberOf(program[at], address);
        if (!number || std::abs(change(number->value) - number->value) < 1e-3) return false;
        program[at].replace(number->begin, number->size, fmt::format("{:.5f}", change(number->value)));
        return true;
    };
}

Mutation replaced(const std::string& from, const std::string& to) {
    return [from, to](Lines& program, std::size_t at) { return replace(program[at], from, to); };
}

bool swapXAndY(Lines& program, std::size_t at) {
    const auto x = numberOf(program[at], 'X');
    const auto y = numberOf(program[at], 'Y');
    if (!x || !y) return false;
    program[at].replace(y->begin, y->size, fmt::format("{:.5f}", x->value));
    program[at].replace(x->begin, x->size, fmt::format("{:.5f}", y->value));
    return true;
}

bool dropMotion(Lines& program, std::size_t at) {
    if (!isMotion(program[at])) return false;
    program.erase(program.begin() + static_cast<std::ptrdiff_t>(at));
    return true;
}

bool doubleMotion(Lines& program, std::size_t at) {
    if (!isMotion(program[at]) || program[at].find("G0") != std::string::npos) return false;
    program.insert(program.begin() + static_cast<std::ptrdiff_t>(at), program[at]);
    return true;
}

/// The same tool axis by the other branch: true at the end of the block, not on the way.
bool otherBranch(Lines& program, std::size_t at) {
    const auto a = numberOf(program[at], 'A');
    const auto c = numberOf(program[at], 'C');
    if (!a || !c || program[at].find("G0") != std::string::npos || program[at].find("F500.") != std::string::npos)
        return false;
    program[at].replace(c->begin, c->size, fmt::format("{:.5f}", c->value + (c->value > 0.0 ? -180.0 : 180.0)));
    program[at].replace(a->begin, a->size, fmt::format("{:.5f}", -a->value));
    return true;
}

/// A whole turn more: on an endless axis no limit shows it.
bool anotherTurn(Lines& program, std::size_t at) {
    if (program[at].find("G0") != std::string::npos) return false;
    return changed('C', [](double v) { return v + 360.0; })(program, at);
}

struct Named {
    const char* name;
    Mutation mutation;
    std::size_t at_least;  ///< places the program must offer
};

void PrintTo(const Named& named, std::ostream* out) { *out << named.name; }

class Caught : public testing::TestWithParam<Named> {};

TEST_P(Caught, AtEveryPlace) {
    RecordProperty("seed", static_cast<int>(seed));
    const ProgramPair pair = twoOperations(seed, points);
    const MachineFile machine = shippedMachine("head-c200-a95");
    std::size_t places = 0;
    for (std::size_t at = 0; at < pair.program.size(); ++at) {
        Lines program = pair.program;
        if (!GetParam().mutation(program, at)) continue;
        ++places;
        const VerifyReport report = verify(joined(program), pair.path, machine);
        EXPECT_FALSE(report.pass) << GetParam().name << " at line " << at + 1 << ": " << pair.program[at];
    }
    EXPECT_GE(places, GetParam().at_least);
}

INSTANTIATE_TEST_SUITE_P(
    Mutations, Caught,
    testing::Values(Named{"sign of X", changed('X', [](double v) { return -v; }), 240},
                    Named{"sign of Y", changed('Y', [](double v) { return -v; }), 240},
                    Named{"sign of Z", changed('Z', [](double v) { return -v; }), 240},
                    Named{"sign of A", changed('A', [](double v) { return -v; }), 240},
                    Named{"sign of C", changed('C', [](double v) { return -v; }), 240},
                    Named{"2 µm in X", changed('X', [](double v) { return v + 0.002; }), 240},
                    Named{"2 µm in Z", changed('Z', [](double v) { return v - 0.002; }), 240},
                    Named{"0.01° in A", changed('A', [](double v) { return v + 0.01; }), 240},
                    Named{"dropped block", dropMotion, 240}, Named{"doubled block", doubleMotion, 230},
                    Named{"X and Y swapped", swapXAndY, 240}, Named{"other branch", otherBranch, 230},
                    Named{"another turn of C", anotherTurn, 230}, Named{"G1 to G0", replaced("G1 ", "G0 "), 2},
                    Named{"F500 ×10", replaced("F500.", "F5000."), 2},
                    Named{"F1500 ×10", replaced("F1500.", "F15000."), 2}, Named{"no M3", replaced(" M3", ""), 2},
                    Named{"M4 for M3", replaced(" M3 ", " M4 "), 2}, Named{"no coolant", replaced(" M8", ""), 2},
                    Named{"wrong speed", replaced(" S8", " S9"), 2}, Named{"wrong tool", replaced(" T5", " T6"), 1},
                    Named{"no tool change", replaced(" M6", ""), 2}, Named{"lost TRAORI", replaced(" TRAORI", ""), 2},
                    Named{"TRAFOOF for TRAORI", replaced(" TRAORI", " TRAFOOF"), 2},
                    Named{"misspelled", replaced("TRAFOOF", "TRAOOF"), 3},
                    Named{"D0 for D1", replaced(" D1", " D0"), 2}, Named{"G55 for G54", replaced(" G54", " G55"), 2},
                    Named{"inches", replaced("G710", "G700"), 2}, Named{"incremental", replaced("G90", "G91"), 2},
                    Named{"no end", replaced(" M30", ""), 1}));

TEST(Mutations, TheUnharmedProgramPasses) {
    for (std::uint32_t i = 0; i < 20; ++i) {
        const ProgramPair pair = twoOperations(seed + i, points);
        const VerifyReport report = verify(joined(pair.program), pair.path, shippedMachine("head-c200-a95"));
        EXPECT_EQ(errorTexts(report), "") << "seed " << seed + i;
        EXPECT_TRUE(report.pass);
        EXPECT_EQ(report.matched, report.points);
        EXPECT_EQ(report.points, 2U * (points + 3));
        EXPECT_LT(report.max_tip_error_mm.value, 1e-5);
        EXPECT_LT(report.max_axis_error_rad.value, 2e-7) << "half a unit of the fifth decimal of two axes";
        EXPECT_GT(report.max_axis_between_rad.value, 0.0);
        EXPECT_EQ(report.findings.size(), 0U) << base::toText(report.findings);
    }
}

}  // namespace
}  // namespace cusp::post::verify::test
