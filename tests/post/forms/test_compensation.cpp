// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Cutter compensation with an edge of its own: that D holds while it is on, and the tool's first behind it.
#include "posted_path.hpp"

#include <gtest/gtest.h>

#include <string>

namespace cusp::post::test {
namespace {

constexpr const char* contour = "UNITS/MM\nCUTTER/6,0,3,0,0,0,50\nLOADTL/4\nSPINDL/500,RPM,CLW\nFEDRAT/600,MMPM\n"
                                "RAPID\nGOTO/0,0,60\nGOTO/0,0,0\nCUTCOM/LEFT,3\nGOTO/10,0,0\nGOTO/20,0,0\n"
                                "GOTO/20,10,0\nCUTCOM/OFF\nGOTO/0,10,0\nGOTO/0,20,0\nRAPID\nGOTO/0,20,60\nFINI\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from << '\n' << text;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(Compensation, ItsEdgeHoldsWhileItIsOn) {
    const MachineFile machine = shippedMachine("fooke-endura-ca");
    const Posted posted = post(contour, machine, {});
    ASSERT_FALSE(posted.report.hasErrors()) << base::toText(posted.report);
    EXPECT_NE(posted.program.find(" G41 D3 X10 Y0 Z0\n"), std::string::npos) << posted.program;
    EXPECT_NE(posted.program.find(" G40 D1 X0 Y10 Z0\n"), std::string::npos) << posted.program;
    const auto good = verify(posted.program, contour, machine, {});
    EXPECT_TRUE(good.pass) << base::toText(good.findings) << posted.program;
    for (const auto& [from, to] : {std::pair{" G41 D3 ", " G41 D4 "}, {" G41 D3 ", " G41 "}, {" G40 D1 ", " G40 "}}) {
        const auto bad = verify(replaced(posted.program, from, to), contour, machine, {});
        EXPECT_FALSE(bad.pass) << to;
        EXPECT_NE(base::toText(bad.findings).find("[verify.tool-length]"), std::string::npos)
            << base::toText(bad.findings);
    }
}

}  // namespace
}  // namespace cusp::post::test
