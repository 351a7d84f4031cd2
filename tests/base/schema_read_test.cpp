// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Reading structs by their field tables: values, units, and that every problem of a file is reported at once.
#include "everything.hpp"

#include <cusp/base/units.hpp>

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <string>

namespace {

using namespace cusp::base;
using namespace cusp::base::testing;

constexpr double pi = std::numbers::pi;

TEST(SchemaRead, EveryKindOfField) {
    Diagnostics report;
    const Everything value = readEverything(R"(
lead_deg = 90
feed_mm_per_min = 20000
direction = [1, 0.5, -2]
angles_deg = [180, -90.0]
names = ["a", "b"]
rotary_deg = {A = 180, "B 2" = -90}
spare_mm = 2.5
colour = "red"
second_colour = "green"
[axis]
min_deg = -180
home_deg = 0
[tail]
max_deg = 180
[[step]]
name = "one"
[[step]]
name = "two"
axis = {min_deg = -90}
[axes.A]
[axes."B C"]
min_deg = -180
)",
                                            report);
    EXPECT_EQ(toText(report), "");
    EXPECT_DOUBLE_EQ(value.lead_rad, pi / 2);
    EXPECT_EQ(value.feed_mm_per_s, mmPerSFromMmPerMin(20000.0));
    EXPECT_EQ(value.direction, (std::array<double, 3>{1.0, 0.5, -2.0}));
    ASSERT_EQ(value.angles_rad.size(), 2U);
    EXPECT_DOUBLE_EQ(value.angles_rad[0], pi);
    EXPECT_EQ(value.names, (std::vector<std::string>{"a", "b"}));
    EXPECT_DOUBLE_EQ(value.rotary_rad.at("B 2"), -pi / 2);
    EXPECT_EQ(value.spare_mm, 2.5);
    EXPECT_EQ(value.remark, std::nullopt);
    EXPECT_EQ(value.colour, Everything::Colour::Red);
    EXPECT_EQ(value.second_colour, Everything::Colour::Green);
    EXPECT_EQ(value.axis.home_rad, 0.0);
    EXPECT_DOUBLE_EQ(value.tail->max_rad, pi);
    ASSERT_EQ(value.steps.size(), 2U);  // the default step is replaced, not kept
    EXPECT_DOUBLE_EQ(value.steps[1].axis.min_rad, -pi / 2);
    EXPECT_DOUBLE_EQ(value.axes.at("B C").min_rad, -pi);
    EXPECT_EQ(value.count, 3);  // left out: the default
}

TEST(SchemaRead, EveryProblemAtOnceInFileOrder) {
    Diagnostics report;
    static_cast<void>(readEverything(
        "plain = \"1\"\ncount = 0\ncolor = 1\nlead = 3\n[axes.A]\nmin = 1\nmin_deg = []\n[[step]]\n", report));
    EXPECT_EQ(
        toText(report),
        "T.toml:1:9: error: plain: expected a number, found \"1\" [toml.wrong-type]\n"
        "T.toml:2:9: error: count: must be at least 1, found 0 [toml.range]\n"
        "T.toml:8:1: error: step[0].name: this key is missing: a text [toml.missing-key]\n"
        "T.toml:7:11: error: axes.A.min_deg: expected a number in deg, found a list of 0 values [toml.wrong-type]\n"
        "T.toml:6:1: error: axes.A.min: unknown key [toml.unknown-key]\n"
        "T.toml:3:1: error: color: unknown key; did you mean `colour`? [toml.unknown-key]\n"
        "T.toml:4:1: error: lead: unknown key; write the value in deg: `lead_deg` [toml.unknown-key]\n");
}

TEST(SchemaRead, ChecksRunOnlyOnTablesWithoutErrors) {
    Diagnostics report;
    static_cast<void>(readEverything("[axis]\nmin_deg = 200\n[tail]\nmin_deg = 200\nextra = 1\n", report));
    EXPECT_EQ(toText(report), "T.toml:2:1: error: axis.min_deg: the lower end lies above the upper end [test.order]\n"
                              "T.toml:5:1: error: tail.extra: unknown key [toml.unknown-key]\n");
}

