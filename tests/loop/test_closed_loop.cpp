// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Machines with hidden errors, once around the loop; the whole campaign of 100 is in bench/loop.
#include "loop_scene.hpp"

#include <gtest/gtest.h>

namespace cusp::loop {
namespace {

constexpr std::uint64_t campaign_seed = 20260917;
constexpr double out_mm = 0.030;
constexpr double in_mm = 0.010;

const test_support::LoopScene& scene() {
    static const test_support::LoopScene made(CUSP_SOURCE_DIR);
    return made;
}

PostedProgram firstProgram() {
    base::Diagnostics warnings;
    return postPath(scene().path, scene().file, scene().machine, "FIRST", warnings).value();
}

TEST(ClosedLoop, TheProgramArrivesOverModbusAndRunsAsIfHandedOver) {
    const auto program = firstProgram();
    const auto direct = runProgram(program, scene().file, scene().machine, scene().setup, "").value();
    const auto sent = runProgram(program, scene().file, scene().machine, scene().setup, "modbus-tcp://127.0.0.1:0");
    ASSERT_TRUE(sent) << base::toText(sent.error());
    EXPECT_TRUE(sent->delivery.compared);
    EXPECT_EQ(sent->delivery.bytes, program.text.size());
    EXPECT_EQ(sent->delivery.link.substr(0, 23), "modbus-tcp://127.0.0.1:");
    ASSERT_EQ(sent->track.size(), direct.track.size());
    for (std::size_t i = 0; i < direct.track.size(); ++i) ASSERT_EQ(sent->track.axes[i], direct.track.axes[i]) << i;
    const auto tcp = runProgram(program, scene().file, scene().machine, scene().setup, "tcp://127.0.0.1:0");
    ASSERT_TRUE(tcp) << base::toText(tcp.error());
    EXPECT_EQ(tcp->track.axes.back(), direct.track.axes.back());
}

TEST(ClosedLoop, WhatCannotRunIsSaid) {
    auto program = firstProgram();
    program.text = "G54 G90\nSUPA G1 F6000 X99999\nM30\n";
    const auto alarm = runProgram(program, scene().file, scene().machine, scene().setup, "");
    ASSERT_FALSE(alarm);
    EXPECT_EQ(alarm.error().front().code, "shop.alarm");
    EXPECT_EQ(alarm.error().front().where.line, 2u);
    EXPECT_FALSE(runProgram(program, scene().file, scene().machine, scene().setup, "nonsense"));
}

TEST(ClosedLoop, ACorrectionBringsThePartInAndDoingNothingDoesNot) {
    const auto program = firstProgram();
    const auto run = runProgram(program, scene().file, scene().machine, scene().setup, "").value();
    const auto job = cutJob(scene().path).value();
    LoopTask task = scene().task();
    constexpr int machines = 1;
    for (int i = 0; i < machines; ++i) {
        base::Random random = base::Random(campaign_seed).split(static_cast<std::uint64_t>(i));
        const MachineErrors drawn = drawErrors(scene().machine, random);
        task.inspection.cmm.seed = random.next();
        const auto first = firstPartOut(task, run.track, job, drawn, out_mm);
        ASSERT_TRUE(first) << base::toText(first.error());
        EXPECT_GT(first->part.maxAbsInDatum(), out_mm);
        const auto second = secondPart(task, first->hidden, first->part, random.next());
        ASSERT_TRUE(second) << base::toText(second.error());
        EXPECT_LT(second->part.maxAbsInDatum(), in_mm) << "machine " << i;
        InspectionTask again = task.inspection;
        again.cmm.seed = random.next();
        const auto real = realMachine(scene().file.machine, first->hidden, scene().setup).value();
        EXPECT_GT(cutAndMeasure(run.track, job, real, again).value().maxAbsInDatum(), out_mm - 0.004)
            << "machine " << i;
    }
}

}  // namespace
}  // namespace cusp::loop
