// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The reader of stylus profiles, and its reject corpus.
#include <cusp/base/atomic_file.hpp>
#include <cusp/inspect/texture_profile.hpp>

#include <filesystem>
#include <gtest/gtest.h>
#include <sstream>

namespace cusp::inspect {
namespace {

base::Result<StylusProfile> read(const std::string& text, base::Diagnostics& warnings) {
    std::istringstream in(text);
    return readStylusProfile(in, "", warnings);
}

std::string repeated(const std::string& line, int times) {
    std::string out;
    for (int i = 0; i < times; ++i) out += line;
    return out;
}

TEST(StylusReader, ReadsHeightsWithTheirUnits) {
    base::Diagnostics warnings;
    const auto profile = read("cusp_stylus_profile,1\n# a remark\nspacing_um,0.5\ntip_radius_um,2\nheight_nm\n" +
                                  repeated("113\r\n-20\n", 60),
                              warnings);
    ASSERT_TRUE(profile.has_value()) << base::toText(profile.error());
    EXPECT_TRUE(warnings.empty());
    EXPECT_DOUBLE_EQ(profile->spacing_mm, 0.0005);
    EXPECT_DOUBLE_EQ(profile->tip_radius_mm.value_or(0.0), 0.002);
    ASSERT_EQ(profile->height_mm.size(), 120U);
    EXPECT_DOUBLE_EQ(profile->height_mm[0], 113e-6);
    EXPECT_DOUBLE_EQ(profile->height_mm[1], -20e-6);
    EXPECT_DOUBLE_EQ(profile->lengthMm(), 119 * 0.0005);
}

TEST(StylusReader, TakesTheSpacingFromAColumn) {
    std::string text = "\xEF\xBB\xBF"
                       "cusp_stylus_profile;1\nx_mm;height_um\n";
    for (int i = 0; i < 200; ++i) text += "0," + std::to_string(1000 + 4 * i) + ";" + std::to_string(i % 7) + ",5\n";
    base::Diagnostics warnings;
    const auto profile = read(text, warnings);
    ASSERT_TRUE(profile.has_value()) << base::toText(profile.error());
    EXPECT_NEAR(profile->spacing_mm, 0.0004, 1e-15);
    EXPECT_DOUBLE_EQ(profile->height_mm[3], 0.0035);
}

TEST(StylusReader, WarnsOfASpacingBeyondTheStandard) {
    base::Diagnostics warnings;
    ASSERT_TRUE(read("cusp_stylus_profile,1\nspacing_um,10\nheight_um\n" + repeated("1\n", 100), warnings).has_value());
    EXPECT_EQ(base::toText(warnings),
              "warning: points lie 0.01 mm apart, coarser than the 0.005 mm of ISO 3274: the finest "
              "texture is not seen [texture.spacing]\n");
}

TEST(StylusReader, RefusesWhatCannotSeeTexture) {
    base::Diagnostics warnings;
    const auto coarse = read("cusp_stylus_profile,1\nspacing_mm,0.5\nheight_um\n" + repeated("1\n", 205), warnings);
    ASSERT_FALSE(coarse.has_value());
    EXPECT_EQ(
        base::toText(coarse.error()),
        "error: points lie 0.5 mm apart: texture needs them 0.005 mm apart (ISO 3274), and beyond 0.05 mm nothing of "
        "it is seen; such points give form and scallops only [texture.too-coarse]\n");
    const auto ball =
        read("cusp_stylus_profile,1\nspacing_um,5\ntip_radius_mm,1\nheight_um\n" + repeated("1\n", 205), warnings);
    ASSERT_FALSE(ball.has_value());
    EXPECT_EQ(base::toText(ball.error()),
              "error: a tip of radius 1 mm bridges the texture instead of following it; ISO 3274 "
              "has 0.002, 0.005 and 0.01 mm [texture.tip]\n");
}

/// The texts behind `# expect: `, one problem each.
TEST(StylusReader, RejectsEveryBrokenFileWithItsExactProblems) {
    const std::string mark = "# expect: ";
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(CUSP_SOURCE_DIR "/tests/inspect/reject_texture")) {
        const std::string text = base::readWholeFile(entry.path(), 1 << 20).value_or("");
        std::istringstream lines(text);
        std::string expected;
        for (std::string line; std::getline(lines, line) && line.starts_with(mark);)
            expected += line.substr(mark.size()) + "\n";
        base::Diagnostics warnings;
        const auto profile = read(text, warnings);
        EXPECT_EQ(profile ? "accepted" : base::toText(profile.error()), expected) << entry.path();
        ++files;
    }
    EXPECT_GE(files, 12U);
}

}  // namespace
}  // namespace cusp::inspect
