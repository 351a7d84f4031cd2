// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A real 840D program is read from its first block to its last.
#include "nc_recorder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace cusp::post::reader::test {
namespace {

TEST(RealFiles, S840dslCamTest) {
    const std::string path = CUSP_SHARED_DATA "/nc/s840dsl_cam_test.mpf";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no shared data: " << path;
    const Recording out = run(fileText(path), shippedMachine("head-c200-a95"));
    EXPECT_EQ(out.problems, "");
    EXPECT_EQ(out.summary.lines, 996U);
    EXPECT_EQ(out.motions.size(), 978U);
    // Values read off the file by eye: N180, N200, N9890, N9900.
    const auto at = [&](std::size_t block) -> const RecordedMotion& {
        return *std::find_if(out.motions.begin(), out.motions.end(),
                             [&](const RecordedMotion& m) { return m.motion.place.block_number == block; });
    };
    EXPECT_EQ(at(180).state.tool, "DRILL 8.5");
    EXPECT_EQ(at(180).state.spindle_rpm, 1061.0);
    EXPECT_EQ(norm(at(200).motion.end_pose->tip_mm - Vector3{165.434, 122.046, 49.0}), 0.0);
    EXPECT_EQ(at(200).state.feed.value, 250.0);
    EXPECT_EQ(norm(at(9890).motion.end_pose->tip_mm - Vector3{174.94, 98.786, 43.0}), 0.0);
    EXPECT_EQ(at(9900).motion.end_pose->tip_mm.z, 60.0);
    const auto arcs = std::count_if(out.motions.begin(), out.motions.end(),
                                    [](const RecordedMotion& m) { return m.motion.arc.has_value(); });
    EXPECT_GT(arcs, 300);
}

/// Programs for another control are refused with named words, not misread.
TEST(RealFiles, ProgramsForOtherControlsAreRefused) {
    const std::string path = CUSP_SHARED_DATA "/nc/linuxcnc_boat-xyzac.ngc";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "no shared data: " << path;
    const Recording out = run(fileText(path), shippedMachine("trunnion-ac"));
    EXPECT_TRUE(out.report.hasErrors());
    EXPECT_NE(out.problems.find("[nc.syntax]"), std::string::npos);
}

}  // namespace
}  // namespace cusp::post::reader::test
