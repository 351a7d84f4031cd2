// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The fault campaign: for each framing 2 000 seeded schedules of loss, duplication, reordering, corruption, delay, stall,
// half-open peer, control reset and power loss. Every run ends bit-exact, or in a clean abort that says why and can be
// resumed.
#include "campaign_world.hpp"

#include <cstdio>
#include <gtest/gtest.h>
#include <map>

namespace cusp::comm {
namespace {

using test::Framing;
using test::World;

constexpr std::uint64_t first_seed = 20'000;
constexpr int schedules = 2'000;

class FaultCampaign : public ::testing::TestWithParam<Framing> {};

const char* nameOf(Framing framing) {
    switch (framing) {
        case Framing::Stream: return "stream";
        case Framing::Registers: return "registers";
        case Framing::CanClassic: return "CAN classic";
        case Framing::CanFd: return "CAN FD";
    }
    return "";
}

TEST_P(FaultCampaign, EveryRunEndsBitExactOrInACleanResumableAbort) {
    std::map<std::string, int> ends;
    std::uint64_t repeated = 0;
    std::uint64_t resumed = 0;
    int violations = 0;
    for (int i = 0; i < schedules && violations < 5; ++i) {
        const std::uint64_t seed = first_seed + static_cast<std::uint64_t>(i);
        World world(test::randomSchedule(GetParam(), seed));
        std::string wrong = world.run() ? world.violation() : "it hangs";
        const TransferOutcome outcome = world.sender().outcome();
        repeated += world.sender().statistics().chunks_repeated;
        ++ends[outcome.end == TransferEnd::Delivered ? "delivered" : outcome.code];
        if (wrong.empty() && outcome.end != TransferEnd::Delivered) {
            if (!outcome.resumable) wrong = "not resumable: " + outcome.code + " " + outcome.message;
            const bool delivered = world.runAgain() && world.sender().outcome().end == TransferEnd::Delivered;
            if (wrong.empty() && !delivered) wrong = "the resumed transfer failed: " + world.sender().outcome().message;
            if (wrong.empty()) wrong = world.violation();
            if (wrong.empty()) ++resumed;
        }
        if (wrong.empty()) continue;
        ++violations;
        ADD_FAILURE() << nameOf(GetParam()) << ", seed " << seed << ": " << wrong << " (" << outcome.code << ": "
                      << outcome.message << ")";
    }
    std::printf("%s: %d schedules from seed %llu:", nameOf(GetParam()), schedules,
                static_cast<unsigned long long>(first_seed));
    for (const auto& [end, count] : ends) std::printf(" %s %d,", end.c_str(), count);
    std::printf(" chunks repeated %llu, aborts resumed to bit-exact %llu\n", static_cast<unsigned long long>(repeated),
                static_cast<unsigned long long>(resumed));
    // A campaign in which nothing is ever lost, or everything, would show nothing.
    EXPECT_GT(ends["delivered"], schedules / 2);
    EXPECT_LT(ends["delivered"], schedules);
    EXPECT_GT(repeated, static_cast<std::uint64_t>(schedules));
}

INSTANTIATE_TEST_SUITE_P(Framings, FaultCampaign,
                         ::testing::Values(Framing::Stream, Framing::Registers, Framing::CanClassic, Framing::CanFd));

}  // namespace
}  // namespace cusp::comm
