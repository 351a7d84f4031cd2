// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Two threads make the program that one makes, byte for byte and message for message.
#include "posted_path.hpp"

#include <cusp/kinematics/machine.hpp>
#include <cusp/post/writer/sinumerik_writer.hpp>
#include <cusp/toolpath/cl_reader.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <fmt/format.h>
#include <sstream>

namespace cusp::post::test {
namespace {

/// More points than the branch planner looks at together, holes in a leaning plane, and an axis beyond its limits.
std::string longPath() {
    std::string cl = "UNITS/MM\nCUTTER/6,0,3,0,0,0,50\nLOADTL/4\nSPINDL/900,RPM,CLW\nFEDRAT/900,MMPM\nMULTAX/ON\n";
    for (int i = 0; i < 70000; ++i) {
        const double tilt = 0.3 + 0.2 * std::sin(0.003 * i);
        const double turn = 2.0 * std::sin(0.0007 * i);
        if (i % 9000 == 8999)
            cl += fmt::format("CYCLE/DRILL,DEPTH,5,MMPM,300,CLEAR,2\nGOTO/{0},1,2,0,-0.6,0.8\nGOTO/{0},9,8,0,-0.6,0.8\n"
                              "CYCLE/OFF\nLOADTL/{1}\nRAPID\nGOTO/{0},0,30,0,0,1\n",
                              i % 100, 5 + i / 9000);
        cl += fmt::format("GOTO/{:.4f},{:.4f},{:.4f},{:.7f},{:.7f},{:.7f}\n", 0.01 * i, std::sin(0.01 * i), 5.0,
                          std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt));
    }
    return cl + "GOTO/0,0,5,0,0.1,-0.9949874\nFINI\n";
}

struct Made {
    std::string program;
    std::string messages;
    std::size_t locations = 0;
};

Made make(const std::string& cl, ProgramPlanner::Threads threads) {
    const MachineFile machine = shippedMachine("head-c200-a95");
    const kinematics::Machine model(machine.machine);
    Made out;
    base::Diagnostics report;
    SinumerikWriter writer([&](std::string_view text) { out.program += text; }, machine, {"P", "", {}});
    ProgramPlanner planner(machine, model, {}, "P.apt", writer, report);
    std::istringstream in(cl);
    toolpath::ClReader reader(in, "P.apt");
    out.locations =
        planner.run([&](toolpath::ClRecord& record) { return reader.next(record); }, threads).cutter_locations;
    writer.finish();
    out.messages = base::toText(report) + base::toText(reader.report());
    return out;
}

TEST(Threads, TwoMakeTheProgramOfOne) {
    const std::string cl = longPath();
    const Made one = make(cl, ProgramPlanner::Threads::One);
    EXPECT_GT(one.locations, 70000U);
    EXPECT_NE(one.program.find("CYCLE800"), std::string::npos);
    EXPECT_NE(one.messages.find("kinematics.axis-limit"), std::string::npos) << one.messages;
    for (int trial = 0; trial < 3; ++trial) {
        const Made two = make(cl, ProgramPlanner::Threads::Two);
        EXPECT_EQ(two.locations, one.locations);
        EXPECT_EQ(two.messages, one.messages);
        EXPECT_TRUE(two.program == one.program);
    }
}

TEST(Threads, NothingToReadEnds) {
    const Made none = make("UNITS/MM\n", ProgramPlanner::Threads::Two);
    EXPECT_EQ(none.locations, 0U);
    EXPECT_EQ(none.program, make("UNITS/MM\n", ProgramPlanner::Threads::One).program);
}

}  // namespace
}  // namespace cusp::post::test
