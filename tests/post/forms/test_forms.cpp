// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Every form on every shipped machine: what the writer makes of generated five-axis paths, the witness proves.
#include "posted_path.hpp"

#include <cusp/base/units.hpp>

#include <gtest/gtest.h>

#include <algorithm>

namespace cusp::post::test {
namespace {

constexpr std::uint64_t first_seed = 20261124;
constexpr double tool_length_mm = 137.5;
constexpr std::array<double, 3> wcs_origin_mm{12.5, -31.0, 44.0};

PostOptions optionsFor(ProgramForm form) {
    PostOptions options;
    options.form = form;
    options.tool_length_mm = tool_length_mm;
    options.wcs_origin_mm = wcs_origin_mm;
    return options;
}

verify::VerifyOptions witnessOptions(double between_tip_mm) {
    verify::VerifyOptions options;
    options.tool_length_mm = tool_length_mm;
    options.wcs_origin_mm = wcs_origin_mm;
    options.between_tip_tolerance_mm = between_tip_mm;
    options.between_axis_tolerance_rad = base::radFromDeg(0.05);
    return options;
}

class Forms : public ::testing::TestWithParam<std::string> {
protected:
    void holds(const std::string& cl, const MachineFile& machine, const PostOptions& options) {
        const Posted posted = post(cl, machine, options);
        ASSERT_FALSE(posted.report.hasErrors()) << base::toText(posted.report);
        const auto report = verify(posted.program, cl, machine, witnessOptions(options.chord_tolerance_mm));
        EXPECT_TRUE(report.pass) << base::toText(report.findings) << posted.program.substr(0, 1500);
        EXPECT_EQ(report.matched, report.points);
        EXPECT_LE(report.max_tip_error_mm.value, 0.001);
        EXPECT_LE(report.max_axis_error_rad.value, base::radFromDeg(0.001));
        EXPECT_LE(report.max_tip_between_mm.value, options.chord_tolerance_mm);
        // What the post says it proved holds for what the witness sampled.
        if (options.form == ProgramForm::Machine) {
            // Beside it stand the ends of straight blocks, as they are printed.
            EXPECT_LE(report.max_tip_between_mm.value,
                      std::max(posted.summary.largest_chord_error_mm, report.max_tip_error_mm.value) + 1e-9);
        }
    }
};

TEST_P(Forms, GeneratedPathsAreFollowed) {
    const MachineFile machine = shippedMachine(GetParam());
    const double most_tilt_deg = machine.machine.rotary.empty() ? 0.0 : 60.0;
    for (std::uint64_t seed = first_seed; seed < first_seed + 6; ++seed) {
        SCOPED_TRACE(GetParam() + ", seed " + std::to_string(seed));
        const std::string cl = wanderingPath(seed, 120, machine.machine.rotary.empty() ? 0.0 : 4.0, most_tilt_deg);
        for (const auto& [word, form] : programFormWords()) {
            SCOPED_TRACE(word);
            holds(cl, machine, optionsFor(form));
        }
    }
}

TEST_P(Forms, TheEffectiveOrientationCommandIsChosen) {
    MachineFile machine = shippedMachine(GetParam());
    if (machine.machine.rotary.empty()) GTEST_SKIP() << "no rotary axes, no orientation command";
    const std::string cl = wanderingPath(first_seed + 50, 60, 4.0, 60.0);
    for (const bool by_group_51 : {false, true}) {
        machine.control.md21104_ori_ipo_with_g_code = by_group_51;
        for (const ProgramForm form : {ProgramForm::TraoriRotary, ProgramForm::TraoriVectors})
            holds(cl, machine, optionsFor(form));
    }
}

TEST_P(Forms, AFinerToleranceTakesMoreBlocks) {
    const MachineFile machine = shippedMachine(GetParam());
    if (machine.machine.rotary.empty()) GTEST_SKIP() << "no rotary axes, nothing to linearise";
    const std::string cl = wanderingPath(first_seed + 70, 60, 4.0, 60.0);
    std::size_t blocks_before = 0;
    for (const double tolerance_mm : {0.1, 0.01, 0.001}) {
        PostOptions options = optionsFor(ProgramForm::Machine);
        options.chord_tolerance_mm = tolerance_mm;
        holds(cl, machine, options);
        const std::size_t blocks = post(cl, machine, options).blocks;
        EXPECT_GT(blocks, blocks_before);
        blocks_before = blocks;
    }
}

TEST_P(Forms, CoarseDecimalsAreRaisedAndTold) {
    MachineFile machine = shippedMachine(GetParam());
    machine.control.format.linear_decimals = 2;
    machine.control.format.rotary_decimals = 2;
    machine.control.format.vector_decimals = 3;
    const std::string cl = wanderingPath(first_seed + 90, 60, machine.machine.rotary.empty() ? 0.0 : 4.0,
                                         machine.machine.rotary.empty() ? 0.0 : 60.0);
    for (const auto& [word, form] : programFormWords()) {
        SCOPED_TRACE(word);
        EXPECT_GT(post(cl, machine, optionsFor(form)).report.warningCount(), 0U);
        holds(cl, machine, optionsFor(form));
    }
}

INSTANTIATE_TEST_SUITE_P(ShippedMachines, Forms, ::testing::ValuesIn(shippedMachineNames()), [](const auto& machine) {
    std::string name = machine.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

TEST(MachineForm, WithoutTheToolsLengthOrTheOriginItIsRefused) {
    const std::string cl = wanderingPath(first_seed, 5, 4.0, 60.0);
    PostOptions options;
    options.form = ProgramForm::Machine;
    EXPECT_EQ(base::toText(post(cl, shippedMachine("head-c200-a95"), options).report),
              "P.cls:8: error: without TRAORI the program holds the length of the tool: give that of \"BALL_6\" with "
              "--setup or --tool-length-mm [post.tool-length]\n");
    EXPECT_EQ(
        base::toText(post(cl, shippedMachine("trunnion-ac"), options).report),
        "P.cls:8: error: without TRAORI, a program for a machine with a rotary table needs to know where G54 lies in "
        "the machine: --setup or --wcs-origin-mm [post.wcs-origin]\n");
    options.tool_lengths_mm["BALL_6"] = 100.0;
    EXPECT_FALSE(post(cl, shippedMachine("head-c200-a95"), options).report.hasErrors());
}

}  // namespace
}  // namespace cusp::post::test
