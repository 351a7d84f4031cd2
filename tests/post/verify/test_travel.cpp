// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Travel of the linear axes, with a setup that says where the workpiece stands and how long the tool is.
#include "campaign/closed_forms.hpp"
#include "program_pair.hpp"

#include <cusp/base/random.hpp>
#include <cusp/machine/setup_definition.hpp>
#include <cusp/post/reader/forward_chain.hpp>

#include <gtest/gtest.h>

#include <sstream>

namespace cusp::post::verify::test {
namespace {

constexpr std::uint64_t seed = 11;

machine::SetupDefinition plate() {
    auto setup =
        machine::readSetup("schema = 1\nname = \"plate\"\n[work_offset.G54]\norigin_mm = [1000.0, 0.0, -900.0]\n"
                           "[[tool]]\nnumber = 5\nlength_mm = 130.0\n[[tool]]\nname = \"LONG\"\nlength_mm = 430.0\n",
                           "plate.toml");
    EXPECT_TRUE(setup) << base::toText(setup.error());
    return *std::move(setup);
}

/// On the C/A head: X 0 … , gauge point at −220 mm, so that upright with tool 5 Z = −900 + 220 + 130 + z.
VerifyReport travel(const std::string& blocks, MachineFile machine = shippedMachine("head-c200-a95")) {
    machine.machine.linear.at("X").max_mm = 1500.0;
    machine.machine.linear.at("Z").min_mm = -1000.0;
    machine.machine.linear.at("Z").max_mm = 0.0;
    const machine::SetupDefinition setup = plate();
    VerifyOptions options;
    options.setup = &setup;
    std::istringstream in("T5 M6\nG54 D1 S1000 M3 F600\nG0 A0 C0\nTRAORI\nORIAXES\n" + blocks + "M30\n");
    auto report = verifyProgram(in, "P.MPF", machine, nullptr, options);
    EXPECT_TRUE(report) << base::toText(report.error());
    return *std::move(report);
}

TEST(Travel, OfTheTipUpright) {
    EXPECT_EQ(errorTexts(travel("G0 X500 Y0 Z550\n")), "");
    EXPECT_TRUE(travel("G0 X500 Y0 Z550\n").linear_travel_checked);
    EXPECT_EQ(errorTexts(travel("G0 X500.001 Y0 Z550\n")),
              "line 6: axis X is at 1500.0010 mm, beyond its limit 1500 mm\n");
    const VerifyReport high = travel("G0 X500 Y0 Z551\n");
    EXPECT_EQ(errorTexts(high), "line 6: axis Z is at 1.0000 mm, beyond its limit 0 mm\n");
    EXPECT_EQ(high.limit_violations, 1U);
    EXPECT_EQ(high.travel_violations, 1U);
}

TEST(Travel, OfALeaningHeadAndOnItsWay) {
    // A lever of 350 mm: at A90 C90 the head stands 350 mm beside the tip, in X.
    EXPECT_EQ(errorTexts(travel("G0 X150 Y0 Z0 A90 C90\n")), "");
    EXPECT_EQ(errorTexts(travel("G0 X151 Y0 Z0 A90 C90\n")),
              "line 6: axis X is at 1501.0000 mm, beyond its limit 1500 mm\n");
    // C from 30° to 150° passes 90°, where X is largest; both ends are within.
    const std::string ends = "G0 X200 Y0 Z0 A90 C30\nG1 C150\n";
    const std::string texts = errorTexts(travel(ends));
    EXPECT_EQ(texts.substr(0, 24), "line 7: axis X is at 150") << texts;
    EXPECT_EQ(travel(ends).limit_violations, 1U);
}

TEST(Travel, KnowsTheToolAndTheOffset) {
    // 300 mm longer.
    EXPECT_EQ(errorTexts(travel("TRAFOOF\nT=\"LONG\" M6\nTRAORI\nG0 X500 Y0 Z251\n")),
              "line 9: axis Z is at 1.0000 mm, beyond its limit 0 mm\n");
    const VerifyReport other = travel("G55\nG0 X5000 Y0 Z551\n");
    EXPECT_EQ(errorTexts(other), "") << "the setup does not know G55";
    EXPECT_EQ(other.travel_unchecked, 1U);
    EXPECT_FALSE(other.linear_travel_checked);
}

TEST(Travel, OfMachinePositions) {
    EXPECT_EQ(errorTexts(travel("TRAFOOF\nSUPA G0 Z0 D0\nSUPA X1600\n")),
              "line 8: axis X is at 1600.0000 mm, beyond its limit 1500 mm\n");
    EXPECT_EQ(errorTexts(travel("TRAFOOF\nSUPA G0 Z0.1 D0\n")),
              "line 7: axis Z is at 0.1000 mm, beyond its limit 0 mm\n");
}

/// The positions against each machine's closed form.
TEST(Travel, LinearPositionsInClosedForm) {
    RecordProperty("seed", static_cast<int>(seed));
    base::Random random(seed);
    const auto draw = [&](double size) {
        return Vector3d(random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size));
    };
    for (const ClosedForm& form : fiveAxisMachines()) {
        const MachineFile machine = shippedMachine(form.machine);
        const reader::ForwardChain chain(machine.machine);
        for (int i = 0; i < 200; ++i) {
            const Vector3d tip = draw(200);
            const Vector3d origin = draw(500);
            const double length_mm = random.uniform(50, 300);
            const AxisValues at{{}, random.uniform(-170, 170), random.uniform(-90, 90)};
            const Vector3d programmed = form.programmed(tip, at, origin, length_mm);
            const auto found = chain.linearPositions({tip.x(), tip.y(), tip.z()},
                                                     {base::radFromDeg(at.first_deg), base::radFromDeg(at.second_deg)},
                                                     {length_mm, reader::Vector3{origin.x(), origin.y(), origin.z()}});
            ASSERT_TRUE(found);
            // Programmed positions are the tip upright; the axes stand at it, less the tip they hold at zero.
            const double tip_at_zero = machine.machine.spindle.gauge_point_mm[2] - length_mm;
            EXPECT_NEAR((*found)[0], programmed.x() + origin.x(), 1e-9) << form.machine;
            EXPECT_NEAR((*found)[1], programmed.y() + origin.y(), 1e-9) << form.machine;
            EXPECT_NEAR((*found)[2], programmed.z() + origin.z() - tip_at_zero, 1e-9) << form.machine;
        }
    }
}

}  // namespace
}  // namespace cusp::post::verify::test