TEST(SchemaRead, SharedTablesLeaveUnknownKeysToTheirReader) {
    struct Left {
        double a_mm = 0.0;
    };
    struct Right {
        double b_mm = 0.0;
    };
    Section<Left> left("Left.");
    left.field("a_mm", &Left::a_mm, "A.").sharesTable();
    Section<Right> right("Right.");
    right.field("b_mm", &Right::b_mm, "B.").sharesTable();
    const auto document = TomlDocument::parse("a_mm = 1\nb_mm = 2\nc_mm = 3\n", "T.toml");
    Diagnostics report;
    EXPECT_EQ(left.read(document->root(), report).a_mm, 1.0);
    EXPECT_EQ(right.read(document->root(), report).b_mm, 2.0);
    EXPECT_TRUE(report.empty());
    reportUnknownKeys(document->root(), {left.describe(), right.describe()}, report);
    EXPECT_EQ(toText(report), "T.toml:3:1: error: c_mm: unknown key [toml.unknown-key]\n");
}

TEST(SchemaRead, MinusZeroIsZero) {
    Diagnostics report;
    EXPECT_FALSE(std::signbit(readEverything("plain = -0.0\n", report).plain));
}

TEST(UnitOfKey, TakesTheLongestSuffix) {
    EXPECT_EQ(unitOfKey("lead_deg").name, "deg");
    EXPECT_DOUBLE_EQ(unitOfKey("lead_deg").toInside(180.0), pi);
    EXPECT_EQ(unitOfKey("feed_mm_per_min").name, "mm_per_min");
    EXPECT_EQ(unitOfKey("feed_mm_per_min").toInside(60.0), 1.0);
    EXPECT_EQ(unitOfKey("jerk_mm_per_s3").toInside(7.0), 7.0);
    EXPECT_DOUBLE_EQ(unitOfKey("speed_deg_per_min").toInside(10800.0), unitOfKey("x_deg_per_s").toInside(180.0));
    EXPECT_EQ(unitOfKey("speed_rpm").toInside(24000.0), 24000.0);
    EXPECT_EQ(unitOfKey("share_percent").toInside(50.0), 0.5);
    EXPECT_EQ(unitOfKey("wait_ms").toInside(1500.0), 1.5);
    EXPECT_EQ(unitOfKey("life_minutes").toInside(2.0), 120.0);
    EXPECT_EQ(unitOfKey("cut_m_per_min").toInside(60.0), 1000.0);
    EXPECT_EQ(unitOfKey("d_inch").toInside(1.0), 25.4);
    for (const char* key : {"count", "deg", "_deg", "comma", "swarm", "modes", ""}) {
        EXPECT_EQ(unitOfKey(key).name, "") << key;
        EXPECT_EQ(unitOfKey(key).toInside(3.0), 3.0) << key;
    }
}

TEST(UnitOfKey, ShowsUnitsAsPeopleWriteThem) {
    const auto shown = [](const char* key) { return displayUnit(unitOfKey(key)); };
    EXPECT_EQ(shown("a_mm_per_min"), "mm/min");
    EXPECT_EQ(shown("a_mm_per_s2"), "mm/s²");
    EXPECT_EQ(shown("a_deg_per_s3"), "deg/s³");
    EXPECT_EQ(shown("a_mm3_per_min"), "mm³/min");
    EXPECT_EQ(shown("a_rpm"), "rev/min");
    EXPECT_EQ(shown("a_percent"), "%");
    EXPECT_EQ(shown("a_n_per_mm2"), "N/mm²");
    EXPECT_EQ(shown("a_um_per_m_k"), "µm/(m K)");
    EXPECT_EQ(shown("a_per_mm"), "1/mm");
    EXPECT_EQ(shown("a"), "");
}

}  // namespace
