// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A struct with a field of every kind a schema knows, for the tests of reading, printing and documenting.
#pragma once

#include <cusp/base/toml_schema.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cusp::base::testing {

struct Axis {
    double min_rad = 0.0;
    double max_rad = 1.0;
    std::optional<double> home_rad;

    bool operator==(const Axis&) const = default;
};

struct Step {
    std::string name;
    Axis axis;

    bool operator==(const Step&) const = default;
};

struct Everything {
    enum class Colour { Red, Green };

    double plain = 1.0;
    double lead_rad = 0.0;
    double feed_mm_per_s = 10.0;
    double limited = 5.0;
    double positive_mm = 1.0;
    std::int64_t count = 3;
    bool on = true;
    std::string name = "a \"name\"";
    std::array<double, 3> direction{0.0, 0.0, 1.0};
    std::array<double, 2> size_mm{1.0, 2.0};
    std::vector<double> angles_rad;
    std::vector<std::string> names{"x"};
    std::map<std::string, double> rotary_rad;
    std::optional<double> spare_mm;
    std::optional<std::string> remark;
    Colour colour = Colour::Green;
    std::optional<Colour> second_colour;
    Axis axis;
    std::optional<Axis> tail;
    std::vector<Step> steps{Step{"first", {}}};
    std::map<std::string, Axis> axes;

    bool operator==(const Everything&) const = default;
};

inline const Section<Axis>& axisSection() {
    static const Section<Axis> section = [] {
        Section<Axis> out("A rotary axis.");
        out.field("min_deg", &Axis::min_rad, "Lower end of travel.");
        out.field("max_deg", &Axis::max_rad, "Upper end of travel.");
        out.field("home_deg", &Axis::home_rad, "Where it rests.");
        out.check([](const Axis& axis, const TomlNode& table, Diagnostics& report) {
            if (axis.min_rad > axis.max_rad)
                report.error("test.order", "the lower end lies above the upper end", table.whereKey("min_deg"));
        });
        return out;
    }();
    return section;
}

inline const Section<Everything>& everythingSection() {
    using Colour = Everything::Colour;
    static const Section<Everything> section = [] {
        Section<Step> step("One step.");
        step.field("name", &Step::name, "What it is called.", required());
        step.table("axis", &Step::axis, axisSection());
        Section<Everything> out("Everything.");
        out.field("plain", &Everything::plain, "A number without a unit.");
        out.field("lead_deg", &Everything::lead_rad, "An angle.", {.min = -180.0, .max = 180.0});
        out.field("feed_mm_per_min", &Everything::feed_mm_per_s, "A feed.");
        out.field("limited", &Everything::limited, "A number in bounds.",
                  {.min = 0.0, .max = 10.0, .min_exclusive = true});
        out.field("positive_mm", &Everything::positive_mm, "A length.", positive());
        out.field("count", &Everything::count, "A count.", {.min = 1.0});
        out.field("on", &Everything::on, "A switch.");
        out.field("name", &Everything::name, "A text.");
        out.field("direction", &Everything::direction, "Three numbers.");
        out.field("size_mm", &Everything::size_mm, "Two numbers.");
        out.field("angles_deg", &Everything::angles_rad, "Any number of angles.");
        out.field("names", &Everything::names, "Any number of texts.");
        out.field("rotary_deg", &Everything::rotary_rad, "Angles by name.");
        out.field("spare_mm", &Everything::spare_mm, "A length, or none.");
        out.field("remark", &Everything::remark, "A text, or none.");
        out.choice("colour", &Everything::colour, {{"red", Colour::Red}, {"green", Colour::Green}}, "A colour.");
        out.choice("second_colour", &Everything::second_colour, {{"red", Colour::Red}, {"green", Colour::Green}},
                   "A colour, or none.");
        out.table("axis", &Everything::axis, axisSection());
        out.table("tail", &Everything::tail, axisSection());
        out.tables("step", &Everything::steps, step);
        out.named("axes", &Everything::axes, axisSection());
        return out;
    }();
    return section;
}

/// Reads a text that may have schema errors; a syntax error ends up in the report too.
inline Everything readEverything(std::string_view text, Diagnostics& report, const std::string& file = "T.toml") {
    const Result<TomlDocument> document = TomlDocument::parse(text, file);
    if (document) return everythingSection().read(document->root(), report);
    report.append(document.error());
    return {};
}

}  // namespace cusp::base::testing
