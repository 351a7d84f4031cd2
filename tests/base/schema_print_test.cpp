// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The printed configuration and the documentation page, word by word.
#include "everything.hpp"

#include <cusp/base/units.hpp>

#include <gtest/gtest.h>
#include <numbers>

namespace {

using namespace cusp::base;
using namespace cusp::base::testing;

TEST(SchemaPrint, DefaultsAsToml) {
    EXPECT_EQ(everythingSection().toToml(Everything{}), R"(plain = 1
lead_deg = 0
feed_mm_per_min = 600
limited = 5
positive_mm = 1
count = 3
on = true
name = "a \"name\""
direction = [0, 0, 1]
size_mm = [1, 2]
angles_deg = []
names = ["x"]
rotary_deg = {}
colour = "green"
axes = {}

[axis]
min_deg = 0
max_deg = 57.29577951308232

[[step]]
name = "first"

[step.axis]
min_deg = 0
max_deg = 57.29577951308232
)");
}

TEST(SchemaPrint, DocumentationAsComments) {
    Axis axis;
    axis.max_rad = radFromDeg(90.0);
    EXPECT_EQ(
        axisSection().toToml(axis, PrintDocs::Yes),
        "# Lower end of travel.\nmin_deg = 0\n# Upper end of travel.\nmax_deg = 90\n# Where it rests.\n# home_deg =\n");
    Everything value;
    value.axes["B C"] = axis;
    const std::string text = everythingSection().toToml(value, PrintDocs::Yes);
    EXPECT_NE(text.find("\n# A rotary axis.\n[axes.\"B C\"]\n# Lower end of travel.\n"), std::string::npos) << text;
    Diagnostics report;
    EXPECT_EQ(readEverything(text, report), value) << toText(report);
}

TEST(SchemaPrint, NumbersStayAsTheyWereWritten) {
    struct Case {
        const char* key;
        double inside;
        const char* text;
    };
    const double pi = std::numbers::pi;
    for (const Case& c :
         {Case{"a_deg", radFromDeg(-120.0), "-120"}, Case{"a_deg", -2.0 * pi / 3.0, "-120"},
          Case{"v_mm_per_min", 20000.0 / 60.0, "20000"}, Case{"v_m_per_min", 20.0 * 1000.0 / 60.0, "20"},
          Case{"x_percent", 0.07, "7"}, Case{"x_um", 0.0123, "12.3"}, Case{"x", 0.1, "0.1"}, Case{"x", -0.0, "0"},
          Case{"x", 1e300, "1e+300"}, Case{"x", 1e-7, "1e-07"}, Case{"x_deg", radFromDeg(0.1), "0.1"},
          Case{"x_deg", radFromDeg(359.99999), "359.99999"}, Case{"d_inch", 12.7, "0.5"},
          Case{"x", 1.0 / 3.0, "0.3333333333333333"}})
        EXPECT_EQ(printValue(c.inside, describeField<double>(c.key, "", {})), c.text) << c.key;
}

TEST(SchemaPrint, TextsAndKeysAreQuoted) {
    EXPECT_EQ(quoteToml("a\"b\\c\n\t\x01\x7F ü"), "\"a\\\"b\\\\c\\n\\t\\u0001\\u007F ü\"");
    EXPECT_EQ(quoteTomlKey("a-b_1"), "a-b_1");
    EXPECT_EQ(quoteTomlKey("a.b"), "\"a.b\"");
    EXPECT_EQ(quoteTomlKey(""), "\"\"");
}

TEST(SchemaPrint, DocumentationPage) {
    Section<Axis> axis("A rotary axis.");
    axis.field("min_deg", &Axis::min_rad, "Lower | end\nof travel.", {.required = true, .min = -360.0, .max = 0.0});
    axis.field("max_deg", &Axis::max_rad, "Upper end.", positive());
    axis.field("home_deg", &Axis::home_rad, "Rest.");
    struct Machine {
        std::string name;
        std::map<std::string, Axis> rotary;
        std::vector<Step> steps;
    };
    Section<Step> step("A step.");
    step.field("name", &Step::name, "Its name.", required());
    step.table("axis", &Step::axis, axis);
    Section<Machine> machine("A machine.");
    machine.field("name", &Machine::name, "Its name.", required());
    machine.named("rotary", &Machine::rotary, axis, required());
    machine.tables("step", &Machine::steps, step);
    const std::string axis_table =
        "| key | type | unit | default | demanded | meaning |\n|---|---|---|---|---|---|\n"
        "| `min_deg` | number | deg |  | required, between -360 and 0 | Lower \\| end of travel. |\n"
        "| `max_deg` | number | deg | `57.29577951308232` | greater than 0 | Upper end. |\n"
        "| `home_deg` | number | deg |  |  | Rest. |\n";
    EXPECT_EQ(
        schemaMarkdown("Machine file", "One machine.", machine.describe()),
        "# Machine file\n\nOne machine.\n\n"
        "| key | type | unit | default | demanded | meaning |\n|---|---|---|---|---|---|\n"
        "| `name` | text |  |  | required | Its name. |\n\n"
        "## `[rotary.NAME]`\n\nA rotary axis.\n\nOne table per name; the names are yours to choose.\n\nRequired.\n\n" +
            axis_table +
            "\n## `[[step]]`\n\nA step.\n\n"
            "| key | type | unit | default | demanded | meaning |\n|---|---|---|---|---|---|\n"
            "| `name` | text |  |  | required | Its name. |\n\n"
            "## `[step.axis]`\n\nA rotary axis.\n\n" +
            axis_table);
}

}  // namespace
