// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Holes at any height behind cuts at any height: reached from above, on every machine and in every form.
#include "posted_path.hpp"

#include <cusp/base/units.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <fmt/format.h>
#include <random>
#include <sstream>

namespace cusp::post::test {
namespace {

constexpr std::uint32_t first_seed = 20261125;

struct HolePattern {
    std::string cl;
    int lifts = 0;
};

/// Cuts and patterns in turns; a pattern has its own cycle, its holes wander up and down. With `most_tilt_deg` the cuts lean.
HolePattern holePattern(std::uint32_t seed, double most_tilt_deg) {
    std::mt19937 random(seed);
    const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    HolePattern out;
    out.cl = "UNITS/MM\nCUTTER/6,0,3,0,0,0,50\nLOADTL/4\nSPINDL/500,RPM,CLW\nMULTAX/ON\nRAPID\nGOTO/0,0,60,0,0,1\n";
    double height = 60.0;
    for (int pattern = 0; pattern < 6; ++pattern) {
        const double cut_z = between(-5.0, 30.0);
        const double tilt = base::radFromDeg(between(0.0, most_tilt_deg));
        const double azimuth = base::radFromDeg(between(-150.0, 150.0));
        out.cl += fmt::format("FEDRAT/600,MMPM\nGOTO/{:.4f},{:.4f},{:.4f},{:.9f},{:.9f},{:.9f}\n", between(0.0, 40.0),
                              between(0.0, 40.0), cut_z, std::sin(tilt) * std::cos(azimuth),
                              std::sin(tilt) * std::sin(azimuth), std::cos(tilt));
        height = cut_z;
        const char* kinds[] = {"CYCLE/DRILL,DEPTH,12,MMPM,300,CLEAR,2", "CYCLE/DEEP,DEPTH,12,STEP,4,MMPM,300,CLEAR,2",
                               "CYCLE/TAP,DEPTH,12,MMPM,300,CLEAR,2"};
        // The second thread is a left-hand one.
        if (pattern % 3 == 2) out.cl += pattern > 3 ? "SPINDL/500,RPM,CCLW\n" : "SPINDL/500,RPM,CLW\n";
        out.cl += std::string(kinds[pattern % 3]) + (pattern % 2 == 0 ? "\n" : ",RETURN,9\n");
        const double above = pattern % 2 == 0 ? 2.0 : 9.0;
        for (int hole = 0; hole < 4; ++hole) {
            const double z = between(-5.0, 30.0);
            out.cl += fmt::format("GOTO/{:.4f},{:.4f},{:.4f},0,0,1\n", between(0.0, 40.0), between(0.0, 40.0), z);
            out.lifts += height + 0.01 < z + above ? 1 : 0;
            height = z + above;
        }
        out.cl += "CYCLE/OFF\n";
    }
    out.cl += "RAPID\nGOTO/0,0,80,0,0,1\nFINI\n";
    return out;
}

PostOptions optionsFor(ProgramForm form) {
    PostOptions options;
    options.form = form;
    options.tool_length_mm = 120.0;
    options.wcs_origin_mm = {10.0, -20.0, 30.0};
    return options;
}
verify::VerifyOptions witnessOptions() {
    verify::VerifyOptions options;
    options.tool_length_mm = 120.0;
    options.wcs_origin_mm = {10.0, -20.0, 30.0};
    options.between_tip_tolerance_mm = 0.005;
    return options;
}

class Holes : public ::testing::TestWithParam<std::string> {};

TEST_P(Holes, AreReachedFromAbove) {
    const MachineFile machine = shippedMachine(GetParam());
    const double most_tilt_deg = machine.machine.rotary.empty() ? 0.0 : 40.0;
    for (std::uint32_t seed = first_seed; seed < first_seed + 8; ++seed)
        for (const auto& [word, form] : programFormWords()) {
            SCOPED_TRACE(fmt::format("{}, seed {}, {}", GetParam(), seed, word));
            const HolePattern pattern = holePattern(seed, most_tilt_deg);
            const Posted posted = post(pattern.cl, machine, optionsFor(form));
            ASSERT_FALSE(posted.report.hasErrors()) << base::toText(posted.report) << pattern.cl;
            const auto report = verify(posted.program, pattern.cl, machine, witnessOptions());
            EXPECT_TRUE(report.pass) << base::toText(report.findings) << pattern.cl << posted.program;
            EXPECT_EQ(report.matched, report.points);
            EXPECT_GT(pattern.lifts, 3);
        }
}

/// Patterns across leaning axes in one operation, with cuts between: each in a plane of its own, by way of home.
std::string leaningHoles(std::uint32_t seed) {
    std::mt19937 random(seed);
    const auto between = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    std::string cl = "UNITS/MM\nCUTTER/6,0,3,0,0,0,50\nLOADTL/4\nSPINDL/500,RPM,CLW\nMULTAX/ON\nFEDRAT/600,MMPM\n";
    for (int pattern = 0; pattern < 4; ++pattern) {
        cl += fmt::format("GOTO/{:.4f},{:.4f},20,0,0,1\nGOTO/{:.4f},{:.4f},20,0,0,1\n", between(0.0, 40.0),
                          between(0.0, 40.0), between(0.0, 40.0), between(0.0, 40.0));
        const double tilt = base::radFromDeg(between(10.0, 60.0));
        const double azimuth = base::radFromDeg(between(-150.0, 150.0));
        const std::string axis = fmt::format("{:.9f},{:.9f},{:.9f}", std::sin(tilt) * std::cos(azimuth),
                                             std::sin(tilt) * std::sin(azimuth), std::cos(tilt));
        if (pattern % 2 == 1)
            cl += fmt::format("RAPID\nGOTO/{:.4f},{:.4f},60,{}\n", between(0.0, 40.0), between(0.0, 40.0), axis);
        cl += "CYCLE/DRILL,DEPTH,12,MMPM,300,CLEAR,2\n";
        for (int hole = 0; hole < 3; ++hole)
            cl += fmt::format("GOTO/{:.4f},{:.4f},{:.4f},{}\n", between(0.0, 40.0), between(0.0, 40.0),
                              between(-5.0, 30.0), axis);
        cl += "CYCLE/OFF\n";
    }
    return cl + "RAPID\nGOTO/0,0,80,0,0,1\nFINI\n";
}

TEST_P(Holes, LeanWithinOneOperation) {
    const MachineFile machine = shippedMachine(GetParam());
    if (machine.machine.rotary.empty()) GTEST_SKIP() << "no rotary axes, no leaning holes";
    for (std::uint32_t seed = first_seed; seed < first_seed + 6; ++seed)
        for (const auto& [word, form] : programFormWords()) {
            SCOPED_TRACE(fmt::format("{}, seed {}, {}", GetParam(), seed, word));
            const std::string cl = leaningHoles(seed);
            const Posted posted = post(cl, machine, optionsFor(form));
            ASSERT_FALSE(posted.report.hasErrors()) << base::toText(posted.report) << cl;
            const auto report = verify(posted.program, cl, machine, witnessOptions());
            EXPECT_TRUE(report.pass) << base::toText(report.findings) << cl << posted.program;
            EXPECT_EQ(report.matched, report.points);
        }
}

/// Every lift taken out, one at a time.
TEST_P(Holes, AMissingLiftIsFound) {
    const MachineFile machine = shippedMachine(GetParam());
    const HolePattern pattern = holePattern(first_seed, 0.0);
    const Posted posted = post(pattern.cl, machine, optionsFor(ProgramForm::TraoriRotary));
    std::vector<std::string> lines;
    std::istringstream in(posted.program);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    int lifts = 0;
    for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
        // A rapid in Z on the way to a hole: behind it the cycle is called, its feed perhaps before.
        const bool last_before_cycle = lines[i + 1].find("MCALL CYCLE") != std::string::npos ||
                                       (i + 2 < lines.size() && lines[i + 2].find("MCALL CYCLE") != std::string::npos);
        if (lines[i].find(" G0 ") == std::string::npos || lines[i].find(" Z") == std::string::npos ||
            !last_before_cycle)
            continue;
        ++lifts;
        std::string without;
        for (std::size_t k = 0; k < lines.size(); ++k)
            if (k != i) without += lines[k] + '\n';
        const auto report = verify(without, pattern.cl, machine, witnessOptions());
        EXPECT_FALSE(report.pass) << lines[i];
        const std::string findings = base::toText(report.findings);
        EXPECT_NE(findings.find("[verify.low-approach]"), std::string::npos) << findings << lines[i];
    }
    EXPECT_EQ(lifts, pattern.lifts) << pattern.cl << posted.program;
}

INSTANTIATE_TEST_SUITE_P(ShippedMachines, Holes, ::testing::ValuesIn(shippedMachineNames()), [](const auto& machine) {
    std::string name = machine.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

}  // namespace
}  // namespace cusp::post::test
